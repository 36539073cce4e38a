//! Copy and paste: a selection as the text of a document, with the groups and functions that it needs.

use std::collections::{BTreeMap, BTreeSet};

use super::import::{Needed, held, import, needed};
use super::{Refusal, in_graph, refuse};
use crate::check::surface_nodes;
use crate::document::{
    Comment, Document, Frame, GROUP_INPUT, GROUP_OUTPUT, Link, Node, NodeId, Rect, SURFACE_MIX, SURFACE_NODE,
    SocketRef, free_name, group_of,
};
use crate::edit::Edit;
use crate::file::{from_json, to_json};
use crate::library::Library;

/// What is picked out of a graph, by ids.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pick {
    /// Nodes.
    pub nodes: Vec<NodeId>,
    /// Frames; what lies in them is not meant with them.
    pub frames: Vec<String>,
    /// Comments.
    pub comments: Vec<String>,
}

impl Pick {
    /// Nodes alone.
    pub fn nodes(nodes: impl IntoIterator<Item = NodeId>) -> Pick {
        Pick { nodes: nodes.into_iter().collect(), ..Pick::default() }
    }

    /// Whether nothing is picked.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.frames.is_empty() && self.comments.is_empty()
    }
}

/// What is picked of a graph as text: nodes with the links among them, their places and the groups and functions that they need; frames and
/// comments. Parameters stay with the material, the nodes of a group's sockets with the group.
pub fn copy(document: &Document, group: Option<&str>, pick: &Pick) -> String {
    let mut copied = Document::new("");
    let Some(graph) = document.graph_of(group) else { return to_json(&copied) };
    let is_copied = |node: &Node| node.node != GROUP_INPUT && node.node != GROUP_OUTPUT;
    for id in &pick.nodes {
        if let Some(node) = graph.nodes.get(id).filter(|node| is_copied(node)) {
            copied.graph.nodes.insert(id.clone(), node.clone());
            copied.graph.layout.extend(graph.layout.get(id).map(|place| (id.clone(), *place)));
        }
    }
    let frames = pick.frames.iter().filter_map(|id| Some((id.clone(), graph.frames.get(id)?.clone())));
    copied.graph.frames = frames.collect();
    let comments = pick.comments.iter().filter_map(|id| Some((id.clone(), graph.comments.get(id)?.clone())));
    copied.graph.comments = comments.collect();
    let has = |id: &str| copied.graph.nodes.contains_key(id);
    copied.graph.links = graph.links.iter().filter(|l| has(&l.from.node) && has(&l.to.node)).cloned().collect();
    let Needed { groups, functions } = needed(document, copied.graph.nodes.values());
    (copied.groups, copied.functions) = (groups, functions);
    to_json(&copied)
}

/// The edit that puts what was copied into a graph, its upper left corner at `at`, and the ids that it gets there. A second surface is left
/// out.
///
/// # Errors
/// The text is no document or has nothing that can stand here; a group would come to hold itself.
pub fn paste(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    text: &str,
    at: [f32; 2],
) -> Result<(Edit, Pick), Refusal> {
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
    let (frames, comments) = (&copied.graph.frames, &copied.graph.comments);
    if nodes.is_empty() && frames.is_empty() && comments.is_empty() {
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
    let mut places: Vec<[f32; 2]> = nodes.iter().filter_map(|(id, _)| copied.graph.layout.get(*id).copied()).collect();
    places.extend(frames.values().map(|frame| frame.rect.position));
    places.extend(comments.values().map(|comment| comment.rect.position));
    let corner = [0, 1].map(|axis| places.iter().map(|place| place[axis]).fold(f32::INFINITY, f32::min));
    let moved = |place: [f32; 2]| [0, 1].map(|axis| at[axis] + (place[axis] - corner[axis]));
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
            inside.push(Edit::MoveNode { id: new.clone(), position: Some(moved(*place)) });
        }
    }
    let named = |socket: &SocketRef| Some(SocketRef::new(ids.get(socket.node.as_str())?, &socket.socket));
    let links = copied.graph.links.iter().filter_map(|link| Some(Link::new(named(&link.from)?, named(&link.to)?)));
    inside.extend(links.map(|link| Edit::AddLink { link }));
    let mut pasted = Pick::nodes(ids.into_values());
    for (id, frame) in frames {
        let id = free_name(id, |id| graph.frames.contains_key(id) || pasted.frames.iter().any(|one| one == id));
        pasted.frames.push(id.clone());
        let rect = Rect { position: moved(frame.rect.position), ..frame.rect };
        inside.push(Edit::AddFrame { id, frame: Frame { rect, ..frame.clone() } });
    }
    for (id, comment) in comments {
        let id = free_name(id, |id| graph.comments.contains_key(id) || pasted.comments.iter().any(|one| one == id));
        pasted.comments.push(id.clone());
        let rect = Rect { position: moved(comment.rect.position), ..comment.rect };
        inside.push(Edit::AddComment { id, comment: Comment { rect, ..comment.clone() } });
    }
    edits.push(in_graph(group, inside));
    Ok((Edit::Many(edits), pasted))
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
