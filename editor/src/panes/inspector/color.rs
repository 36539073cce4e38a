//! Colours: a swatch that opens a picker, and the code of the colour in sRGB. The document holds linear Rec. 709, and so does
//! the picker; what no display shows (above 1, below 0) is kept until it is changed.

use eframe::egui::color_picker::{Alpha, color_picker_hsva_2d, show_color_at};
use eframe::egui::ecolor::Hsva;
use eframe::egui::{self, Color32, DragValue, Popup, PopupCloseBehavior, Response, Rgba, Sense, TextEdit};

use crate::written::{self, Kind};

/// Width of the code's field.
const CODE_WIDTH: f32 = 72.0;

/// A linear colour as a display shows it.
pub(crate) fn shown(linear: [f32; 3]) -> Color32 {
    let [r, g, b] = linear.map(|channel| channel.clamp(0.0, 1.0));
    Rgba::from_rgb(r, g, b).into()
}

/// Sets a colour of three or four linear components. The response says whether it changed.
pub(crate) fn color(ui: &mut egui::Ui, values: &mut [f32], label: egui::Id) -> Response {
    let height = ui.spacing().interact_size.y;
    let width = (ui.available_width() - CODE_WIDTH - ui.spacing().item_spacing.x).max(24.0);
    let (rect, mut swatch) = ui.allocate_exact_size(egui::vec2(width, height), Sense::click());
    let rgb = first_three(values);
    if ui.is_rect_visible(rect) {
        let visuals = ui.style().interact(&swatch);
        show_color_at(ui.painter(), shown(rgb), rect.shrink(1.0));
        ui.painter().rect_stroke(rect, 2.0, visuals.bg_stroke, egui::StrokeKind::Inside);
    }
    let text = format!("linear {:.4}, {:.4}, {:.4}", rgb[0], rgb[1], rgb[2]);
    swatch.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ColorButton, true, "Colour"));
    swatch = swatch.labelled_by(label).on_hover_text(text);
    let mut picked = false;
    Popup::menu(&swatch).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        picked = picker(ui, values);
    });
    let code = code_field(ui, values, label);
    if picked {
        swatch.mark_changed();
    }
    swatch | code
}

fn first_three(values: &[f32]) -> [f32; 3] {
    std::array::from_fn(|channel| values.get(channel).copied().unwrap_or(0.0))
}

fn picker(ui: &mut egui::Ui, values: &mut [f32]) -> bool {
    ui.set_max_width(240.0);
    // The picker's own hue and saturation are kept while it is open: black and grey have none.
    let id = ui.id().with("hsva");
    let rgb = first_three(values);
    let kept = ui.data(|data| data.get_temp::<Hsva>(id)).filter(|hsva| close(hsva.to_rgb(), rgb));
    let mut hsva = kept.unwrap_or_else(|| Hsva::from_rgb(rgb.map(|channel| channel.clamp(0.0, 1.0))));
    let mut changed = false;
    if color_picker_hsva_2d(ui, &mut hsva, Alpha::Opaque) {
        for (value, channel) in values.iter_mut().zip(hsva.to_rgb()) {
            *value = channel;
        }
        changed = true;
    }
    ui.data_mut(|data| data.insert_temp(id, hsva));
    ui.separator();
    ui.weak("Linear Rec. 709");
    ui.horizontal(|ui| {
        for (value, name) in values.iter_mut().zip(["R", "G", "B", "A"]) {
            ui.label(name);
            let place = |ui: &mut egui::Ui, drag: DragValue<'_>| ui.add(drag.speed(0.003).max_decimals(4));
            changed |= written::drag(ui, value, Kind::default(), place).response.changed();
        }
    });
    changed
}

fn close(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
}

/// The sRGB code, which can be written. What is half written is kept until it is a code.
fn code_field(ui: &mut egui::Ui, values: &mut [f32], label: egui::Id) -> Response {
    let id = ui.id().with("code").with(label);
    let code = code(first_three(values));
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| code.clone());
    let field = TextEdit::singleline(&mut text).font(egui::TextStyle::Monospace).desired_width(CODE_WIDTH - 8.0);
    let mut response = ui.add(field).labelled_by(label).on_hover_text("sRGB code, such as #c08040");
    let typed = response.changed();
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    match linear(&text) {
        Some(rgb) if typed && text != code => {
            for (value, channel) in values.iter_mut().zip(rgb) {
                *value = channel;
            }
            response.mark_changed();
        }
        None if response.lost_focus() && text != code && !ui.input(|input| input.key_pressed(egui::Key::Escape)) => {
            response.flags.remove(egui::response::Flags::CHANGED);
            let why =
                format!("“{text}” is no colour; write six digits of hexadecimal such as #c08040. It stays {code}.");
            written::tell(ui.ctx(), response.rect, why);
        }
        // A text that is no code yet changes nothing.
        _ => response.flags.remove(egui::response::Flags::CHANGED),
    }
    response
}

/// `#rrggbb` of a linear colour, as a display shows it.
pub(crate) fn code(linear: [f32; 3]) -> String {
    let [r, g, b, _] = shown(linear).to_array();
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The linear colour of `#rrggbb`, `rrggbb` or `#rgb`.
pub(crate) fn linear(code: &str) -> Option<[f32; 3]> {
    let digits = code.trim().trim_start_matches('#');
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let [_, r, g, b] = match digits.len() {
        6 => number.to_be_bytes(),
        3 => [0, (number >> 8 & 15) as u8 * 17, (number >> 4 & 15) as u8 * 17, (number & 15) as u8 * 17],
        _ => return None,
    };
    let rgba = Rgba::from(Color32::from_rgb(r, g, b));
    Some([rgba.r(), rgba.g(), rgba.b()])
}
