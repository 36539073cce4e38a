//! What the pointer does on the canvas: pan, select, move, wire, change a number. A gesture changes the document when it
//! ends (a number while it is dragged), and not at all when Escape comes before.

use std::collections::BTreeSet;

use eframe::egui::{self, PointerButton, Pos2, Rect, Response, Vec2};
use halfvector_graph::document::{Link, NodeId, SocketRef, function_of, group_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::REROUTE;
use halfvector_graph::operation::insert_on_link;
use halfvector_graph::value::Value;

use super::adding::Purpose;
use super::fit::{self, Loose, candidates, refusal, sentence};
use super::guides::{self, Snapped};
use super::hit::{self, Hit};
use super::notes::{self, NoteId, Part};
use super::picked::Chosen;
use super::sheet::{Field, REROUTE_SIZE, Sheet, Side};
use super::view::to_grid;
use super::{Canvas, Desk, edits, fields};
use crate::action::Action;

/// How near to a socket a wire may be dropped, in screen points.
const DROP_REACH: f32 = 22.0;

/// What the pointer is doing.
#[derive(Debug, Default)]
pub(super) enum Gesture {
    #[default]
    Idle,
    Pan,
    /// A rectangle is drawn around what is to be selected.
    Box {
        /// Canvas point where it began.
        from: Pos2,
        /// What was chosen before and stays so.
        kept: Chosen,
    },
    Move {
        /// With what lies in the frames among it.
        held: Chosen,
        /// What undo calls it.
        name: String,
        /// Canvas point where it began.
        from: Pos2,
        snapped: Snapped,
        /// The wire that the node would be put into.
        into: Option<usize>,
    },
    Wire {
        loose: Loose,
        /// The link that was taken from its input.
        taken: Option<Link>,
        /// What the last socket under the pointer says to the link.
        asked: Option<(Link, Option<String>)>,
    },
    /// A frame or comment changes its size.
    Resize {
        note: NoteId,
        /// Canvas point where it began.
        from: Pos2,
        way: Vec2,
    },
    Number {
        socket: SocketRef,
        value: f64,
        per_point: f64,
        is_whole: bool,
        /// It stays within.
        range: [f64; 2],
        is_changed: bool,
    },
}

/// Where a wire would end.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    Nothing,
    /// Over a card whose sockets do not fit.
    Card,
    /// Card and row.
    Socket(usize, usize),
}

impl Gesture {
    pub(super) fn is_idle(&self) -> bool {
        matches!(self, Gesture::Idle)
    }

    /// The wire that looks for its other end.
    pub(super) fn loose(&self) -> Option<&Loose> {
        match self {
            Gesture::Wire { loose, .. } => Some(loose),
            _ => None,
        }
    }

    /// The link that is not drawn, as it was taken up.
    pub(super) fn lifted(&self) -> Option<&Link> {
        match self {
            Gesture::Wire { taken, .. } => taken.as_ref(),
            _ => None,
        }
    }

    /// The wire that a dragged node lies on.
    pub(super) fn over_wire(&self) -> Option<usize> {
        match self {
            Gesture::Move { into, .. } => *into,
            _ => None,
        }
    }
}

