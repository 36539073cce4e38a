//! Frames and comments: what stands behind and beside the nodes. A frame takes along what lies in it.

use std::collections::BTreeSet;

use eframe::egui::{self, Align2, Color32, FontId, Id, Key, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2, vec2};
use halfvector_graph::document::{self, Comment, Frame, Graph, free_name};
use halfvector_graph::edit::Edit;

use super::draw::{Brush, Detail};
use super::picked::Chosen;
use super::sheet::{Card, HEADER, Sheet};
use super::view::{Lens, to_grid};
use super::{Canvas, Desk};
use crate::theme;

/// Height of a frame's title and of a comment's grip.
pub(super) const TITLE: f32 = 26.0;
/// Side of the corner that changes the size.
const CORNER: f32 = 14.0;
/// Free space between a frame and what it is put around.
const AROUND: f32 = 20.0;
/// Size of a frame that is put around nothing.
const EMPTY: Vec2 = vec2(280.0, 180.0);
/// Smallest width and height.
const SMALLEST: Vec2 = vec2(80.0, 48.0);

/// A frame or a comment.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Note {
    pub(super) id: NoteId,
    pub(super) rect: Rect,
    /// Where it is seen while it is dragged.
    pub(super) shown: Rect,
    pub(super) text: String,
    color: Option<[u8; 3]>,
}

/// Which frame or comment.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum NoteId {
    Frame(String),
    Comment(String),
}

/// What of a note lies under the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Where it is gripped.
    Title,
    /// Where its size is changed.
    Corner,
}

/// The notes of a graph, frames first; of frames the large ones first, as they lie behind the others.
pub(super) fn notes(graph: &Graph) -> Vec<Note> {
    let frames = graph.frames.iter().map(|(id, frame)| Note {
        id: NoteId::Frame(id.clone()),
        rect: rect(&frame.rect),
        shown: rect(&frame.rect),
        text: frame.title.clone(),
        color: frame.color,
    });
    let mut all: Vec<Note> = frames.collect();
    all.sort_by(|a, b| b.rect.area().total_cmp(&a.rect.area()));
    all.extend(graph.comments.iter().map(|(id, comment)| Note {
        id: NoteId::Comment(id.clone()),
        rect: rect(&comment.rect),
        shown: rect(&comment.rect),
        text: comment.text.clone(),
        color: None,
    }));
    all.retain(|note| note.rect.is_finite());
    all
}

fn rect(rect: &document::Rect) -> Rect {
    Rect::from_min_size(rect.position.into(), Vec2::from(rect.size).max(SMALLEST))
}

fn document_rect(rect: Rect) -> document::Rect {
    document::Rect { position: rect.min.into(), size: rect.size().into() }
}

impl Note {
    /// What of it lies under a point of the canvas.
    pub(super) fn part(&self, at: Pos2) -> Option<Part> {
        let corner = Rect::from_min_max(self.rect.max - Vec2::splat(CORNER), self.rect.max);
        let grip = match self.id {
            NoteId::Frame(_) => Rect::from_min_size(self.rect.min, vec2(self.rect.width(), TITLE)),
            NoteId::Comment(_) => self.rect,
        };
        if corner.contains(at) { Some(Part::Corner) } else { grip.contains(at).then_some(Part::Title) }
    }

    /// Whether a card lies in it: the middle of its header, so that a card that grows stays in its frame.
    pub(super) fn holds(&self, card: &Card) -> bool {
        let middle = card.place + vec2(card.size.x, card.size.y.min(HEADER)) / 2.0;
        matches!(self.id, NoteId::Frame(_)) && self.rect.contains(middle)
    }

    /// Whether another note lies in it.
    pub(super) fn holds_note(&self, other: &Note) -> bool {
        matches!(self.id, NoteId::Frame(_)) && self.id != other.id && self.rect.contains_rect(other.rect)
    }

