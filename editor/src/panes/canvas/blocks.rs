//! Nodes arranged together with the frames around them and the comments beside them. What lies in a frame is arranged by
//! itself, and the frame then stands among the others like one large card; a comment lies beside what it is nearest to.

use eframe::egui::{Pos2, Rect, Vec2, vec2};
use halfvector_graph::edit::Edit;

use super::arrange::{Thing, lanes, places_of};
use super::notes::{Note, NoteId};
use super::sheet::Sheet;
use super::view::{GRID, to_grid};
use super::{Canvas, Desk, moved};
use crate::action::Action;

/// Free space between a frame's edges and what lies in it: on the left and above, on the right and below.
const WITHIN: [Vec2; 2] = [vec2(GRID, 2.0 * GRID), vec2(GRID, GRID)];
/// How near what lies beside a card is left where it is, and how near the rest comes. Both are less than what lies between cards,
/// so that all belong to the same ones when they are arranged again.
const NEAR: f32 = 20.0;
const BESIDE: f32 = 10.0;

/// What is moved as one: cards and notes with their places from its corner.
#[derive(Debug, Default)]
struct Block {
    /// What other notes can lie beside: where it was, and where it is from the corner.
    anchors: Vec<[Rect; 2]>,
    cards: Vec<(usize, Vec2)>,
    notes: Vec<(usize, Rect)>,
    size: Vec2,
}

impl Block {
    fn shift(&mut self, by: Vec2) {
        self.cards.iter_mut().for_each(|(_, place)| *place += by);
        self.notes.iter_mut().for_each(|(_, rect)| *rect = rect.translate(by));
        self.anchors.iter_mut().for_each(|[_, rect]| *rect = rect.translate(by));
    }

    /// Takes in what lies beside one of its anchors.
    fn take(&mut self, sheet: &Sheet, cluster: &Cluster, anchor: usize) {
        let now = beside(cluster.was, self.anchors[anchor], &self.anchors);
        let way = now.min - cluster.was.min;
        self.notes.extend(cluster.notes.iter().map(|&i| (i, sheet.notes[i].rect.translate(way))));
        self.anchors.push([cluster.was, now]);
        let all = Rect::from_min_size(Pos2::ZERO, self.size).union(now);
        // Its cards stay on the grid.
        let by = vec2((-all.min.x / GRID).ceil(), (-all.min.y / GRID).ceil()) * GRID;
        self.shift(by);
        self.size = all.max.to_vec2() + by;
    }
}

/// A comment, or a frame without nodes and what lies in it.
#[derive(Debug)]
struct Cluster {
    was: Rect,
    notes: Vec<usize>,
}

/// Where something goes that was beside an anchor: as far from it as it was when that is near, else just beside it, on the same side. It makes
/// way for what is there.
fn beside(was: Rect, [anchor, now]: [Rect; 2], all: &[[Rect; 2]]) -> Rect {
    let before = [anchor.left() - was.right(), anchor.top() - was.bottom()];
    let behind = [was.left() - anchor.right(), was.top() - anchor.bottom()];
    let gap = |axis: usize| before[axis].max(behind[axis]);
    let axis = usize::from(gap(1) >= gap(0));
    // What lies on it goes above it.
    let is_on = gap(axis) < 0.0;
    let axis = if is_on { 1 } else { axis };
    let is_before = is_on || before[axis] >= behind[axis];
    let keeps = !is_on && distance(was, anchor) <= NEAR;
    let size = was.size();
    let far = if keeps { gap(axis) } else { BESIDE };
    let mut place = now.min + (was.min - anchor.min);
    place[axis] = if is_before { now.min[axis] - far - size[axis] } else { now.max[axis] + far };
    let other = 1 - axis;
    let slack = if keeps { NEAR } else { 0.0 };
    let (low, high) = match keeps {
        true => (now.min[other] - size[other] - slack, now.max[other] + slack),
        false => (now.min[other], (now.max[other] - size[other]).max(now.min[other])),
    };
    place[other] = place[other].clamp(low, high);
    // On whole numbers, so that nothing wanders when it is arranged again. What it lies on pushes it farther out.
    let mut rect = Rect::from_min_size(place.round(), size);
    while let Some([_, there]) = all.iter().find(|[_, there]| there.shrink(0.5).intersects(rect)) {
        place[axis] = if is_before { there.min[axis] - BESIDE - size[axis] } else { there.max[axis] + BESIDE };
        rect = Rect::from_min_size(place.round(), size);
    }
    rect
}