impl Canvas {
    /// Follows the pointer through a frame.
    pub(super) fn pointer(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &mut Sheet) {
        let pressed = ui.input(|input| input.pointer.any_pressed());
        if pressed && response.contains_pointer() {
            response.request_focus();
        }
        let Some(at) = ui.input(|input| input.pointer.latest_pos()) else { return };
        let modifiers = ui.input(|input| input.modifiers);
        if response.drag_started() {
            self.words = None;
            let origin = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
            let pans = !response.drag_started_by(PointerButton::Primary) || modifiers.alt;
            self.gesture = if pans { Gesture::Pan } else { self.begin(desk, sheet, origin, modifiers) };
        }
        if response.dragged() {
            self.go_on(ui, response, desk, sheet, at);
        }
        // Escape ends a drag of egui's, too.
        if response.drag_stopped() && ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape))
        {
            self.cancel(desk);
        } else if response.drag_stopped() {
            self.finish(ui, desk, sheet, at);
        }
        if response.clicked_by(PointerButton::Primary) {
            self.click(desk, sheet, at, modifiers);
        }
        if response.double_clicked_by(PointerButton::Primary) {
            self.double_click(ui, desk, sheet, at);
        }
        self.shift(sheet);
    }

    /// Gives up what is half done.
    pub(super) fn cancel(&mut self, desk: &mut Desk<'_>) {
        if let Gesture::Number { is_changed: true, .. } = self.gesture {
            desk.actions.push(Action::TakeBack);
        }
        self.gesture = Gesture::Idle;
    }

    fn begin(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, origin: Pos2, modifiers: egui::Modifiers) -> Gesture {
        let from = desk.lens.to_canvas(origin);
        match hit::hit(sheet, desk.lens, origin) {
            Hit::Socket(card, row) => wire_from(sheet, card, row),
            Hit::Field(card, row) if matches!(sheet.cards[card].rows[row].field, Field::Number { .. }) => {
                fields::number_from(&sheet.cards[card], row)
            }
            Hit::Card(card) | Hit::Field(card, _) | Hit::Fold(card) | Hit::Toggle(card) => {
                let id = &sheet.cards[card].id;
                let mut held = self.chosen(desk);
                if !held.nodes.contains(id) {
                    if !modifiers.shift && !modifiers.command {
                        held = Chosen::default();
                    }
                    held.nodes.insert(id.clone());
                    self.choose_only(desk, held.clone());
                }
                moving(held, sheet, from)
            }
            Hit::Note(note, part) => {
                let id = &sheet.notes[note].id;
                let mut held = self.chosen(desk);
                if !held.notes.contains(id) {
                    if !modifiers.shift && !modifiers.command {
                        held = Chosen::default();
                    }
                    held.notes.insert(id.clone());
                    self.choose_only(desk, held.clone());
                }
                match part {
                    Part::Title => moving(held, sheet, from),
                    Part::Corner => Gesture::Resize { note: id.clone(), from, way: Vec2::ZERO },
                }
            }
            Hit::Empty | Hit::Wire(_) => {
                let keeps = modifiers.shift || modifiers.command;
                Gesture::Box { from, kept: if keeps { self.chosen(desk) } else { Chosen::default() } }
            }
        }
    }

    fn go_on(&mut self, ui: &egui::Ui, response: &Response, desk: &mut Desk<'_>, sheet: &mut Sheet, at: Pos2) {
        let modifiers = ui.input(|input| input.modifiers);
        match &mut self.gesture {
            Gesture::Idle => {}
            Gesture::Pan => {
                desk.lens.view = desk.lens.panned(response.drag_delta());
                ui.set_cursor_icon(egui::CursorIcon::Grabbing);
            }
            Gesture::Box { from, kept } => {
                let rect = Rect::from_two_pos(*from, desk.lens.to_canvas(at));
                let mut chosen = kept.clone();
                let cards = sheet.cards.iter().filter(|card| card.rect().intersects(rect));
                chosen.nodes.extend(cards.map(|card| card.id.clone()));
                let notes = sheet.notes.iter().filter(|note| note.is_in_box(rect));
                chosen.notes.extend(notes.map(|note| note.id.clone()));
                self.choose_only(desk, chosen);
            }
            Gesture::Move { held, from, snapped, into, .. } => {
                let way = desk.lens.to_canvas(at) - *from;
                *snapped = if self.keeps_off_grid != modifiers.command {
                    Snapped { way, lines: Vec::new() }
                } else {
                    snap(sheet, held, way, desk.lens)
                };
                *into = wire_for(sheet, held, desk, at);
                ui.set_cursor_icon(egui::CursorIcon::Move);
            }
            Gesture::Resize { note, from, way } => {
                *way = desk.lens.to_canvas(at) - *from;
                if self.keeps_off_grid == modifiers.command
                    && let Some(rect) = sheet.notes.iter().find(|other| other.id == *note).map(|note| note.rect)
                {
                    *way = to_grid(rect.max + *way) - rect.max;
                }
                ui.set_cursor_icon(egui::CursorIcon::ResizeNwSe);
            }
            Gesture::Wire { .. } => ui.set_cursor_icon(egui::CursorIcon::Crosshair),
            Gesture::Number { socket, value, per_point, is_whole, range, is_changed } => {
                let fine = if modifiers.shift { 0.1 } else { 1.0 };
                *value = (*value + f64::from(response.drag_delta().x) * *per_point * fine).clamp(range[0], range[1]);
                let shown = if *is_whole { value.round() } else { fields::rounded(*value, *per_point * fine) };
                let shown = shown.clamp(range[0], range[1]);
                let value = Some(Value::Number(shown as f32));
                if desk.graph.value(socket) != value.as_ref() {
                    *is_changed = true;
                    let edit = Edit::SetValue { socket: socket.clone(), value };
                    desk.drag(format!("Set {}", socket.socket), edit, &format!("canvas {socket}"));
                }
                ui.set_cursor_icon(egui::CursorIcon::ResizeHorizontal);
            }
        }
    }

    fn finish(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &mut Sheet, at: Pos2) {
        self.shift(sheet);
        match std::mem::take(&mut self.gesture) {
            Gesture::Idle | Gesture::Pan | Gesture::Box { .. } => {}
            Gesture::Move { held, name, snapped, into, .. } => {
                let way = snapped.way;
                let all = if way == Vec2::ZERO { Vec::new() } else { held.moved(desk, sheet, way) };
                let (document, group) = (desk.session.document(), desk.session.group());
                // On a wire that it does not fit it only lies, and it is told why.
                let over = into.or_else(|| {
                    loose_card(sheet, &held)?;
                    hit::wire_at(sheet, desk.lens, at, |_| true)
                });
                let insert = |i: usize| {
                    let node = held.nodes.first()?;
                    Some(insert_on_link(document, Library::standard(), group, &sheet.wires[i].link, node))
                };
                match over.and_then(insert) {
                    Some(Ok(edit)) => desk.make_with(sheet, "Insert node into wire", all, edit),
                    refused => {
                        if let Some(Err(why)) = refused {
                            self.say(ui, at, sentence(&why.0));
                        }
                        if !all.is_empty() {
                            desk.edit(sheet, name, all);
                        }
                    }
                }
            }
            Gesture::Resize { note, way, .. } => {
                let note = sheet.notes.iter().find(|other| other.id == note).filter(|_| way != Vec2::ZERO);
                if let Some((note, edit)) =
                    note.and_then(|note| Some((note, note.placed(desk.graph, notes::resized(note.rect, way))?)))
                {
                    desk.edit(sheet, format!("Resize {}", note.kind()), vec![edit]);
                }
            }
            Gesture::Wire { loose, taken, .. } => self.drop_wire(ui, desk, sheet, at, loose, taken),
            Gesture::Number { .. } => desk.actions.push(Action::EndMerge),
        }
    }

    fn drop_wire(
        &mut self,
        ui: &egui::Ui,
        desk: &mut Desk<'_>,
        sheet: &Sheet,
        at: Pos2,
        loose: Loose,
        taken: Option<Link>,
    ) {
        match target(sheet, desk, at, &loose) {
            Target::Socket(card, row) => {
                let link = loose.link(SocketRef::new(&sheet.cards[card].id, &sheet.cards[card].rows[row].name));
                if taken.as_ref() == Some(&link) {
                    return;
                }
                if let Some(why) = refusal(desk.session, &link) {
                    return self.say(ui, at, why);
                }
                let mut all: Vec<Edit> = taken.into_iter().map(|link| Edit::RemoveLink { link }).collect();
                all.push(Edit::AddLink { link });
                desk.edit(sheet, "Connect", all);
            }
            Target::Card => self.say(ui, at, "Nothing of this node goes together with the wire.".into()),
            Target::Nothing => match taken {
                Some(link) => desk.edit(sheet, "Disconnect", vec![Edit::RemoveLink { link }]),
                None => {
                    let purpose = Purpose { at: desk.lens.to_canvas(at), loose: Some(loose), into: None };
                    self.open_palette(desk, at, purpose);
                }
            },
        }
    }

    fn double_click(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        match hit::hit(sheet, desk.lens, at) {
            Hit::Empty => {
                let purpose = Purpose { at: desk.lens.to_canvas(at), ..Purpose::default() };
                self.open_palette(desk, at, purpose);
            }
            Hit::Wire(wire) => {
                let link = sheet.wires[wire].link.clone();
                self.bend(ui, desk, sheet, &link, [desk.lens.to_canvas(at), at]);
            }
            Hit::Note(note, _) => self.write_note(&sheet.notes[note]),
            Hit::Card(card) => {
                let card = &sheet.cards[card];
                if let Some(group) = group_of(&card.definition) {
                    desk.enter(group);
                } else if let Some(function) = function_of(&card.definition) {
                    desk.actions.push(Action::EditFunction(function.to_owned()));
                } else if desk.lens.to_canvas(at).y < card.rect().top() + super::sheet::HEADER {
                    self.rename(sheet, &card.id);
                }
            }
            Hit::Socket(..) | Hit::Field(..) | Hit::Fold(_) | Hit::Toggle(_) => {}
        }
    }

    /// Puts a reroute into a wire, where the pointer is: on the grid it might lie on a card.
    pub(super) fn bend(
        &mut self,
        ui: &egui::Ui,
        desk: &mut Desk<'_>,
        sheet: &Sheet,
        link: &Link,
        [at, screen]: [Pos2; 2],
    ) {
        let mut arrival = edits::add(desk.session, REROUTE, (at - REROUTE_SIZE / 2.0).into());
        if edits::put_into(desk.session, &mut arrival, link) {
            desk.arrive(sheet, "Add reroute", arrival);
        } else {
            self.say(ui, screen, "A surface or a picture goes through no reroute.".to_owned());
        }
    }

    fn click(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2, modifiers: egui::Modifiers) {
        let hit = hit::hit(sheet, desk.lens, at);
        match hit {
            Hit::Fold(card) => switch(&mut self.unfolded.inputs, &sheet.cards[card].id),
            Hit::Toggle(card) => switch(&mut self.unfolded.pictures, &sheet.cards[card].id),
            Hit::Field(card, row) => self.edit_field(desk, sheet, card, row),
            _ => {}
        }
        let mut chosen = self.chosen(desk);
        let adds = modifiers.shift || modifiers.command;
        match (hit.card(), hit) {
            (Some(card), _) => {
                let id = sheet.cards[card].id.clone();
                if !adds {
                    chosen = Chosen::default();
                }
                if !(adds && chosen.nodes.remove(&id)) {
                    chosen.nodes.insert(id);
                }
            }
            (None, Hit::Note(note, _)) => {
                let id = sheet.notes[note].id.clone();
                if !adds {
                    chosen = Chosen::default();
                }
                if !(adds && chosen.notes.remove(&id)) {
                    chosen.notes.insert(id);
                }
            }
            _ if adds => {}
            _ => chosen = Chosen::default(),
        }
        self.choose_only(desk, chosen);
    }

    /// Shows dragged cards where they are dragged to.
    fn shift(&self, sheet: &mut Sheet) {
        match &self.gesture {
            Gesture::Move { held, snapped, .. } => {
                let cards = sheet.cards.iter_mut().filter(|card| held.nodes.contains(&card.id));
                cards.for_each(|card| card.shift = snapped.way);
                let notes = sheet.notes.iter_mut().filter(|note| held.notes.contains(&note.id));
                notes.for_each(|note| note.shown = note.rect.translate(snapped.way));
            }
            Gesture::Resize { note, way, .. } => {
                if let Some(note) = sheet.notes.iter_mut().find(|other| other.id == *note) {
                    note.shown = notes::resized(note.rect, *way);
                }
            }
            _ => {}
        }
    }
}

