//! Groups taken apart: a document in which every node is one of the library.
//!
//! The node `rust` of a group becomes a node that hands on the group's inputs, under its own id, so that values and parameters
//! set on it are found where they were. The group's inside follows, with ids that are paths: `rust/noise` is the node `noise`
//! of the group that `rust` stands for; labels are paths too, "Rust › Noise". Only what reaches the surface is taken
//! along. Nothing here reads positions.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::check::{MAX_LIVE_NODES, node_label, surface_nodes};
use crate::document::{Document, GROUP_INPUT, GROUP_OUTPUT, Graph, Group, Link, Node, SocketRef, group_of};
use crate::group::{Extents, MAX_GROUP_DEPTH, Recursion, extents, live_nodes, output_node};
use crate::library::{Library, own};

/// A document without groups.
#[derive(Clone, Debug)]
pub struct Flat<'d> {
    /// The document itself when it used no group.
    pub document: Cow<'d, Document>,
    /// The definitions of its nodes.
    pub library: Library,
}

/// Why a document's groups cannot be taken apart.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FlattenError {
    /// Groups hold each other.
    #[error(transparent)]
    Recursion(#[from] Recursion),
    /// There is no such group.
    #[error("there is no group `{0}` in this document")]
    NoGroup(String),
    /// Groups lie too deep in each other.
    #[error("groups lie more than {MAX_GROUP_DEPTH} deep in each other; take some apart")]
    TooDeep,
    /// More nodes than any driver takes.
    #[error(
        "with its groups taken apart {0} nodes reach the surface; no driver takes a shader of more than {MAX_LIVE_NODES}: use fewer groups, or bake parts into pictures"
    )]
    TooMany(usize),
}

/// How many nodes reach the surface when all groups are taken apart; saturates.
///
/// # Errors
/// As for [`flatten`], but for the number itself.
pub(crate) fn count(document: &Document, live: &[String], extents: &Extents) -> Result<usize, FlattenError> {
    let mut nodes = live.len();
    let mut depth = 0;
    for group in live.iter().filter_map(|id| group_of(&document.graph.nodes.get(id)?.node)) {
        let Some(extent) = extents.groups.get(group) else {
            return Err(match extents.rings.first() {
                // It lies on a ring, or holds one that does.
                Some(ring) if document.groups.contains_key(group) => ring.clone().into(),
                _ => FlattenError::NoGroup(group.into()),
            });
        };
        nodes = nodes.saturating_add(extent.nodes - 1);
        depth = depth.max(extent.depth);
    }
    if depth > MAX_GROUP_DEPTH { Err(FlattenError::TooDeep) } else { Ok(nodes) }
}

/// Takes all groups of a document apart. `library` is the shipped one.
///
/// # Errors
/// Groups that hold themselves, are missing, lie too deep or become too many nodes: before anything is copied.
pub fn flatten<'d>(document: &'d Document, library: &Library) -> Result<Flat<'d>, FlattenError> {
    let own = library.of(document);
    if !document.graph.nodes.values().any(|node| group_of(&node.node).is_some()) {
        return Ok(Flat { document: Cow::Borrowed(document), library: own });
    }
    let surfaces = surface_nodes(document, library);
    let live = live_nodes(&document.graph, &surfaces);
    let extents = extents(document);
    let nodes = count(document, &live, &extents)?;
    if nodes > MAX_LIVE_NODES {
        return Err(FlattenError::TooMany(nodes));
    }
    let mut flat = Flattening { document, library: &own, graph: Graph::default() };
    let mut waiting = vec![Part { group: None, path: String::new(), label: String::new() }];
    while let Some(part) = waiting.pop() {
        let live = part.group.and_then(|id| extents.groups.get(id)).map_or(&live, |extent| &extent.live);
        flat.part(&part, live, &mut waiting)?;
    }
    let graph = flat.graph;
    let defs = document.groups.iter().flat_map(|(id, group)| [own::enter(id, group), own::leave(id, group)]);
    let library = own.with(defs);
    let document = Document {
        version: document.version,
        name: document.name.clone(),
        graph,
        groups: Default::default(),
        functions: document.functions.clone(),
        parameters: document.parameters.clone(),
        surface: document.surface,
        unknown: document.unknown.clone(),
    };
    Ok(Flat { document: Cow::Owned(document), library })
}

