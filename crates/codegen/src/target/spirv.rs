//! SPIR-V, one module for each stage, without names and debug lines.

use naga::back::spv;

use super::{ExportError, OutputFile, Source, Target, file, json, same};

pub(super) const TARGET: Target =
    Target { name: "spirv", help: "SPIR-V 1.0 for Vulkan, one module a stage", needs: same, write };

fn write(source: &Source<'_>, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let fail = |e: spv::Error| ExportError::Backend { target: TARGET.name, message: e.to_string() };
    let mut files = Vec::new();
    for (stage, entry_point, ending) in Source::STAGES {
        let alone = source.stage(stage, TARGET.name)?;
        let options = spv::Options {
            flags: spv::WriterFlags::empty(),
            // Every loop of ours counts to a constant.
            force_loop_bounding: false,
            ..spv::Options::default()
        };
        let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: entry_point.into() };
        let words = spv::write_vec(&alone.module, &alone.info, &options, Some(&pipeline)).map_err(fail)?;
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        files.push(file(format!("{name}.{ending}.spv"), bytes));
    }
    files.push(json::reflection(source, name, TARGET.name, None));
    Ok(files)
}