/// What is chosen on its way.
fn moving(chosen: Chosen, sheet: &Sheet, from: Pos2) -> Gesture {
    let name = format!("Move {}", chosen.words());
    Gesture::Move { held: chosen.with_contents(sheet), name, from, snapped: Snapped::default(), into: None }
}

/// Puts an id into a set, or takes it out.
pub(super) fn switch(set: &mut BTreeSet<NodeId>, id: &str) {
    if !set.remove(id) {
        set.insert(id.to_owned());
    }
}

/// A wire taken up at a socket: of a wired input the other end, of any other socket a new one.
fn wire_from(sheet: &Sheet, card: usize, row: usize) -> Gesture {
    let (own, socket) = (&sheet.cards[card], &sheet.cards[card].rows[row]);
    let name = SocketRef::new(&own.id, &socket.name);
    let wire = sheet.wires.iter().find(|wire| wire.to == (card, row));
    let (loose, taken) = match (socket.side, wire) {
        (Side::Input, Some(wire)) => (Loose::Output(wire.link.from.clone(), wire.ty), Some(wire.link.clone())),
        (Side::Input, None) => (Loose::Input(name, candidates(socket.ty, socket.is_generic, &own.generic)), None),
        _ => (Loose::Output(name, socket.ty), None),
    };
    Gesture::Wire { loose, taken, asked: None }
}

