//! The keys of the canvas, while it has the focus or the pointer rests over it.

use eframe::egui::{self, Event, EventFilter, Key, Modifiers, Pos2, Response, vec2};
use halfvector_graph::document::{NodeId, SocketRef, group_of};
use halfvector_graph::library::Library;
use halfvector_graph::operation::{collapse, ungroup};

use super::adding::Purpose;
use super::edits::Arrival;
use super::fit::{Loose, sentence};
use super::picked::Chosen;
use super::sheet::{Sheet, Side};
use super::view::GRID;
use super::{Canvas, Desk};
use crate::action::Action;

/// What the window's menu can do with the selected nodes; each is a key of the canvas, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verb {
    Cut,
    Copy,
    Paste,
    Duplicate,
    Delete,
    DeleteAndHeal,
    Connect,
    SelectAll,
}

impl Verb {
    /// What is done with what is chosen, with names and keys.
    pub(crate) const ALL: [(Verb, &str, &str); 7] = [
        (Verb::Cut, "Cut", "Ctrl+X"),
        (Verb::Copy, "Copy", "Ctrl+C"),
        (Verb::Paste, "Paste", "Ctrl+V"),
        (Verb::Duplicate, "Duplicate", "Ctrl+D"),
        (Verb::Delete, "Delete", "Del"),
        (Verb::DeleteAndHeal, "Delete and heal", "Ctrl+Del"),
        (Verb::Connect, "Connect…", "C"),
    ];
}

impl Canvas {
    /// Does what the window's menu has asked for.
    pub(super) fn do_asked(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet) {
        for verb in std::mem::take(&mut self.asked) {
            match verb {
                Verb::Cut => self.cut(ui, desk, sheet),
                Verb::Copy => self.copy(ui, desk, sheet),
                Verb::Paste => ui.ctx().send_viewport_cmd(egui::ViewportCommand::RequestPaste),
                Verb::Duplicate => self.duplicate(desk, sheet),
                Verb::Delete => self.remove(desk, sheet, false),
                Verb::DeleteAndHeal => self.remove(desk, sheet, true),
                Verb::Connect => self.connect(ui, desk, sheet, None),
                Verb::SelectAll => self.choose_all(desk, sheet),
            }
            // What is pasted comes as an event, which the focus takes.
            response.request_focus();
        }
    }

    /// Does what the keys ask for.
    pub(super) fn keys(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet) {
        if self.palette.is_open() || self.editing.is_some() || self.connecting.is_some() {
            return;
        }
        let focused = ui.memory(|memory| memory.focused());
        if response.has_focus() {
            // After the last node the focus goes on by itself.
            let last = reading_order(sheet).last().copied();
            let tab = !last.is_some_and(|last| sheet.cards[last].is_selected) || response.contains_pointer();
            let filter = EventFilter { tab, horizontal_arrows: true, vertical_arrows: true, escape: true };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        }
        let is_over = response.contains_pointer();
        if focused.is_some_and(|id| id != response.id) || (focused.is_none() && !is_over) {
            return;
        }
        let pointer = ui.input(|input| input.pointer.latest_pos()).filter(|_| is_over);
        let at = pointer.unwrap_or(desk.lens.pane.center());
        self.clipboard(ui, desk, sheet, at);
        let pressed = |modifiers: Modifiers, key: Key| ui.input_mut(|input| input.consume_key(modifiers, key));
        let (none, command, shift) = (Modifiers::NONE, Modifiers::COMMAND, Modifiers::SHIFT);

        if pressed(none, Key::Escape) {
            if !self.gesture.is_idle() {
                self.cancel(desk);
            } else if self.chosen(desk).is_empty() {
                desk.leave();
            } else {
                self.choose_only(desk, Chosen::default());
            }
        }
        // The ones with more modifiers first: the others would take them.
        if pressed(command, Key::Delete) || pressed(Modifiers::ALT, Key::Delete) || pressed(command, Key::Backspace) {
            self.remove(desk, sheet, true);
        } else if pressed(none, Key::Delete) || pressed(none, Key::X) {
            self.remove(desk, sheet, false);
        } else if pressed(none, Key::Backspace) {
            // With nothing to delete it leads out of the group.
            if self.chosen(desk).is_empty() {
                desk.leave();
            } else {
                self.remove(desk, sheet, false);
            }
        }
        if pressed(command.plus(shift), Key::G) {
            self.ungroup(ui, desk, sheet, at);
        }
        if pressed(command, Key::G) {
            self.group(ui, desk, sheet, at);
        }
        if pressed(command, Key::J) {
            self.add_frame(desk, sheet, desk.lens.to_canvas(at));
        }
        if pressed(command, Key::D) {
            self.duplicate(desk, sheet);
        }
        if pressed(command, Key::A) {
            self.choose_all(desk, sheet);
        }
        if pressed(command, Key::L) || pressed(none, Key::L) {
            self.arrange(desk, sheet);
        }
        if pressed(none, Key::Home) {
            self.fit(desk, sheet, false);
        }
        if pressed(none, Key::F) {
            self.fit(desk, sheet, true);
        }
        for (key, factor) in [(Key::Plus, 1.25), (Key::Equals, 1.25), (Key::Minus, 0.8)] {
            if pressed(none, key) {
                desk.lens.view = desk.lens.zoomed(factor, at);
            }
        }
        if pressed(none, Key::Num1) {
            desk.lens.view = desk.lens.zoomed(1.0 / desk.lens.view.zoom, at);
        }
        if pressed(none, Key::F2) {
            self.rename_chosen(desk, sheet);
        }
        if pressed(none, Key::C) {
            self.connect(ui, desk, sheet, None);
        }
        let arrows = [
            (Key::ArrowLeft, -1.0, 0.0),
            (Key::ArrowRight, 1.0, 0.0),
            (Key::ArrowUp, 0.0, -1.0),
            (Key::ArrowDown, 0.0, 1.0),
        ];
        for (key, x, y) in arrows {
            if pressed(shift, key) {
                self.nudge(desk, sheet, vec2(x, y) * GRID * 5.0);
            } else if pressed(none, key) {
                self.nudge(desk, sheet, vec2(x, y) * GRID);
            }
        }
        if pressed(none, Key::Enter) {
            self.go_on_from_selected(desk, sheet);
        } else if pressed(none, Key::Space) || (pointer.is_some() && pressed(none, Key::Tab)) {
            let purpose = Purpose { at: desk.lens.to_canvas(at), ..Purpose::default() };
            self.open_palette(desk, at, purpose);
        }
        let (back, on) = (pressed(shift, Key::Tab), pressed(none, Key::Tab));
        if on || back {
            self.walk(response, desk, sheet, on);
        }
    }

