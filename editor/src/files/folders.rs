//! Where the editor keeps files of its own.

use std::path::PathBuf;

/// Folders of the editor's own files. What has no folder is not kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Folders {
    /// For `editor.json`: theme, layout, recent files.
    pub settings: Option<PathBuf>,
    /// For records of open windows: unsaved work that is offered after a crash, and by which windows notice each other.
    pub recovery: Option<PathBuf>,
}

impl Folders {
    /// The user's, where the system wants them: on Linux by the XDG base directory specification, on macOS in `Library`,
    /// on Windows in `AppData`.
    pub fn of_user() -> Folders {
        let variable = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
        let (config, state) = if cfg!(windows) {
            (variable("APPDATA"), variable("LOCALAPPDATA"))
        } else if cfg!(target_os = "macos") {
            let support = variable("HOME").map(|home| home.join("Library/Application Support"));
            (support.clone(), support)
        } else {
            let home = variable("HOME");
            let below = |path: &str| home.as_ref().map(|home| home.join(path));
            (
                variable("XDG_CONFIG_HOME").or_else(|| below(".config")),
                variable("XDG_STATE_HOME").or_else(|| below(".local/state")),
            )
        };
        Folders {
            settings: config.map(|folder| folder.join("halfvector")),
            recovery: state.map(|folder| folder.join("halfvector").join("recovery")),
        }
    }
}
