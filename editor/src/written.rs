//! Numbers as people write them, with a decimal point or a comma. What is no number is refused in words beside its field, and
//! the value stays what it was.

use std::cell::RefCell;
use std::ops::BitOr;
use std::time::Duration;

use eframe::egui::emath::Numeric;
use eframe::egui::{self, DragValue, Id, Key, Rect, Response};
use halfvector_graph::docs::capitalised;

use crate::theme;

/// How long a refusal is shown, in seconds.
const STAYS: f64 = 6.0;

/// What numbers a field takes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kind<'a> {
    /// Whether only whole ones.
    pub is_whole: bool,
    /// What may stand behind them, such as `°`.
    pub unit: &'a str,
}

/// One number; see [`numbers`].
///
/// # Errors
/// Why it is none, in words.
pub(crate) fn number(text: &str, kind: Kind<'_>) -> Result<f64, String> {
    numbers(text, 1, kind).map(|numbers| numbers[0])
}

/// As many numbers as wanted: as many are written, or one for all. A comma is a decimal one where nothing else fits.
///
/// # Errors
/// Why they are none, in words.
pub fn numbers(text: &str, count: usize, kind: Kind<'_>) -> Result<Vec<f64>, String> {
    let unit = kind.unit.trim();
    let bare = text.trim().strip_suffix(unit).unwrap_or(text).trim();
    if bare.is_empty() {
        return Err("nothing was written".to_owned());
    }
    let fits = |parts: &[&str]| parts.len() == count || parts.len() == 1;
    let is_gap = |c: char| c == ';' || c.is_whitespace();
    let listed: Vec<&str> = bare.split(|c| c == ',' || is_gap(c)).filter(|part| !part.is_empty()).collect();
    // "0,5; 0,2" and "0,5, 0,2": the commas that end a word separate.
    let words: Vec<&str> =
        bare.split(is_gap).map(|word| word.trim_end_matches(',')).filter(|word| !word.is_empty()).collect();
    // ",5" begins with a decimal one.
    let is_list = !bare.split(is_gap).any(|word| word.starts_with(','));
    let all = |parts: Vec<f64>| if parts.len() == 1 { vec![parts[0]; count] } else { parts };
    if fits(&listed) && is_list {
        return listed.iter().map(|part| one(part, kind)).collect::<Result<_, _>>().map(all);
    }
    if fits(&words) {
        let decimal = |word: &&str| match word.split(',').collect::<Vec<_>>().as_slice() {
            [_] => one(word, kind),
            [whole, part] if !word.contains('.') && !is_in_thousands(whole, part) => {
                one(&format!("{whole}.{part}"), kind).map_err(|_| none(word))
            }
            [whole, part] if !word.contains('.') => Err(format!(
                "“{word}” may be {whole}.{part} or {whole}{part}; write {whole} or {whole}{part}, without a comma",
            )),
            _ => Err(none(word)),
        };
        return words.iter().map(decimal).collect::<Result<_, _>>().map(all);
    }
    if let Some(wrong) = listed.iter().find_map(|part| one(part, kind).err()) {
        return Err(wrong);
    }
    let all = if count > 1 { ", or one for all" } else { "" };
    Err(format!("“{bare}” are {} numbers; write {count}{all}", listed.len()))
}

/// Whether a comma may as well stand between thousands.
fn is_in_thousands(whole: &str, part: &str) -> bool {
    let digits = whole.trim_start_matches(['-', '+', '\u{2212}']);
    part.len() == 3
        && part.bytes().all(|c| c.is_ascii_digit())
        && (1..=3).contains(&digits.len())
        && !digits.starts_with('0')
}

fn one(text: &str, kind: Kind<'_>) -> Result<f64, String> {
    let number: f64 = text.replace('\u{2212}', "-").parse().map_err(|_| none(text))?;
    if number.is_nan() || text.to_ascii_lowercase().contains("inf") {
        return Err(none(text));
    }
    if number.abs() > f64::from(f32::MAX) {
        return Err(format!("“{text}” is beyond the largest number, {:.1e}", f32::MAX));
    }
    if kind.is_whole && number.fract() != 0.0 {
        return Err(format!("“{text}” is no whole number"));
    }
    Ok(number)
}

fn none(text: &str) -> String {
    format!("“{text}” is no number")
}