    /// Whether a box that selects takes it: a frame when it lies in it as a whole, as boxes are drawn within frames, too.
    pub(super) fn is_in_box(&self, rect: Rect) -> bool {
        match self.id {
            NoteId::Frame(_) => rect.contains_rect(self.rect),
            NoteId::Comment(_) => rect.intersects(self.rect),
        }
    }

    /// The edit that puts it into another rectangle.
    pub(super) fn placed(&self, graph: &Graph, rect: Rect) -> Option<Edit> {
        let size = rect.size().max(SMALLEST);
        let rect = document_rect(Rect::from_min_size(rect.min, size));
        Some(match &self.id {
            NoteId::Frame(id) => {
                Edit::SetFrame { id: id.clone(), frame: Frame { rect, ..graph.frames.get(id)?.clone() } }
            }
            NoteId::Comment(id) => {
                Edit::SetComment { id: id.clone(), comment: Comment { rect, ..graph.comments.get(id)?.clone() } }
            }
        })
    }

    /// The edit that writes something else on it.
    pub(super) fn written(&self, graph: &Graph, text: &str) -> Option<Edit> {
        Some(match &self.id {
            NoteId::Frame(id) => {
                Edit::SetFrame { id: id.clone(), frame: Frame { title: text.into(), ..graph.frames.get(id)?.clone() } }
            }
            NoteId::Comment(id) => {
                let comment = Comment { text: text.into(), ..graph.comments.get(id)?.clone() };
                Edit::SetComment { id: id.clone(), comment }
            }
        })
    }

    /// The edit that gives a frame a colour; none for the usual one.
    fn colored(&self, graph: &Graph, color: Option<[u8; 3]>) -> Option<Edit> {
        match &self.id {
            NoteId::Frame(id) => {
                Some(Edit::SetFrame { id: id.clone(), frame: Frame { color, ..graph.frames.get(id)?.clone() } })
            }
            NoteId::Comment(_) => None,
        }
    }

    /// The edit that takes it away.
    pub(super) fn removed(&self) -> Edit {
        match &self.id {
            NoteId::Frame(id) => Edit::RemoveFrame { id: id.clone() },
            NoteId::Comment(id) => Edit::RemoveComment { id: id.clone() },
        }
    }

    /// What it is called.
    pub(super) fn kind(&self) -> &'static str {
        self.id.kind()
    }
}

impl NoteId {
    pub(super) fn kind(&self) -> &'static str {
        match self {
            NoteId::Frame(_) => "frame",
            NoteId::Comment(_) => "comment",
        }
    }
}

/// A frame around some cards.
fn frame_around(graph: &Graph, cards: Rect) -> Edit {
    frame_of(graph, Rect::from_min_max(cards.min - vec2(AROUND, AROUND + TITLE), cards.max + Vec2::splat(AROUND)))
}

fn frame_of(graph: &Graph, rect: Rect) -> Edit {
    let id = free_name("frame", |id| graph.frames.contains_key(id));
    Edit::AddFrame { id, frame: Frame { title: "Frame".into(), rect: document_rect(rect), ..Frame::default() } }
}

/// A comment at a place.
fn comment_at(graph: &Graph, at: Pos2) -> Edit {
    let id = free_name("comment", |id| graph.comments.contains_key(id));
    let rect = document_rect(Rect::from_min_size(at, vec2(180.0, 72.0)));
    Edit::AddComment { id, comment: Comment { text: "Comment".into(), rect, ..Comment::default() } }
}

