//! One input of a node: the widget that its type, range and unit ask for, or where it comes from.

use eframe::egui::{self, Checkbox, RichText};
use halfvector_graph::check::node_label;
use halfvector_graph::context::CONTEXTS;
use halfvector_graph::document::{Link, NodeId, Parameter, SocketRef, is_name};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::{Default as SocketDefault, Input, NodeDef};
use halfvector_graph::resolve::Types;
use halfvector_graph::value::{SocketType, Type, Value};

use crate::action::Action;
use crate::colors::nodes_of_colors;
use crate::panes::inspector::number::Style;
use crate::panes::inspector::row::{end_when_done, gives_up, in_words, row};
use crate::panes::inspector::thumbnail::Thumbnails;
use crate::panes::inspector::{color, image, number, parameter};
use crate::session::Session;
use crate::theme;

/// An input that is drawn.
pub(crate) struct Slot<'a> {
    /// Its node.
    pub(crate) node: &'a NodeId,
    /// What it is.
    pub(crate) input: &'a Input,
    /// Its type, no longer generic.
    pub(crate) ty: SocketType,
    /// Whether three or four numbers on it are a colour.
    pub(crate) is_color: bool,
    /// What its numbers are kept between.
    pub(crate) limits: Option<[f32; 2]>,
}

/// The value that an unconnected input has: the one set, or the definition's. `None` for contexts and empty image slots.
pub(crate) fn value_of(session: &Session, def: &NodeDef, socket: &SocketRef) -> Option<Value> {
    session.value(socket).cloned().or_else(|| {
        match &def.inputs.iter().find(|input| input.name == socket.socket)?.default {
            SocketDefault::Value(value) => Some(value.clone()),
            SocketDefault::Context(_) | SocketDefault::Image(_) | SocketDefault::Surface => None,
        }
    })
}

/// The number that an unconnected input has; 0 without one.
pub(crate) fn number_of(session: &Session, def: &NodeDef, socket: &SocketRef) -> f32 {
    match value_of(session, def, socket) {
        Some(Value::Number(number) | Value::Decimal { nearest: number, .. }) => number,
        _ => 0.0,
    }
}

/// Draws the input's row, and its parameter's below when it is exposed.
pub(crate) fn show(
    ui: &mut egui::Ui,
    session: &Session,
    slot: &Slot<'_>,
    thumbnails: &mut Thumbnails,
    actions: &mut Vec<Action>,
) {
    let socket = SocketRef::new(slot.node, &slot.input.name);
    let exposed = session.document().parameters.iter().position(|parameter| parameter.socket == socket);
    ui.push_id(&slot.input.name, |ui| {
        if slot.ty == SocketType::Texture && session.incoming(&socket).is_none() {
            image::show(ui, session, slot, thumbnails, actions);
        } else {
            let is_set = session.value(&socket).is_some();
            let name = RichText::new(in_words(&slot.input.name));
            let name = if is_set { name.strong() } else { name };
            let mut chosen = Vec::new();
            let mut menu = |ui: &mut egui::Ui| menu(ui, session, slot, &socket, exposed, &mut chosen);
            let hint = hint(slot);
            let dot = Some(theme::socket_color(slot.ty));
            row(ui, name, &hint, dot, |ui, label| widget(ui, session, slot, &socket, label, actions), Some(&mut menu));
            actions.extend(chosen);
        }
        if let Some(place) = exposed {
            ui.indent("parameter", |ui| parameter::show(ui, session, place, actions));
        }
    });
}

/// Draws the value of a parameter of the material, within the range that this one states.
pub(crate) fn value(
    ui: &mut egui::Ui,
    session: &Session,
    parameter: &Parameter,
    types: &Types<'_>,
    actions: &mut Vec<Action>,
) {
    let socket = &parameter.socket;
    let Some(of_node) = types.get(&socket.node) else { return };
    let input = of_node.def.inputs.iter().find(|input| input.name == socket.socket);
    let (Some(input), Some(ty)) = (input, of_node.input(&socket.socket)) else { return };
    if ty == SocketType::Texture {
        return;
    }
    let is_color = input.unit == "color"
        || (input.ty == SocketType::Generic
            && nodes_of_colors(&session.document().graph, types).contains(&*socket.node));
    let input = &Input { range: parameter.range.or(input.range), ..input.clone() };
    let slot = Slot { node: &socket.node, input, ty, is_color, limits: parameter.range };
    let dot = Some(theme::socket_color(ty));
    let name = RichText::new(parameter.label.as_deref().unwrap_or(&parameter.name));
    row(ui, name, &hint(&slot), dot, |ui, label| widget(ui, session, &slot, socket, label, actions), None);
}

fn hint(slot: &Slot<'_>) -> String {
    let Input { help, range, unit, .. } = slot.input;
    let mut lines = vec![help.clone()];
    if let Some([low, high]) = range {
        lines.push(format!("usually {low} to {high}"));
    }
    if !unit.is_empty() {
        lines.push(format!("unit: {unit}"));
    }
    if let SocketType::Value(ty) = slot.ty {
        lines.push(format!("type: {}", ty.wgsl()));
    }
    lines.retain(|line| !line.is_empty());
    lines.join("\n")
}

