//! The graph: cards, wires and what a person does with them.
//!
//! `sheet` lays the document out, `view` says what part of it is seen, `hit` what lies under the pointer, `draw` paints. What a
//! person does goes through `gesture` (the pointer), `keys`, `menus` and `adding` (the palette), and becomes edits (`edits`, `fit`, `arrange`,
//! `guides`). The document is never changed here: what is half done, such as a drag, is kept until it is done and then
//! returned as one action.

mod adding;
mod announce;
mod arrange;
mod blocks;
mod connect;
mod draw;
mod edits;
mod feedback;
mod fields;
mod fit;
mod gesture;
mod guides;
mod hit;
mod keys;
mod menus;
mod minimap;
mod notes;
mod picked;
mod rows;
mod sheet;
mod tips;
mod view;
mod wire;

use std::collections::BTreeSet;

use eframe::egui::{self, Id, Pos2, Rect, Sense, Vec2, pos2, vec2};
use halfvector_graph::document::{Graph, NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;

use crate::action::Action;
use crate::palette::Palette;
use crate::session::Session;
use crate::theme;
use crate::thumbnails::Thumbnails;
use adding::Purpose;
use connect::Connecting;
use draw::{Brush, Detail};
use fields::Editing;
use gesture::Gesture;
use hit::Hit;
pub(crate) use keys::Verb;
use menus::Meant;
use notes::NoteId;
use sheet::{Card, Sheet};
use view::{Lens, View};

/// Zoom at which a node that is looked for is shown at least.
const READABLE: f32 = 0.7;

/// The graph's view.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    /// The session, and the groups in it that were entered: which graph is shown.
    level: (u64, Vec<String>),
    /// None until it was drawn once.
    view: Option<View>,
    /// The view that showed everything, and the size of the pane that it did so in: until it is moved it goes on to.
    fitted: Option<(View, Vec2)>,
    /// Nodes that are to be brought into view.
    wanted: Vec<NodeId>,
    sheet: Option<Sheet>,
    gesture: Gesture,
    editing: Option<Editing>,
    /// What the open menu is about.
    meant: Meant,
    palette: Palette,
    /// What is done with the node that the palette gives.
    purpose: Purpose,
    /// What is unfolded on cards.
    unfolded: Unfolded,
    /// Why something was not done, where, and until when that is shown.
    words: Option<(String, Pos2, f64)>,
    /// The frames and comments that were chosen.
    picked: BTreeSet<NoteId>,
    /// What the selected node is to be joined with.
    connecting: Option<Connecting>,
    keeps_off_grid: bool,
    hides_map: bool,
    /// What the window's menu asks for.
    asked: Vec<Verb>,
    /// Whether a menu or a dialog was open when the frame began.
    was_covered: bool,
}

/// Which nodes show more than usual.
#[derive(Clone, Debug, Default, PartialEq)]
struct Unfolded {
    /// Their unused inputs.
    inputs: BTreeSet<NodeId>,
    /// A picture of what they give.
    pictures: BTreeSet<NodeId>,
}

/// What the parts of the canvas work on in a frame.
struct Desk<'a> {
    session: &'a Session,
    /// The level that is worked on, and the nodes that it can be made of.
    graph: &'a Graph,
    library: &'a Library,
    lens: Lens,
    actions: &'a mut Vec<Action>,
}

impl Desk<'_> {
    /// Makes edits as one step. Cards that have no place in the document yet get the one where they are seen, so that they
    /// do not jump when others move.
    fn edit(&mut self, sheet: &Sheet, name: impl Into<String>, edits: Vec<Edit>) {
        let edits = self.settled(sheet, edits);
        self.make(name, Edit::Many(edits));
    }

    /// Edits, and before them the places of the cards that have none.
    fn settled(&self, sheet: &Sheet, edits: Vec<Edit>) -> Vec<Edit> {
        let layout = &self.graph.layout;
        let homeless = sheet.cards.iter().filter(|card| !layout.contains_key(&card.id));
        homeless.map(|card| moved(card, card.place)).chain(edits).collect()
    }

    /// Makes edits of the level, and one of the document, as one step.
    fn make_with(&mut self, sheet: &Sheet, name: impl Into<String>, edits: Vec<Edit>, of_document: Edit) {
        let here = self.session.here(Edit::Many(self.settled(sheet, edits)));
        self.actions.push(Action::edit(name, Edit::Many(vec![here, of_document])));
    }

    /// Makes an edit of the level.
    fn make(&mut self, name: impl Into<String>, edit: Edit) {
        self.actions.push(Action::edit(name, self.session.here(edit)));
    }

    /// Makes an edit of the level that joins those before it with the same key.
    fn drag(&mut self, name: impl Into<String>, edit: Edit, key: &str) {
        self.actions.push(Action::drag(name, self.session.here(edit), key));
    }

    /// Goes into a group, or out of it.
    fn enter(&mut self, group: &str) {
        let mut path = self.session.path().to_vec();
        path.push(group.to_owned());
        self.actions.push(Action::Enter(path));
    }

    fn leave(&mut self) {
        if let [outer @ .., _] = self.session.path() {
            self.actions.push(Action::Enter(outer.to_vec()));
        }
    }

    /// Adds what arrives and selects it.
    fn arrive(&mut self, sheet: &Sheet, name: impl Into<String>, arrival: edits::Arrival) {
        self.make_with(sheet, name, Vec::new(), Edit::Many(arrival.edits));
        self.actions.push(Action::Select(arrival.ids));
    }
}

