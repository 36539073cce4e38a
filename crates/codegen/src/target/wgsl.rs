//! WGSL: the shader as it is.

use super::{ExportError, OutputFile, Source, Target, file, json, same};

pub(super) const TARGET: Target = Target { name: "wgsl", help: "WGSL, both stages in one file", needs: same, write };

fn write(source: &Source<'_>, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let code = file(format!("{name}.wgsl"), source.shader.wgsl.clone());
    Ok(vec![code, json::reflection(source, name, TARGET.name, None)])
}
