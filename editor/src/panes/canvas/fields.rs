//! Values and names that are changed on a card: numbers are written, colours picked, switches turned.

use eframe::egui::{self, Color32, Id, Key, Rect, ecolor::Hsva, pos2, vec2};
use halfvector_graph::docs::capitalised;
use halfvector_graph::document::{NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::value::Value;

use super::gesture::Gesture;
use super::notes::{self, NoteId};
use super::sheet::{Card, Field, HEADER, Sheet, Side, number};
use super::{Canvas, Desk};
use crate::action::Action;
use crate::written::{self, Kind, numbers};

/// What is being changed.
#[derive(Debug)]
pub(super) enum Editing {
    /// One number or several, written with commas.
    Numbers {
        socket: SocketRef,
        text: String,
        /// As it was: what is not changed sets nothing.
        before: String,
        count: usize,
        kind: Taken,
        is_new: bool,
    },
    Color {
        socket: SocketRef,
        hsva: Hsva,
        scale: f32,
        is_new: bool,
    },
    Name {
        node: NodeId,
        text: String,
        is_new: bool,
    },
    /// The title of a frame or the words of a comment.
    Note {
        note: NoteId,
        text: String,
        is_new: bool,
    },
}

/// What numbers are taken.
#[derive(Debug, Default)]
pub(super) struct Taken {
    is_whole: bool,
    unit: String,
}

impl Taken {
    fn kind(&self) -> Kind<'_> {
        Kind { is_whole: self.is_whole, unit: &self.unit }
    }
}

impl Field {
    /// What it shows, as text.
    pub(super) fn text(&self) -> String {
        match self {
            Field::None => String::new(),
            Field::Number { value, .. } => number(*value),
            Field::Color(color) => color.map(number).join(", "),
            Field::Switch(on) => on.to_string(),
            Field::Vector(parts) => parts.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", "),
            Field::Note(text) => text.clone(),
        }
    }
}

impl Canvas {
    /// Begins to change the value of an input.
    pub(super) fn edit_field(&mut self, desk: &mut Desk<'_>, sheet: &Sheet, card: usize, row: usize) {
        let (card, row) = (&sheet.cards[card], &sheet.cards[card].rows[row]);
        let socket = SocketRef::new(&card.id, &row.name);
        match &row.field {
            Field::Number { value, is_whole, unit, .. } => {
                let text = value.to_string();
                let (before, kind) = (text.clone(), Taken { is_whole: *is_whole, unit: unit.clone() });
                self.editing = Some(Editing::Numbers { socket, before, text, count: 1, kind, is_new: true });
            }
            Field::Vector(parts) => {
                // In full: what is not changed stays as it is.
                let text = parts.iter().map(f32::to_string).collect::<Vec<_>>().join(", ");
                let (before, count) = (text.clone(), parts.len());
                let kind = Taken::default();
                self.editing = Some(Editing::Numbers { socket, text, before, count, kind, is_new: true });
            }
            Field::Color(color) => {
                // The picker goes up to 1; what is brighter keeps its brightness.
                let scale = color.iter().copied().fold(1.0, f32::max);
                let hsva = Hsva::from_rgb(color.map(|x| (x / scale).max(0.0)));
                self.editing = Some(Editing::Color { socket, hsva, scale, is_new: true });
            }
            Field::Switch(on) => {
                let edit = Edit::SetValue { socket, value: Some(Value::Bool(!on)) };
                desk.make(format!("Set {}", row.name), edit);
            }
            Field::None | Field::Note(_) => {}
        }
    }

    /// Begins to rename a node.
    pub(super) fn rename(&mut self, sheet: &Sheet, node: &str) {
        if let Some(card) = sheet.card(node) {
            self.editing = Some(Editing::Name { node: node.to_owned(), text: card.title.clone(), is_new: true });
        }
    }

