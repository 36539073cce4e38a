//! What the editor remembers of its user: theme, scale, layout, recent files.

use std::fs::OpenOptions;
use std::path::{Path, PathBuf};

use eframe::egui;
use serde::{Deserialize, Serialize};

use crate::app::Pane;

/// Most files in the list of recent ones.
const MAX_RECENT: usize = 12;

/// All that is remembered. A field that is missing in the file has its default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    /// Dark, light, or as the system has it.
    pub(crate) theme: egui::ThemePreference,
    /// Size of everything: 1 is as the system has it.
    pub(crate) scale: f32,
    /// Files that were opened or saved, the last one first.
    pub(crate) recent: Vec<PathBuf>,
    /// The folder that file dialogs open with.
    pub(crate) last_folder: Option<PathBuf>,
    /// The parts of the window.
    pub(crate) layout: Option<egui_tiles::Tree<Pane>>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            theme: egui::ThemePreference::System,
            scale: 1.0,
            recent: Vec::new(),
            last_folder: None,
            layout: None,
        }
    }
}

impl Settings {
    /// The settings of a folder; defaults when there are none. Settings that cannot be read are defaults too, and why is said.
    pub(crate) fn load(folder: &Path) -> (Settings, Option<String>) {
        let path = path(folder);
        let text = match std::fs::read(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return (Settings::default(), None),
            Err(error) => return (Settings::default(), Some(format!("{} could not be read: {error}", path.display()))),
        };
        match serde_json::from_slice::<Settings>(&text) {
            Ok(settings) => (settings.sound(), None),
            Err(error) => {
                let why = format!("{} is passed over: {error}; delete it to be rid of this message", path.display());
                (Settings::default(), Some(why))
            }
        }
    }

    /// Writes what has changed `since` then, whole or not at all: what other windows have written stays.
    pub(crate) fn save_since(self, since: &Settings, folder: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        // One window after the other; it is unlocked when it is closed.
        let lock = OpenOptions::new().write(true).create(true).truncate(false).open(folder.join("editor.lock"))?;
        lock.lock()?;
        let there = std::fs::read(path(folder)).ok().and_then(|text| serde_json::from_slice::<Settings>(&text).ok());
        let settings = match there {
            Some(there) => self.merged(since, there),
            None => self,
        };
        let mut text = serde_json::to_vec_pretty(&settings)?;
        text.push(b'\n');
        halfvector_graph::file::replace(&path(folder), &text)
    }

    /// What others have written, with what has changed here since.
    fn merged(self, since: &Settings, theirs: Settings) -> Settings {
        fn one<T: PartialEq>(now: T, before: &T, theirs: T) -> T {
            if now == *before { theirs } else { now }
        }
        let mut recent = theirs.recent;
        if self.recent.is_empty() {
            recent = if since.recent.is_empty() { recent } else { Vec::new() };
        } else if self.recent != since.recent {
            // Opened here since: the last one comes first.
            let known = self.recent.iter().position(|file| Some(file) == since.recent.first());
            let fresh = &self.recent[..known.unwrap_or(self.recent.len())];
            let gone =
                |file: &PathBuf| fresh.contains(file) || (since.recent.contains(file) && !self.recent.contains(file));
            recent.retain(|file| !gone(file));
            recent.splice(0..0, fresh.iter().cloned());
            recent.truncate(MAX_RECENT);
        }
        Settings {
            theme: one(self.theme, &since.theme, theirs.theme),
            scale: one(self.scale, &since.scale, theirs.scale),
            recent,
            last_folder: one(self.last_folder, &since.last_folder, theirs.last_folder),
            layout: one(self.layout, &since.layout, theirs.layout),
        }
    }

    /// Puts a file at the top of the recent ones.
    pub(crate) fn remember(&mut self, file: &Path) {
        self.recent.retain(|recent| recent != file);
        // JSON holds text only.
        if file.to_str().is_some() {
            self.recent.insert(0, file.to_owned());
            self.recent.truncate(MAX_RECENT);
        }
        if let Some(folder) = file.parent().filter(|folder| folder.to_str().is_some()) {
            self.last_folder = Some(folder.to_owned());
        }
    }

    /// With numbers that a window can be drawn with, whatever stood in the file.
    fn sound(mut self) -> Settings {
        self.scale = if self.scale.is_finite() { self.scale.clamp(0.5, 3.0) } else { 1.0 };
        self.recent.truncate(MAX_RECENT);
        self
    }
}

fn path(folder: &Path) -> PathBuf {
    folder.join("editor.json")
}
