//! The picker of metals: a conductor becomes another one, and what is linked to it stays linked.

use eframe::egui;
use halfvector_graph::document::{Node, NodeId};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;

use crate::action::Action;
use crate::session::Session;

/// The node whose constants are set by hand.
const CONDUCTOR: &str = "optics/conductor";

/// Whether a node is a metal: it has the outputs of the conductor.
pub(crate) fn is_metal(def: &NodeDef) -> bool {
    let names = |def: &NodeDef| def.outputs.iter().map(|output| output.name.clone()).collect::<Vec<_>>();
    let like_conductor = Library::standard().get(CONDUCTOR).is_some_and(|conductor| names(conductor) == names(def));
    def.id == CONDUCTOR || (like_conductor && def.inputs.is_empty())
}

/// Draws the choice.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, id: &NodeId, def: &NodeDef, actions: &mut Vec<Action>) {
    let Some(node) = session.node(id) else { return };
    egui::ComboBox::new("metal", "Metal").selected_text(&def.label).show_ui(ui, |ui| {
        for metal in Library::standard().iter().filter(|metal| is_metal(metal)) {
            let text = if metal.id == CONDUCTOR { "By optical constants" } else { metal.label.as_str() };
            if ui.selectable_label(metal.id == def.id, text).on_hover_text(first_line(&metal.help)).clicked()
                && metal.id != def.id
            {
                let changed = Node { node: metal.id.clone(), ..node.clone() };
                let edits = vec![Edit::TakeNode { id: id.clone() }, Edit::AddNode { id: id.clone(), node: changed }];
                actions.push(Action::edit(format!("Make it {}", metal.label), Edit::Many(edits)));
            }
        }
    });
}

fn first_line(help: &str) -> &str {
    help.split("\n\n").next().unwrap_or_default()
}
