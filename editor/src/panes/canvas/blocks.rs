//! Nodes arranged together with the frames around them and the comments beside them. What lies in a frame is arranged by
//! itself, and the frame then stands among the others like one large card; a comment keeps its place beside its node.

use eframe::egui::{Pos2, Rect, Vec2, vec2};
use halfvector_graph::edit::Edit;

use super::arrange::{edges, places_of};
use super::notes::{Note, NoteId};
use super::sheet::Sheet;
use super::view::{GRID, to_grid};
use super::{Canvas, Desk, moved};

/// Free space between a frame's edges and what lies in it: on the left and above, on the right and below.
const WITHIN: [Vec2; 2] = [vec2(GRID, 2.0 * GRID), vec2(GRID, GRID)];
/// How near a comment must be to what it belongs to.
const NEAR: f32 = 60.0;

/// What is moved as one: cards and notes with their places from its corner.
#[derive(Debug, Default)]
struct Block {
    /// Where all of it was.
    was: Option<Rect>,
    cards: Vec<(usize, Vec2)>,
    notes: Vec<(usize, Rect)>,
    size: Vec2,
}

impl Block {
    fn shift(&mut self, by: Vec2) {
        self.cards.iter_mut().for_each(|(_, place)| *place += by);
        self.notes.iter_mut().for_each(|(_, rect)| *rect = rect.translate(by));
    }

    /// Puts a note beside it, as far away as it was.
    fn take(&mut self, i: usize, note: &Note) {
        let was = self.was.unwrap_or(note.rect);
        // What stood right of it or below stays there, also when it has become larger.
        let side = |low: f32, near: f32, far: f32, size: f32| if low >= far { size + low - far } else { low - near };
        let place = vec2(
            side(note.rect.left(), was.left(), was.right(), self.size.x),
            side(note.rect.top(), was.top(), was.bottom(), self.size.y),
        );
        self.notes.push((i, Rect::from_min_size(place.to_pos2(), note.rect.size())));
        let all =
            Rect::from_min_size(Pos2::ZERO, self.size).union(Rect::from_min_size(place.to_pos2(), note.rect.size()));
        self.shift(-all.min.to_vec2());
        self.size = all.size();
        self.was = Some(was.union(note.rect));
    }
}

/// Arranges cards with the frames among `notes`, and the comments there; what is near to none of them is left out when it `stays`.
fn arranged(sheet: &Sheet, cards: &[usize], notes: &[usize], stays: bool) -> Block {
    let mut blocks: Vec<Block> = Vec::new();
    let (mut free_cards, mut free_notes) = (cards.to_vec(), Vec::new());
    // Large frames come first: what lies in one is not looked at again.
    let mut waiting = notes.to_vec();
    while !waiting.is_empty() {
        let i = waiting.remove(0);
        let note = &sheet.notes[i];
        let (inside, outside): (Vec<usize>, Vec<usize>) =
            free_cards.iter().copied().partition(|&card| note.holds(&sheet.cards[card]));
        if inside.is_empty() {
            free_notes.push(i);
            continue;
        }
        let (held, others): (Vec<usize>, Vec<usize>) =
            waiting.iter().copied().partition(|&other| note.holds_note(&sheet.notes[other]));
        (free_cards, waiting) = (outside, others);
        let mut block = arranged(sheet, &inside, &held, false);
        block.shift(WITHIN[0]);
        block.size += WITHIN[0] + WITHIN[1];
        block.notes.push((i, Rect::from_min_size(Pos2::ZERO, block.size)));
        block.was = Some(note.rect);
        blocks.push(block);
    }
    for card in free_cards {
        let (was, size) = (Some(sheet.cards[card].rect()), sheet.cards[card].size);
        blocks.push(Block { was, size, cards: vec![(card, Vec2::ZERO)], ..Block::default() });
    }
    for i in free_notes {
        let note = &sheet.notes[i];
        let way = |block: &Block| block.was.map_or(f32::INFINITY, |was| distance(was, note.rect));
        let nearest = blocks.iter_mut().min_by(|a, b| way(a).total_cmp(&way(b)));
        match nearest.filter(|block| way(block) <= NEAR) {
            Some(block) => block.take(i, note),
            None if stays => {}
            None => {
                let notes = vec![(i, Rect::from_min_size(Pos2::ZERO, note.rect.size()))];
                blocks.push(Block { size: note.rect.size(), notes, ..Block::default() });
            }
        }
    }
    let mut block_of = vec![None; sheet.cards.len()];
    for (i, block) in blocks.iter().enumerate() {
        block.cards.iter().for_each(|(card, _)| block_of[*card] = Some(i));
    }
    let sizes: Vec<Vec2> = blocks.iter().map(|block| block.size).collect();
    let mut whole = Block::default();
    for (mut block, place) in blocks.into_iter().zip(places_of(&sizes, edges(&sheet.wires, &block_of))) {
        block.shift(place.to_vec2());
        whole.size = whole.size.max(place.to_vec2() + block.size);
        whole.cards.append(&mut block.cards);
        whole.notes.append(&mut block.notes);
    }
    whole
}

