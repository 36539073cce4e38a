//! The graph laid out: cards, rows, sockets and wires in units of the canvas. It is made anew when the document changes,
//! and holds nothing that the document does not say. It draws nothing.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use eframe::egui::{self, FontId, Pos2, Rect, Vec2, pos2, vec2};
use halfvector_graph::check::{Problem, Severity, node_label};
use halfvector_graph::document::{Document, Graph, Link, NodeId, SocketRef, group_of};
use halfvector_graph::node_def::REROUTE;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::{SocketType, Type};

use super::Unfolded;
use super::arrange;
use super::notes::{self, Note};
use super::rows::{rows_of, rows_of_unknown};
use crate::colors::nodes_of_colors;
use crate::session::Session;

/// Height of a card's title.
pub(super) const HEADER: f32 = 26.0;
/// Height of a row.
pub(super) const ROW: f32 = 21.0;
/// Free space under the last row.
pub(super) const FOOT: f32 = 6.0;
/// Free space between a card's edge and its text.
pub(super) const MARGIN: f32 = 12.0;
/// Sizes of the title's and the rows' letters.
pub(super) const TITLE_SIZE: f32 = 13.0;
pub(super) const ROW_SIZE: f32 = 12.0;
/// Side of the picture of what a node gives.
const PICTURE: f32 = 96.0;
/// Room that a card needs that is not laid out yet.
const NEW: Vec2 = vec2(220.0, 180.0);
/// Size of the dot that bends a wire.
pub(super) const REROUTE_SIZE: Vec2 = vec2(28.0, 16.0);

/// The whole graph.
#[derive(Debug)]
pub(super) struct Sheet {
    document: Arc<Document>,
    group: Option<String>,
    unfolded: Unfolded,
    /// What is wrong with pictures.
    notices: Arc<Vec<Problem>>,
    pub(super) notes: Vec<Note>,
    pub(super) cards: Vec<Card>,
    index: HashMap<NodeId, usize>,
    pub(super) wires: Vec<Wire>,
}

/// A node.
#[derive(Debug)]
pub(super) struct Card {
    pub(super) id: NodeId,
    /// Id of the definition.
    pub(super) definition: String,
    pub(super) title: String,
    /// What the definition says of itself; why there is none when it is unknown.
    pub(super) help: String,
    pub(super) place: Pos2,
    pub(super) size: Vec2,
    /// How far it is dragged away from its place at the moment.
    pub(super) shift: Vec2,
    /// The types that `T` may be.
    pub(super) generic: Vec<Type>,
    pub(super) rows: Vec<Row>,
    /// The worst problem first.
    pub(super) problems: Vec<(Severity, String)>,
    pub(super) is_selected: bool,
    /// How costly it is, 0 to 1, when the graph is coloured by it.
    pub(super) heat: Option<f32>,
    /// Whether a picture of what it gives is shown.
    is_pictured: bool,
}

/// A socket, or what a card offers besides.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) side: Side,
    pub(super) name: String,
    /// The name as people read it.
    pub(super) label: String,
    /// With `T` replaced.
    pub(super) ty: SocketType,
    pub(super) is_generic: bool,
    /// Centre below the card's top.
    pub(super) y: f32,
    pub(super) is_wired: bool,
    pub(super) help: String,
    pub(super) field: Field,
}

/// Where a row's socket is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Input,
    Output,
    /// No socket: more inputs are shown or hidden here.
    Fold,
}

/// What an unconnected input shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Field {
    None,
    Number {
        value: f32,
        range: Option<[f32; 2]>,
        is_whole: bool,
        unit: String,
    },
    Color([f32; 3]),
    Switch(bool),
    /// Several numbers.
    Vector(Vec<f32>),
    /// A note that cannot be changed here: a context, a picture.
    Note(String),
}

/// A link whose ends are shown.
#[derive(Debug)]
pub(super) struct Wire {
    pub(super) link: Link,
    /// Card and row of the output.
    pub(super) from: (usize, usize),
    /// Card and row of the input.
    pub(super) to: (usize, usize),
    pub(super) ty: SocketType,
}

