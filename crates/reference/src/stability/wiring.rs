//! Who feeds whom.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_graph::document::{Document, NodeId, SocketRef};

use crate::stability::trace::{Trace, Value};

/// The links of a document by the node that they lead to, and what of it is traced.
pub(super) struct Wiring<'t> {
    incoming: BTreeMap<&'t NodeId, Vec<&'t SocketRef>>,
    values: BTreeMap<&'t NodeId, Vec<usize>>,
    all: &'t [Value],
}

impl<'t> Wiring<'t> {
    pub(super) fn new(trace: &'t Trace<'_>) -> Wiring<'t> {
        let mut wiring = Wiring { incoming: incoming(&trace.flat), values: BTreeMap::new(), all: &trace.values };
        for (number, value) in trace.values.iter().enumerate() {
            wiring.values.entry(&value.node).or_default().push(number);
        }
        wiring
    }

    /// Whether one of some nodes feeds a node, at any distance.
    pub(super) fn has_source(&self, node: &NodeId, of: &BTreeSet<NodeId>) -> bool {
        let mut open = vec![node];
        let mut seen = BTreeSet::new();
        while let Some(at) = open.pop() {
            for from in self.incoming.get(at).into_iter().flatten() {
                if of.contains(&from.node) {
                    return true;
                }
                if seen.insert(&from.node) {
                    open.push(&from.node);
                }
            }
        }
        false
    }

    /// The values that the nodes are fed, by node; what is not traced (a reroute, a group's border) is looked through.
    pub(super) fn fed(&self) -> BTreeMap<&'t NodeId, Vec<usize>> {
        self.values.keys().map(|node| (*node, self.fed_to(node))).collect()
    }

    fn fed_to(&self, node: &'t NodeId) -> Vec<usize> {
        let mut fed = Vec::new();
        let mut open = vec![node];
        let mut seen = BTreeSet::new();
        while let Some(at) = open.pop() {
            for from in self.incoming.get(at).into_iter().flatten() {
                match self.values.get(&from.node) {
                    Some(values) => {
                        let of_socket = |value: &&usize| self.all[**value].socket == from.socket;
                        let named: Vec<usize> = values.iter().filter(of_socket).copied().collect();
                        // A node's cheaper function for one output gives a plain value.
                        fed.extend(if named.is_empty() { values.clone() } else { named });
                    }
                    None if seen.insert(&from.node) => open.push(&from.node),
                    None => {}
                }
            }
        }
        fed
    }
}

fn incoming(document: &Document) -> BTreeMap<&NodeId, Vec<&SocketRef>> {
    let mut all: BTreeMap<&NodeId, Vec<&SocketRef>> = BTreeMap::new();
    for link in &document.graph.links {
        all.entry(&link.to.node).or_default().push(&link.from);
    }
    all
}
