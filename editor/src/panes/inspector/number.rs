//! Numbers: a slider over the soft range, and the exact value, which may lie outside of it. Angles are shown in degrees.

use eframe::egui::{self, Slider, SliderClamping};

use crate::written::{self, Answer, Kind};

/// How a number is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style<'a> {
    /// Soft range, in the document's unit.
    pub(crate) range: Option<[f32; 2]>,
    /// As the node's doc comment has it: `deg`, `rad`, `m`, ...
    pub(crate) unit: &'a str,
    /// Whether only whole numbers are meant.
    pub(crate) is_whole: bool,
}

/// Width of the exact value.
const VALUE_WIDTH: f32 = 68.0;

impl Style<'_> {
    /// From the document's number to the one that is shown.
    fn shown(self, value: f32) -> f64 {
        if self.unit == "rad" { f64::from(value).to_degrees() } else { f64::from(value) }
    }

    fn stored(self, shown: f64) -> f32 {
        let value = if self.unit == "rad" { shown.to_radians() } else { shown };
        // The largest finite number in place of infinity.
        (value as f32).clamp(f32::MIN, f32::MAX)
    }

    fn kind(self, suffix: &str) -> Kind<'_> {
        Kind { is_whole: self.is_whole, unit: suffix }
    }

    fn suffix(self) -> String {
        match self.unit {
            "deg" | "rad" => "°".to_owned(),
            "" | "color" => String::new(),
            unit => format!(" {unit}"),
        }
    }

    fn shown_range(self) -> Option<[f64; 2]> {
        let [low, high] = self.range?.map(|bound| self.shown(bound));
        (low.is_finite() && high.is_finite() && low < high).then_some([low, high])
    }

    /// What one point of the pointer's way changes.
    fn speed(self, value: f64) -> f64 {
        if self.is_whole {
            return 0.1;
        }
        match self.shown_range() {
            Some([low, high]) => (high - low) / 300.0,
            None => (value.abs() * 0.01).max(0.002),
        }
    }
}

/// A slider, where there is a range and room for it, and the exact value.
pub(crate) fn number(ui: &mut egui::Ui, value: &mut f32, style: Style<'_>, label: egui::Id) -> Answer {
    let mut shown = style.shown(*value);
    let slider_width = ui.available_width() - VALUE_WIDTH - ui.spacing().item_spacing.x;
    let mut slid = None;
    if let Some([low, high]) = style.shown_range().filter(|_| slider_width > 40.0) {
        ui.spacing_mut().slider_width = slider_width;
        let mut slider = Slider::new(&mut shown, low..=high).clamping(SliderClamping::Never).show_value(false);
        if style.is_whole {
            slider = slider.integer();
        }
        slid = Some(ui.add(slider).labelled_by(label));
    }
    let width = VALUE_WIDTH.min(ui.available_width());
    let exact = exact(ui, &mut shown, style, 5, width, (label, "Drag, or double click to write"));
    let answer = match slid {
        Some(slider) => Answer::from(slider) | exact,
        None => exact,
    };
    if answer.response.changed() {
        *value = style.stored(shown);
    }
    answer
}

/// The components of a vector side by side.
pub(crate) fn vector(ui: &mut egui::Ui, values: &mut [f32], style: Style<'_>, label: egui::Id) -> Answer {
    let count = values.len().max(1) as f32;
    let width = (ui.available_width() - ui.spacing().item_spacing.x * (count - 1.0)) / count;
    let mut all: Option<Answer> = None;
    for (value, name) in values.iter_mut().zip(["x", "y", "z", "w"]) {
        let mut shown = style.shown(*value);
        let answer = exact(ui, &mut shown, style, 4, width, (label, name));
        if answer.response.changed() {
            *value = style.stored(shown);
        }
        all = Some(match all {
            Some(before) => before | answer,
            None => answer,
        });
    }
    all.unwrap_or_else(|| ui.label("").into())
}

fn exact(
    ui: &mut egui::Ui,
    shown: &mut f64,
    style: Style<'_>,
    digits: usize,
    width: f32,
    (label, hint): (egui::Id, &str),
) -> Answer {
    let speed = style.speed(*shown);
    let suffix = style.suffix();
    written::drag(ui, shown, style.kind(&suffix), |ui, drag| {
        let drag = drag.speed(speed);
        let drag = if style.is_whole { drag.fixed_decimals(0) } else { drag.max_decimals(digits) };
        ui.add_sized([width, ui.spacing().interact_size.y], drag).labelled_by(label).on_hover_text(hint)
    })
}
