//! What is chosen in the graph: nodes, which the session knows, and frames and comments, which the canvas knows. What is done with
//! them is done with both.

use std::collections::BTreeSet;

use eframe::egui::{self, Pos2, Rect, Vec2, vec2};
use halfvector_graph::document::NodeId;
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::operation::{Pick, Refusal, copy, paste, remove_and_heal};

use super::edits::Arrival;
use super::fit::sentence;
use super::notes::NoteId;
use super::sheet::Sheet;
use super::view::{GRID, to_grid};
use super::{Canvas, Desk, moved};
use crate::action::Action;

/// How far duplicates lie from their originals.
const BESIDE: Vec2 = vec2(GRID * 2.0, GRID * 2.0);

/// Nodes and notes of a graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Chosen {
    pub(super) nodes: BTreeSet<NodeId>,
    pub(super) notes: BTreeSet<NoteId>,
}

impl Chosen {
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.notes.is_empty()
    }

    /// With all that lies in its frames.
    pub(super) fn with_contents(mut self, sheet: &Sheet) -> Chosen {
        for frame in sheet.notes.iter().filter(|note| self.notes.contains(&note.id)).collect::<Vec<_>>() {
            let cards = sheet.cards.iter().filter(|card| frame.holds(card));
            self.nodes.extend(cards.map(|card| card.id.clone()));
            let notes = sheet.notes.iter().filter(|note| frame.holds_note(note));
            self.notes.extend(notes.map(|note| note.id.clone()));
        }
        self
    }

    /// In words: "node", "3 nodes", "frame", "5 items".
    pub(super) fn words(&self) -> String {
        match (self.nodes.len(), self.notes.len()) {
            (1, 0) => "node".to_owned(),
            (nodes, 0) => format!("{nodes} nodes"),
            (0, 1) => self.notes.first().map_or("", NoteId::kind).to_owned(),
            (nodes, notes) => format!("{} items", nodes + notes),
        }
    }

    /// The rectangle around it.
    pub(super) fn bounds(&self, sheet: &Sheet) -> Option<Rect> {
        let cards = sheet.cards.iter().filter(|card| self.nodes.contains(&card.id)).map(super::Card::rect);
        let notes = sheet.notes.iter().filter(|note| self.notes.contains(&note.id)).map(|note| note.rect);
        cards.chain(notes).reduce(Rect::union)
    }

    fn pick(&self) -> Pick {
        let mut pick = Pick::nodes(self.nodes.iter().cloned());
        for note in &self.notes {
            match note {
                NoteId::Frame(id) => pick.frames.push(id.clone()),
                NoteId::Comment(id) => pick.comments.push(id.clone()),
            }
        }
        pick
    }

    /// The edits that bring all of it to where it is shown.
    pub(super) fn moved(&self, desk: &Desk<'_>, sheet: &Sheet, way: Vec2) -> Vec<Edit> {
        let cards = sheet.cards.iter().filter(|card| self.nodes.contains(&card.id));
        let notes = sheet.notes.iter().filter(|note| self.notes.contains(&note.id));
        let cards = cards.map(|card| moved(card, card.place + way));
        cards.chain(notes.filter_map(|note| note.placed(desk.graph, note.rect.translate(way)))).collect()
    }
}

impl Canvas {
    /// Whether frames or comments are chosen.
    pub(crate) fn has_picked(&self) -> bool {
        !self.picked.is_empty()
    }

    /// Chooses no frame and no comment.
    pub(crate) fn pick_nothing(&mut self) {
        self.picked.clear();
    }

    pub(super) fn chosen(&self, desk: &Desk<'_>) -> Chosen {
        Chosen { nodes: desk.session.selection().clone(), notes: self.picked.clone() }
    }

    /// Chooses this and nothing else.
    pub(super) fn choose_only(&mut self, desk: &mut Desk<'_>, chosen: Chosen) {
        self.picked = chosen.notes;
        if chosen.nodes != *desk.session.selection() {
            desk.actions.push(Action::Select(chosen.nodes.into_iter().collect()));
        }
    }

    pub(super) fn choose_all(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let nodes = sheet.cards.iter().map(|card| card.id.clone()).collect();
        let notes = sheet.notes.iter().map(|note| note.id.clone()).collect();
        self.choose_only(desk, Chosen { nodes, notes });
    }

