//! What the canvas does to a document, as edits. Nothing here changes it, and nothing here knows the screen.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_graph::document::{Document, Graph, Link, Node, NodeId, SURFACE_NODE, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::{from_json, to_json};
use halfvector_graph::library::Library;
use halfvector_graph::resolve::{Types, resolve_types};

use super::fit::fits;

/// Nodes that come into a document, with their places and the edits that bring them.
#[derive(Debug, Default)]
pub(super) struct Arrival {
    pub(super) edits: Vec<Edit>,
    pub(super) ids: Vec<NodeId>,
}

/// Adds a node of a definition at a place.
pub(super) fn add(graph: &Graph, definition: &str, place: [f32; 2]) -> Arrival {
    let base = definition.rsplit('/').next().unwrap_or(definition);
    let id = graph.free_id(base);
    let edits = vec![
        Edit::AddNode { id: id.clone(), node: Node::new(definition) },
        Edit::MoveNode { id: id.clone(), position: Some(place) },
    ];
    Arrival { edits, ids: vec![id] }
}

/// Removes nodes. With `heals`, what fed them feeds what they fed, where the types allow it.
pub(super) fn remove(graph: &Graph, library: &Library, nodes: &BTreeSet<NodeId>, heals: bool) -> Vec<Edit> {
    let mut edits: Vec<Edit> = nodes.iter().map(|id| Edit::RemoveNode { id: id.clone() }).collect();
    if heals {
        let types = resolve_types(graph, library);
        let ends = graph.links.iter().filter(|link| nodes.contains(&link.from.node) && !nodes.contains(&link.to.node));
        for link in ends {
            if let Some(from) = source(graph, &types, nodes, link) {
                edits.push(Edit::AddLink { link: Link::new(from, link.to.clone()) });
            }
        }
    }
    edits
}

/// What feeds a link in the end when nodes are taken out of the way: of each the first input that is fed and fits.
fn source(graph: &Graph, types: &Types, nodes: &BTreeSet<NodeId>, link: &Link) -> Option<SocketRef> {
    let wanted = types.get(&link.to.node)?.input(&link.to.socket)?;
    let mut from = &link.from;
    // A ring among them would lead on for ever.
    for _ in 0..=nodes.len() {
        if !nodes.contains(&from.node) {
            return Some(from.clone());
        }
        let def = types.get(&from.node)?.def;
        from = def.inputs.iter().find_map(|input| {
            let from = graph.incoming(&SocketRef::new(&from.node, &input.name))?;
            fits(types.get(&from.node)?.output(&from.socket)?, wanted).then_some(from)
        })?;
    }
    None
}

/// Puts a node into a wire: what fed the wire's input feeds the node, and the node feeds the input. None when its
/// sockets do not fit. The node need not be there yet.
pub(super) fn insert(graph: &Graph, library: &Library, node: &str, definition: &str, link: &Link) -> Option<Vec<Edit>> {
    let types = resolve_types(graph, library);
    let def = library.get(definition)?;
    let given = types.get(&link.from.node)?.output(&link.from.socket)?;
    let wanted = types.get(&link.to.node)?.input(&link.to.socket)?;
    let (input, output) = super::fit::through(def, given, wanted)?;
    Some(vec![
        Edit::AddLink { link: Link::new(link.from.clone(), SocketRef::new(node, input)) },
        Edit::AddLink { link: Link::new(SocketRef::new(node, output), link.to.clone()) },
    ])
}

/// Nodes as the text of a document that holds nothing else: what the clipboard gets.
pub(super) fn copied(
    document: &Document,
    graph: &Graph,
    nodes: &BTreeSet<NodeId>,
    places: &BTreeMap<NodeId, [f32; 2]>,
) -> String {
    let mut part = Document::new(&document.name);
    part.graph.nodes =
        graph.nodes.iter().filter(|(id, _)| nodes.contains(*id)).map(|(id, node)| (id.clone(), node.clone())).collect();
    let inner = |link: &&Link| nodes.contains(&link.from.node) && nodes.contains(&link.to.node);
    part.graph.links = graph.links.iter().filter(inner).cloned().collect();
    part.graph.layout =
        places.iter().filter(|(id, _)| nodes.contains(*id)).map(|(id, place)| (id.clone(), *place)).collect();
    to_json(&part)
}

/// The nodes of a document's text, put so that the middle of them comes to a place, or moved by an offset.
///
/// # Errors
/// When the text is no document, or one without nodes that can come in.
pub(super) fn pasted(graph: &Graph, text: &str, to: Where) -> Result<Arrival, String> {
    let part = from_json(text).map_err(|error| format!("the clipboard holds no nodes: {error}"))?.graph;
    let mut taken = graph.clone();
    let mut ids = BTreeMap::new();
    for (id, node) in &part.nodes {
        // A material has one surface.
        if node.node == SURFACE_NODE && graph.nodes.values().any(|other| other.node == SURFACE_NODE) {
            continue;
        }
        let free = taken.free_id(without_number(id));
        taken.nodes.insert(free.clone(), Node::new(&node.node));
        ids.insert(id.clone(), free);
    }
    if ids.is_empty() {
        return Err("there is nothing in the clipboard that can be pasted: a material has one surface".into());
    }
    let shift = match to {
        Where::Shifted(by) => by,
        Where::Around(place) => {
            let corners = part.layout.iter().filter(|(id, _)| ids.contains_key(*id)).map(|(_, place)| *place);
            let start = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
            let (low, high) = corners.fold(start, |(low, high), p| {
                ([low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])])
            });
            let middle = |i: usize| if low[i] <= high[i] { (low[i] + high[i]) / 2.0 } else { 0.0 };
            [place[0] - middle(0), place[1] - middle(1)]
        }
    };
    let mut edits = Vec::new();
    for (old, id) in &ids {
        edits.push(Edit::AddNode { id: id.clone(), node: part.nodes[old].clone() });
        let place = part.layout.get(old).copied().unwrap_or_default();
        edits.push(Edit::MoveNode { id: id.clone(), position: Some([place[0] + shift[0], place[1] + shift[1]]) });
    }
    for link in &part.links {
        let end = |socket: &SocketRef| ids.get(&socket.node).map(|id| SocketRef::new(id, &socket.socket));
        if let (Some(from), Some(to)) = (end(&link.from), end(&link.to)) {
            edits.push(Edit::AddLink { link: Link::new(from, to) });
        }
    }
    Ok(Arrival { edits, ids: ids.into_values().collect() })
}

/// Where pasted nodes come to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Where {
    /// Their middle here.
    Around([f32; 2]),
    /// Away from where they were.
    Shifted([f32; 2]),
}

/// `mix` of `mix_12`, so that copies of copies count on.
fn without_number(id: &str) -> &str {
    match id.rsplit_once('_') {
        Some((base, number)) if !base.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => base,
        _ => id,
    }
}
