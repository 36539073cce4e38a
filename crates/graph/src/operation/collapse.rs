//! A selection becomes a group.

use std::collections::{BTreeMap, BTreeSet};

use super::{Refusal, graph_and_library, in_graph, refuse, selected};
use crate::check::node_label;
use crate::document::{
    Document, GROUP_INPUT, GROUP_OUTPUT, Graph, Group, GroupInput, GroupOutput, Interface, Link, Node, NodeId,
    Parameter, SocketRef, free_name, is_group_id,
};
use crate::edit::Edit;
use crate::library::Library;
use crate::node_def::{Default, Input};
use crate::resolve::{Types, resolve_in};
use crate::value::{SocketType, Value};
use crate::wiring::Wiring;

/// How far the nodes of a group's sockets stand beside its nodes.
const MARGIN: f32 = 240.0;

/// Makes a group of the selected nodes and puts one node in their place. What comes in over a wire becomes an input of the group, each
/// source once; what goes out an output; a parameter on a node inside becomes an input too, and the material keeps it. The shader
/// stays the same.
///
/// # Errors
/// The surface and the sockets of the group that is worked on stay where they are; a selection that a wire leaves and comes back to
/// would feed itself; a wire of unknown type has no socket.
pub fn collapse(
    document: &Document,
    library: &Library,
    group: Option<&str>,
    nodes: &[NodeId],
    label: &str,
) -> Result<Edit, Refusal> {
    let (graph, own) = graph_and_library(document, library, group)?;
    let wiring = Wiring::new(graph);
    let inside = selected(graph, nodes)?;
    refuse_fixed(graph, &own, &inside)?;
    refuse_ring(graph, &own, &wiring, &inside)?;
    let is_taken = |id: &str| document.groups.contains_key(id) || !is_group_id(id);
    let id = free_name(if label.is_empty() { "group" } else { label }, is_taken);
    let node_id = graph.free_id(&id);
    let types = resolve_in(graph, &own, &wiring);
    let mut maker = Maker {
        types: &types,
        group: Group::default(),
        node: Node::new(&format!("group/{id}")),
        node_id: node_id.clone(),
        input_node: free_name("inputs", |id| inside.contains(id)),
        output_node: free_name("outputs", |id| inside.contains(id)),
        inputs: BTreeMap::new(),
        outputs: BTreeMap::new(),
    };
    maker.group.interface = Interface { label: label.into(), ..Interface::default() };
    for id in &inside {
        maker.group.graph.nodes.insert(id.to_string(), graph.nodes[*id].clone());
        if let Some(position) = graph.layout.get(*id) {
            maker.group.graph.layout.insert(id.to_string(), *position);
        }
    }
    let mut touched = Vec::new();
    let mut links = Vec::new();
    let mut kept = 0;
    for (place, link) in graph.links.iter().enumerate() {
        let (from_inside, to_inside) =
            (inside.contains(link.from.node.as_str()), inside.contains(link.to.node.as_str()));
        if !from_inside && !to_inside {
            kept += 1;
            continue;
        }
        touched.push(place);
        let outer = match (from_inside, to_inside) {
            (true, true) => {
                maker.group.graph.links.push(link.clone());
                None
            }
            // Of several wires into one input the first counts; the others would change hands.
            (_, true) if wiring.incoming(&link.to.node, &link.to.socket) != Some(&link.from) => None,
            (_, true) => maker.incoming(link)?,
            _ => Some(maker.outgoing(link)?),
        };
        if let Some(link) = outer {
            links.push((kept + links.len(), link));
        }
    }
    let mut of_document = Vec::new();
    if group.is_none() {
        for (place, parameter) in document.parameters.iter().enumerate() {
            if inside.contains(parameter.socket.node.as_str()) {
                let socket = maker.lifted(parameter)?;
                of_document.push(Edit::SetParameter { place, parameter: Parameter { socket, ..parameter.clone() } });
            }
        }
    }
    let center = maker.finish();
    let mut edits = vec![Edit::RemoveLinksAt { places: touched }];
    edits.extend(inside.iter().map(|id| Edit::RemoveNode { id: id.to_string() }));
    edits.push(Edit::AddNode { id: node_id.clone(), node: maker.node });
    edits.push(Edit::InsertLinks { links });
    edits.extend(center.map(|position| Edit::MoveNode { id: node_id, position: Some(position) }));
    let mut all = vec![Edit::AddGroup { id, group: Box::new(maker.group) }];
    all.append(&mut of_document);
    all.push(in_graph(group, edits));
    Ok(Edit::Many(all))
}