    /// Copy, cut and paste: the window system sends them as events.
    fn clipboard(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let events = ui.input(|input| {
            let is_ours = |event: &&Event| matches!(event, Event::Copy | Event::Cut | Event::Paste(_));
            input.events.iter().filter(is_ours).cloned().collect::<Vec<_>>()
        });
        for event in events {
            match event {
                Event::Copy => self.copy(ui, desk, sheet),
                Event::Cut => self.cut(ui, desk, sheet),
                Event::Paste(text) => self.paste(ui, desk, sheet, &text, at),
                _ => {}
            }
        }
    }

    /// Makes a group of the selected nodes.
    pub(super) fn group(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let ids: Vec<NodeId> = desk.session.selection().iter().cloned().collect();
        let session = desk.session;
        match collapse(session.document(), Library::standard(), session.group(), &ids, "Group") {
            Ok(edit) => {
                let arrival = Arrival::of(session.group(), edit);
                desk.arrive(sheet, format!("Group {}", count(ids.len())), arrival);
            }
            Err(why) => self.say(ui, at, sentence(&why.0)),
        }
    }

    /// Puts the nodes of the selected groups in their places.
    pub(super) fn ungroup(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let session = desk.session;
        let is_group = |id: &&NodeId| session.graph().nodes.get(*id).is_some_and(|node| group_of(&node.node).is_some());
        let Some(id) = session.selection().iter().find(is_group) else { return };
        match ungroup(session.document(), Library::standard(), session.group(), id) {
            Ok(edit) => desk.arrive(sheet, "Ungroup", Arrival::of(session.group(), edit)),
            Err(why) => self.say(ui, at, sentence(&why.0)),
        }
    }

    /// Begins to rename what is chosen, when it is one node, frame or comment.
    fn rename_chosen(&mut self, desk: &Desk<'_>, sheet: &Sheet) {
        let chosen = self.chosen(desk);
        match (chosen.nodes.first(), chosen.notes.first()) {
            (Some(node), None) if chosen.nodes.len() == 1 => self.rename(sheet, node),
            (None, Some(id)) if chosen.notes.len() == 1 => {
                if let Some(note) = sheet.notes.iter().find(|note| note.id == *id) {
                    self.write_note(note);
                }
            }
            _ => {}
        }
    }

    /// Opens the palette for what the selected node gives.
    fn go_on_from_selected(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let Some(card) = sheet.cards.iter().find(|card| card.is_selected) else { return };
        let rect = card.rect();
        let at = desk.lens.to_screen(rect.right_top()) + vec2(24.0, 0.0);
        let output = card.rows.iter().find(|row| row.side == Side::Output && row.has_socket());
        let loose = output.map(|row| Loose::Output(SocketRef::new(&card.id, &row.name), row.ty));
        let purpose = Purpose { at: rect.right_top() + vec2(GRID * 3.0, 0.0), loose, into: None };
        self.open_palette(desk, at, purpose);
    }

    /// Selects the next node, or lets the focus go after the last one.
    fn walk(&mut self, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet, on: bool) {
        let order = reading_order(sheet);
        let now = order.iter().position(|&i| sheet.cards[i].is_selected);
        let next = match (now, on) {
            (None, true) => Some(0),
            (None, false) => order.len().checked_sub(1),
            (Some(now), true) => Some(now + 1),
            (Some(now), false) => now.checked_sub(1),
        };
        match next.and_then(|next| order.get(next)) {
            Some(&card) => {
                let card = &sheet.cards[card];
                desk.actions.push(Action::Select(vec![card.id.clone()]));
                if !desk.lens.seen().contains_rect(card.rect()) {
                    self.wanted = vec![card.id.clone()];
                }
            }
            None => response.surrender_focus(),
        }
    }
}

/// The cards column by column.
fn reading_order(sheet: &Sheet) -> Vec<usize> {
    let mut order: Vec<usize> = (0..sheet.cards.len()).collect();
    let key = |i: usize| (sheet.cards[i].place.x, sheet.cards[i].place.y);
    order.sort_by(|&a, &b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    order
}

fn count(nodes: usize) -> String {
    if nodes == 1 { "node".into() } else { format!("{nodes} nodes") }
}
