//! Nodes that come: the palette, what it offers at a place of the canvas, and where the chosen one goes.

use eframe::egui::{self, Id, Pos2};
use halfvector_graph::check::node_label;
use halfvector_graph::document::{Link, Node, SocketRef, free_name, group_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::SocketType;

use super::fit::{self, Loose};
use super::sheet::{ROW, Row, Sheet, Side, shown};
use super::{Canvas, Desk, edits, hit, view};
use crate::action::Action;
use crate::dropped::{Kind, no_picture, take};
use crate::functions;
use crate::palette::{self, Outcome};
use crate::pictures;

/// The node that a dropped picture becomes.
const IMAGE: &str = "textures/image";

/// Where a node of the palette goes.
#[derive(Clone, Debug, Default)]
pub(super) struct Purpose {
    /// Its place on the canvas.
    pub(super) at: Pos2,
    /// The wire that it is for.
    pub(super) loose: Option<Loose>,
    /// The wire that it is put into.
    pub(super) into: Option<Link>,
}

impl Canvas {
    /// Opens the palette.
    pub(super) fn open_palette(&mut self, desk: &Desk<'_>, at: Pos2, purpose: Purpose) {
        let words = |socket: &SocketRef| {
            let label = node_label(desk.graph, desk.library, &socket.node);
            format!("“{}” of {label}", shown(&socket.socket))
        };
        let named = |purpose: &Purpose| match (&purpose.loose, &purpose.into) {
            (Some(Loose::Output(socket, _)), _) => Some(format!("Nodes that take {}", words(socket))),
            (Some(Loose::Input(socket, _)), _) => Some(format!("Nodes that give {}", words(socket))),
            (None, Some(_)) => Some("Nodes that can stand in this wire".to_owned()),
            (None, None) => None,
        };
        let types = halfvector_graph::resolve::resolve_types(desk.graph, desk.library);
        let ends = purpose.into.as_ref().and_then(|link| {
            let given = types.get(&link.from.node)?.output(&link.from.socket)?;
            Some((given, types.get(&link.to.node)?.input(&link.to.socket)?))
        });
        let path = desk.session.path();
        // A group cannot hold itself.
        let is_around = |def: &NodeDef| group_of(&def.id).is_some_and(|id| path.iter().any(|outer| outer == id));
        let offers = |def: &NodeDef| match (&purpose.loose, ends) {
            _ if is_around(def) => false,
            (Some(loose), _) => loose.socket_of(def).is_some(),
            (None, Some((given, wanted))) => fit::through(def, given, wanted).is_some(),
            (None, None) => true,
        };
        self.palette.open(at, desk.library, named(&purpose), offers);
        self.purpose = purpose;
    }

    /// Shows the palette and adds the node that is chosen.
    pub(super) fn choose(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) {
        let canvas = Id::new("graph canvas");
        match self.palette.show(ui, ui.ctx().content_rect(), desk.library) {
            Outcome::None => return,
            Outcome::Closed => {}
            Outcome::Chosen(definition) => self.add(desk, sheet, &definition),
        }
        ui.memory_mut(|memory| memory.request_focus(canvas));
    }

    pub(super) fn add(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, definition: &str) {
        if definition == palette::NEW_FUNCTION {
            let at = std::mem::take(&mut self.purpose).at;
            self.add_function(desk, sheet, at);
            return;
        }
        let Some(def) = desk.library.get(definition) else { return };
        let purpose = std::mem::take(&mut self.purpose);
        let at = if self.keeps_off_grid { purpose.at } else { view::to_grid(purpose.at) };
        let mut arrival = edits::add(desk.session, definition, at.into());
        let id = arrival.ids[0].clone();
        if let Some(loose) = &purpose.loose
            && let Some(socket) = loose.socket_of(def)
        {
            arrival.edits.push(desk.session.here(Edit::AddLink { link: loose.link(SocketRef::new(&id, socket)) }));
        }
        if let Some(link) = &purpose.into {
            edits::put_into(desk.session, &mut arrival, link);
        }
        desk.arrive(sheet, format!("Add {}", def.label), arrival);
    }

    /// Gives a picture that is dropped on a node to its input, and adds a node for each that is dropped beside them, one below the
    /// other.
    pub(super) fn take_dropped(&mut self, ui: &egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, pointer: Option<Pos2>) {
        let Some(at) = pointer.filter(|at| desk.lens.pane.contains(*at)) else { return };
        if let Some(socket) = picture_input(desk, sheet, at) {
            let files = take(ui.ctx(), |kind| kind == Kind::Picture);
            desk.actions.extend(files.first().map(|path| pictures::chosen(desk.session, &socket, path)));
            if let Some(path) = take(ui.ctx(), |kind| kind == Kind::Radiance).first() {
                self.say(ui, at, no_picture(path));
            }
        }
        let mut all = edits::Arrival::default();
        let mut place = view::to_grid(desk.lens.to_canvas(at));
        for path in take(ui.ctx(), |kind| kind == Kind::Picture) {
            let id = free_name("image", |id| desk.graph.nodes.contains_key(id) || all.ids.iter().any(|one| one == id));
            let value = pictures::value(desk.session, IMAGE, "image", &path);
            let node = Edit::AddNode { id: id.clone(), node: Node::new(IMAGE).with("image", value) };
            let position = Edit::MoveNode { id: id.clone(), position: Some(place.into()) };
            all.edits.push(desk.session.here(Edit::Many(vec![node, position])));
            all.ids.push(id);
            place.y += view::GRID * 12.0;
        }
        if !all.ids.is_empty() {
            desk.arrive(sheet, "Add a picture", all);
        }
    }

    /// Adds a function of the document with a node of it, and brings its text to the front.
    pub(super) fn add_function(&self, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let at = if self.keeps_off_grid { at } else { view::to_grid(at) };
        let (id, function) = functions::new(desk.session.document());
        let mut arrival = edits::add(desk.session, &format!("custom/{id}"), at.into());
        arrival.edits.insert(0, function);
        desk.arrive(sheet, "New function", arrival);
        desk.actions.push(Action::EditFunction(id));
    }
}

/// The input for pictures of the node at a point of the screen: the one on that line, or the first.
fn picture_input(desk: &Desk<'_>, sheet: &Sheet, at: Pos2) -> Option<SocketRef> {
    let card = &sheet.cards[hit::card_at(sheet, desk.lens, at)?];
    let y = desk.lens.to_canvas(at).y - card.rect().top();
    let takes = |row: &&Row| row.side == Side::Input && row.ty == SocketType::Texture && !row.is_wired;
    let rows = || card.rows.iter().filter(takes);
    let row = rows().find(|row| (row.y - y).abs() <= ROW / 2.0).or_else(|| rows().next())?;
    Some(SocketRef::new(&card.id, &row.name))
}
