//! The file dialog: which files it shows, where it opens, and what is done with the file that is chosen.

use std::path::{Path, PathBuf};

use eframe::egui;
use egui_file_dialog::{FileDialog, Filter};

use crate::action::{Action, Choose};
use crate::app::Editor;
use crate::app::files::Next;
use crate::app::questions::Question;
use crate::files::clerk::Order;
use crate::pictures;

/// How the names of materials end.
const ENDING: &str = ".material.json";
/// How the names of groups end.
const GROUP_ENDING: &str = ".group.json";
/// Endings of pictures that can be read.
const PICTURES: &[&str] = &["png", "jpg", "jpeg", "tif", "tiff", "webp", "tga", "bmp"];

/// An open file dialog.
pub(crate) struct Chooser {
    dialog: FileDialog,
    purpose: Choose,
}

impl Editor {
    /// Opens the dialog.
    pub(crate) fn choose(&mut self, purpose: Choose) {
        let folder = self.session.file().and_then(Path::parent).map(Path::to_owned);
        let folder = folder.or_else(|| self.files.settings.last_folder.clone()).filter(|folder| folder.is_dir());
        let folder = folder.or_else(|| std::env::current_dir().ok()).unwrap_or_default();
        let mut dialog = FileDialog::new()
            .initial_directory(folder)
            .default_size([760.0, 480.0])
            .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0]);
        let is_material = |path: &Path| path.to_str().is_some_and(|name| name.ends_with(ENDING));
        let is_group = |path: &Path| path.to_str().is_some_and(|name| name.ends_with(GROUP_ENDING));
        match &purpose {
            Choose::Open => {
                dialog = dialog
                    .title("Open a material")
                    .add_file_filter("Materials", Filter::new(is_material))
                    .default_file_filter("Materials");
                dialog.pick_file();
            }
            Choose::SaveAs => {
                dialog = dialog.title("Save the material").default_file_name(&self.proposed_name());
                dialog.save_file();
            }
            Choose::Group => {
                dialog = dialog
                    .title("Add a group")
                    .add_file_filter("Groups", Filter::new(is_group))
                    .default_file_filter("Groups");
                dialog.pick_file();
            }
            Choose::SaveGroup(id) => {
                let label = self.session.document().groups.get(id).map_or("", |group| &group.interface.label);
                let name = named(if label.is_empty() { id } else { label }, "group", GROUP_ENDING);
                dialog = dialog.title("Save the group").default_file_name(&name);
                dialog.save_file();
            }
            Choose::Image(_) => {
                let is_picture = |path: &Path| {
                    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
                    PICTURES.contains(&ending.to_ascii_lowercase().as_str())
                };
                dialog = dialog
                    .title("Choose a picture")
                    .add_file_filter("Pictures", Filter::new(is_picture))
                    .default_file_filter("Pictures");
                dialog.pick_file();
            }
            Choose::ExportFolder => {
                dialog = dialog.title("Export into a folder");
                dialog.pick_directory();
            }
        }
        self.files.chooser = Some(Chooser { dialog, purpose });
    }

    /// Draws the dialog and takes what is chosen.
    pub(crate) fn show_chooser(&mut self) {
        let Some(chooser) = &mut self.files.chooser else { return };
        chooser.dialog.update(&self.context);
        if let Some(path) = chooser.dialog.take_picked() {
            let purpose = chooser.purpose.clone();
            self.files.chooser = None;
            self.chosen(purpose, path);
        } else if !matches!(chooser.dialog.state(), egui_file_dialog::DialogState::Open) {
            self.files.chooser = None;
            self.cancel();
        }
    }

    fn chosen(&mut self, purpose: Choose, path: PathBuf) {
        match purpose {
            Choose::Open => self.ask(Next::Open(path)),
            Choose::SaveAs => {
                // The dialog has asked about a file that is there, but of the name that was typed.
                let whole = with_ending(path.clone(), ENDING);
                if whole != path && whole.exists() {
                    self.files.question = Some(Question::Replace(whole));
                } else {
                    self.save_as(whole, true);
                }
            }
            Choose::Group => self.files.order(Order::ReadGroup(path)),
            Choose::SaveGroup(id) => {
                let whole = with_ending(path.clone(), GROUP_ENDING);
                if whole != path && whole.exists() {
                    let whole = whole.display();
                    self.messages.fail(format!("{whole} is there already: choose it by its whole name to replace it"));
                } else {
                    self.act(Action::SaveGroup(id, whole));
                }
            }
            Choose::Image(socket) => {
                self.act(pictures::chosen(&self.session, &socket, &path));
            }
            Choose::ExportFolder => self.export_to(path),
        }
    }

    fn proposed_name(&self) -> String {
        if let Some(name) = self.session.file().and_then(Path::file_name) {
            return name.to_string_lossy().into_owned();
        }
        named(&self.session.document().name, "material", ENDING)
    }
}

/// A file's name of words, or another where there is none.
fn named(words: &str, otherwise: &str, ending: &str) -> String {
    let name: String = words.to_lowercase().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    format!("{}{ending}", if name.is_empty() { otherwise } else { &name })
}

/// The path with an ending such as `.material.json`; what stands there of it already is not repeated.
fn with_ending(path: PathBuf, ending: &str) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if name.ends_with(ending) {
        return path;
    }
    let name = name.strip_suffix(".json").unwrap_or(&name);
    let name = name.strip_suffix(ending.trim_end_matches(".json")).unwrap_or(name);
    path.with_file_name(format!("{name}{ending}"))
}
