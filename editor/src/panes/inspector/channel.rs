//! What of a picture is used, and how its normals are meant: the output of the node that is wired, and the switch of the normal
//! map that it feeds. Both stand in the graph; this sets them where the picture is chosen.

use eframe::egui::{self, ComboBox};
use halfvector_graph::document::{Link, NodeId, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::operation::can_connect;
use halfvector_graph::value::Value;

use crate::action::Action;
use crate::panes::inspector::image::setting;
use crate::panes::inspector::row::in_words;
use crate::session::Session;

/// The input that says which way a normal map's green channel runs.
const FLIP: &str = "flip_y";

/// Draws the choice of the channel, when one output of the node is wired and another one could be.
pub(crate) fn channel(ui: &mut egui::Ui, session: &Session, node: &NodeId, def: &NodeDef, actions: &mut Vec<Action>) {
    let links: Vec<&Link> = session.links().iter().filter(|link| link.from.node == *node).collect();
    let Some(now) = links.first().map(|link| link.from.socket.as_str()) else { return };
    if def.outputs.len() < 2 || links.iter().any(|link| link.from.socket != now) {
        return;
    }
    setting(ui, "channel", "What of the picture is used: the output that is wired", |ui, label| {
        let combo = ComboBox::from_id_salt("channel").width(ui.available_width() - 8.0).selected_text(in_words(now));
        let combo = combo.show_ui(ui, |ui| {
            for output in &def.outputs {
                let from = SocketRef::new(node, &output.name);
                let can = |link: &&Link| {
                    can_connect(session.document(), Library::standard(), session.group(), &from, &link.to).is_ok()
                };
                let is_now = output.name == now;
                let choice = egui::Button::selectable(is_now, in_words(&output.name));
                let response = ui.add_enabled(is_now || links.iter().all(can), choice).on_hover_text(&output.help);
                if response.on_disabled_hover_text("It does not fit what the picture feeds").clicked() && !is_now {
                    // The link into an input makes way for another one.
                    let other =
                        links.iter().map(|link| Edit::AddLink { link: Link::new(from.clone(), link.to.clone()) });
                    actions.push(Action::edit("Choose the channel", Edit::Many(other.collect())));
                }
            }
        });
        combo.response.labelled_by(label);
    });
}

/// Draws the choice of the sign of a normal map's green channel, when the picture feeds one.
pub(crate) fn sign(ui: &mut egui::Ui, session: &Session, node: &NodeId, actions: &mut Vec<Action>) {
    let fed = session.links().iter().filter(|link| link.from.node == *node);
    let mut maps: Vec<&NodeId> = fed.map(|link| &link.to.node).filter(|id| has_flip(session, id)).collect();
    maps.dedup();
    let Some(first) = maps.first() else { return };
    if session.incoming(&SocketRef::new(first, FLIP)).is_some() {
        return;
    }
    let mut flipped = session.value(&SocketRef::new(first, FLIP)) == Some(&Value::Bool(true));
    let before = flipped;
    let words = |flipped: bool| if flipped { "-Y (DirectX)" } else { "+Y (OpenGL)" };
    setting(ui, "normals", "Which way the green channel of the normal map runs", |ui, label| {
        let combo = ComboBox::from_id_salt("normals").width(ui.available_width() - 8.0).selected_text(words(flipped));
        let combo = combo.show_ui(ui, |ui| {
            for one in [false, true] {
                ui.selectable_value(&mut flipped, one, words(one));
            }
        });
        combo.response.labelled_by(label);
    });
    if flipped != before {
        let set = |id: &&NodeId| Edit::SetValue { socket: SocketRef::new(id, FLIP), value: Some(Value::Bool(flipped)) };
        let edit = Edit::Many(maps.iter().map(set).collect());
        actions.push(Action::edit("Set the sign of the normal map", edit));
    }
}

fn has_flip(session: &Session, id: &NodeId) -> bool {
    let def = session.node(id).and_then(|node| session.library().get(&node.node));
    def.is_some_and(|def| def.inputs.iter().any(|input| input.name == FLIP))
}
