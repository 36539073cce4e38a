//! What several kinds of test share: where things are, and what may be skipped.

use std::path::{Path, PathBuf};

/// Root of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the workspace").to_path_buf()
}

/// Whether a variable asks that what is missing is a failure.
pub(crate) fn required(variable: &str) -> bool {
    std::env::var(variable).is_ok_and(|v| v == "1")
}

/// Whether committed files are to be written anew.
pub(crate) fn bless() -> bool {
    required("HALFVECTOR_BLESS")
}

/// A file or folder of the data beside the project, or none with a printed line.
pub(crate) fn data(path: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("HALFVECTOR_DATA").map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let path = folder.join(path);
    if path.exists() {
        Some(path)
    } else {
        println!("skipped: {} is not there", path.display());
        None
    }
}

/// [`crate::models::with_models`] with the models of the data folder.
pub(crate) fn with_models(example: PathBuf) -> Option<PathBuf> {
    crate::models::with_models(example, || data("models"))
}

/// A renderer on the GPU of this machine, a software one included, or none with a printed line.
/// `HALFVECTOR_REQUIRE_GPU=1`: none is a failure.
pub(crate) fn renderer() -> Option<halfvector_render::Renderer> {
    match halfvector_render::Renderer::new() {
        Ok(renderer) => Some(renderer),
        Err(error) => {
            assert!(!required("HALFVECTOR_REQUIRE_GPU"), "{error}");
            println!("skipped: {error}");
            None
        }
    }
}
