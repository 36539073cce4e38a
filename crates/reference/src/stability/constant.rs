//! Nodes that have no inputs but constants: a shader has their results as numbers, computed in f32 when it is made.

use std::collections::BTreeSet;

use halfvector_graph::document::NodeId;
use halfvector_graph::node_def::{Argument, Default, NodeDef};
use halfvector_graph::value::SocketType;

use crate::stability::trace::Trace;

/// Those of a material, but for surfaces and nodes that only hand on what they get.
pub(super) fn nodes(trace: &Trace<'_>) -> BTreeSet<NodeId> {
    let document = &trace.flat;
    let mut varying = BTreeSet::new();
    let mut open: Vec<&NodeId> = Vec::new();
    for (id, node) in &document.graph.nodes {
        let Some(def) = trace.library.get(&node.node) else { continue };
        let exposed = document.parameters.iter().any(|parameter| parameter.socket.node == *id);
        let reads = |input: &halfvector_graph::node_def::Input| match input.default {
            Default::Value(_) => false,
            Default::Context(_) => {
                !node.values.contains_key(&input.name)
                    && !document.graph.links.iter().any(|link| link.to.node == *id && link.to.socket == input.name)
            }
            Default::Image(_) | Default::Surface => true,
        };
        if exposed || has_frame(def) || def.inputs.iter().any(reads) {
            varying.insert(id.clone());
            open.push(id);
        }
    }
    while let Some(at) = open.pop() {
        for link in document.graph.links.iter().filter(|link| link.from.node == *at) {
            if varying.insert(link.to.node.clone()) {
                open.push(&link.to.node);
            }
        }
    }
    let computes = |def: &NodeDef| !def.forwards && !gives_surface(def);
    let is_constant = |(id, node): (&NodeId, &halfvector_graph::document::Node)| {
        let computes = trace.library.get(&node.node).is_some_and(computes);
        (computes && !varying.contains(id)).then(|| id.clone())
    };
    document.graph.nodes.iter().filter_map(is_constant).collect()
}

/// Whether a node makes or mixes surfaces.
pub(super) fn gives_surface(def: &NodeDef) -> bool {
    def.outputs.iter().any(|output| output.ty == SocketType::Surface)
}

fn has_frame(def: &NodeDef) -> bool {
    def.function.arguments.iter().any(|argument| matches!(argument, Argument::Frame(_)))
}
