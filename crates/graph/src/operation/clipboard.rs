//! Copy and paste: a selection as the text of a document, with the groups and functions that it needs.

use std::collections::{BTreeMap, BTreeSet};

use super::import::{Needed, held, import, needed};
use super::{Refusal, in_graph, refuse};
use crate::check::surface_nodes;
use crate::document::{
    Document, GROUP_INPUT, GROUP_OUTPUT, Link, Node, NodeId, SURFACE_MIX, SURFACE_NODE, SocketRef, free_name, group_of,
};
use crate::edit::Edit;
use crate::file::{from_json, to_json};
use crate::library::Library;

/// The selected nodes of a graph as text: with the links among them, their places and the groups and functions that they need. Parameters
/// stay with the material, the nodes of a group's sockets with the group.
pub fn copy(document: &Document, group: Option<&str>, nodes: &[NodeId]) -> String {
    let mut copied = Document::new("");
    let Some(graph) = document.graph_of(group) else { return to_json(&copied) };
    let is_copied = |node: &Node| node.node != GROUP_INPUT && node.node != GROUP_OUTPUT;
    for id in nodes {
        if let Some(node) = graph.nodes.get(id).filter(|node| is_copied(node)) {
            copied.graph.nodes.insert(id.clone(), node.clone());
            copied.graph.layout.extend(graph.layout.get(id).map(|place| (id.clone(), *place)));
        }
    }
    let has = |id: &str| copied.graph.nodes.contains_key(id);
    copied.graph.links = graph.links.iter().filter(|l| has(&l.from.node) && has(&l.to.node)).cloned().collect();
    let Needed { groups, functions } = needed(document, copied.graph.nodes.values());
    (copied.groups, copied.functions) = (groups, functions);
    to_json(&copied)
}

/// The edit that puts copied nodes into a graph, the upper left one at `at`, and the ids that they get. A second surface is left
/// out.
///
/// # Errors
/// The text is no document or has no nodes; a group would come to hold itself.
pub fn paste(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    text: &str,
    at: [f32; 2],
) -> Result<(Edit, Vec<NodeId>), Refusal> {
    let Ok(copied) = from_json(text) else { return refuse("the clipboard holds no nodes") };
    let Some(graph) = document.graph_of(group) else {
        return refuse("the group is not there any more");
    };
    let has_surface = group.is_some() || !surface_nodes(document, library).is_empty();
    let is_pasted = |node: &Node| {
        let is_socket = node.node == GROUP_INPUT || node.node == GROUP_OUTPUT;
        let is_mix = group.is_some() && node.node == SURFACE_MIX;
        !(is_socket || is_mix || has_surface && node.node == SURFACE_NODE)
    };
    let nodes: Vec<(&NodeId, &Node)> = copied.graph.nodes.iter().filter(|(_, node)| is_pasted(node)).collect();
    if nodes.is_empty() {
        return refuse("what was copied has no nodes that can stand here");
    }
    let (mut edits, names) = import(document, &copied.groups, &copied.functions);
    let mut ids: BTreeMap<&str, NodeId> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for (id, _) in &nodes {
        let free = free_name(id, |id| graph.nodes.contains_key(id) || taken.contains(id));
        taken.insert(free.clone());
        ids.insert(id, free);
    }
    let places: Vec<[f32; 2]> = nodes.iter().filter_map(|(id, _)| copied.graph.layout.get(*id).copied()).collect();
    let corner = [0, 1].map(|axis| places.iter().map(|place| place[axis]).fold(f32::INFINITY, f32::min));
    let mut inside = Vec::new();
    for (id, node) in nodes {
        let mut node = node.clone();
        node.node = names.definition(&node.node);
        if let (Some(held), Some(group)) = (group_of(&node.node), group)
            && reaches(document, held, group)
        {
            return refuse("a group cannot hold itself; paste this node elsewhere");
        }
        let new = &ids[id.as_str()];
        inside.push(Edit::AddNode { id: new.clone(), node });
        if let Some(place) = copied.graph.layout.get(id) {
            let position = Some([0, 1].map(|axis| at[axis] + (place[axis] - corner[axis])));
            inside.push(Edit::MoveNode { id: new.clone(), position });
        }
    }
    let moved = |socket: &SocketRef| Some(SocketRef::new(ids.get(socket.node.as_str())?, &socket.socket));
    let links = copied.graph.links.iter().filter_map(|link| Some(Link::new(moved(&link.from)?, moved(&link.to)?)));
    inside.extend(links.map(|link| Edit::AddLink { link }));
    edits.push(in_graph(group, inside));
    Ok((Edit::Many(edits), ids.into_values().collect()))
}

/// Whether a group is another one or holds it, directly or not.
fn reaches(document: &Document, from: &str, to: &str) -> bool {
    let mut open = vec![from];
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if id == to {
            return true;
        }
        if let Some(group) = document.groups.get(id)
            && seen.insert(id)
        {
            open.extend(held(group));
        }
    }
    false
}
