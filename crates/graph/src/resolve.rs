//! Types of all sockets of a graph: the one place where `T` of a generic node is decided.
//!
//! It reports nothing: links that do not fit are found by `check`, which compares the types given here.

use std::collections::HashMap;

use crate::document::Graph;
use crate::library::Library;
use crate::node_def::NodeDef;
use crate::value::{SocketType, Type};
use crate::wiring::Wiring;

/// The types of the known nodes of a graph.
pub struct Types<'a> {
    nodes: HashMap<&'a str, NodeTypes<'a>>,
}

/// The types of a node's sockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeTypes<'l> {
    /// The node's definition.
    pub def: &'l NodeDef,
    /// What `T` is; none for a node that is not generic.
    pub generic: Option<Type>,
}

impl NodeTypes<'_> {
    /// The type of an input, never [`SocketType::Generic`]; none when there is no such input.
    pub fn input(&self, name: &str) -> Option<SocketType> {
        self.def.inputs.iter().find(|input| input.name == name).map(|input| self.resolved(input.ty))
    }

    /// The type of an output, never [`SocketType::Generic`]; none when there is no such output.
    pub fn output(&self, name: &str) -> Option<SocketType> {
        self.def.outputs.iter().find(|output| output.name == name).map(|output| self.resolved(output.ty))
    }

    /// A socket's type with `T` replaced.
    pub fn resolved(&self, ty: SocketType) -> SocketType {
        match (ty, self.generic) {
            (SocketType::Generic, Some(t)) => SocketType::Value(t),
            _ => ty,
        }
    }
}

impl<'a> Types<'a> {
    /// The types of a node; none when the graph has no such node or the library no such definition.
    pub fn get(&self, node: &str) -> Option<&NodeTypes<'a>> {
        self.nodes.get(node)
    }
}

/// The types of all sockets. `T` of a node is the narrowest of its types that every generic input can be converted to: the
/// connected ones by what feeds them, the others by the value set on them (one number fits all). When there is none, it is
/// the widest that comes in, and some input does not fit. With nothing connected or set it is the narrowest.
pub fn resolve_types<'a>(graph: &'a Graph, library: &'a Library) -> Types<'a> {
    resolve_in(graph, library, &Wiring::new(graph))
}

/// [`resolve_types`] for a caller that has the wiring already.
pub fn resolve_in<'a>(graph: &'a Graph, library: &'a Library, wiring: &Wiring<'a>) -> Types<'a> {
    resolve_some(graph, library, wiring, &wiring.order_of_all())
}

/// [`resolve_types`] of some nodes, each of which comes after all that feed it.
pub fn resolve_some<'a>(graph: &'a Graph, library: &'a Library, wiring: &Wiring<'a>, order: &[&'a str]) -> Types<'a> {
    let mut types = Types { nodes: HashMap::with_capacity(order.len()) };
    // A document has many nodes of few definitions.
    let mut kinds: HashMap<&str, Option<&NodeDef>> = HashMap::new();
    for id in order.iter().copied() {
        let Some(node) = graph.nodes.get(id) else { continue };
        let Some(def) = *kinds.entry(&node.node).or_insert_with(|| library.get(&node.node)) else { continue };
        let generic = (!def.generic.is_empty()).then(|| {
            let incoming: Vec<Type> = def
                .inputs
                .iter()
                .filter(|input| input.ty == SocketType::Generic)
                .filter_map(|input| incoming_type(graph, wiring, &types, id, &input.name))
                .collect();
            generic_type(&def.generic, &incoming)
        });
        types.nodes.insert(id, NodeTypes { def, generic });
    }
    types
}

/// The type that comes into an input by link or by value.
fn incoming_type(graph: &Graph, wiring: &Wiring, types: &Types, node: &str, input: &str) -> Option<Type> {
    match wiring.incoming(node, input) {
        Some(from) => match types.get(&from.node)?.output(&from.socket)? {
            SocketType::Value(ty) => Some(ty),
            _ => None,
        },
        None => graph.nodes.get(node)?.values.get(input)?.ty(),
    }
}

fn generic_type(candidates: &[Type], incoming: &[Type]) -> Type {
    let fits = |t: &Type| incoming.iter().all(|ty| ty.converts_to(*t));
    let widest = || incoming.iter().copied().filter(|ty| candidates.contains(ty)).max_by_key(|ty| ty.components());
    candidates.iter().copied().find(fits).or_else(widest).unwrap_or(candidates[0])
}