    /// Shows what is being changed, in its place.
    pub(super) fn fields(&mut self, ui: &mut egui::Ui, desk: &mut Desk<'_>, sheet: &Sheet) {
        let Some(mut editing) = self.editing.take() else { return };
        let is_open = match &mut editing {
            Editing::Numbers { socket, text, before, count, kind, is_new } => {
                let Some(rect) = place(sheet, socket) else { return };
                let rect = desk.lens.rect_to_screen(rect).expand(2.0);
                let (is_open, is_done) = write(ui, rect, text, std::mem::take(is_new), desk, "Value");
                match numbers(text, *count, kind.kind()) {
                    _ if !is_done || text == before => is_open,
                    Ok(numbers) => {
                        if let Some(value) = value_of(&numbers) {
                            let edit = Edit::SetValue { socket: socket.clone(), value: Some(value) };
                            desk.make(format!("Set {}", socket.socket), edit);
                        }
                        is_open
                    }
                    Err(why) => {
                        written::tell(ui.ctx(), rect, format!("{}; it stays {before}.", capitalised(&why)));
                        // After Enter it can be mended; who went elsewhere has left it.
                        *is_new = ui.input(|input| input.key_pressed(Key::Enter));
                        *is_new
                    }
                }
            }
            Editing::Name { node, text, is_new } => {
                let Some(card) = sheet.card(node) else { return };
                let rect = Rect::from_min_size(card.rect().min, vec2(card.size.x, HEADER));
                let rect = desk.lens.rect_to_screen(rect).shrink(2.0);
                let (is_open, is_done) = write(ui, rect, text, std::mem::take(is_new), desk, "Name");
                if is_done && *text != card.title {
                    let label = Some(text.trim().to_owned()).filter(|text| !text.is_empty());
                    desk.make("Rename node", Edit::SetLabel { id: node.clone(), label });
                }
                is_open
            }
            Editing::Note { note, text, is_new } => {
                let Some(note) = sheet.notes.iter().find(|other| other.id == *note) else { return };
                let rect = desk.lens.rect_to_screen(note.rect);
                let is_new = std::mem::take(is_new);
                let (is_open, is_done) = match note.id {
                    NoteId::Frame(_) => {
                        let title =
                            Rect::from_min_size(rect.min, vec2(rect.width(), notes::TITLE * desk.lens.view.zoom));
                        write(ui, title.shrink(2.0), text, is_new, desk, "Title")
                    }
                    NoteId::Comment(_) => notes::write_lines(ui, rect, text, is_new, desk.lens.view.zoom),
                };
                if is_done && *text != note.text {
                    let edits = note.written(desk.graph, text).into_iter().collect();
                    desk.edit(sheet, format!("Write {}", note.kind()), edits);
                }
                is_open
            }
            Editing::Color { socket, hsva, scale, is_new } => {
                let Some(rect) = place(sheet, socket) else { return };
                pick(ui, desk, desk.lens.rect_to_screen(rect), socket, hsva, *scale, std::mem::take(is_new))
            }
        };
        if is_open {
            self.editing = Some(editing);
        } else {
            ui.memory_mut(|memory| memory.request_focus(Id::new("graph canvas")));
        }
    }
}

/// Where the value of an input is shown.
fn place(sheet: &Sheet, socket: &SocketRef) -> Option<Rect> {
    let (card, row) = sheet.find(socket, Side::Input)?;
    sheet.cards[card].field(&sheet.cards[card].rows[row])
}

/// A drag over the number of a row.
pub(super) fn number_from(card: &Card, row: usize) -> Gesture {
    let row = &card.rows[row];
    let Field::Number { value, range, is_whole, .. } = &row.field else { return Gesture::Idle };
    let span = range.map(|[low, high]| f64::from(high) - f64::from(low)).filter(|span| span.is_finite() && *span > 0.0);
    // A value that lies outside already may come back, and goes no farther.
    let value = f64::from(*value);
    let range = match (span, range) {
        (Some(_), Some([low, high])) => [f64::from(*low).min(value), f64::from(*high).max(value)],
        _ => [f64::from(f32::MIN), f64::from(f32::MAX)],
    };
    let per_point = match span {
        _ if *is_whole => 0.1,
        Some(span) => span / 200.0,
        None => (value.abs() * 0.01).max(0.01),
    };
    Gesture::Number {
        socket: SocketRef::new(&card.id, &row.name),
        value,
        per_point,
        is_whole: *is_whole,
        range,
        is_changed: false,
    }
}

