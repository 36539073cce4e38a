//! The editor of colour ramps: a bar with the colours, and stops that are dragged along it. It sets the inputs `color_*` and
//! `position_*` of ramp nodes.

use eframe::egui::{self, Color32, Pos2, Rect, Sense, Stroke, Vec2};
use halfvector_graph::document::{NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::Value;

use crate::action::Action;
use crate::panes::inspector::{color, input};
use crate::session::Session;

/// Height of the bar.
const HEIGHT: f32 = 28.0;
/// Strips that the bar is painted with.
const STRIPS: usize = 128;

/// A colour on the ramp.
struct Stop {
    name: String,
    color: [f32; 3],
    at: f32,
    /// The input that moves it; some stops stand still.
    position: Option<SocketRef>,
}

/// Whether a node is a ramp.
pub(crate) fn is_ramp(def: &NodeDef) -> bool {
    let has = |name: &str| def.inputs.iter().any(|input| input.name == name);
    has("t") && has("color_a") && has("color_b") && has("position_b")
}

/// Draws the ramp and moves its stops.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, id: &NodeId, def: &NodeDef, actions: &mut Vec<Action>) {
    let stops = stops(session, id, def);
    let smooth = input::value_of(session, def, &SocketRef::new(id, "smooth_steps")) == Some(Value::Bool(true));
    let low = stops.iter().map(|stop| stop.at).fold(0.0_f32, f32::min);
    let high = stops.iter().map(|stop| stop.at).fold(1.0_f32, f32::max);
    let (rect, _) = ui.allocate_exact_size(egui::vec2(ui.available_width(), HEIGHT + 14.0), Sense::hover());
    let bar = Rect::from_min_max(rect.min + egui::vec2(6.0, 0.0), egui::pos2(rect.right() - 6.0, rect.top() + HEIGHT));
    let width = bar.width() / STRIPS as f32;
    for strip in 0..STRIPS {
        let t = low + (high - low) * (strip as f32 + 0.5) / STRIPS as f32;
        let left = bar.left() + width * strip as f32;
        // A little wider, so that no seam shows.
        let part = Rect::from_min_max(egui::pos2(left, bar.top()), egui::pos2(left + width + 0.5, bar.bottom()));
        ui.painter().rect_filled(part.intersect(bar), 0.0, color::shown(mixed(&stops, t, smooth)));
    }
    ui.painter().rect_stroke(bar, 2.0, ui.visuals().widgets.noninteractive.bg_stroke, egui::StrokeKind::Outside);
    for stop in &stops {
        let at = Pos2::new(bar.left() + bar.width() * (stop.at - low) / (high - low), bar.bottom() + 6.0);
        let sense = if stop.position.is_some() { Sense::drag() } else { Sense::hover() };
        let handle = ui.interact(Rect::from_center_size(at, Vec2::splat(16.0)), ui.id().with(&stop.name), sense);
        handle.widget_info(|| egui::WidgetInfo::slider(true, f64::from(stop.at), format!("Stop {}", stop.name)));
        let line = if handle.hovered() || handle.has_focus() { Color32::WHITE } else { ui.visuals().text_color() };
        let radius = if stop.position.is_some() { 6.0 } else { 4.0 };
        ui.painter().circle(at, radius, color::shown(stop.color), Stroke::new(1.5, line));
        let Some(socket) = &stop.position else {
            handle.on_hover_text("This stop stands still");
            continue;
        };
        let moved = handle.drag_delta().x / bar.width() * (high - low);
        if moved != 0.0 {
            let edit = Edit::SetValue { value: Some(Value::Number(stop.at + moved)), socket: socket.clone() };
            actions.push(Action::drag("Move a stop", edit, socket.to_string()));
        }
        if handle.drag_stopped() {
            actions.push(Action::EndMerge);
        }
        handle.on_hover_text(format!("At {:.3}; drag to move, its colour is below", stop.at));
    }
}

fn stops(session: &Session, id: &NodeId, def: &NodeDef) -> Vec<Stop> {
    let names = def.inputs.iter().filter_map(|input| input.name.strip_prefix("color_"));
    let names: Vec<&str> = names.collect();
    let last = names.len().saturating_sub(1);
    let stop = |(place, name): (usize, &&str)| {
        let position = SocketRef::new(id, &format!("position_{name}"));
        let moves = def.inputs.iter().any(|input| input.name == position.socket);
        let at = if moves { input::number_of(session, def, &position) } else { f32::from(u8::from(place == last)) };
        let color = match input::value_of(session, def, &SocketRef::new(id, &format!("color_{name}"))) {
            Some(Value::Vec3(color)) => color,
            Some(Value::Number(grey) | Value::Decimal { nearest: grey, .. }) => [grey; 3],
            _ => [0.5; 3],
        };
        let position = Some(position).filter(|socket| moves && session.incoming(socket).is_none());
        Stop { name: (*name).to_owned(), color, at, position }
    };
    names.iter().enumerate().map(stop).collect()
}

/// The ramp's colour at t, as the nodes compute it: from stop to stop, each border a linear step.
fn mixed(stops: &[Stop], t: f32, smooth: bool) -> [f32; 3] {
    let mut color = stops.first().map_or([0.0; 3], |stop| stop.color);
    for pair in stops.windows(2) {
        let (from, to) = (pair[0].at, pair[1].at);
        let share = if to > from { ((t - from) / (to - from)).clamp(0.0, 1.0) } else { f32::from(u8::from(t >= to)) };
        let share = if smooth { share * share * (3.0 - 2.0 * share) } else { share };
        color = std::array::from_fn(|i| color[i] + (pair[1].color[i] - color[i]) * share);
    }
    color
}
