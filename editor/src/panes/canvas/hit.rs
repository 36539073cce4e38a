//! What lies under a point of the screen.

use eframe::egui::Pos2;

use super::draw::Detail;
use super::notes::{self, Part};
use super::sheet::{Sheet, Side};
use super::view::Lens;
use super::wire;

/// How near a point must be to a socket and to a wire, in screen points.
const SOCKET_REACH: f32 = 9.0;
const WIRE_REACH: f32 = 6.0;

/// What lies there. Cards and rows by their places in the sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Hit {
    #[default]
    Empty,
    Card(usize),
    /// Card and row.
    Socket(usize, usize),
    /// The value of an input.
    Field(usize, usize),
    /// Where inputs are shown or hidden.
    Fold(usize),
    /// Where the picture is put on and off.
    Toggle(usize),
    Wire(usize),
    /// A frame or comment, and what of it.
    Note(usize, Part),
}

impl Hit {
    /// The card that is meant, if one is.
    pub(super) fn card(self) -> Option<usize> {
        match self {
            Hit::Card(card) | Hit::Socket(card, _) | Hit::Field(card, _) | Hit::Fold(card) | Hit::Toggle(card) => {
                Some(card)
            }
            Hit::Empty | Hit::Wire(_) | Hit::Note(..) => None,
        }
    }
}

/// What lies under a point: sockets first, then cards from the uppermost, then wires, then notes.
pub(super) fn hit(sheet: &Sheet, lens: Lens, point: Pos2) -> Hit {
    if let Some((card, row)) = socket_near(sheet, lens, point, SOCKET_REACH, |_| true) {
        return Hit::Socket(card, row);
    }
    if let Some(card) = card_at(sheet, lens, point) {
        return part(sheet, lens, point, card);
    }
    if let Some(wire) = wire_at(sheet, lens, point, |_| true) {
        return Hit::Wire(wire);
    }
    notes::note_at(sheet, lens, point).map_or(Hit::Empty, |(note, part)| Hit::Note(note, part))
}

/// The uppermost card under a point. Selected cards lie above the others.
pub(super) fn card_at(sheet: &Sheet, lens: Lens, point: Pos2) -> Option<usize> {
    let at = lens.to_canvas(point);
    let under = |selected: bool| {
        let cards = sheet.cards.iter().enumerate().rev();
        cards.filter(move |(_, card)| card.is_selected == selected && card.rect().contains(at)).map(|(i, _)| i).next()
    };
    under(true).or_else(|| under(false))
}

/// The socket nearest to a point, if one is near enough.
pub(super) fn socket_near(
    sheet: &Sheet,
    lens: Lens,
    point: Pos2,
    reach: f32,
    wanted: impl Fn(Side) -> bool,
) -> Option<(usize, usize)> {
    let at = lens.to_canvas(point);
    // Sockets stay findable when they are drawn small, but not so that they cover their cards.
    let reach = (reach / lens.view.zoom).min(16.0);
    let mut nearest = None;
    let mut best = reach;
    for (i, card) in sheet.cards.iter().enumerate() {
        if !card.rect().expand(reach).contains(at) {
            continue;
        }
        for (j, row) in card.rows.iter().enumerate().filter(|(_, row)| row.has_socket() && wanted(row.side)) {
            let distance = card.socket(row).distance(at) + if card.is_reroute() { reach * 0.45 } else { 0.0 };
            if distance < best {
                best = distance;
                nearest = Some((i, j));
            }
        }
    }
    nearest
}

/// The wire under a point.
pub(super) fn wire_at(sheet: &Sheet, lens: Lens, point: Pos2, wanted: impl Fn(usize) -> bool) -> Option<usize> {
    let mut points = Vec::new();
    let mut nearest = None;
    let mut best = WIRE_REACH;
    for (i, wire) in sheet.wires.iter().enumerate().filter(|(i, _)| wanted(*i)) {
        let (from, to) = (lens.to_screen(sheet.socket(wire.from)), lens.to_screen(sheet.socket(wire.to)));
        if !wire::bounds(from, to, lens.view.zoom).expand(WIRE_REACH).contains(point) {
            continue;
        }
        wire::curve(from, to, lens.view.zoom, &mut points);
        let distance = wire::distance(&points, point);
        if distance < best {
            best = distance;
            nearest = Some(i);
        }
    }
    nearest
}

fn part(sheet: &Sheet, lens: Lens, point: Pos2, index: usize) -> Hit {
    if Detail::of(lens) != Detail::Full {
        return Hit::Card(index);
    }
    let card = &sheet.cards[index];
    let at = lens.to_canvas(point);
    if card.has_picture() && card.toggle().distance(at) < 9.0 {
        return Hit::Toggle(index);
    }
    for (j, row) in card.rows.iter().enumerate() {
        let is_level = (at.y - card.rect().top() - row.y).abs() <= super::sheet::ROW / 2.0;
        if is_level && row.side == Side::Fold {
            return Hit::Fold(index);
        }
        if row.field.is_editable() && card.field(row).is_some_and(|rect| rect.contains(at)) {
            return Hit::Field(index, j);
        }
    }
    Hit::Card(index)
}
