//! Examples that need others' models, for the tests of several packages, which take this file in by its path.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// An example as it stands, or, where it reads others' models, a copy that finds them in the data folder's `models`; none where it
/// is not there. A copy, for what an example says is `../shared/data` beside the project, and the data may lie elsewhere.
pub(crate) fn with_models(example: PathBuf, models: impl FnOnce() -> Option<PathBuf>) -> Option<PathBuf> {
    /// No two copies that are on their way have one name.
    static COPIES: AtomicU32 = AtomicU32::new(0);
    let name = example.file_name()?.to_str()?;
    if !name.starts_with("flight-helmet") {
        return Some(example);
    }
    let models = models()?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("flight-helmet");
    std::fs::create_dir_all(&folder).expect("a folder for the copy");
    // The scene names the material.
    for name in ["flight-helmet.scene.json", "flight-helmet-leather.material.json"] {
        let text = std::fs::read_to_string(example.with_file_name(name)).expect("an example");
        let found = text.replace("../../shared/data/models", models.to_str().expect("a path of characters"));
        assert_ne!(found, text, "{name} has its models elsewhere");
        // Renamed into place, for another test or process may be reading it.
        let copy = COPIES.fetch_add(1, Ordering::Relaxed);
        let written = folder.join(format!("{name}.{}.{copy}", std::process::id()));
        std::fs::write(&written, found).and_then(|()| std::fs::rename(&written, folder.join(name))).expect("a copy");
    }
    Some(folder.join(name))
}
