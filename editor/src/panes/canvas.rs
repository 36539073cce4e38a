//! The graph.

use eframe::egui;
use halfvector_graph::check::node_label;
use halfvector_graph::document::NodeId;
use halfvector_graph::library::Library;

use crate::action::Action;
use crate::session::Session;
use crate::theme;

/// The graph's view.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    /// A node that is to be brought into view.
    wanted: Option<NodeId>,
}

impl Canvas {
    /// Brings a node into view when the canvas is drawn next.
    pub(crate) fn show_node(&mut self, node: NodeId) {
        self.wanted = Some(node);
    }

    /// Draws the graph.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        if let Some(node) = self.wanted.take() {
            actions.push(Action::Select(vec![node]));
        }
        for id in session.graph().nodes.keys() {
            let label = node_label(session.graph(), Library::standard(), id);
            let definition = session.graph().nodes.get(id).and_then(|node| Library::standard().get(&node.node));
            let output = definition.and_then(|definition| definition.outputs.first());
            let category = definition.map_or("", |definition| definition.id.split('/').next().unwrap_or(""));
            let color = output.map_or(theme::category_color(category), |output| theme::socket_color(output.ty));
            let text = egui::RichText::new(label).color(color);
            if ui.selectable_label(session.selection().contains(id), text).clicked() {
                actions.push(Action::Select(vec![id.clone()]));
            }
        }
    }
}