/// A value to the digits that a drag can choose.
pub(super) fn rounded(value: f64, step: f64) -> f64 {
    let unit = 10f64.powf(step.abs().max(1e-9).log10().floor());
    (value / unit).round() * unit
}

/// A field to write in; whether it stays open, and whether what stands there is meant.
fn write(ui: &mut egui::Ui, rect: Rect, text: &mut String, is_new: bool, desk: &Desk<'_>, label: &str) -> (bool, bool) {
    let rect = Rect::from_center_size(rect.center(), rect.size().max(vec2(84.0, 20.0)));
    let size = (12.0 * desk.lens.view.zoom).clamp(11.0, 18.0);
    let id = Id::new("graph field");
    let edit = egui::TextEdit::singleline(text).id(id).font(egui::FontId::proportional(size)).margin(vec2(4.0, 1.0));
    let response = ui.put(rect, edit.vertical_align(egui::Align::Center));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::TextEdit, true, label));
    if is_new {
        response.request_focus();
        let mut state = egui::text_edit::TextEditState::load(ui.ctx(), id).unwrap_or_default();
        let all =
            egui::text::CCursorRange::two(egui::text::CCursor::new(0), egui::text::CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
        return (true, false);
    }
    let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
    let is_done = response.lost_focus() && !is_given_up;
    (!response.lost_focus() && !is_given_up, is_done)
}

fn value_of(numbers: &[f64]) -> Option<Value> {
    let numbers: Vec<f32> = numbers.iter().map(|x| *x as f32).collect();
    match *numbers.as_slice() {
        [x] => Some(Value::Number(x)),
        [x, y] => Some(Value::Vec2([x, y])),
        [x, y, z] => Some(Value::Vec3([x, y, z])),
        [x, y, z, w] => Some(Value::Vec4([x, y, z, w])),
        _ => None,
    }
}

/// The colour picker under a swatch; whether it stays open.
fn pick(
    ui: &egui::Ui,
    desk: &mut Desk<'_>,
    swatch: Rect,
    socket: &SocketRef,
    hsva: &mut Hsva,
    scale: f32,
    is_new: bool,
) -> bool {
    let key = format!("canvas {socket}");
    let area = egui::Area::new(Id::new("graph colour")).order(egui::Order::Foreground);
    let at = pos2(swatch.left(), swatch.bottom() + 4.0);
    let shown = area.fixed_pos(at).constrain_to(ui.ctx().content_rect()).show(ui.ctx(), |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.spacing_mut().slider_width = 240.0;
            let mut is_changed = egui::color_picker::color_picker_hsva_2d(ui, hsva, egui::color_picker::Alpha::Opaque);
            let mut rgb = hsva.to_rgb().map(|x| x * scale);
            ui.horizontal(|ui| {
                for (name, part) in ["Red", "Green", "Blue"].into_iter().zip(&mut rgb) {
                    let place = |ui: &mut egui::Ui, drag: egui::DragValue<'_>| {
                        let drag = drag.speed(0.003).range(0.0..=scale).max_decimals(4);
                        ui.add(drag).on_hover_text(format!("{name}, linear"))
                    };
                    is_changed |= written::drag(ui, part, Kind::default(), place).response.changed();
                }
            });
            if is_changed {
                *hsva = Hsva::from_rgb(rgb.map(|x| x / scale));
                let edit = Edit::SetValue { socket: socket.clone(), value: Some(Value::Vec3(rgb)) };
                desk.drag(format!("Set {}", socket.socket), edit, &key);
            }
        });
    });
    let closes = !is_new && (shown.response.clicked_elsewhere() || ui.input(|input| input.key_pressed(Key::Escape)));
    if closes {
        desk.actions.push(Action::EndMerge);
    }
    !closes
}

/// The colour of a swatch on the screen.
pub(super) fn on_screen([r, g, b]: [f32; 3]) -> Color32 {
    Color32::from(egui::Rgba::from_rgb(r.clamp(0.0, 1.0), g.clamp(0.0, 1.0), b.clamp(0.0, 1.0)))
}
