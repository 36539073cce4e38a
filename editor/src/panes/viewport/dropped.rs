//! Files and materials that are dropped on the picture.

use eframe::egui;
use halfvector_scene::{EnvironmentSource, MeshSource};

use super::Viewport;
use crate::action::Action;
use crate::dropped::{Kind, take};
use crate::library::LibraryMaterial;

impl Viewport {
    /// Takes models and environments that were dropped on the window, pictures only over this part, and materials of the
    /// library.
    pub(super) fn take_dropped(&mut self, ui: &egui::Ui, response: &egui::Response, actions: &mut Vec<Action>) {
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let is_here = pointer.is_none_or(|place| response.rect.contains(place));
        for file in take(ui.ctx(), |kind| kind == Kind::Model) {
            self.set_mesh(MeshSource::File(file));
        }
        for file in take(ui.ctx(), |kind| {
            kind == Kind::Environment || (matches!(kind, Kind::Picture | Kind::Radiance) && is_here)
        }) {
            self.set_environment(EnvironmentSource::File(file));
        }
        if response.dnd_hover_payload::<LibraryMaterial>().is_some() {
            let stroke = egui::Stroke::new(2.0, crate::theme::ACCENT);
            ui.ctx().layer_painter(ui.layer_id()).rect_stroke(response.rect, 0.0, stroke, egui::StrokeKind::Inside);
        }
        if let Some(material) = response.dnd_release_payload::<LibraryMaterial>() {
            Viewport::wear(&material, actions);
        }
    }
    /// Takes the environments that no other part has taken for a picture.
    pub(crate) fn take_left(&mut self, context: &egui::Context) {
        for file in take(context, |kind| kind == Kind::Radiance) {
            self.set_environment(EnvironmentSource::File(file));
        }
    }
}