/// What became of a field of a number.
#[derive(Debug)]
pub(crate) struct Answer {
    /// It says whether the number changed.
    pub(crate) response: Response,
    /// Whether what was changed while it was written is to be as if it had never been: the whole was refused, or Escape was pressed.
    pub(crate) is_given_up: bool,
}

impl From<Response> for Answer {
    fn from(response: Response) -> Answer {
        Answer { response, is_given_up: false }
    }
}

impl BitOr for Answer {
    type Output = Answer;

    fn bitor(self, other: Answer) -> Answer {
        let is_given_up = self.is_given_up || other.is_given_up;
        Answer { response: self.response | other.response, is_given_up }
    }
}

/// What is remembered while a number is written.
#[derive(Clone, Debug, Default)]
struct Writing {
    before: f64,
    refused: Option<String>,
    /// Whether it has changed the value in frames before.
    has_changed: bool,
}

/// A field of a number, which is dragged or written. `place` gives it range, speed and digits, and adds it.
pub(crate) fn drag<N: Numeric>(
    ui: &mut egui::Ui,
    value: &mut N,
    kind: Kind<'_>,
    place: impl FnOnce(&mut egui::Ui, DragValue<'_>) -> Response,
) -> Answer {
    let before = value.to_f64();
    // What the last text that was read said: nothing was read, it is a number, it is none.
    let read: RefCell<Option<Option<String>>> = RefCell::new(None);
    let mut response = {
        let parser = |text: &str| {
            let number = number(text, kind);
            read.replace(Some(number.as_ref().err().cloned()));
            number.ok()
        };
        let field = DragValue::new(&mut *value).suffix(kind.unit).custom_parser(parser);
        place(ui, field)
    };
    let key = response.id.with("written");
    let mut writing = ui.data_mut(|data| data.remove_temp::<Writing>(key));
    if response.gained_focus() {
        writing = Some(Writing { before, refused: None, has_changed: false });
    }
    let Some(mut writing) = writing else { return response.into() };
    if let Some(refused) = read.into_inner() {
        writing.refused = refused;
    }
    if !response.lost_focus() {
        writing.has_changed |= response.changed();
        ui.data_mut(|data| data.insert_temp(key, writing));
        return response.into();
    }
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    if !escaped && writing.refused.is_none() {
        return response.into();
    }
    let is_given_up = writing.has_changed;
    *value = N::from_f64(writing.before);
    response.flags.set(egui::response::Flags::CHANGED, is_given_up);
    if let Some(why) = writing.refused.filter(|_| !escaped) {
        let unit = kind.unit;
        tell(ui.ctx(), response.rect, format!("{}; it stays {}{unit}.", capitalised(&why), writing.before as f32));
    }
    Answer { response, is_given_up }
}

/// What is told beside a field, and until when.
#[derive(Clone, Debug, Default)]
struct Told {
    text: String,
    at: egui::Pos2,
    until: f64,
}

fn told() -> Id {
    Id::new("refusal")
}

/// Tells below a field why what was written there is not taken.
pub(crate) fn tell(context: &egui::Context, field: Rect, text: String) {
    let until = context.input(|input| input.time) + STAYS;
    context.data_mut(|data| {
        data.insert_temp(told(), Told { text, at: field.left_bottom() + egui::vec2(0.0, 3.0), until })
    });
    context.request_repaint();
}

/// Draws what is told, above everything.
pub(crate) fn show(context: &egui::Context) {
    let Some(Told { text, at, until }) = context.data(|data| data.get_temp::<Told>(told())) else { return };
    let left = until - context.input(|input| input.time);
    if left <= 0.0 {
        context.data_mut(|data| data.remove::<Told>(told()));
        return;
    }
    context.request_repaint_after(Duration::from_secs_f64(left));
    let area = egui::Area::new(told()).order(egui::Order::Tooltip).interactable(false).fixed_pos(at);
    area.constrain_to(context.content_rect()).show(context, |ui| {
        let frame = egui::Frame::popup(ui.style()).stroke(egui::Stroke::new(1.2, theme::ERROR)).inner_margin(6);
        frame.show(ui, |ui| {
            ui.set_max_width(320.0);
            let label = ui.label(&text);
            ui.ctx().accesskit_node_builder(label.id, |node| {
                node.set_role(egui::accesskit::Role::Alert);
                node.set_label(text.clone());
            });
        });
    });
}
