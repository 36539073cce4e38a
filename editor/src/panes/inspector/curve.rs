//! The editor of curves: five points that are dragged up and down. It sets the inputs `at_0` ... `at_100` of curve nodes.

use eframe::egui::{self, Color32, Pos2, Rect, Sense, Stroke, Vec2};
use halfvector_graph::document::{NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::Value;

use crate::action::Action;
use crate::panes::inspector::input;
use crate::session::Session;
use crate::theme;

/// The inputs of a curve node, left to right.
const POINTS: [&str; 5] = ["at_0", "at_25", "at_50", "at_75", "at_100"];
/// Height of the editor.
const HEIGHT: f32 = 132.0;

/// Whether a node is a curve.
pub(crate) fn is_curve(def: &NodeDef) -> bool {
    POINTS.iter().all(|point| def.inputs.iter().any(|input| input.name == *point))
}

/// Draws the curve and moves its points.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, id: &NodeId, def: &NodeDef, actions: &mut Vec<Action>) {
    let sockets = POINTS.map(|point| SocketRef::new(id, point));
    let values = sockets.clone().map(|socket| input::number_of(session, def, &socket));
    let (rect, _) = ui.allocate_exact_size(egui::vec2(ui.available_width(), HEIGHT), Sense::hover());
    let plot = rect.shrink(8.0);
    let low = values.iter().copied().fold(0.0_f32, f32::min);
    let high = values.iter().copied().fold(1.0_f32, f32::max);
    let place = |x: f32, y: f32| {
        let share = if high > low { (y - low) / (high - low) } else { 0.5 };
        Pos2::new(plot.left() + plot.width() * x, plot.bottom() - plot.height() * share)
    };
    paint(ui, rect, &values, place);
    for (i, socket) in sockets.into_iter().enumerate() {
        if session.incoming(&socket).is_some() {
            continue;
        }
        let at = place(i as f32 / 4.0, values[i]);
        let response =
            ui.interact(Rect::from_center_size(at, Vec2::splat(18.0)), ui.id().with(POINTS[i]), Sense::drag());
        response.widget_info(|| {
            egui::WidgetInfo::slider(true, f64::from(values[i]), format!("Point {} of the curve", i + 1))
        });
        let color = if response.hovered() || response.has_focus() { Color32::WHITE } else { theme::ACCENT };
        ui.painter().circle(at, 5.0, color, Stroke::new(1.0, ui.visuals().extreme_bg_color));
        let step = arrow_keys(ui, &response);
        let moved = -response.drag_delta().y / plot.height() * (high - low) + step * 0.01 * (high - low);
        if moved != 0.0 {
            let value = Value::Number(values[i] + moved);
            let edit = Edit::SetValue { value: Some(value), socket: socket.clone() };
            actions.push(Action::drag("Bend the curve", edit, socket.to_string()));
        }
        if response.drag_stopped() || response.lost_focus() {
            actions.push(Action::EndMerge);
        }
        response.on_hover_text(format!("{:.3}; drag, or focus it and use the arrow keys", values[i]));
    }
}

/// Steps up less steps down, while the handle has the focus.
fn arrow_keys(ui: &egui::Ui, response: &egui::Response) -> f32 {
    if !response.has_focus() {
        return 0.0;
    }
    ui.memory_mut(|memory| {
        let arrows = egui::EventFilter { vertical_arrows: true, ..Default::default() };
        memory.set_focus_lock_filter(response.id, arrows);
    });
    ui.input(|input| input.num_presses(egui::Key::ArrowUp) as f32 - input.num_presses(egui::Key::ArrowDown) as f32)
}

fn paint(ui: &egui::Ui, rect: Rect, values: &[f32; 5], place: impl Fn(f32, f32) -> Pos2) {
    let visuals = ui.visuals();
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 4.0, visuals.extreme_bg_color);
    let faint = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color.gamma_multiply(0.6));
    for i in 0..=4 {
        let share = i as f32 / 4.0;
        painter.line_segment([place(share, 0.0), place(share, 1.0)], faint);
        painter.line_segment([place(0.0, share), place(1.0, share)], faint);
    }
    let line: Vec<Pos2> = (0..=96).map(|i| i as f32 / 96.0).map(|x| place(x, curve(x, values))).collect();
    painter.line(line, Stroke::new(2.0, theme::ACCENT));
}

/// The curve as `monotone_curve` of the shaders draws it. Steffen 1990, "A simple method for monotonic interpolation in one
/// dimension".
fn curve(x: f32, values: &[f32; 5]) -> f32 {
    let along = 4.0 * x.clamp(0.0, 1.0);
    let i = (along as usize).min(3);
    let t = along - i as f32;
    let at = |place: isize| match place {
        -1 => 2.0 * values[0] - values[1],
        5 => 2.0 * values[4] - values[3],
        place => values[place.clamp(0, 4) as usize],
    };
    let rise = |place: isize| at(place + 1) - at(place);
    let slope = |place: isize| {
        let (a, b) = (rise(place - 1), rise(place));
        let sign = |x: f32| {
            if x > 0.0 {
                1.0
            } else if x < 0.0 {
                -1.0
            } else {
                0.0
            }
        };
        (sign(a) + sign(b)) * a.abs().min(b.abs()).min(0.25 * (a + b).abs())
    };
    let i = i as isize;
    let (left, right, rise) = (slope(i), slope(i + 1), rise(i));
    at(i) + t * (left + t * (3.0 * rise - 2.0 * left - right + t * (left + right - 2.0 * rise)))
}
