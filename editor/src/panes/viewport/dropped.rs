//! Files and materials that are dropped on the picture.

use std::path::{Path, PathBuf};

use eframe::egui;
use halfvector_scene::{EnvironmentSource, MeshSource};

use super::Viewport;
use crate::action::Action;
use crate::library::LibraryMaterial;

/// What a file is to the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Model,
    Environment,
    /// An environment when it falls on the picture, something else elsewhere.
    Picture,
}

/// Whether the file can be something to the picture.
pub(crate) fn is_taken(path: &Path) -> bool {
    kind(path).is_some()
}

fn kind(path: &Path) -> Option<Kind> {
    match path.extension()?.to_str()?.to_lowercase().as_str() {
        "glb" | "gltf" => Some(Kind::Model),
        "hdr" | "exr" | "hdre" | "ktx2" => Some(Kind::Environment),
        "png" | "jpg" | "jpeg" => Some(Kind::Picture),
        _ => None,
    }
}

impl Viewport {
    /// Takes models and environments that were dropped on the window, pictures only over this part, and materials of the
    /// library.
    pub(super) fn take_dropped(&mut self, ui: &egui::Ui, response: &egui::Response, actions: &mut Vec<Action>) {
        let files: Vec<PathBuf> =
            ui.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_owned()).collect());
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let is_here = pointer.is_none_or(|place| response.rect.contains(place));
        for file in files {
            match kind(&file) {
                Some(Kind::Model) => self.set_mesh(MeshSource::File(file)),
                Some(Kind::Environment) => self.set_environment(EnvironmentSource::File(file)),
                Some(Kind::Picture) if is_here => self.set_environment(EnvironmentSource::File(file)),
                _ => {}
            }
        }
        if response.dnd_hover_payload::<LibraryMaterial>().is_some() {
            let stroke = egui::Stroke::new(2.0, crate::theme::ACCENT);
            ui.ctx().layer_painter(ui.layer_id()).rect_stroke(response.rect, 0.0, stroke, egui::StrokeKind::Inside);
        }
        if let Some(material) = response.dnd_release_payload::<LibraryMaterial>() {
            Viewport::wear(&material, actions);
        }
    }
}
