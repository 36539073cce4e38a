//! What the canvas does to a document beyond the graph's own operations, as edits. Nothing here changes it, and nothing here
//! knows the screen.

use halfvector_graph::document::{Graph, Link, Node, NodeId};
use halfvector_graph::edit::{Edit, apply};
use halfvector_graph::library::Library;
use halfvector_graph::operation::insert_on_link;

use crate::session::Session;

/// Nodes that come into a graph, with their places and the edits of the document that bring them.
#[derive(Debug, Default)]
pub(super) struct Arrival {
    pub(super) edits: Vec<Edit>,
    pub(super) ids: Vec<NodeId>,
}

impl Arrival {
    /// What an edit of the document brings into the graph that is worked on.
    pub(super) fn of(group: Option<&str>, edit: Edit) -> Arrival {
        let mut ids = Vec::new();
        added(&edit, None, group, &mut ids);
        Arrival { edits: vec![edit], ids }
    }
}

/// The nodes that an edit adds to the graph of `group`; `inside` is the one that it works on.
fn added(edit: &Edit, inside: Option<&str>, group: Option<&str>, ids: &mut Vec<NodeId>) {
    match edit {
        Edit::AddNode { id, .. } if inside == group => ids.push(id.clone()),
        Edit::In { group: inner, edit } => added(edit, Some(inner), group, ids),
        Edit::Many(edits) => edits.iter().for_each(|edit| added(edit, inside, group, ids)),
        _ => {}
    }
}

/// Adds a node of a definition at a place of the graph that is worked on.
pub(super) fn add(session: &Session, definition: &str, place: [f32; 2]) -> Arrival {
    let graph: &Graph = session.graph();
    let base = definition.rsplit('/').next().unwrap_or(definition);
    let id = graph.free_id(base);
    let node = Edit::AddNode { id: id.clone(), node: Node::new(definition) };
    let place = Edit::MoveNode { id: id.clone(), position: Some(place) };
    Arrival { edits: vec![session.here(Edit::Many(vec![node, place]))], ids: vec![id] }
}

/// Puts a node that arrives into a wire, too. An arrival that does not fit there stays beside it.
pub(super) fn put_into(session: &Session, arrival: &mut Arrival, link: &Link) -> bool {
    let mut with = (**session.document()).clone();
    if apply(&mut with, &Edit::Many(arrival.edits.clone())).is_err() {
        return false;
    }
    let into = arrival.ids.first().map(|id| insert_on_link(&with, Library::standard(), session.group(), link, id));
    match into {
        Some(Ok(edit)) => {
            arrival.edits.push(edit);
            true
        }
        _ => false,
    }
}