/// The edit that puts a card somewhere.
fn moved(card: &Card, place: Pos2) -> Edit {
    Edit::MoveNode { id: card.id.clone(), position: Some([place.x, place.y]) }
}

impl Canvas {
    /// Called when a frame begins, before anything is drawn that may close a menu or a dialog.
    pub(crate) fn begin_frame(&mut self, context: &egui::Context) {
        self.was_covered = keys::is_covered(context);
    }

    /// Brings a node into view when the canvas is drawn next.
    pub(crate) fn show_node(&mut self, node: NodeId) {
        self.wanted = vec![node];
    }

    /// The place of the graph in the middle of what is seen, on the grid.
    pub(crate) fn middle(&self) -> [f32; 2] {
        self.view.map_or([0.0; 2], |view| view::to_grid(view.center).into())
    }

    /// What cannot be seen well in the graph as it was drawn last, in words: a wire that runs behind a card which it has nothing to do with, a
    /// card on another one.
    pub(crate) fn tangles(&self) -> Vec<String> {
        let Some(Sheet { cards, wires, .. }) = &self.sheet else { return Vec::new() };
        let mut found = Vec::new();
        let mut points = Vec::new();
        for wire in wires {
            let [from, to] = [wire.from, wire.to].map(|(card, row)| cards[card].socket(&cards[card].rows[row]));
            wire::curve(from, to, 1.0, &mut points);
            for (i, card) in cards.iter().enumerate().filter(|(i, _)| *i != wire.from.0 && *i != wire.to.0) {
                if wire::behind(&points, card.rect()) > 0 {
                    found.push(format!("{} to {} behind {}", wire.link.from, wire.link.to, cards[i].id));
                }
            }
        }
        for (i, card) in cards.iter().enumerate() {
            let on = cards[..i].iter().filter(|other| other.rect().intersects(card.rect()));
            found.extend(on.map(|other| format!("{} on {}", card.id, other.id)));
        }
        found
    }

    /// Does something with the selected nodes when the canvas is drawn next.
    pub(crate) fn ask(&mut self, verb: Verb) {
        self.asked.push(verb);
    }