/// Arranges cards with the frames among `notes`, and the comments there beside what they are nearest to.
fn arranged(sheet: &Sheet, cards: &[usize], notes: &[usize]) -> Block {
    let mut blocks: Vec<Block> = Vec::new();
    let (mut free_cards, mut clusters) = (cards.to_vec(), Vec::new());
    // Large frames come first: what lies in one is not looked at again.
    let mut waiting = notes.to_vec();
    while !waiting.is_empty() {
        let i = waiting.remove(0);
        let note = &sheet.notes[i];
        let (inside, outside): (Vec<usize>, Vec<usize>) =
            free_cards.iter().copied().partition(|&card| note.holds(&sheet.cards[card]));
        let (held, others): (Vec<usize>, Vec<usize>) =
            waiting.iter().copied().partition(|&other| note.holds_note(&sheet.notes[other]));
        (free_cards, waiting) = (outside, others);
        if inside.is_empty() {
            clusters.push(Cluster { was: note.rect, notes: std::iter::once(i).chain(held).collect() });
            continue;
        }
        let mut block = arranged(sheet, &inside, &held);
        block.shift(WITHIN[0]);
        block.size += WITHIN[0] + WITHIN[1];
        let now = Rect::from_min_size(Pos2::ZERO, block.size);
        block.notes.push((i, now));
        block.anchors = vec![[note.rect, now]];
        blocks.push(block);
    }
    for card in free_cards {
        let size = sheet.cards[card].size;
        let anchors = vec![[sheet.cards[card].rect(), Rect::from_min_size(Pos2::ZERO, size)]];
        blocks.push(Block { anchors, size, cards: vec![(card, Vec2::ZERO)], ..Block::default() });
    }
    // In an order that does not depend on where anything is.
    blocks.sort_by_key(|block| block.cards.iter().map(|(card, _)| *card).min());
    clusters.sort_by(|a, b| sheet.notes[a.notes[0]].id.cmp(&sheet.notes[b.notes[0]].id));
    while let Some((cluster, block, anchor)) = nearest(&blocks, &clusters) {
        let cluster = clusters.remove(cluster);
        blocks[block].take(sheet, &cluster, anchor);
    }
    let mut thing_of = vec![None; sheet.cards.len()];
    for (i, block) in blocks.iter().enumerate() {
        for (j, (card, corner)) in block.cards.iter().enumerate() {
            thing_of[*card] = Some((i, j, *corner));
        }
    }
    let thing = |block: &Block| {
        let cards = block.cards.iter().map(|(i, corner)| Rect::from_min_size(corner.to_pos2(), sheet.cards[*i].size));
        Thing { size: block.size, cards: cards.collect() }
    };
    let things: Vec<Thing> = blocks.iter().map(thing).collect();
    let mut whole = Block::default();
    for (mut block, place) in blocks.into_iter().zip(places_of(&things, &lanes(sheet, &thing_of))) {
        block.shift(place.to_vec2());
        whole.size = whole.size.max(place.to_vec2() + block.size);
        whole.cards.append(&mut block.cards);
        whole.notes.append(&mut block.notes);
    }
    whole
}

/// What of the clusters is nearest to something of the blocks: which, to which block and to what of it.
fn nearest(blocks: &[Block], clusters: &[Cluster]) -> Option<(usize, usize, usize)> {
    let ways = clusters.iter().enumerate().flat_map(|(i, cluster)| {
        blocks.iter().enumerate().flat_map(move |(j, block)| {
            let ways = block.anchors.iter().enumerate();
            ways.map(move |(k, [was, _])| (distance(cluster.was, *was), (i, j, k)))
        })
    });
    ways.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, which)| which)
}

/// How far two rectangles are apart.
fn distance(a: Rect, b: Rect) -> f32 {
    let gap = |a_min: f32, a_max: f32, b_min: f32, b_max: f32| (b_min - a_max).max(a_min - b_max).max(0.0);
    vec2(gap(a.left(), a.right(), b.left(), b.right()), gap(a.top(), a.bottom(), b.top(), b.bottom())).length()
}

/// The corner of cards and frames: what lies beside them does not count.
fn corner(rects: impl Iterator<Item = Rect>) -> Option<Vec2> {
    rects.reduce(Rect::union).map(|rect| rect.min.to_vec2())
}

