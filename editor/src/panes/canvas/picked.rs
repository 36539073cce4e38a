//! What is chosen in the graph: nodes, which the session knows, and frames and comments, which the canvas knows. What is done with
//! them is done with both.

use std::collections::BTreeSet;
use std::path::Path;

use eframe::egui::{self, Pos2, Rect, Vec2, vec2};
use halfvector_graph::document::{Document, NodeId};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::{from_json, to_json};
use halfvector_graph::library::Library;
use halfvector_graph::operation::{Pasted, Pick, Refusal, copy, paste, remove_and_heal};

use super::edits::Arrival;
use super::fit::sentence;
use super::notes::NoteId;
use super::sheet::Sheet;
use super::view::{GRID, to_grid};
use super::{Canvas, Desk, moved};
use crate::action::Action;
use crate::session::{names_pictures, with_images_moved};

/// The field of a copied document's file with the folder that its relative paths start from.
const COPIED_FROM: &str = "copied_from";
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
            ui.ctx().copy_text(copied_text(desk, &chosen));
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
        let Ok(copied) = from_json(text) else {
            return self.say(ui, at, "The clipboard holds no nodes.".to_owned());
        };
        let copied = here(desk, copied);
        match pasted(desk, &copied, to_grid(desk.lens.to_canvas(at))) {
            Ok(pasted) => {
                // What comes out of view is shown.
                let places = copied.graph.layout.values().map(|place| Pos2::from(*place));
                let all = places.map(|place| Rect::from_min_size(place, Vec2::ZERO)).reduce(Rect::union);
                let middle = all.map(|all| desk.lens.to_canvas(at) + all.size() / 2.0);
                if middle.is_some_and(|middle| !desk.lens.seen().contains(middle)) {
                    self.wanted.clone_from(&pasted.pick.nodes);
                }
                self.take_in(desk, sheet, ["Paste", "Pasted"], pasted);
            }
            Err(why) => self.say(ui, at, sentence(&why.0)),
        }
    }

    pub(super) fn duplicate(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let chosen = self.chosen(desk).with_contents(sheet);
        let Some(rect) = chosen.bounds(sheet) else { return };
        match pasted(desk, &copied(desk, &chosen), rect.min + BESIDE) {
            Ok(pasted) => self.take_in(desk, sheet, ["Duplicate", "Duplicated"], pasted),
            Err(why) => desk.actions.push(Action::Say(sentence(&why.0))),
        }
    }

    fn take_in(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, [verb, done]: [&str; 2], pasted: Pasted) {
        let Pasted { edit, pick, notes } = pasted;
        let frames = pick.frames.into_iter().map(NoteId::Frame);
        let notes_of_graph = frames.chain(pick.comments.into_iter().map(NoteId::Comment)).collect();
        let chosen = Chosen { nodes: pick.nodes.into_iter().collect(), notes: notes_of_graph };
        let words = chosen.words();
        self.picked = chosen.notes;
        let ids = chosen.nodes.into_iter().collect();
        desk.arrive(sheet, format!("{verb} {words}"), Arrival { edits: vec![edit], ids });
        if !notes.is_empty() {
            desk.actions.push(Action::Say(format!("{done} {words}: {}.", notes.join("; "))));
        }
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

/// What is chosen as a document of its own.
fn copied(desk: &Desk<'_>, chosen: &Chosen) -> Document {
    copy(desk.session.document(), desk.session.group(), &chosen.pick())
}

/// What is chosen as text. With pictures it says where their relative paths start, so that they mean the same files in another window.
fn copied_text(desk: &Desk<'_>, chosen: &Chosen) -> String {
    let mut copied = copied(desk, chosen);
    if names_pictures(&copied) {
        copied.unknown.insert(COPIED_FROM.to_owned(), folder(desk).into());
    }
    to_json(&copied)
}

/// What was copied, with the paths of its pictures as this document writes them.
fn here(desk: &Desk<'_>, copied: Document) -> Document {
    let from = copied.unknown.get(COPIED_FROM).and_then(|from| from.as_str()).filter(|from| *from != folder(desk));
    let moved = from.and_then(|from| with_images_moved(&copied, Path::new(from), &desk.session.directory()));
    moved.unwrap_or(copied)
}

/// The folder that relative paths of this document start from.
fn folder(desk: &Desk<'_>) -> String {
    let folder = desk.session.directory();
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { &folder };
    std::path::absolute(folder).unwrap_or_default().to_string_lossy().into_owned()
}

fn pasted(desk: &Desk<'_>, copied: &Document, at: Pos2) -> Result<Pasted, Refusal> {
    paste(desk.session.document(), Library::standard(), desk.session.group(), copied, at.into())
}
