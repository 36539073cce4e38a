//! The picker of metals: a conductor becomes another one, and what is linked to it stays linked. One whose optical constants are
//! set by hand begins with those of a metal.

use eframe::egui;
use halfvector_graph::document::{Node, NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::Value;

use crate::action::Action;
use crate::panes::inspector::row::row;
use crate::session::Session;

/// The node whose constants are set by hand.
const CONDUCTOR: &str = "optics/conductor";

/// A metal's index and extinction at 650, 550 and 450 nm.
struct Constants {
    /// Id of the node, whose help names the source.
    metal: &'static str,
    eta: [f32; 3],
    k: [f32; 3],
}

/// The published constants that the nodes of the metals were made from, linear between their rows.
const CONSTANTS: [Constants; 11] = [
    Constants { metal: "optics/gold", eta: [0.156, 0.424, 1.383], k: [3.602, 2.472, 1.915] },
    Constants { metal: "optics/silver", eta: [0.052, 0.06, 0.04], k: [4.409, 3.597, 2.648] },
    Constants { metal: "optics/copper", eta: [0.238, 1.007, 1.24], k: [3.626, 2.582, 2.393] },
    Constants { metal: "optics/aluminium", eta: [1.558, 1.015, 0.633], k: [7.712, 6.627, 5.454] },
    Constants { metal: "optics/iron", eta: [2.911, 2.95, 2.584], k: [3.089, 2.932, 2.767] },
    Constants { metal: "optics/chromium", eta: [3.107, 3.181, 2.323], k: [3.331, 3.329, 3.135] },
    Constants { metal: "optics/titanium", eta: [2.741, 2.542, 2.267], k: [3.814, 3.435, 3.038] },
    Constants { metal: "optics/nickel", eta: [1.99, 1.921, 1.729], k: [4.209, 3.616, 2.944] },
    Constants { metal: "optics/platinum", eta: [2.376, 2.085, 1.845], k: [4.264, 3.715, 3.136] },
    Constants { metal: "optics/tungsten", eta: [3.671, 3.522, 3.315], k: [2.927, 2.741, 2.516] },
    Constants { metal: "optics/brass", eta: [0.444, 0.527, 1.094], k: [3.695, 2.765, 1.829] },
];

/// Whether a node is a metal: it has the outputs of the conductor.
pub(crate) fn is_metal(def: &NodeDef) -> bool {
    let names = |def: &NodeDef| def.outputs.iter().map(|output| output.name.clone()).collect::<Vec<_>>();
    let like_conductor = Library::standard().get(CONDUCTOR).is_some_and(|conductor| names(conductor) == names(def));
    def.id == CONDUCTOR || (like_conductor && def.inputs.is_empty())
}

/// Draws the choice.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, id: &NodeId, def: &NodeDef, actions: &mut Vec<Action>) {
    let Some(node) = session.node(id) else { return };
    let shown = if def.id == CONDUCTOR { "By optical constants" } else { def.label.as_str() };
    named(ui, "metal", "Which metal's reflectance it has", shown, |ui| {
        for metal in Library::standard().iter().filter(|metal| is_metal(metal)) {
            let text = if metal.id == CONDUCTOR { "By optical constants" } else { metal.label.as_str() };
            if ui.selectable_label(metal.id == def.id, text).on_hover_text(first_line(&metal.help)).clicked()
                && metal.id != def.id
            {
                actions.push(Action::edit(format!("Make it {}", metal.label), made(session, id, node, metal)));
            }
        }
    });
    if def.id == CONDUCTOR {
        constants(ui, id, node, actions);
    }
}

/// The edit that makes a metal another one. What the other one has no inputs for goes, and is no longer exposed; optical constants
/// begin as its own.
fn made(session: &Session, id: &NodeId, node: &Node, metal: &NodeDef) -> Edit {
    let is_input = |name: &String| metal.inputs.iter().any(|input| input.name == *name);
    let mut changed = Node { node: metal.id.clone(), ..node.clone() };
    changed.values.retain(|name, _| is_input(name));
    if let Some(of) = CONSTANTS.iter().find(|of| metal.id == CONDUCTOR && of.metal == node.node) {
        changed.values.insert("eta".to_owned(), Value::Vec3(of.eta));
        changed.values.insert("k".to_owned(), Value::Vec3(of.k));
    }
    let links = session.links().iter().filter(|link| link.to.node == *id && !is_input(&link.to.socket));
    let mut edits: Vec<Edit> = links.map(|link| Edit::RemoveLink { link: link.clone() }).collect();
    // Parameters are of the whole material's graph. From the end, so that places stay what they are.
    let parameters = session.document().parameters.iter().enumerate().rev().filter(|(_, parameter)| {
        session.group().is_none() && parameter.socket.node == *id && !is_input(&parameter.socket.socket)
    });
    edits.extend(parameters.map(|(place, _)| Edit::RemoveParameter { place }));
    edits.push(Edit::TakeNode { id: id.clone() });
    edits.push(Edit::AddNode { id: id.clone(), node: changed });
    Edit::Many(edits)
}

/// The choice of a metal whose index and extinction are set.
fn constants(ui: &mut egui::Ui, id: &NodeId, node: &Node, actions: &mut Vec<Action>) {
    let is_set = |name: &str, value: [f32; 3]| node.values.get(name) == Some(&Value::Vec3(value));
    let library = Library::standard();
    let label = |of: &Constants| library.get(of.metal).map_or(of.metal, |def| def.label.as_str());
    let known = CONSTANTS.iter().find(|of| is_set("eta", of.eta) && is_set("k", of.k));
    let shown = known.map_or("Its own", label);
    named(ui, "eta and k of", "Sets both to a metal's, as they were published", shown, |ui| {
        for of in &CONSTANTS {
            let help = format!("eta {}, k {} at 650, 550, 450 nm", numbers(of.eta), numbers(of.k));
            let is_known = known.is_some_and(|known| known.metal == of.metal);
            if ui.selectable_label(is_known, label(of)).on_hover_text(help).clicked() {
                let set = |name: &str, value: [f32; 3]| Edit::SetValue {
                    socket: SocketRef::new(id, name),
                    value: Some(Value::Vec3(value)),
                };
                let edit = Edit::Many(vec![set("eta", of.eta), set("k", of.k)]);
                actions.push(Action::edit(format!("Constants of {}", label(of)), edit));
            }
        }
    });
}

/// A row with a choice.
fn named(ui: &mut egui::Ui, name: &str, hint: &str, shown: &str, add_choices: impl FnOnce(&mut egui::Ui)) {
    row(
        ui,
        egui::RichText::new(name),
        hint,
        None,
        |ui, label| {
            let combo = egui::ComboBox::from_id_salt(name).selected_text(shown).width(ui.available_width() - 8.0);
            combo.show_ui(ui, add_choices).response.labelled_by(label);
        },
        None,
    );
}

fn numbers(of: [f32; 3]) -> String {
    of.map(|x| x.to_string()).join(", ")
}

fn first_line(help: &str) -> &str {
    help.split("\n\n").next().unwrap_or_default()
}
