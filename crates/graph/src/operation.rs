//! What an editor does to a document in one step, as pure functions that return the `Edit` to make: a selection becomes a
//! group, a group its nodes, a selection a text and a text nodes, nodes leave a wire or enter it.
//!
//! `group` is the graph that they work on: none for the top level, else the inside of that group. `library` is always the
//! shipped one. Nothing here changes a document, and nothing that is returned leaves a document with more errors than it had.

mod clipboard;
mod collapse;
mod import;
mod rename_socket;
mod ungroup;
mod wire;

use std::collections::BTreeSet;

use crate::document::{Document, Graph, NodeId};
use crate::edit::Edit;
use crate::library::Library;

pub use clipboard::{Pasted, Pick, copy, paste};
pub use collapse::collapse;
pub use import::{export_group, group_as_copied};
pub use rename_socket::{GroupSide, rename_socket};
pub use ungroup::ungroup;
pub use wire::{can_connect, insert_on_link, remove_and_heal};

/// Why something cannot be done. The document is as it was.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

fn refuse<T>(why: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal(why.into()))
}

/// The graph, and the definitions of its nodes.
fn graph_and_library<'d>(
    document: &'d Document,
    library: &Library,
    group: Option<&str>,
) -> Result<(&'d Graph, Library), Refusal> {
    let own = library.of(document);
    match group {
        None => Ok((&document.graph, own)),
        Some(id) => match document.groups.get(id) {
            Some(group) => Ok((&group.graph, own.inside(group))),
            None => refuse(format!("there is no group `{id}`; was it removed?")),
        },
    }
}

/// Edits of the graph as one edit of the document.
fn in_graph(group: Option<&str>, edits: Vec<Edit>) -> Edit {
    match group {
        None => Edit::Many(edits),
        Some(id) => Edit::In { group: id.into(), edit: Box::new(Edit::Many(edits)) },
    }
}

/// The nodes of a selection that the graph has.
fn selected<'g>(graph: &'g Graph, nodes: &[NodeId]) -> Result<BTreeSet<&'g str>, Refusal> {
    let known: BTreeSet<&str> =
        nodes.iter().filter_map(|id| graph.nodes.get_key_value(id)).map(|(id, _)| id.as_str()).collect();
    if known.is_empty() { refuse("no node is selected") } else { Ok(known) }
}