impl Sheet {
    /// Lays out the level that is worked on.
    pub(super) fn new(context: &egui::Context, session: &Session, unfolded: &Unfolded) -> Sheet {
        let (document, graph, library) = (session.document(), session.graph(), session.library());
        let types = resolve_types(graph, library);
        let colors = nodes_of_colors(graph, &types);
        let wired: HashSet<&SocketRef> = graph.links.iter().flat_map(|link| [&link.from, &link.to]).collect();
        let is_top = session.group().is_none();
        let offered = document.parameters.iter().map(|parameter| &parameter.socket);
        let offered: HashSet<&SocketRef> = offered.filter(|_| is_top).collect();
        let mut cards: Vec<Card> = Vec::with_capacity(graph.nodes.len());
        for (id, node) in &graph.nodes {
            let is_wired = |socket: &str| wired.contains(&SocketRef::new(id, socket));
            let is_offered = |socket: &str| offered.contains(&SocketRef::new(id, socket));
            let rows = match types.get(id) {
                Some(types) => {
                    let is_used = |name: &str| is_wired(name) || node.values.contains_key(name) || is_offered(name);
                    let values = &node.values;
                    let has_colors = colors.contains(id.as_str());
                    rows_of(types, values, has_colors, is_wired, is_used, unfolded.inputs.contains(id))
                }
                None => rows_of_unknown(graph, id),
            };
            let def = types.get(id).map(|types| types.def);
            cards.push(Card {
                id: id.clone(),
                definition: node.node.clone(),
                title: node_label(graph, library, id),
                help: def.map_or_else(|| format!("The node {} is not known here.", node.node), |def| def.help.clone()),
                place: Pos2::ZERO,
                size: Vec2::ZERO,
                shift: Vec2::ZERO,
                generic: def.map(|def| def.generic.clone()).unwrap_or_default(),
                rows,
                problems: Vec::new(),
                is_selected: false,
                heat: None,
                is_pictured: unfolded.pictures.contains(id),
            });
        }
        let index: HashMap<NodeId, usize> = cards.iter().enumerate().map(|(i, card)| (card.id.clone(), i)).collect();
        context.fonts_mut(|fonts| cards.iter_mut().for_each(|card| card.size = card.measured(fonts)));
        for problem in session.all_problems().filter(|problem| problem.group.as_deref() == session.group()) {
            if let Some(card) = problem.node.as_ref().and_then(|id| index.get(id)).map(|&i| &mut cards[i]) {
                let socket = problem.socket.as_ref().map_or_else(String::new, |socket| format!("{socket}: "));
                card.problems.push((problem.severity, format!("{socket}{}", problem.message)));
                card.problems.sort_by_key(|(severity, _)| *severity);
            }
        }
        for card in &mut cards {
            if let Some(group) = group_of(&card.definition) {
                card.problems.extend(problems_inside(session, group));
                card.problems.sort_by_key(|(severity, _)| *severity);
            }
        }
        let mut sheet = Sheet {
            document: document.clone(),
            group: session.group().map(str::to_owned),
            unfolded: unfolded.clone(),
            notices: session.notices().clone(),
            notes: notes::notes(graph),
            wires: wires(graph, &cards, &index),
            cards,
            index,
        };
        sheet.place(graph);
        sheet
    }

    /// Whether this is the layout of the level that is worked on.
    pub(super) fn is_of(&self, session: &Session, unfolded: &Unfolded) -> bool {
        Arc::ptr_eq(&self.document, session.document())
            && self.group.as_deref() == session.group()
            && self.unfolded == *unfolded
            && Arc::ptr_eq(&self.notices, session.notices())
    }

    /// The card of a node.
    pub(super) fn card(&self, id: &str) -> Option<&Card> {
        self.index.get(id).map(|&i| &self.cards[i])
    }

