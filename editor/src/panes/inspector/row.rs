//! Rows of the inspector: a name at the left, what sets it in the middle, a menu at the right.

use eframe::egui::{self, Color32, Response, RichText};

use crate::action::Action;

/// Share of the width that names take.
const NAME_SHARE: f32 = 0.36;
/// Width of the menu's button.
const MENU_WIDTH: f32 = 22.0;

/// Names of sockets as people write them: `base_color` becomes "base color".
pub(crate) fn in_words(name: &str) -> String {
    name.replace('_', " ")
}

/// Draws a row: dot and name, the widget, the menu. The widget is given the name's id, for its label.
pub(crate) fn row<R>(
    ui: &mut egui::Ui,
    name: RichText,
    hint: &str,
    dot: Option<Color32>,
    add_widget: impl FnOnce(&mut egui::Ui, egui::Id) -> R,
    add_menu: Option<&mut dyn FnMut(&mut egui::Ui)>,
) -> R {
    ui.horizontal(|ui| {
        let whole = ui.available_width();
        let height = ui.spacing().interact_size.y;
        let name_width = (whole * NAME_SHARE).clamp(70.0, 180.0);
        let label = ui
            .allocate_ui_with_layout(
                egui::vec2(name_width, height),
                egui::Layout::left_to_right(egui::Align::Center),
                |ui| {
                    ui.set_min_width(name_width);
                    if let Some(color) = dot {
                        let (rect, _) = ui.allocate_exact_size(egui::vec2(8.0, height), egui::Sense::hover());
                        ui.painter().circle_filled(rect.center(), 3.5, color);
                    }
                    ui.add(egui::Label::new(name).truncate())
                },
            )
            .inner;
        let label = if hint.is_empty() { label } else { label.on_hover_text(hint) };
        let menu_width = if add_menu.is_some() { MENU_WIDTH + ui.spacing().item_spacing.x } else { 0.0 };
        let width = (ui.available_width() - menu_width).max(60.0);
        let result = ui
            .allocate_ui_with_layout(
                egui::vec2(width, height),
                egui::Layout::left_to_right(egui::Align::Center),
                |ui| {
                    ui.set_min_width(width);
                    add_widget(ui, label.id)
                },
            )
            .inner;
        if let Some(add_menu) = add_menu {
            ui.menu_button("…", |ui| add_menu(ui)).response.on_hover_text("Reset, expose, disconnect");
        }
        result
    })
    .inner
}

/// Ends the row of merged edits when a drag, a text or a slider is done.
pub(crate) fn end_when_done(response: &Response, actions: &mut Vec<Action>) {
    if response.drag_stopped() || response.lost_focus() {
        actions.push(Action::EndMerge);
    }
}

/// Gives a field of text a name for screen readers.
pub(crate) fn named_text(response: &Response, text: &str, name: &str) {
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::text_edit(true, text, text, "");
        info.label = Some(name.to_owned());
        info
    });
}
