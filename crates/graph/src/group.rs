//! What the groups of a document are to each other: which use which, in an order in which each comes after those that it
//! uses, and how many nodes each stands for. It says nothing of sockets and types (see `check`).

use std::collections::{BTreeMap, HashMap, HashSet};

use crate::document::{Document, GROUP_OUTPUT, Graph, Group, function_of, group_of};
use crate::library::custom::read_function;
use crate::wiring::Wiring;

/// Deepest nesting of groups.
pub const MAX_GROUP_DEPTH: usize = 32;

/// Groups that hold each other in a ring: each holds the next, the last one the first.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the groups {} hold each other in a ring; a group cannot hold itself: remove one of them from the next", groups.join(", "))]
pub struct Recursion {
    /// Their ids, at least one.
    pub groups: Vec<String>,
}

/// What is known of a group that does not hold itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Extent {
    /// The nodes that reach its outputs, in order of id; its output nodes among them.
    pub live: Vec<String>,
    /// How many nodes one use of it becomes: itself, its live nodes, and theirs. Saturates.
    pub nodes: usize,
    /// How many groups lie in each other: 1 when it holds none.
    pub depth: usize,
    /// Turns of loops and calls that the document's own functions take in one use of it, as
    /// [`CustomFunction::work`](crate::library::custom::CustomFunction::work) counts them. Saturates.
    pub work: u64,
}

/// The extents of the groups of a document by id, and the groups that hold themselves.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Extents {
    /// The sound ones.
    pub groups: BTreeMap<String, Extent>,
    /// Rings of groups that hold themselves; of very many the first.
    pub rings: Vec<Recursion>,
    /// The work of the document's own functions that are sound, by id.
    pub functions: BTreeMap<String, u64>,
}

impl Extents {
    /// The work of a node that is one of the document's own functions, or of a group; 0 for others.
    pub(crate) fn work(&self, graph: &Graph, node: &str) -> u64 {
        let Some(kind) = graph.nodes.get(node).map(|node| node.node.as_str()) else { return 0 };
        let own = function_of(kind).and_then(|id| self.functions.get(id)).copied();
        own.or_else(|| Some(self.groups.get(group_of(kind)?)?.work)).unwrap_or(0)
    }
}

/// The id of the node that takes a group's outputs, if it has one: the first in order of id.
pub fn output_node(group: &Group) -> Option<&str> {
    nodes_of(&group.graph, GROUP_OUTPUT).next()
}

fn nodes_of<'g>(graph: &'g Graph, definition: &str) -> impl Iterator<Item = &'g str> {
    graph.nodes.iter().filter(move |(_, node)| node.node == definition).map(|(id, _)| id.as_str())
}

/// The nodes that some nodes of a graph are made of, in order of id; all nodes where they feed each other in a ring.
pub fn live_nodes(graph: &Graph, roots: &[&str]) -> Vec<String> {
    let mut live: Vec<String> = match Wiring::new(graph).order(roots) {
        Ok(order) => order.into_iter().map(str::to_string).collect(),
        Err(_) => graph.nodes.keys().cloned().collect(),
    };
    live.sort_unstable();
    live
}

/// Measures the groups of a document. Iterative, and linear in the document, however often a group is used.
pub fn extents(document: &Document) -> Extents {
    let sound = |(id, text): (&String, &String)| Some((id.clone(), read_function(id, text).ok()?.work));
    let functions = document.functions.iter().filter_map(sound).collect();
    let mut extents = Extents { functions, ..Extents::default() };
    let live: BTreeMap<&str, Vec<String>> = document
        .groups
        .iter()
        .map(|(id, group)| {
            let roots: Vec<&str> = output_node(group).into_iter().collect();
            (id.as_str(), live_nodes(&group.graph, &roots))
        })
        .collect();
    // Only what is live counts, for rings as for sizes: what does not reach an output is left out.
    let used = |id: &str| {
        let graph = document.groups.get(id).map(|group| &group.graph);
        let kind = move |node: &String| graph.and_then(|graph| graph.nodes.get(node)).and_then(|n| group_of(&n.node));
        live.get(id).into_iter().flatten().filter_map(kind)
    };
    let mut unsound: HashSet<&str> = HashSet::new();
    for root in document.groups.keys() {
        let mut path: Vec<(&str, Vec<&str>)> = Vec::new();
        let mut place: HashMap<&str, usize> = HashMap::new();
        let open = |id| (id, used(id).filter(|id| document.groups.contains_key(*id)).collect::<Vec<_>>());
        let mut next = Some(root.as_str());
        while let Some(id) = next.or_else(|| path.last().map(|(id, _)| *id)) {
            let is_done = extents.groups.contains_key(id) || unsound.contains(id);
            if next.is_some() && !is_done {
                if let Some(start) = place.get(id) {
                    extents.rings.extend(ring(path[*start..].iter().map(|(id, _)| *id), &extents.rings));
                } else {
                    place.insert(id, path.len());
                    path.push(open(id));
                }
            }
            next = path.last_mut().and_then(|(_, waiting)| waiting.pop());
            if next.is_some() {
                continue;
            }
            let Some((id, _)) = path.pop() else { break };
            place.remove(id);
            // What is on a ring, or holds what is, has a part that is not done.
            let parts = used(id).filter(|id| document.groups.contains_key(*id)).map(|id| extents.groups.get(id));
            match parts.collect::<Option<Vec<&Extent>>>() {
                Some(parts) => {
                    let more = parts.iter().fold(0usize, |sum, part| sum.saturating_add(part.nodes - 1));
                    let depth = 1 + parts.iter().map(|part| part.depth).max().unwrap_or(0);
                    let nodes = more.saturating_add(1 + live[id].len());
                    let graph = &document.groups[id].graph;
                    let each = live[id].iter().map(|node| extents.work(graph, node));
                    let work = each.fold(0u64, u64::saturating_add);
                    extents.groups.insert(id.into(), Extent { live: live[id].clone(), nodes, depth, work });
                }
                None => {
                    unsound.insert(id);
                }
            }
        }
    }
    extents
}

/// A ring as it is told, beginning with its first id, unless it is known or there are many already.
fn ring<'g>(groups: impl Iterator<Item = &'g str>, known: &[Recursion]) -> Option<Recursion> {
    const MAX_RINGS: usize = 16;
    let mut groups: Vec<String> = groups.map(str::to_string).collect();
    let first = groups.iter().enumerate().min_by_key(|(_, id)| id.as_str()).map_or(0, |(i, _)| i);
    groups.rotate_left(first);
    let ring = Recursion { groups };
    (known.len() < MAX_RINGS && !known.contains(&ring)).then_some(ring)
}
