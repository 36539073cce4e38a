//! Several nodes: what they are, and what can be done with all of them.

use std::collections::BTreeMap;

use eframe::egui;
use halfvector_graph::check::node_label;
use halfvector_graph::document::SocketRef;
use halfvector_graph::edit::Edit;

use crate::action::Action;
use crate::session::Session;

/// Draws the selection.
pub(crate) fn show(ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
    let selection = session.selection();
    ui.heading(format!("{} nodes", selection.len()));
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for node in selection.iter().filter_map(|id| session.node(id)) {
        let kind = session.library().get(&node.node).map_or(node.node.as_str(), |def| def.label.as_str());
        *kinds.entry(kind).or_default() += 1;
    }
    let kinds: Vec<String> = kinds.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    ui.label(kinds.join(", "));
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        if ui.button("Delete").on_hover_text("Remove these nodes and their links").clicked() {
            let edits = selection.iter().map(|id| Edit::RemoveNode { id: id.clone() }).collect();
            actions.push(Action::edit("Delete nodes", Edit::Many(edits)));
        }
        if ui.button("Disconnect").on_hover_text("Remove all links from and to these nodes").clicked() {
            let links = session.links().iter();
            let edits: Vec<Edit> = links
                .filter(|link| selection.contains(&link.from.node) || selection.contains(&link.to.node))
                .map(|link| Edit::RemoveLink { link: link.clone() })
                .collect();
            actions.push(Action::edit("Disconnect nodes", Edit::Many(edits)));
        }
        if ui.button("Reset all values").on_hover_text("Every input of these nodes gets its default").clicked() {
            let sockets = selection.iter().filter_map(|id| Some((id, session.node(id)?)));
            let edits: Vec<Edit> = sockets
                .flat_map(|(id, node)| node.values.keys().map(move |socket| SocketRef::new(id, socket)))
                .map(|socket| Edit::SetValue { socket, value: None })
                .collect();
            actions.push(Action::edit("Reset nodes", Edit::Many(edits)));
        }
    });
    ui.separator();
    for id in selection {
        let label = node_label(session.graph(), session.library(), id);
        if ui.link(label).on_hover_text("Select only this one").clicked() {
            actions.push(Action::Select(vec![id.clone()]));
        }
    }
}