fn widget(
    ui: &mut egui::Ui,
    session: &Session,
    slot: &Slot<'_>,
    socket: &SocketRef,
    label: egui::Id,
    actions: &mut Vec<Action>,
) {
    if let Some(from) = session.incoming(socket) {
        let text =
            format!("{} · {}", node_label(session.graph(), session.library(), &from.node), in_words(&from.socket));
        let link = egui::Link::new(text);
        if ui.add(link).labelled_by(label).on_hover_text("Show the node that it comes from").clicked() {
            actions.push(Action::Show(from.node.clone()));
        }
        return;
    }
    let set = session.value(socket);
    let value = match (set, &slot.input.default) {
        (Some(value), _) | (None, SocketDefault::Value(value)) => value.clone(),
        (None, SocketDefault::Context(name)) => {
            let help = CONTEXTS.iter().find(|context| context.name == name).map_or("", |context| context.help);
            ui.weak(in_words(name)).on_hover_text(format!("{help}. Link something to change it."));
            return;
        }
        (None, SocketDefault::Image(_) | SocketDefault::Surface) => return,
    };
    let SocketType::Value(ty) = slot.ty else { return };
    let style = Style { range: slot.input.range, unit: &slot.input.unit, is_whole: ty == Type::I32 };
    let Some(mut parts) = value.components_as(ty) else {
        ui.colored_label(theme::letters(theme::ERROR, ui.visuals()), "this value does not fit")
            .on_hover_text("Reset it in the menu at the right");
        return;
    };
    let is_color = slot.is_color && parts.len() >= 3;
    let answer = match (ty, parts.as_mut_slice()) {
        (Type::Bool, [part]) => {
            let mut on = *part != 0.0;
            let response = ui.add(Checkbox::without_text(&mut on)).labelled_by(label);
            *part = f32::from(u8::from(on));
            response.into()
        }
        (_, [part]) => number::number(ui, part, style, label),
        (_, parts) if is_color => color::color(ui, parts, label).into(),
        (_, parts) => number::vector(ui, parts, style, label),
    };
    let response = &answer.response;
    if !gives_up(&answer, actions) && response.changed() {
        if let Some([low, high]) = slot.limits {
            parts.iter_mut().for_each(|part| *part = part.max(low).min(high));
        }
        let edit = Edit::SetValue { socket: socket.clone(), value: value_from(ty, &parts) };
        actions.push(Action::drag(format!("Set {}", in_words(&slot.input.name)), edit, socket.to_string()));
    }
    end_when_done(response, actions);
}

/// A value from components of a type.
pub(crate) fn value_from(ty: Type, parts: &[f32]) -> Option<Value> {
    Some(match (ty, parts) {
        (Type::Bool, [x]) => Value::Bool(*x != 0.0),
        (Type::I32, [x]) => Value::Number(x.round()),
        (_, [x]) => Value::Number(*x),
        (_, [x, y]) => Value::Vec2([*x, *y]),
        (_, [x, y, z]) => Value::Vec3([*x, *y, *z]),
        (_, [x, y, z, w]) => Value::Vec4([*x, *y, *z, *w]),
        _ => return None,
    })
}

/// What can be done with an input.
pub(crate) fn menu(
    ui: &mut egui::Ui,
    session: &Session,
    slot: &Slot<'_>,
    socket: &SocketRef,
    exposed: Option<usize>,
    actions: &mut Vec<Action>,
) {
    let name = in_words(&slot.input.name);
    if ui.add_enabled(session.value(socket).is_some(), egui::Button::new("Reset to default")).clicked() {
        let edit = Edit::SetValue { socket: socket.clone(), value: None };
        actions.push(Action::edit(format!("Reset {name}"), edit));
        ui.close();
    }
    if let Some(from) = session.incoming(socket) {
        if ui.button("Disconnect").clicked() {
            let link = Link::new(from.clone(), socket.clone());
            actions.push(Action::edit(format!("Disconnect {name}"), Edit::RemoveLink { link }));
            ui.close();
        }
        return;
    }
    let is_number = matches!(slot.ty, SocketType::Value(_)) && matches!(slot.input.default, SocketDefault::Value(_));
    match exposed {
        Some(place) if ui.button("Stop exposing").clicked() => {
            actions.push(Action::edit(format!("Stop exposing {name}"), Edit::RemoveParameter { place }));
            ui.close();
        }
        None if is_number => {
            let button = ui.button("Expose as parameter");
            if button.on_hover_text("Users of the material and of its shader can set it").clicked() {
                let parameter =
                    Parameter { name: free_name(session, socket), label: None, socket: socket.clone(), range: None };
                actions.push(Action::edit(format!("Expose {name}"), Edit::AddParameter { place: None, parameter }));
                ui.close();
            }
        }
        _ => {}
    }
}

/// A name for a new parameter: the socket's, with the node's id in front when it is taken, then with a number.
fn free_name(session: &Session, socket: &SocketRef) -> String {
    let document = session.document();
    let is_free = |name: &String| is_name(name) && document.parameter(name).is_none();
    let with_node = format!("{}_{}", socket.node, socket.socket);
    let numbered = (2u32..).map(|number| format!("{}_{number}", socket.socket));
    let mut names = [socket.socket.clone(), with_node].into_iter().chain(numbered);
    names.find(is_free).unwrap_or_else(|| socket.socket.clone())
}