/// How far two rectangles are apart.
fn distance(a: Rect, b: Rect) -> f32 {
    let gap = |a_min: f32, a_max: f32, b_min: f32, b_max: f32| (b_min - a_max).max(a_min - b_max).max(0.0);
    vec2(gap(a.left(), a.right(), b.left(), b.right()), gap(a.top(), a.bottom(), b.top(), b.bottom())).length()
}

impl Canvas {
    /// Puts the selected cards, or all when fewer than two are selected, in columns; frames and comments go with them.
    pub(super) fn arrange(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let selected: Vec<usize> = (0..sheet.cards.len()).filter(|&i| sheet.cards[i].is_selected).collect();
        let chosen = if selected.len() >= 2 { selected } else { (0..sheet.cards.len()).collect() };
        let held = |note: &Note| (0..sheet.cards.len()).filter(|&i| note.holds(&sheet.cards[i])).collect::<Vec<_>>();
        // A frame of which some cards stay where they are does not go.
        let goes = |note: &Note| held(note).iter().all(|i| chosen.contains(i));
        let (notes, staying): (Vec<usize>, Vec<usize>) = (0..sheet.notes.len()).partition(|&i| goes(&sheet.notes[i]));
        let all = arranged(sheet, &chosen, &notes, true);
        let rects = all.cards.iter().map(|(i, _)| sheet.cards[*i].rect());
        let rects = rects.chain(all.notes.iter().map(|(i, _)| sheet.notes[*i].rect));
        let Some(corner) = rects.reduce(Rect::union).map(|rect| to_grid(rect.min).to_vec2()) else { return };
        let place_of = |card: usize| {
            let found = all.cards.iter().find(|(i, _)| *i == card);
            found.map_or(sheet.cards[card].place, |(_, place)| (*place + corner).to_pos2())
        };
        let mut edits: Vec<Edit> = all.cards.iter().map(|(i, _)| moved(&sheet.cards[*i], place_of(*i))).collect();
        let placed = all.notes.iter().map(|(i, rect)| (*i, rect.translate(corner)));
        edits.extend(placed.filter_map(|(i, rect)| sheet.notes[i].placed(desk.graph, rect)));
        for note in staying.iter().map(|&i| &sheet.notes[i]).filter(|note| matches!(note.id, NoteId::Frame(_))) {
            let rects = held(note).into_iter().map(|i| Rect::from_min_size(place_of(i), sheet.cards[i].size));
            let around = |rect: Rect| Rect::from_min_max(rect.min - WITHIN[0], rect.max + WITHIN[1]);
            // It grows, so that it goes on to hold what it held.
            let grown = rects.map(around).fold(note.rect, Rect::union);
            edits.extend((grown != note.rect).then(|| note.placed(desk.graph, grown)).flatten());
        }
        if !edits.is_empty() {
            desk.make("Arrange nodes", Edit::Many(edits));
        }
    }
}
