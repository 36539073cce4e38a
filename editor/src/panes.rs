//! The parts of the window. Each reads the session and returns what a person does there as actions.

pub(crate) mod accuracy;
pub(crate) mod canvas;
pub(crate) mod code;
pub(crate) mod cost;
pub(crate) mod functions;
pub(crate) mod inspector;
pub(crate) mod library;
pub(crate) mod problems;
pub(crate) mod viewport;

use eframe::egui;

/// A button that stays down: what it does is on until it is pressed again.
pub(crate) fn toggle(ui: &mut egui::Ui, on: &mut bool, text: impl Into<String>) -> egui::Response {
    let mut response = ui.add(egui::Button::selectable(*on, text.into()).frame_when_inactive(true));
    if response.clicked() {
        *on = !*on;
        response.mark_changed();
    }
    response
}
