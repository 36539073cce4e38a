//! What a generic node works on: numbers, vectors or colours. Its wires decide; what is not wired goes along with the choice.

use eframe::egui::{self, ComboBox, RichText};
use halfvector_graph::document::{NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::{SocketType, Type};

use crate::action::Action;
use crate::panes::inspector::input::{value_from, value_of};
use crate::panes::inspector::row::row;
use crate::session::Session;

/// Draws the choice.
pub(crate) fn show(
    ui: &mut egui::Ui,
    session: &Session,
    id: &NodeId,
    def: &NodeDef,
    now: Type,
    actions: &mut Vec<Action>,
) {
    let wired = wired(session, id, def);
    let hint = "What the node computes with. What is wired to it may ask for more";
    row(
        ui,
        RichText::new("works on"),
        hint,
        None,
        |ui, label| {
            let combo = ComboBox::from_id_salt("works on").selected_text(name(now)).width(ui.available_width() - 8.0);
            let shown = combo.show_ui(ui, |ui| {
                for &ty in def.generic.iter().filter(|ty| wired.iter().all(|wired| wired.converts_to(**ty))) {
                    if ui.selectable_label(ty == now, name(ty)).clicked() && ty != now {
                        let edit = Edit::Many(changed(session, id, def, ty));
                        actions.push(Action::edit(format!("Work on {}", name(ty)), edit));
                    }
                }
            });
            shown.response.labelled_by(label);
        },
        None,
    );
}

/// The types that come in over wires.
fn wired(session: &Session, id: &NodeId, def: &NodeDef) -> Vec<Type> {
    let types = resolve_types(session.graph(), session.library());
    let inputs = def.inputs.iter().filter(|input| input.ty == SocketType::Generic);
    let from = inputs.filter_map(|input| session.incoming(&SocketRef::new(id, &input.name)));
    let given = from.filter_map(|from| types.get(&from.node)?.output(&from.socket));
    given.filter_map(|ty| if let SocketType::Value(ty) = ty { Some(ty) } else { None }).collect()
}

/// The values of all inputs that are not wired, as values of a type: one number stands for all, the first of several for one.
fn changed(session: &Session, id: &NodeId, def: &NodeDef, ty: Type) -> Vec<Edit> {
    let inputs = def.inputs.iter().filter(|input| input.ty == SocketType::Generic);
    let sockets = inputs.map(|input| SocketRef::new(id, &input.name));
    let free = sockets.filter(|socket| session.incoming(socket).is_none());
    let edits = free.filter_map(|socket| {
        let value = value_of(session, def, &socket)?;
        let parts = value.components()?;
        let fill = if let [only] = parts { *only } else { 0.0 };
        let parts: Vec<f32> = (0..ty.components()).map(|i| parts.get(i).copied().unwrap_or(fill)).collect();
        Some(Edit::SetValue { socket, value: value_from(ty, &parts) })
    });
    edits.collect()
}

/// A type as people say it.
pub(crate) fn name(ty: Type) -> &'static str {
    match ty {
        Type::Bool => "a switch",
        Type::I32 => "a whole number",
        Type::F32 => "a number",
        Type::Vec2 => "two numbers",
        Type::Vec3 => "a colour or vector",
        Type::Vec4 => "four numbers",
    }
}