impl Brush<'_> {
    /// Frames and comments, behind wires and cards.
    pub(super) fn notes(&self, sheet: &Sheet, picked: &BTreeSet<NoteId>) {
        let seen = self.lens.seen();
        for note in sheet.notes.iter().filter(|note| note.shown.intersects(seen)) {
            let rect = self.lens.rect_to_screen(note.shown);
            let is_picked = picked.contains(&note.id);
            let [r, g, b] = note.color.unwrap_or(theme::FRAME);
            let color = Color32::from_rgb(r, g, b);
            let radius = (6.0 * self.lens.view.zoom).round();
            match note.id {
                NoteId::Frame(_) => {
                    let line = if is_picked {
                        Stroke::new(2.0, theme::ACCENT)
                    } else {
                        Stroke::new(1.0, color.gamma_multiply(0.7))
                    };
                    self.painter.rect(rect, radius, color.gamma_multiply(0.14), line, StrokeKind::Inside);
                    let title = Rect::from_min_size(rect.min, vec2(rect.width(), TITLE * self.lens.view.zoom));
                    self.painter.rect_filled(title, radius, color.gamma_multiply(0.3));
                    // A title can be read from afar: frames are the map's names.
                    let size = (14.0 * self.lens.view.zoom).clamp(11.0_f32.min(title.height().max(8.0)), 24.0);
                    let at = title.left_center() + vec2(10.0 * self.lens.view.zoom, 0.0);
                    cut(
                        self.painter,
                        at,
                        &note.text,
                        size,
                        self.colors.text,
                        title.width() - 12.0 * self.lens.view.zoom,
                    );
                }
                NoteId::Comment(_) => {
                    let line =
                        if is_picked { Stroke::new(2.0, theme::ACCENT) } else { Stroke::new(1.0, self.colors.line) };
                    self.painter.rect(rect, radius, self.colors.note, line, StrokeKind::Inside);
                    let size = (12.5 * self.lens.view.zoom * 2.0).round() / 2.0;
                    if size >= 4.0 {
                        let margin = 8.0 * self.lens.view.zoom;
                        let font = FontId::proportional(size);
                        let galley = self.painter.layout(
                            note.text.clone(),
                            font,
                            self.colors.note_text,
                            rect.width() - 2.0 * margin,
                        );
                        let painter = self.painter.with_clip_rect(rect.intersect(self.painter.clip_rect()));
                        painter.galley(rect.min + Vec2::splat(margin), galley, self.colors.note_text);
                    }
                }
            }
            if self.detail == Detail::Full {
                let corner = rect.max - Vec2::splat(4.0);
                for step in [4.0, 8.0] {
                    let ends = [corner - vec2(step, 0.0), corner - vec2(0.0, step)];
                    self.painter.line_segment(ends, Stroke::new(1.0, self.colors.weak));
                }
            }
        }
    }
}

/// A line of text that is cut where there is no room.
fn cut(painter: &Painter, at: Pos2, text: &str, size: f32, color: Color32, room: f32) {
    let room = Rect::from_center_size(at + vec2(room / 2.0, 0.0), vec2(room.max(0.0), size * 2.0));
    painter.with_clip_rect(room.intersect(painter.clip_rect())).text(
        at,
        Align2::LEFT_CENTER,
        text,
        FontId::proportional(size),
        color,
    );
}

/// The uppermost note under a point of the screen.
pub(super) fn note_at(sheet: &Sheet, lens: Lens, point: Pos2) -> Option<(usize, Part)> {
    let at = lens.to_canvas(point);
    sheet.notes.iter().enumerate().rev().find_map(|(i, note)| Some((i, note.part(at)?)))
}

impl Canvas {
    /// Puts a frame around what is chosen, or an empty one at a place of the canvas. From then on the frame is chosen.
    pub(super) fn add_frame(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let edit = match self.chosen(desk).bounds(sheet) {
            Some(rect) => frame_around(desk.graph, rect),
            None => frame_of(desk.graph, Rect::from_min_size(to_grid(at), EMPTY)),
        };
        if let Edit::AddFrame { id, .. } = &edit {
            self.choose_note(desk, NoteId::Frame(id.clone()));
        }
        desk.edit(sheet, "Add frame", vec![edit]);
    }