impl Canvas {
    /// Puts the selected cards, or all when fewer than two are selected, in columns; frames and comments go with them.
    pub(super) fn arrange(&mut self, desk: &mut Desk<'_>, sheet: &Sheet) {
        let selected: Vec<usize> = (0..sheet.cards.len()).filter(|&i| sheet.cards[i].is_selected).collect();
        let chosen = if selected.len() >= 2 { selected } else { (0..sheet.cards.len()).collect() };
        let held = |note: &Note| (0..sheet.cards.len()).filter(|&i| note.holds(&sheet.cards[i])).collect::<Vec<_>>();
        // A frame of which some cards stay where they are does not go, nor does what is beside such a card.
        let nearest = |note: &Note| {
            let all = 0..sheet.cards.len();
            all.min_by(|&a, &b| {
                let way = |i: usize| distance(note.rect, sheet.cards[i].rect());
                way(a).total_cmp(&way(b))
            })
        };
        let goes = |note: &Note| match held(note).as_slice() {
            [] => nearest(note).is_some_and(|card| chosen.contains(&card)),
            held => held.iter().all(|i| chosen.contains(i)),
        };
        let (notes, staying): (Vec<usize>, Vec<usize>) = (0..sheet.notes.len()).partition(|&i| goes(&sheet.notes[i]));
        let all = arranged(sheet, &chosen, &notes);
        let frames = || all.notes.iter().filter(|(i, _)| !held(&sheet.notes[*i]).is_empty());
        let were = all.cards.iter().map(|(i, _)| sheet.cards[*i].rect());
        let were = corner(were.chain(frames().map(|(i, _)| sheet.notes[*i].rect)));
        let are = all.cards.iter().map(|(i, place)| Rect::from_min_size(place.to_pos2(), sheet.cards[*i].size));
        let are = corner(are.chain(frames().map(|(_, rect)| *rect)));
        let (Some(were), Some(are)) = (were, are) else { return };
        let mut by = to_grid(were.to_pos2()) - are.to_pos2();
        // Others that stay make them go below.
        let others =
            || (0..sheet.cards.len()).filter(|i| !chosen.contains(i)).map(|i| sheet.cards[i].rect().expand(GRID / 2.0));
        let is_on = |by: Vec2| {
            let mut rects =
                all.cards.iter().map(|(i, place)| Rect::from_min_size((*place + by).to_pos2(), sheet.cards[*i].size));
            rects.any(|rect| others().any(|other| other.intersects(rect)))
        };
        while is_on(by) {
            by.y += GRID;
        }
        let place_of = |card: usize| {
            let found = all.cards.iter().find(|(i, _)| *i == card);
            found.map_or(sheet.cards[card].place, |(_, place)| (*place + by).to_pos2())
        };
        let mut edits: Vec<Edit> = all.cards.iter().map(|(i, _)| moved(&sheet.cards[*i], place_of(*i))).collect();
        let placed = all.notes.iter().map(|(i, rect)| (*i, rect.translate(by)));
        edits.extend(placed.filter_map(|(i, rect)| sheet.notes[i].placed(desk.graph, rect)));
        for note in staying.iter().map(|&i| &sheet.notes[i]).filter(|note| matches!(note.id, NoteId::Frame(_))) {
            let rects = held(note).into_iter().map(|i| Rect::from_min_size(place_of(i), sheet.cards[i].size));
            let around = |rect: Rect| Rect::from_min_max(rect.min - WITHIN[0], rect.max + WITHIN[1]);
            // It grows, so that it goes on to hold what it held.
            let grown = rects.map(around).fold(note.rect, Rect::union);
            edits.extend((grown != note.rect).then(|| note.placed(desk.graph, grown)).flatten());
        }
        // Where all is in its place already there is nothing to undo.
        if Canvas::changes(desk, &edits) {
            desk.make("Arrange nodes", Edit::Many(edits));
        } else {
            desk.actions.push(Action::Say("All is arranged.".to_owned()));
        }
    }

    /// Whether edits of places change any.
    fn changes(desk: &Desk<'_>, edits: &[Edit]) -> bool {
        let graph = desk.graph;
        edits.iter().any(|edit| match edit {
            Edit::MoveNode { id, position } => graph.layout.get(id) != position.as_ref(),
            Edit::SetFrame { id, frame } => graph.frames.get(id) != Some(frame),
            Edit::SetComment { id, comment } => graph.comments.get(id) != Some(comment),
            _ => true,
        })
    }
}
