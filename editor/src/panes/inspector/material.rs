//! The material itself: name, what opacity does, its parameters in their order, what it is made of.

use eframe::egui::{self, Checkbox, CollapsingHeader, ComboBox, RichText, TextEdit};
use halfvector_graph::check::{Severity, node_label, surface_node};
use halfvector_graph::document::{AlphaMode, SurfaceSettings};
use halfvector_graph::edit::Edit;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::Value;
use halfvector_graph::wiring::Wiring;

use crate::action::Action;
use crate::panes::inspector::number::{self, Style};
use crate::panes::inspector::row::{end_when_done, gives_up, named_text, row};
use crate::panes::inspector::{input, parameter};
use crate::session::Session;

/// Draws the material.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
    let document = session.document();
    let mut name = document.name.clone();
    let field = TextEdit::singleline(&mut name).font(egui::TextStyle::Heading).desired_width(f32::INFINITY);
    let response = ui.add(field).on_hover_text("The name of the material");
    named_text(&response, &name, "Name of the material");
    if response.changed() {
        actions.push(Action::drag("Rename the material", Edit::SetName { name }, "name of the material"));
    }
    end_when_done(&response, actions);
    ui.weak("Material · select a node to see its inputs");
    ui.separator();
    surface(ui, document.surface, actions);
    ui.add_space(8.0);
    CollapsingHeader::new(format!("Parameters ({})", document.parameters.len()))
        .id_salt("parameters")
        .default_open(true)
        .show(ui, |ui| parameters(ui, session, actions));
    CollapsingHeader::new("What it is made of").id_salt("statistics").default_open(true).show(ui, |ui| {
        statistics(ui, session);
    });
}

fn surface(ui: &mut egui::Ui, before: SurfaceSettings, actions: &mut Vec<Action>) {
    let mut now = before;
    let hint = "opaque: opacity is ignored. mask: fragments below the cutoff are discarded. blend: blended over what lies behind";
    let modes = [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend];
    row(
        ui,
        RichText::new("alpha mode"),
        hint,
        None,
        |ui, label| {
            let combo = ComboBox::from_id_salt("alpha mode").selected_text(now.alpha_mode.name());
            let response = combo.show_ui(ui, |ui| {
                modes.iter().for_each(|mode| {
                    ui.selectable_value(&mut now.alpha_mode, *mode, mode.name());
                });
            });
            response.response.labelled_by(label);
        },
        None,
    );
    let mut done = None;
    if now.alpha_mode == AlphaMode::Mask {
        let style = Style { range: Some([0.0, 1.0]), unit: "", is_whole: false };
        let cutoff = &mut now.alpha_cutoff;
        let hint = "opacity below which fragments are discarded";
        done = Some(row(
            ui,
            RichText::new("cutoff"),
            hint,
            None,
            |ui, label| number::number(ui, cutoff, style, label),
            None,
        ));
    }
    row(
        ui,
        RichText::new("double sided"),
        "back faces are drawn too, with the normal turned to the viewer",
        None,
        |ui, label| ui.add(Checkbox::without_text(&mut now.double_sided)).labelled_by(label),
        None,
    );
    if done.as_ref().is_some_and(|answer| gives_up(answer, actions)) {
        now.alpha_cutoff = before.alpha_cutoff;
    }
    if now != before {
        actions.push(Action::drag("Change the surface", Edit::SetSurface { surface: now }, "surface settings"));
    }
    match done {
        Some(answer) => end_when_done(&answer.response, actions),
        None if now != before => actions.push(Action::EndMerge),
        None => {}
    }
}

/// The parameters in their order, which dragging the handles or the arrow buttons change.
fn parameters(ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
    let document = session.document();
    if document.parameters.is_empty() {
        ui.weak("None. Expose an input in its menu to let users of the material set it.");
        return;
    }
    let types = resolve_types(&document.graph, session.library());
    let count = document.parameters.len();
    let mut moved = None;
    for (place, one) in document.parameters.iter().enumerate() {
        ui.push_id(place, |ui| {
            let row = ui.horizontal(|ui| {
                let handle = ui.dnd_drag_source(ui.id().with("handle"), place, |ui| ui.weak("::"));
                handle.response.on_hover_text("Drag to change the order");
                if ui.add_enabled(place > 0, egui::Button::new("Up").small()).on_hover_text("Earlier").clicked() {
                    moved = Some((place, place - 1));
                }
                if ui.add_enabled(place + 1 < count, egui::Button::new("Down").small()).on_hover_text("Later").clicked()
                {
                    moved = Some((place, place + 1));
                }
                let of = node_label(&document.graph, session.library(), &one.socket.node);
                let text = format!("{of} · {}", super::row::in_words(&one.socket.socket));
                if ui.link(text).on_hover_text("Show the node").clicked() {
                    actions.push(Action::Show(one.socket.node.clone()));
                }
            });
            if let Some(from) = row.response.dnd_release_payload::<usize>() {
                moved = Some((*from, place));
            }
            ui.indent("fields", |ui| {
                input::value(ui, session, one, &types, actions);
                parameter::show(ui, session, place, actions);
            });
        });
    }
    if let Some((from, to)) = moved.filter(|(from, to)| from != to && *from < count)
        && let Some(parameter) = document.parameters.get(from)
    {
        let edits = vec![
            Edit::RemoveParameter { place: from },
            Edit::AddParameter { place: Some(to), parameter: parameter.clone() },
        ];
        actions.push(Action::edit("Move a parameter", Edit::Many(edits)));
    }
}

fn statistics(ui: &mut egui::Ui, session: &Session) {
    let document = session.document();
    let wiring = Wiring::new(&document.graph);
    let live = surface_node(document, session.library())
        .and_then(|surface| wiring.order(&[surface]).ok())
        .map(|order| order.len());
    let images: std::collections::BTreeSet<&str> = document
        .graph
        .nodes
        .values()
        .flat_map(|node| node.values.values())
        .filter_map(|value| if let Value::Image(image) = value { Some(image.file.as_str()) } else { None })
        .collect();
    let count = |severity| session.problems().iter().filter(|problem| problem.severity == severity).count();
    let rows = [
        ("nodes", document.graph.nodes.len().to_string()),
        ("of them used", live.map_or_else(|| "-".to_owned(), |live| live.to_string())),
        ("links", document.graph.links.len().to_string()),
        ("pictures", images.len().to_string()),
        ("errors", count(Severity::Error).to_string()),
        ("warnings", count(Severity::Warning).to_string()),
    ];
    egui::Grid::new("statistics").num_columns(2).show(ui, |ui| {
        for (what, number) in rows {
            ui.label(what);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.monospace(number));
            ui.end_row();
        }
    });
}
