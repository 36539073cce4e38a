//! The keys of the canvas, while it has the focus or the pointer rests over it.

use std::collections::BTreeSet;

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
use super::{Canvas, Desk, seen_whole};

/// How something is selected without the pointer.
pub(super) const TAB: &str = "Tab goes from one to the next.";

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
    Frame,
    Comment,
    SelectAll,
}

impl Verb {
    /// What is done with what is chosen, with names and keys.
    pub(crate) const ALL: [(Verb, &str, &str); 9] = [
        (Verb::Cut, "Cut", "Ctrl+X"),
        (Verb::Copy, "Copy", "Ctrl+C"),
        (Verb::Paste, "Paste", "Ctrl+V"),
        (Verb::Duplicate, "Duplicate", "Ctrl+D"),
        (Verb::Delete, "Delete", "Del"),
        (Verb::DeleteAndHeal, "Delete and heal", "Ctrl+Del"),
        (Verb::Connect, "Connect…", "C"),
        (Verb::Frame, "Add frame", "Ctrl+J"),
        (Verb::Comment, "Add comment", ""),
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
                Verb::Frame => self.add_frame(desk, sheet, desk.lens.pane_center()),
                Verb::Comment => {
                    let at = sheet.free_place(desk.lens.pane_center());
                    self.add_comment(desk, sheet, at);
                }
                Verb::SelectAll => self.choose_all(desk, sheet),
            }
            // What is pasted comes as an event, which the focus takes.
            response.request_focus();
        }
    }

    /// Does what the keys ask for.
    pub(super) fn keys(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet) {
        // What lies over the canvas comes first; one that Escape has closed in this frame is not open any more.
        let is_covered = self.was_covered || is_covered(ui.ctx());
        if is_covered || self.palette.is_open() || self.editing.is_some() || self.connecting.is_some() {
            return;
        }
        let focused = ui.memory(|memory| memory.focused());
        if response.has_focus() {
            // After the last node the focus goes on by itself.
            let last = reading_order(sheet).last().copied();
            let tab = !last.is_some_and(|last| self.is_at(sheet, last)) || response.contains_pointer();
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
            self.rename_chosen(ui, desk, sheet, at);
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
            self.go_on_from_selected(ui, desk, sheet, at);
        } else if pressed(none, Key::Space) || (pointer.is_some() && pressed(none, Key::Tab)) {
            // Without the pointer all come to the same place.
            let place = pointer.map(|at| desk.lens.to_canvas(at));
            let place = place.unwrap_or_else(|| sheet.free_place(desk.lens.pane_center()));
            self.open_palette(desk, at, Purpose { at: place, ..Purpose::default() });
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
        let Some(id) = session.selection().iter().find(is_group) else {
            return self.say(ui, at, "No group is selected that could be taken apart.".to_owned());
        };
        match ungroup(session.document(), Library::standard(), session.group(), id) {
            Ok(edit) => desk.arrive(sheet, "Ungroup", Arrival::of(session.group(), edit)),
            Err(why) => self.say(ui, at, sentence(&why.0)),
        }
    }

    /// Begins to rename what is chosen, when it is one node, frame or comment.
    fn rename_chosen(&mut self, ui: &egui::Ui, desk: &Desk<'_>, sheet: &Sheet, at: Pos2) {
        let chosen = self.chosen(desk);
        match (chosen.nodes.first(), chosen.notes.first()) {
            (Some(node), None) if chosen.nodes.len() == 1 => self.rename(sheet, node),
            (None, Some(id)) if chosen.notes.len() == 1 => {
                if let Some(note) = sheet.notes.iter().find(|note| note.id == *id) {
                    self.write_note(note);
                }
            }
            _ => self.say(ui, at, format!("Select one node, frame or comment to name it. {TAB}")),
        }
    }

    /// Opens the palette for what the selected node gives.
    fn go_on_from_selected(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let Some(card) = sheet.cards.iter().find(|card| card.is_selected) else {
            return self.say(ui, at, format!("Select a node to go on from. {TAB}"));
        };
        let rect = card.rect();
        let at = desk.lens.to_screen(rect.right_top()) + vec2(24.0, 0.0);
        let output = card.rows.iter().find(|row| row.side == Side::Output && row.has_socket());
        let loose = output.map(|row| Loose::Output(SocketRef::new(&card.id, &row.name), row.ty));
        let place = sheet.free_place(rect.right_top() + vec2(GRID * 3.0, 0.0));
        let purpose = Purpose { at: place, loose, into: None };
        self.open_palette(desk, at, purpose);
    }

    /// Chooses the next node, frame or comment, or lets the focus go after the last one.
    fn walk(&mut self, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet, on: bool) {
        let order = reading_order(sheet);
        let now = order.iter().position(|stop| self.is_at(sheet, *stop));
        let next = match (now, on) {
            (None, true) => Some(0),
            (None, false) => order.len().checked_sub(1),
            (Some(now), true) => Some(now + 1),
            (Some(now), false) => now.checked_sub(1),
        };
        let Some(stop) = next.and_then(|next| order.get(next)) else { return response.surrender_focus() };
        let rect = match *stop {
            Stop::Card(card) => {
                let card = &sheet.cards[card];
                self.choose_only(desk, Chosen { nodes: BTreeSet::from([card.id.clone()]), ..Chosen::default() });
                card.rect()
            }
            Stop::Note(note) => {
                let note = &sheet.notes[note];
                self.choose_note(desk, note.id.clone());
                note.rect
            }
        };
        if !desk.lens.seen().contains_rect(rect) {
            desk.lens.view = seen_whole(rect, desk.lens);
        }
    }

    fn is_at(&self, sheet: &Sheet, stop: Stop) -> bool {
        match stop {
            Stop::Card(card) => sheet.cards[card].is_selected,
            Stop::Note(note) => self.picked.contains(&sheet.notes[note].id),
        }
    }
}

/// Whether a menu or a dialog is open anywhere in the window: the keys are for that.
pub(super) fn is_covered(context: &egui::Context) -> bool {
    egui::Popup::is_any_open(context) || context.memory(|memory| memory.top_modal_layer().is_some())
}

/// Where Tab stops.
#[derive(Clone, Copy)]
enum Stop {
    Card(usize),
    Note(usize),
}

/// All from left to right, of those in one column from above; a frame before what lies in it.
fn reading_order(sheet: &Sheet) -> Vec<Stop> {
    let cards = (0..sheet.cards.len()).map(|card| (sheet.cards[card].place, Stop::Card(card)));
    let notes = (0..sheet.notes.len()).map(|note| (sheet.notes[note].rect.min, Stop::Note(note)));
    let mut order: Vec<(Pos2, Stop)> = notes.chain(cards).collect();
    order.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    order.into_iter().map(|(_, stop)| stop).collect()
}

fn count(nodes: usize) -> String {
    if nodes == 1 { "node".into() } else { format!("{nodes} nodes") }
}