/// One use of a group, or the top level.
struct Part<'d> {
    group: Option<&'d str>,
    /// Of the node that uses it; empty at the top.
    path: String,
    /// The node's label, with those that it lies in; empty at the top.
    label: String,
}

struct Flattening<'d, 'l> {
    document: &'d Document,
    library: &'l Library,
    graph: Graph,
}

impl<'d> Flattening<'d, '_> {
    fn group(&self, id: &str) -> Result<&'d Group, FlattenError> {
        self.document.groups.get(id).ok_or_else(|| FlattenError::NoGroup(id.into()))
    }

    /// Copies the live nodes of a graph and the links between them; the groups among them go to `waiting`.
    fn part(&mut self, part: &Part<'d>, live: &[String], waiting: &mut Vec<Part<'d>>) -> Result<(), FlattenError> {
        let graph: &'d Graph = match part.group {
            Some(id) => &self.group(id)?.graph,
            None => &self.document.graph,
        };
        let id_of = |id: &str| if part.path.is_empty() { id.to_string() } else { format!("{}/{id}", part.path) };
        // Nodes that are replaced: by the node whose outputs stand for theirs. A group without outputs has none.
        let mut sources: HashMap<&str, Option<String>> = HashMap::new();
        for id in live {
            let Some((id, node)) = graph.nodes.get_key_value(id) else { continue };
            let mut label = node.label.clone();
            if !part.label.is_empty() {
                let own = node_label(graph, self.library, id);
                label = Some(format!("{} \u{203a} {own}", part.label));
            }
            let kind = match (node.node.as_str(), group_of(&node.node), part.group) {
                (GROUP_INPUT, _, Some(_)) => {
                    sources.insert(id, Some(part.path.clone()));
                    continue;
                }
                (GROUP_OUTPUT, _, Some(group)) => format!("leave/{group}"),
                (_, Some(group), _) => {
                    let inside = self.group(group)?;
                    sources.insert(id, output_node(inside).map(|output| format!("{}/{output}", id_of(id))));
                    let path_label = label.clone().unwrap_or_else(|| node_label(graph, self.library, id));
                    waiting.push(Part { group: Some(group), path: id_of(id), label: path_label });
                    format!("enter/{group}")
                }
                (kind, None, _) => kind.to_string(),
            };
            let copy = Node { node: kind, label, values: node.values.clone(), unknown: node.unknown.clone() };
            self.graph.nodes.insert(id_of(id), copy);
        }
        for link in &graph.links {
            if live.binary_search(&link.to.node).is_err() {
                continue;
            }
            let from = match sources.get(link.from.node.as_str()) {
                Some(Some(node)) => node.clone(),
                Some(None) => continue,
                None => id_of(&link.from.node),
            };
            self.graph.links.push(Link {
                from: SocketRef::new(&from, &link.from.socket),
                to: SocketRef::new(&id_of(&link.to.node), &link.to.socket),
            });
        }
        Ok(())
    }
}

/// A node of a document by the path that [`flatten`] gives it, and the group that it stands in.
pub fn find<'d>(document: &'d Document, path: &str) -> Option<(Option<&'d str>, &'d str, &'d Node)> {
    let (mut group, mut graph) = (None, &document.graph);
    let mut rest = path;
    while let Some((id, inner)) = rest.split_once('/') {
        let (id, _) = document.groups.get_key_value(group_of(&graph.nodes.get(id)?.node)?)?;
        group = Some(id.as_str());
        graph = &document.groups[id].graph;
        rest = inner;
    }
    let (id, node) = graph.nodes.get_key_value(rest)?;
    Some((group, id, node))
}
