//! The keys of the canvas, while it has the focus or the pointer rests over it.

use std::collections::BTreeSet;

use eframe::egui::{self, Event, EventFilter, Key, Modifiers, Pos2, Response, vec2};
use halfvector_graph::document::{NodeId, SocketRef, group_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::operation::{Refusal, collapse, copy, paste, remove_and_heal, ungroup};

use super::adding::Purpose;
use super::edits::Arrival;
use super::fit::{Loose, sentence};
use super::sheet::{Sheet, Side};
use super::view::{GRID, to_grid};
use super::{Canvas, Desk, moved};
use crate::action::Action;

/// How far duplicates lie from their originals.
const BESIDE: egui::Vec2 = vec2(GRID * 2.0, GRID * 2.0);

/// What the window's menu can do with the selected nodes; each is a key of the canvas, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verb {
    Cut,
    Copy,
    Paste,
    Duplicate,
    Delete,
    DeleteAndHeal,
}

impl Verb {
    /// All, with their names and keys.
    pub(crate) const ALL: [(Verb, &str, &str); 6] = [
        (Verb::Cut, "Cut", "Ctrl+X"),
        (Verb::Copy, "Copy", "Ctrl+C"),
        (Verb::Paste, "Paste", "Ctrl+V"),
        (Verb::Duplicate, "Duplicate", "Ctrl+D"),
        (Verb::Delete, "Delete", "Del"),
        (Verb::DeleteAndHeal, "Delete and heal", "Ctrl+Del"),
    ];
}

impl Canvas {
    /// Does what the window's menu has asked for.
    pub(super) fn do_asked(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet) {
        for verb in std::mem::take(&mut self.asked) {
            match verb {
                Verb::Cut => {
                    self.copy(ui, desk);
                    self.remove(desk, sheet, false);
                }
                Verb::Copy => self.copy(ui, desk),
                Verb::Paste => ui.ctx().send_viewport_cmd(egui::ViewportCommand::RequestPaste),
                Verb::Duplicate => self.duplicate(desk, sheet),
                Verb::Delete => self.remove(desk, sheet, false),
                Verb::DeleteAndHeal => self.remove(desk, sheet, true),
            }
            // What is pasted comes as an event, which the focus takes.
            response.request_focus();
        }
    }

    /// Does what the keys ask for.
    pub(super) fn keys(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &Sheet) {
        if self.palette.is_open() || self.editing.is_some() {
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
            } else if !desk.session.selection().is_empty() {
                desk.actions.push(Action::Select(Vec::new()));
            } else if self.picked.take().is_none() {
                desk.leave();
            }
        }
        // The ones with more modifiers first: the others would take them.
        if pressed(command, Key::Delete) || pressed(Modifiers::ALT, Key::Delete) || pressed(command, Key::Backspace) {
            self.remove(desk, sheet, true);
        } else if pressed(none, Key::Delete) || pressed(none, Key::X) {
            self.remove(desk, sheet, false);
        } else if pressed(none, Key::Backspace) {
            // With nothing to delete it leads out of the group.
            if desk.session.selection().is_empty() && self.picked.is_none() {
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
            self.add_frame(desk, sheet);
        }
        if pressed(command, Key::D) {
            self.duplicate(desk, sheet);
        }
        if pressed(command, Key::A) {
            desk.actions.push(Action::Select(sheet.cards.iter().map(|card| card.id.clone()).collect()));
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
        if pressed(none, Key::F2)
            && let [only] = desk.session.selection().iter().collect::<Vec<_>>().as_slice()
        {
            self.rename(sheet, only);
        }
        let arrows = [
            (Key::ArrowLeft, -1.0, 0.0),
            (Key::ArrowRight, 1.0, 0.0),
            (Key::ArrowUp, 0.0, -1.0),
            (Key::ArrowDown, 0.0, 1.0),
        ];
        for (key, x, y) in arrows {
            if pressed(shift, key) {
                nudge(desk, sheet, vec2(x, y) * GRID * 5.0);
            } else if pressed(none, key) {
                nudge(desk, sheet, vec2(x, y) * GRID);
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
                Event::Copy => self.copy(ui, desk),
                Event::Cut => {
                    self.copy(ui, desk);
                    self.remove(desk, sheet, false);
                }
                Event::Paste(text) => {
                    let place = to_grid(desk.lens.to_canvas(at));
                    match pasted(desk, &text, place) {
                        Ok(arrival) => desk.arrive(sheet, format!("Paste {}", count(arrival.ids.len())), arrival),
                        Err(why) => self.say(ui, at, sentence(&why.0)),
                    }
                }
                _ => {}
            }
        }
    }

    /// Puts the selected nodes into the clipboard.
    pub(super) fn copy(&self, ui: &egui::Ui, desk: &Desk<'_>) {
        if !desk.session.selection().is_empty() {
            ui.ctx().copy_text(copied(desk));
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

    pub(super) fn duplicate(&self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let Some(rect) = Sheet::bounds(sheet.cards.iter().filter(|card| card.is_selected)) else { return };
        if let Ok(arrival) = pasted(desk, &copied(desk), rect.min + BESIDE) {
            desk.arrive(sheet, format!("Duplicate {}", count(arrival.ids.len())), arrival);
        }
    }

    pub(super) fn remove(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, heals: bool) {
        let nodes: &BTreeSet<NodeId> = desk.session.selection();
        if nodes.is_empty() {
            self.remove_note(desk, sheet);
        } else {
            let name = format!("Delete {}{}", count(nodes.len()), if heals { " and heal" } else { "" });
            let ids: Vec<NodeId> = nodes.iter().cloned().collect();
            let session = desk.session;
            let healed = || remove_and_heal(session.document(), Library::standard(), session.group(), &ids).ok();
            match heals.then(healed).flatten() {
                Some(edit) => desk.make_with(sheet, name, Vec::new(), edit),
                None => desk.edit(sheet, name, ids.into_iter().map(|id| Edit::RemoveNode { id }).collect()),
            }
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

fn nudge(desk: &mut Desk<'_>, sheet: &Sheet, by: egui::Vec2) {
    let edits: Vec<_> =
        sheet.cards.iter().filter(|card| card.is_selected).map(|card| moved(card, card.place + by)).collect();
    if !edits.is_empty() {
        desk.edit(sheet, "Move nodes", edits);
    }
}

/// The selected nodes as text.
fn copied(desk: &Desk<'_>) -> String {
    let ids: Vec<NodeId> = desk.session.selection().iter().cloned().collect();
    copy(desk.session.document(), desk.session.group(), &ids)
}

/// The nodes of a text, the upper left one at a place.
fn pasted(desk: &Desk<'_>, text: &str, at: Pos2) -> Result<Arrival, Refusal> {
    let session = desk.session;
    let (edit, ids) = paste(session.document(), Library::standard(), session.group(), text, at.into())?;
    Ok(Arrival { edits: vec![edit], ids })
}

fn count(nodes: usize) -> String {
    if nodes == 1 { "node".into() } else { format!("{nodes} nodes") }
}
