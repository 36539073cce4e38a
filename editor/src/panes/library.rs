//! The library: materials with their pictures. A click opens one as new, a drag puts it on the model.

use eframe::egui::{self, Sense};

use crate::action::Action;
use crate::library::{LibraryMaterial, materials};
use crate::theme;
use crate::thumbnails::Thumbnails;

/// Edge of a picture [points].
const CARD: f32 = 92.0;

/// The list of materials.
#[derive(Debug, Default)]
pub(crate) struct LibraryPane {
    search: String,
}

impl LibraryPane {
    /// Draws the list.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, thumbnails: &mut Thumbnails, actions: &mut Vec<Action>) {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            let search = egui::TextEdit::singleline(&mut self.search).hint_text("Search materials");
            let field = ui.add(search.desired_width(f32::INFINITY));
            field.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::TextEdit, true, "Search materials"));
            field.on_hover_text("Names, kinds and other words: gold, cloth, wet, template …");
            ui.add_space(4.0);
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                let mut found: Vec<&LibraryMaterial> =
                    materials().iter().filter(|material| material.is_found_by(&self.search)).collect();
                if found.is_empty() {
                    ui.weak("No material has all of these words.");
                }
                while let Some(first) = found.first() {
                    let shelf = first.shelf;
                    let count = found.iter().take_while(|material| material.shelf == shelf).count();
                    ui.weak(shelf);
                    ui.horizontal_wrapped(|ui| {
                        ui.spacing_mut().item_spacing = egui::vec2(8.0, 8.0);
                        for material in found.drain(..count) {
                            card(ui, material, thumbnails, actions);
                        }
                    });
                    ui.add_space(6.0);
                }
            });
        });
    }
}

fn card(ui: &mut egui::Ui, material: &LibraryMaterial, thumbnails: &mut Thumbnails, actions: &mut Vec<Action>) {
    let name = &material.document.name;
    let (rect, response) = ui.allocate_exact_size(egui::vec2(CARD, CARD + 18.0), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, name));
    if !ui.is_rect_visible(rect) {
        return;
    }
    let picture = egui::Rect::from_min_size(rect.min, egui::Vec2::splat(CARD));
    thumbnails.paint_material(ui, picture, material.id, &material.document, std::path::Path::new(""));
    if response.hovered() || response.has_focus() {
        let stroke = egui::Stroke::new(1.5, theme::ACCENT);
        ui.painter().rect_stroke(picture, 4.0, stroke, egui::StrokeKind::Inside);
    }
    let font = egui::FontId::proportional(11.5);
    let color = ui.visuals().text_color();
    let mut text = egui::text::LayoutJob::simple_singleline(name.clone(), font, color);
    text.wrap = egui::text::TextWrapping::truncate_at_width(CARD);
    let galley = ui.painter().layout_job(text);
    let left = rect.center().x - 0.5 * galley.size().x;
    ui.painter().galley(egui::pos2(left, picture.bottom() + 3.0), galley, color);
    response.dnd_set_drag_payload(material.clone());
    if response.clicked() {
        actions.push(Action::NewFrom(material.document.clone()));
    }
    response.on_hover_text(format!("{name}: click to open it as a new material, or drag it on to the model"));
}
