//! What a document may hold at most, counted before anything is built of it: what is larger comes from a program that went wrong, or
//! from somebody who means harm, and is told as such at once.

use super::{MAX_LIVE_NODES, Problem, Severity};
use crate::document::Document;

/// Most nodes of a document, with those in its groups and those that reach nothing.
pub const MAX_NODES: usize = 50_000;
/// Most links of a document, with those in its groups.
pub const MAX_LINKS: usize = 200_000;
/// Most groups of a document.
pub const MAX_GROUPS: usize = 1000;
/// Most inputs of a group, and most outputs.
pub const MAX_GROUP_SOCKETS: usize = 128;
/// Most functions of a document: each is parsed with what it calls of the library.
pub const MAX_FUNCTIONS: usize = 256;
/// Most parameters of a material: a uniform buffer that every device has holds 16 KiB.
pub const MAX_PARAMETERS: usize = 1024;

/// What there is too much of.
pub(super) fn check(document: &Document) -> Vec<Problem> {
    let graphs = || document.groups.values().map(|group| &group.graph).chain([&document.graph]);
    let nodes: usize = graphs().map(|graph| graph.nodes.len()).sum();
    let links: usize = graphs().map(|graph| graph.links.len()).sum();
    let mut problems = Vec::new();
    let mut told = |group: Option<(&str, &str)>, message: String| {
        let (group, label) = group.unzip();
        problems.push(Problem {
            severity: Severity::Error,
            group: group.map(str::to_string),
            node: None,
            node_label: label.map(str::to_string),
            socket: None,
            message,
        });
    };
    if nodes > MAX_NODES {
        let message = format!(
            "the document has {nodes} nodes; at most {MAX_NODES} are read, of which {MAX_LIVE_NODES} may reach the surface: remove what \
             reaches nothing, or bake parts into pictures"
        );
        told(None, message);
    }
    for (count, most, what, remedy) in [
        (links, MAX_LINKS, "links", "remove those that lead nowhere"),
        (document.groups.len(), MAX_GROUPS, "groups", "remove those that nothing uses"),
        (document.functions.len(), MAX_FUNCTIONS, "functions", "remove those that nothing uses"),
        (document.parameters.len(), MAX_PARAMETERS, "parameters", "offer fewer"),
    ] {
        if count > most {
            told(None, format!("the document has {count} {what}; at most {most} are read: {remedy}"));
        }
    }
    for (id, group) in document.groups.iter().take(MAX_GROUPS) {
        let interface = &group.interface;
        let label = if interface.label.is_empty() { id } else { &interface.label };
        for (count, what) in [(interface.inputs.len(), "inputs"), (interface.outputs.len(), "outputs")] {
            if count > MAX_GROUP_SOCKETS {
                let message = format!(
                    "the group has {count} {what}; at most {MAX_GROUP_SOCKETS} are read: put numbers together into vectors"
                );
                told(Some((id, label)), message);
            }
        }
    }
    problems
}
