//! The menus of the right mouse button.

use std::collections::BTreeSet;

use eframe::egui::{self, PointerButton, Pos2, Response};
use halfvector_graph::document::{Link, NodeId, function_of, group_of};
use halfvector_graph::edit::Edit;

use super::adding::Purpose;
use super::hit::Hit;
use super::notes::NoteId;
use super::picked::Chosen;
use super::sheet::Sheet;
use super::{Canvas, Desk};
use crate::action::{Action, Choose};

/// What a menu is about.
#[derive(Clone, Debug, Default)]
pub(super) enum Meant {
    #[default]
    Nothing,
    /// A place of the canvas, and the screen.
    Place(Pos2, Pos2),
    Node(NodeId),
    Wire(Link, Pos2, Pos2),
    Note(NoteId),
}

impl Canvas {
    /// Shows the menu of what lies under the pointer.
    pub(super) fn menu(
        &mut self,
        ui: &egui::Ui,
        response: &Response,
        desk: &mut Desk<'_>,
        sheet: &Sheet,
        hovered: Hit,
    ) {
        if response.clicked_by(PointerButton::Secondary) {
            let at = response.interact_pointer_pos().unwrap_or(desk.lens.pane.center());
            self.meant = match (hovered, hovered.card()) {
                (_, Some(card)) => {
                    let card = &sheet.cards[card];
                    if !card.is_selected {
                        let nodes = BTreeSet::from([card.id.clone()]);
                        self.choose_only(desk, Chosen { nodes, ..Chosen::default() });
                    }
                    Meant::Node(card.id.clone())
                }
                (Hit::Note(note, _), _) => {
                    let id = sheet.notes[note].id.clone();
                    if !self.picked.contains(&id) {
                        self.choose_note(desk, id.clone());
                    }
                    Meant::Note(id)
                }
                (Hit::Wire(wire), _) => Meant::Wire(sheet.wires[wire].link.clone(), desk.lens.to_canvas(at), at),
                _ => Meant::Place(desk.lens.to_canvas(at), at),
            };
        }
        response.context_menu(|menu| {
            menu.set_min_width(200.0);
            match self.meant.clone() {
                Meant::Nothing => {}
                Meant::Place(place, at) => self.place_menu(menu, desk, sheet, place, at),
                Meant::Node(node) => self.node_menu(ui, menu, desk, sheet, &node),
                Meant::Note(note) => self.note_menu(menu, desk, sheet, &note),
                Meant::Wire(link, place, at) => self.wire_menu(menu, desk, sheet, link, place, at),
            }
        });
    }

    fn place_menu(&mut self, menu: &mut egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, place: Pos2, at: Pos2) {
        if item(menu, "Add node…", "Space") {
            self.open_palette(desk, at, Purpose { at: place, ..Purpose::default() });
        }
        if item(menu, "New function…", "") {
            self.add_function(desk, sheet, place);
        }
        if item(menu, "Group from a file…", "") {
            desk.actions.push(Action::Choose(Choose::Group));
        }
        if item(menu, "Paste", "Ctrl+V") {
            menu.ctx().send_viewport_cmd(egui::ViewportCommand::RequestPaste);
        }
        if item(menu, "Select all", "Ctrl+A") {
            self.choose_all(desk, sheet);
        }
        if item(menu, "Add comment", "") {
            self.add_comment(desk, sheet, place);
        }
        let frame = if self.chosen(desk).is_empty() { "Add frame" } else { "Put a frame around the selection" };
        if item(menu, frame, "Ctrl+J") {
            self.add_frame(desk, sheet, place);
        }
        menu.separator();
        if item(menu, "Arrange", "L") {
            self.arrange(desk, sheet);
        }
        if item(menu, "Show all", "Home") {
            self.fit(desk, sheet, false);
        }
        let mut snaps = !self.keeps_off_grid;
        if menu
            .checkbox(&mut snaps, "Snap to the grid")
            .on_hover_text("Ctrl while dragging does the opposite")
            .changed()
        {
            self.keeps_off_grid = !snaps;
        }
        let mut has_map = !self.hides_map;
        if menu.checkbox(&mut has_map, "Map").on_hover_text("The whole graph in the corner").changed() {
            self.hides_map = !has_map;
        }
    }

    fn node_menu(&mut self, ui: &egui::Ui, menu: &mut egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, node: &str) {
        if item(menu, "Rename…", "F2") {
            self.rename(sheet, node);
        }
        menu.separator();
        if item(menu, "Copy", "Ctrl+C") {
            self.copy(ui, desk, sheet);
        }
        if item(menu, "Cut", "Ctrl+X") {
            self.cut(ui, desk, sheet);
        }
        if item(menu, "Duplicate", "Ctrl+D") {
            self.duplicate(desk, sheet);
        }
        menu.separator();
        if item(menu, "Connect…", "C") {
            self.connect(ui, desk, sheet, None);
        }
        if item(menu, "Disconnect", "") {
            let selected = desk.session.selection();
            let links = desk.graph.links.iter();
            let theirs = links.filter(|link| selected.contains(&link.from.node) || selected.contains(&link.to.node));
            let edits: Vec<Edit> = theirs.map(|link| Edit::RemoveLink { link: link.clone() }).collect();
            if !edits.is_empty() {
                desk.edit(sheet, "Disconnect", edits);
            }
        }
        let at = desk.lens.pane.center();
        if item(menu, "Group", "Ctrl+G") {
            self.group(ui, desk, sheet, at);
        }
        let inside = desk.graph.nodes.get(node).and_then(|node| group_of(&node.node));
        if let Some(inside) = inside {
            if item(menu, "Open the group", "Double-click") {
                desk.enter(inside);
            }
            if item(menu, "Save the group…", "") {
                desk.actions.push(Action::Choose(Choose::SaveGroup(inside.to_owned())));
            }
            if item(menu, "Ungroup", "Ctrl+Shift+G") {
                self.ungroup(ui, desk, sheet, at);
            }
        }
        if let Some(function) = desk.graph.nodes.get(node).and_then(|node| function_of(&node.node))
            && item(menu, "Edit the code", "Double-click")
        {
            desk.actions.push(Action::EditFunction(function.to_owned()));
        }
        if item(menu, "Put a frame around", "Ctrl+J") {
            self.add_frame(desk, sheet, desk.lens.view.center);
        }
        if item(menu, "Arrange", "L") {
            self.arrange(desk, sheet);
        }
        if item(menu, "Show", "F") {
            self.fit(desk, sheet, true);
        }
        menu.separator();
        if item(menu, "Delete", "Del") {
            self.remove(desk, sheet, false);
        }
        if item(menu, "Delete and heal", "Ctrl+Del") {
            self.remove(desk, sheet, true);
        }
    }

    fn wire_menu(
        &mut self,
        menu: &mut egui::Ui,
        desk: &mut Desk<'_>,
        sheet: &Sheet,
        link: Link,
        place: Pos2,
        at: Pos2,
    ) {
        if item(menu, "Insert node…", "") {
            self.open_palette(desk, at, Purpose { at: place, loose: None, into: Some(link.clone()) });
        }
        if item(menu, "Insert reroute", "Double-click") {
            self.bend(menu, desk, sheet, &link, [place, at]);
        }
        if item(menu, "Delete wire", "") {
            desk.edit(sheet, "Disconnect", vec![Edit::RemoveLink { link }]);
        }
    }
}

/// A line of a menu with its key; whether it was chosen.
pub(super) fn item(menu: &mut egui::Ui, text: &str, key: &str) -> bool {
    menu.add(egui::Button::new(text).shortcut_text(key)).clicked()
}