fn refuse_fixed(graph: &Graph, library: &Library, inside: &BTreeSet<&str>) -> Result<(), Refusal> {
    for id in inside {
        let kind = graph.nodes[*id].node.as_str();
        let is_surface = library.get(kind).is_some_and(|def| def.outputs.iter().any(|o| o.ty == SocketType::Surface));
        if is_surface {
            return refuse(
                "the surface is the end of the material and stays outside of groups; leave it out of the selection",
            );
        }
        if kind == GROUP_INPUT || kind == GROUP_OUTPUT {
            return refuse("the sockets of a group stay in it; leave them out of the selection");
        }
    }
    Ok(())
}

/// Refuses a selection that a wire leaves and comes back to.
fn refuse_ring(graph: &Graph, library: &Library, wiring: &Wiring, inside: &BTreeSet<&str>) -> Result<(), Refusal> {
    let mut open: Vec<&str> = inside.iter().copied().collect();
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    while let Some(id) = open.pop() {
        for link in wiring.outgoing(id) {
            let next = link.to.node.as_str();
            if inside.contains(next) {
                if !inside.contains(id) {
                    return refuse(format!(
                        "\u{201c}{}\u{201d} lies between selected nodes, so that the group would feed itself; select it too",
                        node_label(graph, library, id)
                    ));
                }
            } else if seen.insert(next) {
                open.push(next);
            }
        }
    }
    Ok(())
}

/// A group in the making.
struct Maker<'a> {
    types: &'a Types<'a>,
    group: Group,
    /// The node that stands for it.
    node: Node,
    node_id: NodeId,
    /// Inside.
    input_node: NodeId,
    output_node: NodeId,
    /// By source outside: the group's input.
    inputs: BTreeMap<SocketRef, String>,
    /// By source inside: the group's output.
    outputs: BTreeMap<SocketRef, String>,
}