fn snap(sheet: &Sheet, held: &Chosen, way: Vec2, lens: super::Lens) -> Snapped {
    let (mut moving, mut others) = (None::<Rect>, Vec::new());
    let seen = lens.seen();
    for card in &sheet.cards {
        let rect = Rect::from_min_size(card.place, card.size);
        if held.nodes.contains(&card.id) {
            moving = Some(moving.map_or(rect, |all| all.union(rect)));
        } else if seen.intersects(rect) {
            others.push(rect);
        }
    }
    for note in sheet.notes.iter().filter(|note| held.notes.contains(&note.id)) {
        moving = Some(moving.map_or(note.rect, |all| all.union(note.rect)));
    }
    moving.map_or_else(Snapped::default, |moving| guides::snap(moving, &others, way, lens.view.zoom))
}

/// The only node that is dragged, when nothing is wired to it.
fn loose_card<'s>(sheet: &'s Sheet, held: &Chosen) -> Option<&'s super::Card> {
    let id = held.nodes.first().filter(|_| held.nodes.len() == 1 && held.notes.is_empty())?;
    sheet.card(id).filter(|card| card.rows.iter().all(|row| !row.is_wired))
}

/// The wire that a single unwired node is dragged on to, when it fits in there.
fn wire_for(sheet: &Sheet, held: &Chosen, desk: &Desk<'_>, at: Pos2) -> Option<usize> {
    let card = loose_card(sheet, held)?;
    let def = desk.library.get(&card.definition)?;
    hit::wire_at(sheet, desk.lens, at, |i| {
        let wire = &sheet.wires[i];
        let (to, row) = (&sheet.cards[wire.to.0], &sheet.cards[wire.to.0].rows[wire.to.1]);
        let wanted = candidates(row.ty, row.is_generic, &to.generic);
        wanted.into_iter().any(|wanted| fit::through(def, wire.ty, wanted).is_some())
    })
}

