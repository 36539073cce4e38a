//! Rows of the inspector: a name at the left, what sets it in the middle, a menu at the right.

use eframe::egui::{self, Color32, Response, RichText};

use crate::action::Action;
use crate::written::Answer;

/// Share of the width that names take.
const NAME_SHARE: f32 = 0.36;
/// Width of the menu's button.
const MENU_WIDTH: f32 = 26.0;

/// Names of sockets as people write them: `base_color` becomes "base color".
pub(crate) fn in_words(name: &str) -> String {
    name.replace('_', " ")
}

/// Draws a row: dot and name, the widget, the menu. The widget is given the name's id, for its label. Each part has its own
/// place, whatever the others need, so that columns stay columns.
pub(crate) fn row<R>(
    ui: &mut egui::Ui,
    name: RichText,
    hint: &str,
    dot: Option<Color32>,
    add_widget: impl FnOnce(&mut egui::Ui, egui::Id) -> R,
    add_menu: Option<&mut dyn FnMut(&mut egui::Ui)>,
) -> R {
    let size = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    let gap = ui.spacing().item_spacing.x;
    let name_width = (rect.width() * NAME_SHARE).clamp(70.0, 180.0);
    let menu_width = if add_menu.is_some() { MENU_WIDTH + gap } else { 0.0 };
    let (name_rect, rest) = rect.split_left_right_at_x(rect.left() + name_width);
    let (widget_rect, menu_rect) = rest.split_left_right_at_x((rest.right() - menu_width).max(rest.left()));
    let mut part = |rect: egui::Rect| {
        let layout = egui::Layout::left_to_right(egui::Align::Center);
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(layout))
    };
    let mut names = part(name_rect);
    if let Some(color) = dot {
        let (rect, _) = names.allocate_exact_size(egui::vec2(8.0, size.y), egui::Sense::hover());
        names.painter().circle_filled(rect.center(), 3.5, color);
    }
    let label = names.add(egui::Label::new(name).truncate());
    let label = if hint.is_empty() { label } else { label.on_hover_text(hint) };
    let result = add_widget(&mut part(widget_rect), label.id);
    if let Some(add_menu) = add_menu {
        let mut menu = part(menu_rect.with_min_x(menu_rect.left() + gap));
        menu.spacing_mut().button_padding.x = 6.0;
        menu.menu_button("…", |ui| add_menu(ui)).response.on_hover_text("Reset, expose, disconnect");
    }
    result
}

/// Ends the row of merged edits when a drag, a text or a slider is done.
pub(crate) fn end_when_done(response: &Response, actions: &mut Vec<Action>) {
    if response.drag_stopped() || response.lost_focus() {
        actions.push(Action::EndMerge);
    }
}

/// Whether what was changed so far is given up; then it is taken back.
pub(crate) fn gives_up(answer: &Answer, actions: &mut Vec<Action>) -> bool {
    if answer.is_given_up {
        actions.push(Action::TakeBack);
    }
    answer.is_given_up
}

/// Gives a field of text a name for screen readers.
pub(crate) fn named_text(response: &Response, text: &str, name: &str) {
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::text_edit(true, text, text, "");
        info.label = Some(name.to_owned());
        info
    });
}