    /// Draws the graph.
    pub(crate) fn show(
        &mut self,
        ui: &mut egui::Ui,
        session: &Session,
        thumbnails: &mut Thumbnails,
        actions: &mut Vec<Action>,
    ) {
        let (graph, library) = (session.graph(), session.library());
        let level = (session.number(), session.path().to_vec());
        if self.level != level {
            // Another graph is there: it is shown whole.
            *self = Canvas {
                level,
                wanted: std::mem::take(&mut self.wanted),
                palette: std::mem::take(&mut self.palette),
                keeps_off_grid: self.keeps_off_grid,
                hides_map: self.hides_map,
                was_covered: self.was_covered,
                ..Canvas::default()
            };
        }
        let mut sheet = match self.sheet.take() {
            Some(sheet) if sheet.is_of(session, &self.unfolded) => sheet,
            _ => Sheet::new(ui.ctx(), session, &self.unfolded),
        };
        for card in &mut sheet.cards {
            card.is_selected = session.selection().contains(&card.id);
            card.heat = session.heat().get(&card.id).copied();
            card.shift = egui::Vec2::ZERO;
        }
        sheet.notes.iter_mut().for_each(|note| note.shown = note.rect);
        self.picked.retain(|id| sheet.notes.iter().any(|note| note.id == *id));
        let pane = ui.available_rect_before_wrap();
        let response = ui.interact(pane, Id::new("graph canvas"), Sense::click_and_drag());
        ui.advance_cursor_after_rect(pane);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, "Graph canvas"));
        if pane.width() < 8.0 || pane.height() < 8.0 {
            self.sheet = Some(sheet);
            return;
        }
        let lens = Lens { pane, view: self.looked(&sheet, pane) };
        let mut desk = Desk { session, graph, library, lens, actions };
        let bar = Rect::from_min_size(pane.min + vec2(6.0, 5.0), vec2((pane.width() - 12.0).max(0.0), 24.0));
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let is_over = response.hovered();
        if let Some(pointer) = pointer.filter(|_| response.hovered()) {
            desk.lens.view = view::wheel(ui, desk.lens, pointer);
        }
        let map = self.map(ui, &mut desk, &sheet);
        if !map {
            self.pointer(ui, &response, &mut desk, &mut sheet);
        }
        self.keys(ui, &response, &mut desk, &sheet);
        self.do_asked(ui, &response, &mut desk, &sheet);
        self.take_dropped(ui, &mut desk, &sheet, pointer);
        let hovered = pointer.filter(|_| is_over && !map).map_or(Hit::Empty, |at| hit::hit(&sheet, desk.lens, at));

        let colors = theme::canvas(ui.visuals());
        let painter = ui.painter_at(pane);
        draw::grid(&painter, desk.lens, &colors);
        let loose = self.gesture.loose().cloned();
        let takes = loose.map(|loose| {
            move |card: &Card, row: &sheet::Row| {
                loose.fits_row(card, row) || *loose.socket() == SocketRef::new(&card.id, &row.name)
            }
        });
        let brush = Brush {
            painter: &painter,
            lens: desk.lens,
            colors,
            detail: Detail::of(desk.lens),
            takes: takes.as_ref().map(|takes| takes as &dyn Fn(&Card, &sheet::Row) -> bool),
        };
        self.paint(&brush, &sheet, hovered, |brush, card| picture(ui, brush, session, card, thumbnails));
        if let Some(socket) = self.announce(ui, &mut desk, &sheet) {
            self.connect(ui, &mut desk, &sheet, Some(socket));
        }
        self.paint_gesture(ui, &brush, &desk, &sheet, pointer);
        self.paint_map(&brush, &sheet, pointer);
        self.bar(ui, bar, &mut desk, &sheet);
        self.fields(ui, &mut desk, &sheet);
        let is_busy = self.palette.is_open() || self.editing.is_some() || self.connecting.is_some();
        let is_asked = self.gesture.is_idle() && !is_busy;
        if is_over && !map && is_asked && self.words.is_none() {
            tips::show(&response, &sheet, desk.lens, hovered);
        }
        self.menu(ui, &response, &mut desk, &sheet, hovered);
        self.choose(ui, &mut desk, &sheet);
        self.show_connecting(ui, &mut desk, &sheet);
        self.paint_words(ui, &brush);
        self.view = Some(desk.lens.view);
        self.sheet = Some(sheet);
    }

    /// The view of this frame: as it was, or where something is wanted.
    fn looked(&mut self, sheet: &Sheet, pane: Rect) -> View {
        let wanted = std::mem::take(&mut self.wanted);
        let cards = wanted.iter().filter_map(|id| sheet.card(id));
        if let (Some(rect), Some(view)) = (Sheet::bounds(cards), self.view) {
            return seen_whole(rect, Lens { pane, view });
        }
        match (self.view, self.fitted) {
            (Some(view), Some((fitted, size))) if view == fitted && size != pane.size() => self.whole(sheet, pane),
            (Some(view), _) => view,
            (None, _) => self.whole(sheet, pane),
        }
    }

    /// The view that shows all cards, frames and comments.
    fn whole(&mut self, sheet: &Sheet, pane: Rect) -> View {
        let bounds = sheet.whole();
        let view = bounds.map_or_else(View::default, |rect| View::showing(rect, below_bar(pane)));
        self.fitted = Some((view, pane.size()));
        view
    }

    /// Shows what is chosen whole, or all when nothing is.
    fn fit(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, only_selected: bool) {
        let chosen = only_selected.then(|| self.chosen(desk).bounds(sheet)).flatten();
        desk.lens.view = match chosen {
            Some(rect) => View::showing(rect, below_bar(desk.lens.pane)),
            None => self.whole(sheet, desk.lens.pane),
        };
    }

    fn paint(&self, brush: &Brush<'_>, sheet: &Sheet, hovered: Hit, mut picture: impl FnMut(&Brush<'_>, &Card)) {
        brush.notes(sheet, &self.picked);
        let lifted = self.gesture.lifted();
        let hovered_wire = match hovered {
            Hit::Wire(wire) if self.gesture.is_idle() => Some(wire),
            _ => self.gesture.over_wire(),
        };
        brush.wires(sheet, hovered_wire, |i| lifted == Some(&sheet.wires[i].link));
        let seen = brush.lens.seen().expand(12.0);
        for selected in [false, true] {
            for (i, card) in sheet.cards.iter().enumerate() {
                if card.is_selected == selected && card.rect().intersects(seen) {
                    brush.card(card, hovered.card() == Some(i));
                    // With its card, so that it lies below what lies on that.
                    picture(brush, card);
                }
            }
        }
        if let Hit::Socket(card, row) = hovered
            && self.gesture.is_idle()
        {
            let ty = sheet.cards[card].rows[row].ty;
            brush.ring(brush.lens.to_screen(sheet.socket((card, row))), theme::socket_color(ty));
        }
    }

    /// Says at a point of the screen why something was not done.
    fn say(&mut self, ui: &egui::Ui, at: Pos2, text: String) {
        self.words = Some((text, at, ui.input(|input| input.time) + 4.0));
        ui.ctx().request_repaint_after(std::time::Duration::from_secs(5));
    }

    fn paint_words(&mut self, ui: &egui::Ui, brush: &Brush<'_>) {
        let now = ui.input(|input| input.time);
        match &self.words {
            Some((text, at, until)) if now < *until => {
                draw::words(brush.painter, *at, text, theme::ERROR, &brush.colors);
                announce::words(ui, text);
            }
            _ => self.words = None,
        }
    }

    /// Buttons in the corner for what the keys do.
    fn bar(&mut self, ui: &mut egui::Ui, rect: Rect, desk: &mut Desk<'_>, sheet: &Sheet) {
        let mut ui = ui
            .new_child(egui::UiBuilder::new().max_rect(rect).layout(egui::Layout::left_to_right(egui::Align::Center)));
        ui.spacing_mut().item_spacing.x = 4.0;
        if ui.button("Add").on_hover_text("Add a node (Space)").clicked() {
            let at = sheet.free_place(desk.lens.pane_center());
            let below = pos2(rect.left(), rect.bottom() + 4.0);
            self.open_palette(desk, below, Purpose { at, ..Purpose::default() });
        }
        if ui.button("Arrange").on_hover_text("Put the nodes in columns, in the order of their wires (L)").clicked() {
            self.arrange(desk, sheet);
        }
        if ui.button("Fit").on_hover_text("Show all nodes (Home)").clicked() {
            self.fit(desk, sheet, false);
        }
        ui.weak(format!("{:.0} %", desk.lens.view.zoom * 100.0));
        let path = desk.session.path();
        if path.is_empty() {
            return;
        }
        ui.separator();
        let document = desk.session.document();
        let names = path.iter().map(|id| {
            let label = document.groups.get(id).map_or("", |group| group.interface.label.as_str());
            if label.is_empty() { id.as_str() } else { label }
        });
        for (depth, name) in std::iter::once(document.name.as_str()).chain(names).enumerate() {
            if depth > 0 {
                ui.weak("/");
            }
            let crumb = ui.selectable_label(depth == path.len(), name);
            if crumb.on_hover_text("Go to this level (Backspace leaves the innermost)").clicked() {
                desk.actions.push(Action::Enter(path[..depth].to_vec()));
            }
        }
    }
}

/// The view that shows a rectangle in the middle, so that it can be read.
fn seen_whole(rect: Rect, lens: Lens) -> View {
    let room = View::showing(rect, lens.pane).zoom;
    View { center: rect.center(), zoom: lens.view.zoom.max(READABLE).min(room.max(READABLE)) }
}

/// The part of the pane that the buttons leave free.
fn below_bar(pane: Rect) -> Rect {
    pane.with_min_y(pane.top() + 28.0)
}

/// Shows what a node gives, on its card when that is unfolded for it.
fn picture(ui: &mut egui::Ui, brush: &Brush<'_>, session: &Session, card: &Card, thumbnails: &mut Thumbnails) {
    let output = card.rows.iter().find(|row| row.side == sheet::Side::Output);
    if let (Some(rect), Some(output)) = (card.picture().filter(|_| brush.detail != Detail::Blocks), output) {
        let rect = brush.lens.rect_to_screen(rect);
        let mut ui = ui.new_child(egui::UiBuilder::new().id_salt(("picture", &card.id)).max_rect(rect));
        ui.set_clip_rect(brush.lens.pane.intersect(ui.clip_rect()));
        thumbnails.show(&mut ui, session, &card.id, &output.name, rect.width());
    }
}