/// Where a wire that is dropped at a point would end: at the nearest socket of the right side; on a card at the first free
/// socket that fits.
pub(super) fn target(sheet: &Sheet, desk: &Desk<'_>, at: Pos2, loose: &Loose) -> Target {
    let wanted = if matches!(loose, Loose::Output(..)) { Side::Input } else { Side::Output };
    let own = loose.socket();
    let near = hit::socket_near(sheet, desk.lens, at, DROP_REACH, |side| side == wanted);
    if let Some((card, row)) = near {
        return Target::Socket(card, row);
    }
    let Some(card) = hit::card_at(sheet, desk.lens, at) else { return Target::Nothing };
    let over = &sheet.cards[card];
    if over.id == own.node {
        return Target::Nothing;
    }
    // On the line of an input that one is meant, whether it fits or not.
    let y = desk.lens.to_canvas(at).y - over.rect().top();
    let level = over
        .rows
        .iter()
        .position(|row| row.side == wanted && row.has_socket() && (row.y - y).abs() <= super::sheet::ROW / 2.0);
    let free =
        || over.rows.iter().position(|row| loose.fits_row(over, row) && (!row.is_wired || wanted == Side::Output));
    match level.or_else(free) {
        Some(row) => Target::Socket(card, row),
        None => Target::Card,
    }
}
