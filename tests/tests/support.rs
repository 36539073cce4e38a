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

/// An example as it stands, or, where it reads others' models, a copy that finds them in the data; none where they are not there. A
/// copy, for what an example says is `../shared/data` beside the project, and the data may lie elsewhere.
pub(crate) fn with_models(example: PathBuf) -> Option<PathBuf> {
    let name = example.file_name()?.to_str()?;
    if !name.starts_with("flight-helmet") {
        return Some(example);
    }
    let models = data("models")?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("flight-helmet");
    std::fs::create_dir_all(&folder).expect("a folder for the copy");
    // The scene names the material.
    for name in ["flight-helmet.scene.json", "flight-helmet-leather.material.json"] {
        let text = std::fs::read_to_string(example.with_file_name(name)).expect("an example");
        let found = text.replace("../../shared/data/models", models.to_str().expect("a path of characters"));
        assert_ne!(found, text, "{name} has its models elsewhere");
        // Renamed into place, for another process may be reading it.
        let written = folder.join(format!("{name}.{}", std::process::id()));
        std::fs::write(&written, found).and_then(|()| std::fs::rename(&written, folder.join(name))).expect("a copy");
    }
    Some(folder.join(name))
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
