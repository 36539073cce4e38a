//! The inputs of what is selected, with widgets from type, range and unit.

use eframe::egui;
use halfvector_graph::document::SocketRef;
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::Default as SocketDefault;
use halfvector_graph::value::Value;

use crate::action::Action;
use crate::session::Session;

/// The inspector.
#[derive(Debug, Default)]
pub(crate) struct Inspector;

impl Inspector {
    /// Draws the inputs of the selected node.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        let document = session.document();
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            let mut selected = session.selection().iter();
            let (Some(id), None) = (selected.next(), selected.next()) else {
                ui.weak("Select one node to see its inputs.");
                return;
            };
            let Some(node) = document.graph.nodes.get(id) else { return };
            let Some(def) = Library::standard().get(&node.node) else { return };
            ui.heading(node.label.as_deref().unwrap_or(&def.label)).on_hover_text(&def.help);
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                for input in &def.inputs {
                    let socket = SocketRef::new(id, &input.name);
                    let value = document.graph.value(&socket).cloned().or_else(|| match &input.default {
                        SocketDefault::Value(value) => Some(value.clone()),
                        _ => None,
                    });
                    ui.horizontal(|ui| {
                        ui.label(&input.name).on_hover_text(&input.help);
                        if let Some(from) = document.graph.incoming(&socket) {
                            ui.weak(from.to_string());
                        } else if let Some(Value::Number(number)) = value {
                            let mut number = number;
                            if ui.add(egui::DragValue::new(&mut number).speed(0.01)).changed() {
                                let edit =
                                    Edit::SetValue { socket: socket.clone(), value: Some(Value::Number(number)) };
                                actions.push(Action::drag(format!("Set {}", input.name), edit, socket.to_string()));
                            }
                        }
                    });
                }
            });
        });
    }
}
