//! What is written over the picture: who drew it, progress, faults, and what the selected node gives.

use eframe::egui::{self, Color32};
use halfvector_graph::docs::capitalised;
use halfvector_graph::value::SocketType;

use super::Viewport;

use crate::session::Session;
use crate::theme;
use crate::thumbnails::Thumbnails;

impl Viewport {
    /// What is written over the picture: who drew it, progress, faults.
    pub(super) fn overlays(&mut self, ui: &mut egui::Ui, rect: egui::Rect) {
        let side = &self.sides[0];
        let mut text = String::new();
        if let Some(shown) = &side.shown
            && !self.compare.is_on()
        {
            let compiled = if shown.is_compiled { " · new shader" } else { "" };
            text = format!("{} · {:.0} ms{compiled}", shown.by, shown.milliseconds);
            if let Some(noise) = &shown.noise {
                text = format!("{} · {}", shown.by, noise.words());
            }
        }
        let color = ui.visuals().weak_text_color();
        let mut line = egui::text::LayoutJob::simple_singleline(text, egui::FontId::proportional(11.0), color);
        line.wrap = egui::text::TextWrapping::truncate_at_width((rect.width() - 16.0).max(0.0));
        let galley = ui.painter().layout_job(line);
        let corner = rect.left_bottom() + egui::vec2(8.0, -6.0 - galley.size().y);
        ui.painter().galley(corner, galley, color);
        let mut lines: Vec<(String, Color32)> = Vec::new();
        let faults = self.sides.iter().filter_map(|side| side.fault.as_ref());
        lines.extend(faults.map(|fault| (fault.text().to_owned(), theme::ERROR)));
        let count = if self.compare.is_on() { 2 } else { 1 };
        let noises = self.sides[..count].iter().filter_map(|side| side.shown.as_ref()?.noise.as_ref());
        let mut strange: Vec<&String> = noises.flat_map(|noise| noise.faults.iter()).collect();
        strange.dedup();
        lines.extend(strange.into_iter().map(|fault| (capitalised(fault), theme::WARNING)));
        let place = rect.left_top() + egui::vec2(8.0, 8.0);
        let builder = egui::UiBuilder::new()
            .max_rect(egui::Rect::from_min_size(place, egui::vec2((rect.width() - 16.0).max(40.0), rect.height())));
        ui.scope_builder(builder, |ui| {
            if let Some(done) = self.environments.progress() {
                note(ui, theme::ACCENT, |ui| {
                    ui.label(format!("Preparing the environment: {:.0} %", done * 100.0));
                    if ui.button("Cancel").on_hover_text("The picture keeps the environment that it has").clicked() {
                        self.environments.cancel();
                        self.stage.environment = self.good.1.clone();
                    }
                });
            }
            for (line, color) in lines {
                note(ui, color, |ui| {
                    let first = line.lines().next().unwrap_or_default().to_owned();
                    ui.label(first).on_hover_text(egui::RichText::new(line).monospace());
                });
            }
            if let Some(why) = self.gpu.trouble() {
                note(ui, theme::WARNING, |ui| {
                    ui.label(format!("Drawn on the CPU: {why}"));
                    if ui.button("Try the GPU again").on_hover_text("Opens the graphics card anew").clicked() {
                        self.draw_on_cpu(false);
                    }
                });
            }
            if let Some(banner) = self.banner.clone() {
                note(ui, theme::ERROR, |ui| {
                    ui.label(banner);
                    if ui.button("Dismiss").on_hover_text("Removes this message").clicked() {
                        self.banner = None;
                    }
                });
            }
        });
    }
}

/// What the selected node gives, in the corner of the picture: its outputs one beside the other.
pub(super) fn selected(ui: &mut egui::Ui, rect: egui::Rect, session: &Session, thumbnails: &mut Thumbnails) {
    // Small in a small picture, and above the line that says who drew it.
    let edge = (rect.height() * 0.2).min(72.0);
    let mut nodes = session.selection().iter();
    let (Some(id), None) = (nodes.next(), nodes.next()) else { return };
    let Some(definition) = session.node(id).and_then(|node| session.library().get(&node.node)) else { return };
    let outputs = definition.outputs.iter().filter(|output| output.ty != SocketType::Surface).take(3);
    let mut right = rect.right() - 8.0;
    for output in outputs {
        let corner = egui::pos2(right - edge, rect.bottom() - edge - 26.0);
        let place = egui::Rect::from_min_size(corner, egui::Vec2::splat(edge));
        if place.left() < rect.center().x || edge < 32.0 {
            return;
        }
        ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| {
            let response = thumbnails.show(ui, session, id, &output.name, edge);
            response.on_hover_text(format!("{}: {}", output.name, output.help));
        });
        ui.painter().rect_stroke(place, 4.0, egui::Stroke::new(1.0, theme::ACCENT), egui::StrokeKind::Outside);
        right = place.left() - 6.0;
    }
}

/// A message with a stroke of its colour, over the picture.
fn note(ui: &mut egui::Ui, color: Color32, add: impl FnOnce(&mut egui::Ui)) {
    egui::Frame::new()
        .fill(ui.visuals().window_fill.gamma_multiply(0.94))
        .stroke(egui::Stroke::new(1.0, color))
        .corner_radius(4)
        .inner_margin(egui::Margin::symmetric(8, 4))
        .show(ui, |ui| ui.horizontal_wrapped(add));
    ui.add_space(2.0);
}