    /// Puts what is chosen, and what lies in the frames among it, into the clipboard.
    pub(super) fn copy(&self, ui: &egui::Ui, desk: &Desk<'_>, sheet: &Sheet) {
        let chosen = self.chosen(desk).with_contents(sheet);
        if !chosen.is_empty() {
            ui.ctx().copy_text(copied(desk, &chosen));
        }
    }

    /// Copies and removes the same.
    pub(super) fn cut(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) {
        self.copy(ui, desk, sheet);
        let chosen = self.chosen(desk).with_contents(sheet);
        remove(desk, sheet, &chosen, false);
    }

    /// Adds the nodes and notes of a text, the upper left one at a place of the screen.
    pub(super) fn paste(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, text: &str, at: Pos2) {
        match pasted(desk, text, to_grid(desk.lens.to_canvas(at))) {
            Ok((edit, chosen)) => self.take_in(desk, sheet, "Paste", edit, chosen),
            Err(why) => self.say(ui, at, sentence(&why.0)),
        }
    }

    pub(super) fn duplicate(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let chosen = self.chosen(desk).with_contents(sheet);
        let Some(rect) = chosen.bounds(sheet) else { return };
        if let Ok((edit, chosen)) = pasted(desk, &copied(desk, &chosen), rect.min + BESIDE) {
            self.take_in(desk, sheet, "Duplicate", edit, chosen);
        }
    }

    fn take_in(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, verb: &str, edit: Edit, chosen: Chosen) {
        let name = format!("{verb} {}", chosen.words());
        self.picked = chosen.notes;
        desk.arrive(sheet, name, Arrival { edits: vec![edit], ids: chosen.nodes.into_iter().collect() });
    }

    /// Removes what is chosen; of a frame the frame alone.
    pub(super) fn remove(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, heals: bool) {
        remove(desk, sheet, &self.chosen(desk), heals);
    }

    /// Moves what is chosen, with what lies in the frames among it.
    pub(super) fn nudge(&self, desk: &mut Desk<'_>, sheet: &Sheet, by: Vec2) {
        let chosen = self.chosen(desk);
        let name = format!("Move {}", chosen.words());
        let edits = chosen.with_contents(sheet).moved(desk, sheet, by);
        if !edits.is_empty() {
            desk.edit(sheet, name, edits);
        }
    }
}

fn remove(desk: &mut Desk<'_>, sheet: &Sheet, chosen: &Chosen, heals: bool) {
    if chosen.is_empty() {
        return;
    }
    let heals = heals && !chosen.nodes.is_empty();
    let name = format!("Delete {}{}", chosen.words(), if heals { " and heal" } else { "" });
    let notes = sheet.notes.iter().filter(|note| chosen.notes.contains(&note.id));
    let mut edits: Vec<Edit> = notes.map(super::notes::Note::removed).collect();
    let ids: Vec<NodeId> = chosen.nodes.iter().cloned().collect();
    let session = desk.session;
    let healed = || remove_and_heal(session.document(), Library::standard(), session.group(), &ids).ok();
    match heals.then(healed).flatten() {
        Some(edit) => desk.make_with(sheet, name, edits, edit),
        None => {
            edits.extend(ids.into_iter().map(|id| Edit::RemoveNode { id }));
            desk.edit(sheet, name, edits);
        }
    }
}

/// What is chosen as text.
fn copied(desk: &Desk<'_>, chosen: &Chosen) -> String {
    copy(desk.session.document(), desk.session.group(), &chosen.pick())
}

/// The edit that brings what a text holds, the upper left corner at a place, and what is there then.
fn pasted(desk: &Desk<'_>, text: &str, at: Pos2) -> Result<(Edit, Chosen), Refusal> {
    let session = desk.session;
    let (edit, pick) = paste(session.document(), Library::standard(), session.group(), text, at.into())?;
    let frames = pick.frames.into_iter().map(NoteId::Frame);
    let notes = frames.chain(pick.comments.into_iter().map(NoteId::Comment)).collect();
    Ok((edit, Chosen { nodes: pick.nodes.into_iter().collect(), notes }))
}