    /// The rectangle around some cards; none when there are none.
    pub(super) fn bounds<'c>(cards: impl Iterator<Item = &'c Card>) -> Option<Rect> {
        cards.map(Card::rect).reduce(Rect::union)
    }

    /// The rectangle around all cards, frames and comments; none when there are none.
    pub(super) fn whole(&self) -> Option<Rect> {
        // Like a card's place, a note's counts only where it can be drawn.
        let is_near = |rect: &Rect| [rect.min, rect.max].iter().all(|at| at.x.abs() < 1e6 && at.y.abs() < 1e6);
        let notes = self.notes.iter().map(|note| note.shown).filter(is_near);
        self.cards.iter().map(Card::rect).chain(notes).reduce(Rect::union)
    }

    /// The nearest place below a point, or there, where a card does not lie on others.
    pub(super) fn free_place(&self, at: Pos2) -> Pos2 {
        let mut place = Rect::from_min_size(at, NEW);
        while let Some(low) = self
            .cards
            .iter()
            .map(Card::rect)
            .filter(|rect| rect.expand(8.0).intersects(place))
            .map(|rect| rect.bottom())
            .reduce(f32::max)
        {
            place = Rect::from_min_size(pos2(at.x, low + 24.0), NEW);
        }
        place.min
    }

    /// The place of a socket.
    pub(super) fn socket(&self, (card, row): (usize, usize)) -> Pos2 {
        self.cards[card].socket(&self.cards[card].rows[row])
    }

    /// The row of a socket, if it is shown.
    pub(super) fn find(&self, socket: &SocketRef, side: Side) -> Option<(usize, usize)> {
        let card = *self.index.get(&socket.node)?;
        let row = self.cards[card].rows.iter().position(|row| row.side == side && row.name == socket.socket)?;
        Some((card, row))
    }

    /// Puts the cards where the document says. Where it says nothing, they are arranged by depth, below all others.
    fn place(&mut self, graph: &Graph) {
        let layout = &graph.layout;
        let finite = |place: &[f32; 2]| place.iter().all(|x| x.is_finite() && x.abs() < 1e6);
        let mut lowest = f32::NEG_INFINITY;
        let mut leftmost = f32::INFINITY;
        let mut homeless = Vec::new();
        for (i, card) in self.cards.iter_mut().enumerate() {
            match layout.get(&card.id).filter(|place| finite(place)) {
                Some(place) => {
                    card.place = pos2(place[0], place[1]);
                    lowest = lowest.max(card.place.y + card.size.y);
                    leftmost = leftmost.min(card.place.x);
                }
                None => homeless.push(i),
            }
        }
        if homeless.is_empty() {
            return;
        }
        let corner = if lowest.is_finite() { pos2(leftmost, lowest + 60.0) } else { Pos2::ZERO };
        for (i, place) in arrange::places(self, &homeless) {
            self.cards[i].place = corner + place.to_vec2();
        }
    }
}

impl Card {
    /// Where it is seen.
    pub(super) fn rect(&self) -> Rect {
        Rect::from_min_size(self.place + self.shift, self.size)
    }

    /// The place of a row's socket.
    pub(super) fn socket(&self, row: &Row) -> Pos2 {
        let rect = self.rect();
        let x = if row.side == Side::Output { rect.right() } else { rect.left() };
        pos2(x, rect.top() + row.y)
    }

    /// Where a row's value is shown and changed.
    pub(super) fn field(&self, row: &Row) -> Option<Rect> {
        let width = row.field.width();
        (width > 0.0).then(|| {
            let rect = self.rect();
            let center = pos2(rect.right() - 8.0 - width / 2.0, rect.top() + row.y);
            Rect::from_center_size(center, vec2(width, ROW - 4.0))
        })
    }

    /// Whether there can be a picture of what it gives.
    pub(super) fn has_picture(&self) -> bool {
        let is_seen = |row: &Row| row.side == Side::Output && row.ty != SocketType::Texture;
        !self.is_reroute() && self.rows.iter().any(is_seen)
    }

    /// Where the picture of what it gives is, when that is shown.
    pub(super) fn picture(&self) -> Option<Rect> {
        let rect = self.rect();
        let center = pos2(rect.center().x, rect.bottom() - FOOT - PICTURE / 2.0);
        (self.is_pictured && self.has_picture()).then(|| Rect::from_center_size(center, Vec2::splat(PICTURE)))
    }