impl Maker<'_> {
    /// A wire that comes in: joined inside; the wire outside, if it is not there yet.
    fn incoming(&mut self, link: &Link) -> Result<Option<Link>, Refusal> {
        let known = self.inputs.get(&link.from).cloned();
        let name = match &known {
            Some(name) => name.clone(),
            None => {
                let ty = self.types.get(&link.from.node).and_then(|types| types.output(&link.from.socket));
                let name = self.input(&link.to, ty, None)?;
                self.inputs.insert(link.from.clone(), name.clone());
                name
            }
        };
        self.group.graph.links.push(Link::new(SocketRef::new(&self.input_node, &name), link.to.clone()));
        let outer = Link::new(link.from.clone(), SocketRef::new(&self.node_id, &name));
        Ok(known.is_none().then_some(outer))
    }

    /// A wire that goes out: joined inside once; the wire outside.
    fn outgoing(&mut self, link: &Link) -> Result<Link, Refusal> {
        if let Some(name) = self.outputs.get(&link.from) {
            return Ok(Link::new(SocketRef::new(&self.node_id, name), link.to.clone()));
        }
        let types = self.types.get(&link.from.node);
        let Some(SocketType::Value(ty)) = types.and_then(|types| types.output(&link.from.socket)) else {
            return refuse(format!("the wire from {} has no known type; mend it first", link.from));
        };
        let names = &self.group.interface.outputs;
        let name = free_name(&link.from.socket, |name| names.iter().any(|output| output.name == name));
        let help = types.and_then(|t| t.def.outputs.iter().find(|o| o.name == link.from.socket));
        let output =
            GroupOutput { help: help.map_or_else(String::new, |o| o.help.clone()), ..GroupOutput::new(&name, ty) };
        self.group.interface.outputs.push(output);
        self.outputs.insert(link.from.clone(), name.clone());
        self.group.graph.links.push(Link::new(link.from.clone(), SocketRef::new(&self.output_node, &name)));
        Ok(Link::new(SocketRef::new(&self.node_id, &name), link.to.clone()))
    }

    /// An input for a parameter on a node inside; its value goes to the group's node.
    fn lifted(&mut self, parameter: &Parameter) -> Result<SocketRef, Refusal> {
        let inner = &parameter.socket;
        let ty = self.types.get(&inner.node).and_then(|types| types.input(&inner.socket));
        let value = self.group.graph.nodes.get_mut(&inner.node).and_then(|node| node.values.remove(&inner.socket));
        let name = self.input(inner, ty, Some(&parameter.name))?;
        if let Some(value) = value {
            self.node.values.insert(name.clone(), value);
        }
        self.group.graph.links.push(Link::new(SocketRef::new(&self.input_node, &name), inner.clone()));
        Ok(SocketRef::new(&self.node_id, &name))
    }

    /// A new input of the group, named and described as the inner one that it feeds first.
    fn input(&mut self, inner: &SocketRef, ty: Option<SocketType>, wished: Option<&str>) -> Result<String, Refusal> {
        let Some(ty @ (SocketType::Value(_) | SocketType::Texture)) = ty else {
            return refuse(format!("the wire into {inner} has no known type; mend it first"));
        };
        let taken = &self.group.interface.inputs;
        let name = free_name(wished.unwrap_or(&inner.socket), |name| taken.iter().any(|input| input.name == name));
        let def = self.types.get(&inner.node).and_then(|t| t.def.inputs.iter().find(|i| i.name == inner.socket));
        self.group.interface.inputs.push(GroupInput {
            name: name.clone(),
            label: None,
            ty,
            default: default(def, ty),
            range: def.and_then(|def| def.range),
            unit: def.map_or_else(String::new, |def| def.unit.clone()),
            help: def.map_or_else(String::new, |def| def.help.clone()),
            unknown: serde_json::Map::new(),
        });
        Ok(name)
    }

    /// Adds the nodes of the sockets, and says where the selection lay.
    fn finish(&mut self) -> Option<[f32; 2]> {
        let graph = &mut self.group.graph;
        let places: Vec<[f32; 2]> = graph.layout.values().copied().collect();
        let bounds = |axis: usize| {
            let along = places.iter().map(|place| place[axis]).filter(|x| x.is_finite());
            along.fold(None, |bounds: Option<(f32, f32)>, x| {
                Some(bounds.map_or((x, x), |(lo, hi)| (lo.min(x), hi.max(x))))
            })
        };
        let center = bounds(0).zip(bounds(1));
        if !self.group.interface.inputs.is_empty() {
            graph.nodes.insert(self.input_node.clone(), Node::new(GROUP_INPUT));
        }
        graph.nodes.insert(self.output_node.clone(), Node::new(GROUP_OUTPUT));
        let ((left, right), (top, bottom)) = center?;
        let middle = 0.5 * (top + bottom);
        if graph.nodes.contains_key(&self.input_node) {
            graph.layout.insert(self.input_node.clone(), [left - MARGIN, middle]);
        }
        graph.layout.insert(self.output_node.clone(), [right + MARGIN, middle]);
        Some([0.5 * (left + right), middle])
    }
}

/// The default of the inner input where it fits the group's.
fn default(def: Option<&Input>, ty: SocketType) -> Default {
    match (def.map(|def| &def.default), ty) {
        (Some(Default::Value(value)), SocketType::Value(ty)) if value.components_as(ty).is_some() => {
            Default::Value(value.clone())
        }
        (Some(Default::Context(name)), SocketType::Value(ty))
            if crate::context::context(name).is_some_and(|context| context.ty == ty) =>
        {
            Default::Context(name.clone())
        }
        (Some(Default::Image(space)), SocketType::Texture) => Default::Image(*space),
        (_, SocketType::Texture) => Default::Image(crate::value::ColorSpace::Srgb),
        (_, SocketType::Value(crate::value::Type::Bool)) => Default::Value(Value::Bool(false)),
        _ => Default::Value(Value::Number(0.0)),
    }
}
