//! The punctual lights: their list, and their handles in the picture.

use eframe::egui::{self, Color32, Sense};

use super::Viewport;
use crate::stage::{Lamp, LampKind};
use crate::written::{self, Kind};

/// Radius of a handle [points].
const HANDLE: f32 = 8.0;

impl Viewport {
    /// The list with what can be set, as the content of a menu.
    pub(super) fn lamp_list(&mut self, ui: &mut egui::Ui) {
        ui.set_min_width(250.0);
        ui.horizontal(|ui| {
            for kind in LampKind::ALL {
                let button = ui.button(format!("Add {}", kind.label().to_lowercase()));
                if button.on_hover_text("Adds a light; drag its handle in the picture").clicked() {
                    self.stage.lamps.push(Lamp::new(kind));
                    self.selected_lamp = Some(self.stage.lamps.len() - 1);
                }
            }
        });
        if self.stage.lamps.is_empty() {
            ui.weak("No lights: the environment alone.");
        }
        let mut removed = None;
        for (number, lamp) in self.stage.lamps.iter_mut().enumerate() {
            ui.separator();
            ui.push_id(number, |ui| {
                ui.horizontal(|ui| {
                    ui.checkbox(&mut lamp.is_on, format!("{} {}", lamp.kind.label(), number + 1))
                        .on_hover_text("Whether it shines");
                    ui.color_edit_button_rgb(&mut lamp.color).on_hover_text("Colour");
                    let speed = 0.01 * f64::from(lamp.brightness.max(0.5));
                    let kind = Kind { unit: lamp.kind.unit(), ..Kind::default() };
                    let place = |ui: &mut egui::Ui, drag: egui::DragValue<'_>| {
                        ui.add(drag.range(0.0..=1e6).speed(speed).max_decimals(2)).on_hover_text("Brightness")
                    };
                    written::drag(ui, &mut lamp.brightness, kind, place);
                    if ui.button("Remove").on_hover_text("Removes the light").clicked() {
                        removed = Some(number);
                    }
                });
                if lamp.kind == LampKind::Spot {
                    ui.horizontal(|ui| {
                        ui.label("Cone")
                            .on_hover_text("Full within the first angle from its axis, none beyond the second");
                        for angle in &mut lamp.cone {
                            let kind = Kind { unit: "°", ..Kind::default() };
                            let place = |ui: &mut egui::Ui, drag: egui::DragValue<'_>| {
                                ui.add(drag.range(0.5..=90.0).speed(0.2))
                            };
                            written::drag(ui, angle, kind, place);
                        }
                        lamp.cone[1] = lamp.cone[1].max(lamp.cone[0]);
                    });
                }
            });
        }
        if let Some(removed) = removed {
            self.stage.lamps.remove(removed);
            self.selected_lamp = None;
        }
    }

    /// The handles: a disc of the light's colour where it is, or in its direction.
    pub(super) fn lamp_handles(&mut self, ui: &egui::Ui, rect: egui::Rect) {
        let orbit = self.stage.orbit.within(rect.aspect_ratio());
        let screen = |share: [f32; 2]| rect.center() + egui::vec2(share[0], -share[1]) * rect.height();
        for (number, lamp) in self.stage.lamps.iter_mut().enumerate() {
            let Some(place) = orbit.project(lamp.handle(&orbit)).map(screen) else { continue };
            // One outside of the picture waits at its edge.
            let place = place.clamp(rect.min + egui::Vec2::splat(HANDLE), rect.max - egui::Vec2::splat(HANDLE));
            let area = egui::Rect::from_center_size(place, egui::Vec2::splat(2.5 * HANDLE));
            let response = ui.interact(area, ui.id().with(("lamp", number)), Sense::click_and_drag());
            let name = format!("{} light {}", lamp.kind.label(), number + 1);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, &name));
            if response.drag_started() || response.clicked() {
                self.selected_lamp = Some(number);
            }
            if response.dragged() {
                let drag = response.drag_delta() / rect.height().max(1.0);
                lamp.drag(&orbit, drag.x, -drag.y);
            }
            let is_selected = self.selected_lamp == Some(number);
            let [r, g, b] = lamp.color.map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8);
            let fill = if lamp.is_on { Color32::from_rgb(r, g, b) } else { Color32::TRANSPARENT };
            let painter = ui.painter().with_clip_rect(rect);
            let ring = if is_selected || response.hovered() { crate::theme::ACCENT } else { Color32::from_gray(40) };
            if lamp.kind == LampKind::Spot
                && let Some(target) = orbit.project(lamp.target).map(screen)
            {
                painter.line_segment([place, target], egui::Stroke::new(1.0, ring.gamma_multiply(0.6)));
            }
            painter.circle(place, HANDLE, fill, egui::Stroke::new(2.0, ring));
            response.on_hover_text(format!("{name}: drag it"));
        }
    }
}