    /// Where the picture is put on and off.
    pub(super) fn toggle(&self) -> Pos2 {
        let rect = self.rect();
        pos2(rect.right() - 18.0, rect.top() + HEADER / 2.0)
    }

    /// Whether it only bends a wire.
    pub(super) fn is_reroute(&self) -> bool {
        self.definition == REROUTE
    }

    /// Category of the definition, such as `math`.
    pub(super) fn category(&self) -> &str {
        self.definition.split_once('/').map_or("", |(category, _)| category)
    }

    fn measured(&self, fonts: &mut egui::epaint::FontsView<'_>) -> Vec2 {
        if self.is_reroute() {
            return REROUTE_SIZE;
        }
        let mut width_of = |text: &str, size: f32| {
            let font = FontId::proportional(size);
            fonts.layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE).size().x
        };
        let title = width_of(&self.title, TITLE_SIZE) + MARGIN + 48.0;
        let row = |row: &Row| width_of(&row.label, ROW_SIZE) + row.field.width() + MARGIN * 2.0 + 8.0;
        let widest = self.rows.iter().map(row).fold(title, f32::max);
        let last = self.rows.last().map_or(HEADER / 2.0, |row| row.y);
        let foot = if self.is_pictured && self.has_picture() { PICTURE + FOOT } else { 0.0 };
        let bottom = if last <= HEADER / 2.0 { HEADER + FOOT } else { last + ROW / 2.0 + FOOT };
        vec2((widest / 4.0).ceil().clamp(30.0, 70.0) * 4.0, bottom + foot)
    }
}

impl Field {
    fn width(&self) -> f32 {
        match self {
            Field::None => 0.0,
            Field::Number { .. } => 64.0,
            Field::Color(_) => 40.0,
            Field::Switch(_) => 17.0,
            Field::Vector(parts) => 24.0 + 24.0 * parts.len() as f32,
            Field::Note(text) => (text.chars().count() as f32 * 6.2).min(110.0),
        }
    }
}

/// A name as people read it.
pub(super) fn shown(name: &str) -> String {
    name.replace('_', " ")
}

/// A number in few digits.
pub(super) fn number(value: f32) -> String {
    let size = value.abs();
    let text = if size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:.2e}")
    } else {
        let digits = if size >= 1000.0 {
            0
        } else if size >= 100.0 {
            1
        } else {
            3
        };
        format!("{value:.digits$}")
    };
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// What is wrong inside of a group, and in the groups in it.
fn problems_inside(session: &Session, group: &str) -> Vec<(Severity, String)> {
    let groups = &session.document().groups;
    let mut inside = vec![group];
    let mut next = 0;
    while let Some(held) = inside.get(next).and_then(|id| groups.get(*id)) {
        next += 1;
        for id in held.graph.nodes.values().filter_map(|node| group_of(&node.node)) {
            if groups.contains_key(id) && !inside.contains(&id) {
                inside.push(id);
            }
        }
    }
    let is_inside = |problem: &&Problem| problem.group.as_deref().is_some_and(|group| inside.contains(&group));
    let words = |problem: &Problem| {
        let label = problem.node_label.as_deref().or(problem.node.as_deref());
        let label = label.map_or_else(String::new, |label| format!("{label}: "));
        (problem.severity, format!("Inside, {label}{}", problem.message))
    };
    session.all_problems().filter(is_inside).map(words).collect()
}

fn wires(graph: &Graph, cards: &[Card], index: &HashMap<NodeId, usize>) -> Vec<Wire> {
    let find = |socket: &SocketRef, side: Side| {
        let card = *index.get(&socket.node)?;
        let row = cards[card].rows.iter().position(|row| row.side == side && row.name == socket.socket)?;
        Some((card, row))
    };
    let shown = graph.links.iter().filter_map(|link| {
        let (from, to) = (find(&link.from, Side::Output)?, find(&link.to, Side::Input)?);
        Some(Wire { link: link.clone(), from, to, ty: cards[from.0].rows[from.1].ty })
    });
    shown.collect()
}
