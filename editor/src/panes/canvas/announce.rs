//! What screen readers are told of the canvas, and what they ask for.

use std::collections::BTreeSet;

use eframe::egui::{self, Id, Rect, vec2};
use halfvector_graph::document::SocketRef;

use super::picked::Chosen;
use super::sheet::{HEADER, Sheet, Side};
use super::{Canvas, Desk, gesture, notes};

impl Canvas {
    /// Tells screen readers what is seen, and does what they ask for. Returns the socket that is to be joined with another one.
    pub(super) fn announce(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) -> Option<(SocketRef, Side)> {
        use egui::accesskit::{Action as Asked, Role};
        let context = ui.ctx();
        let lens = desk.lens;
        let mut pressed = None;
        let is_asked = |id: Id| ui.input(|input| input.has_accesskit_action_request(id, Asked::Click));
        let tell =
            |id: Id, rect: Rect, role: Role, label: &dyn Fn() -> String, value: Option<String>, is_selected: bool| {
                let told = context.accesskit_node_builder(id, |node| {
                    node.set_role(role);
                    node.set_label(label());
                    let rect = rect.intersect(lens.pane);
                    let [x0, y0, x1, y1] = [rect.left(), rect.top(), rect.right(), rect.bottom()].map(f64::from);
                    node.set_bounds(egui::accesskit::Rect { x0, y0, x1, y1 });
                    node.add_action(Asked::Click);
                    if let Some(value) = value {
                        node.set_value(value);
                    }
                    if is_selected {
                        node.set_selected(true);
                    }
                });
                told.is_some()
            };
        for note in sheet.notes.iter().filter(|note| note.shown.intersects(lens.seen())) {
            let title = Rect::from_min_size(note.shown.min, vec2(note.shown.width(), notes::TITLE));
            let label = || format!("{} {}", if note.kind() == "frame" { "Frame" } else { "Comment" }, note.text);
            let is_picked = self.picked.contains(&note.id);
            let id = Id::new(("graph note", note.kind(), &note.id));
            tell(id, lens.rect_to_screen(title), Role::ListItem, &label, None, is_picked);
            if is_asked(id) {
                self.choose_note(desk, note.id.clone());
            }
        }
        for (i, card) in sheet.cards.iter().enumerate().filter(|(_, card)| card.rect().intersects(lens.seen())) {
            let id = Id::new(("graph node", &card.id));
            let label = || format!("Node {}", card.title);
            let header = Rect::from_min_size(card.rect().min, vec2(card.size.x, HEADER.min(card.size.y)));
            let wrong = card.problems.first().map(|(_, text)| text.clone());
            if !tell(id, lens.rect_to_screen(header), Role::ListItem, &label, wrong, card.is_selected) {
                // Nobody listens.
                return None;
            }
            if is_asked(id) {
                self.choose_only(desk, Chosen { nodes: BTreeSet::from([card.id.clone()]), ..Chosen::default() });
            }
            if card.has_picture() {
                let id = Id::new(("graph toggle", &card.id));
                let rect = Rect::from_center_size(lens.to_screen(card.toggle()), vec2(14.0, 14.0));
                let label = || format!("Picture of {}", card.title);
                tell(id, rect, Role::Button, &label, None, card.picture().is_some());
                if is_asked(id) {
                    gesture::switch(&mut self.unfolded.pictures, &card.id);
                }
            }
            for row in card.rows.iter().filter(|row| row.has_socket()) {
                let side = if row.side == Side::Output { "Output" } else { "Input" };
                let id = Id::new(("graph socket", &card.id, side, &row.name));
                let center = lens.to_screen(card.socket(row));
                let rect = Rect::from_center_size(center, vec2(10.0, 10.0));
                tell(id, rect, Role::Button, &|| format!("{side} {} of {}", row.name, card.title), None, false);
                if is_asked(id) {
                    pressed = Some((SocketRef::new(&card.id, &row.name), row.side));
                }
            }
            for (place, row) in card.rows.iter().enumerate().filter(|(_, row)| row.field.is_editable()) {
                if let Some(rect) = card.field(row) {
                    let id = Id::new(("graph value", &card.id, &row.name));
                    let label = || format!("Value {} of {}", row.name, card.title);
                    tell(id, lens.rect_to_screen(rect), Role::SpinButton, &label, Some(row.field.text()), false);
                    if is_asked(id) {
                        self.edit_field(desk, sheet, i, place);
                    }
                }
            }
        }
        pressed
    }
}

/// Tells screen readers words that are painted.
pub(super) fn words(ui: &egui::Ui, text: &str) {
    ui.ctx().accesskit_node_builder(Id::new("graph words"), |node| {
        node.set_role(egui::accesskit::Role::Alert);
        node.set_label(text.to_owned());
        node.set_bounds(egui::accesskit::Rect::ZERO);
    });
}