    /// Puts a comment somewhere.
    pub(super) fn add_comment(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, at: Pos2) {
        let edit = comment_at(desk.graph, at);
        if let Edit::AddComment { id, .. } = &edit {
            self.choose_note(desk, NoteId::Comment(id.clone()));
        }
        desk.edit(sheet, "Add comment", vec![edit]);
    }

    /// Chooses a note and nothing else.
    pub(super) fn choose_note(&mut self, desk: &mut Desk<'_>, id: NoteId) {
        self.choose_only(desk, Chosen { notes: BTreeSet::from([id]), ..Chosen::default() });
    }

    pub(super) fn note_menu(&mut self, menu: &mut egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet, id: &NoteId) {
        let Some(note) = sheet.notes.iter().find(|note| note.id == *id) else { return };
        if super::menus::item(menu, "Write…", "F2") {
            self.write_note(note);
        }
        if matches!(id, NoteId::Frame(_)) {
            menu.horizontal(|ui| {
                let colors = std::iter::once(None).chain(theme::FRAMES.iter().copied().map(Some));
                for (i, color) in colors.enumerate() {
                    let [r, g, b] = color.unwrap_or(theme::FRAME);
                    let (rect, response) = ui.allocate_exact_size(Vec2::splat(18.0), egui::Sense::click());
                    ui.painter().rect_filled(rect.shrink(1.0), 3.0, Color32::from_rgb(r, g, b));
                    let label = if i == 0 { "Usual colour".to_owned() } else { format!("Colour {i}") };
                    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ColorButton, true, &label));
                    if response.on_hover_text(label).clicked() {
                        let edits = note.colored(desk.graph, color).into_iter().collect();
                        desk.edit(sheet, "Set colour of frame", edits);
                        ui.close();
                    }
                }
            });
            if super::menus::item(menu, "Select what is in it", "") {
                let inside = sheet.cards.iter().filter(|card| note.holds(card)).map(|card| card.id.clone()).collect();
                desk.actions.push(crate::action::Action::Select(inside));
            }
        }
        menu.separator();
        if super::menus::item(menu, "Copy", "Ctrl+C") {
            self.copy(menu, desk, sheet);
        }
        if super::menus::item(menu, "Cut", "Ctrl+X") {
            self.cut(menu, desk, sheet);
        }
        if super::menus::item(menu, "Duplicate", "Ctrl+D") {
            self.duplicate(desk, sheet);
        }
        menu.separator();
        if super::menus::item(menu, "Delete", "Del") {
            self.remove(desk, sheet, false);
        }
    }

    /// Begins to write on a note.
    pub(super) fn write_note(&mut self, note: &Note) {
        self.editing =
            Some(super::fields::Editing::Note { note: note.id.clone(), text: note.text.clone(), is_new: true });
    }
}

/// A field of several lines over a comment; whether it stays open, and whether what stands there is meant.
pub(super) fn write_lines(ui: &mut egui::Ui, rect: Rect, text: &mut String, is_new: bool, zoom: f32) -> (bool, bool) {
    let rect = Rect::from_min_size(rect.min, rect.size().max(vec2(120.0, 48.0)));
    let font = FontId::proportional((12.5 * zoom).clamp(11.0, 18.0));
    let response = ui.put(rect, egui::TextEdit::multiline(text).id(Id::new("graph note")).font(font).desired_rows(1));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::TextEdit, true, "Comment"));
    if is_new {
        response.request_focus();
        return (true, false);
    }
    // A click elsewhere keeps what was written; Escape drops it.
    let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
    let is_done = response.lost_focus() && !is_given_up;
    (!is_done && !is_given_up, is_done)
}

/// The rectangle of a note whose corner is dragged.
pub(super) fn resized(rect: Rect, way: Vec2) -> Rect {
    let max = (rect.max + way).max(rect.min + SMALLEST);
    Rect::from_min_max(rect.min, pos2(max.x, max.y))
}
