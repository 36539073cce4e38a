//! One node: its label and help, what is wrong with it, its inputs.

use eframe::egui::{self, CollapsingHeader, RichText, TextEdit};
use halfvector_graph::check::{Problem, Severity};
use halfvector_graph::document::{NodeId, function_of};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::SocketType;

use crate::action::Action;
use crate::colors::nodes_of_colors;
use crate::panes::inspector::input::{self, Slot};
use crate::panes::inspector::row::{end_when_done, in_words, named_text};
use crate::panes::inspector::thumbnail::Thumbnails;
use crate::panes::inspector::{curve, help, kind, metal, ramp};
use crate::session::Session;
use crate::theme;

/// Draws the node.
pub(crate) fn show(
    ui: &mut egui::Ui,
    session: &Session,
    id: &NodeId,
    thumbnails: &mut Thumbnails,
    actions: &mut Vec<Action>,
) {
    let Some(node) = session.node(id) else { return };
    let function = function_of(&node.node).filter(|id| session.document().functions.contains_key(*id));
    let Some(def) = session.library().get(&node.node) else {
        ui.heading(node.label.as_deref().unwrap_or(id));
        if let Some(function) = function {
            ui.label("Its function is no node yet: there is something wrong in its code.");
            edit_code(ui, function, actions);
        } else {
            ui.label(format!("This version does not know nodes of the kind {}. It is kept as it is.", node.node));
        }
        problems(ui, session, id);
        return;
    };
    label(ui, id, node.label.as_deref(), def, actions);
    if let Some(function) = function {
        edit_code(ui, function, actions);
    }
    CollapsingHeader::new("Help").id_salt(("help", &def.id)).show(ui, |ui| {
        help::show(ui, &def.help);
        outputs(ui, def);
        if function.is_none() && !def.file.is_empty() {
            ui.weak(format!("shaders/{}", def.file)).on_hover_text(&def.function.name);
        }
    });
    problems(ui, session, id);
    ui.separator();
    ui.push_id(id, |ui| {
        if curve::is_curve(def) {
            curve::show(ui, session, id, def, actions);
        }
        if ramp::is_ramp(def) {
            ramp::show(ui, session, id, def, actions);
        }
        if metal::is_metal(def) {
            metal::show(ui, session, id, def, actions);
        }
        if def.inputs.is_empty() {
            ui.weak("This node has no inputs.");
        }
        let (generic, has_colors) = {
            let types = resolve_types(session.graph(), session.library());
            let generic = types.get(id).and_then(|types| types.generic);
            (generic, generic.is_some() && nodes_of_colors(session.graph(), &types).contains(id.as_str()))
        };
        if let Some(now) = generic {
            kind::show(ui, session, id, def, now, actions);
        }
        for input in &def.inputs {
            let ty = match (input.ty, generic) {
                (SocketType::Generic, Some(ty)) => SocketType::Value(ty),
                (ty, _) => ty,
            };
            let is_color = input.unit == "color" || (has_colors && input.ty == SocketType::Generic);
            input::show(ui, session, &Slot { node: id, input, ty, is_color, limits: None }, thumbnails, actions);
        }
    });
}

fn edit_code(ui: &mut egui::Ui, function: &str, actions: &mut Vec<Action>) {
    if ui.button("Edit the code").on_hover_text("The function that this node is").clicked() {
        actions.push(Action::EditFunction(function.to_owned()));
    }
}

/// The editable label, with the kind of the node below.
fn label(ui: &mut egui::Ui, id: &NodeId, label: Option<&str>, def: &NodeDef, actions: &mut Vec<Action>) {
    let mut text = label.unwrap_or_default().to_owned();
    let field = TextEdit::singleline(&mut text)
        .hint_text(RichText::new(&def.label).heading())
        .font(egui::TextStyle::Heading)
        .desired_width(f32::INFINITY);
    let response = ui.add(field).on_hover_text("The name of this node; empty for the name of its kind");
    named_text(&response, &text, "Label of the node");
    if response.changed() {
        let label = Some(text).filter(|label| !label.trim().is_empty());
        let edit = Edit::SetLabel { id: id.clone(), label };
        actions.push(Action::drag("Rename", edit, format!("label of {id}")));
    }
    end_when_done(&response, actions);
    ui.weak(format!("{} · {}", def.label, def.id));
}

fn outputs(ui: &mut egui::Ui, def: &NodeDef) {
    for output in &def.outputs {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(in_words(&output.name)).strong());
            ui.label(&output.help);
        });
    }
}

fn problems(ui: &mut egui::Ui, session: &Session, id: &NodeId) {
    let is_here = |problem: &&Problem| problem.node.as_ref() == Some(id) && problem.group.as_deref() == session.group();
    for problem in session.all_problems().filter(is_here) {
        let color = if problem.severity == Severity::Error { theme::ERROR } else { theme::WARNING };
        let text = match &problem.socket {
            Some(socket) => format!("{}: {}", in_words(socket), problem.message),
            None => problem.message.clone(),
        };
        ui.colored_label(theme::letters(color, ui.visuals()), text);
    }
}
