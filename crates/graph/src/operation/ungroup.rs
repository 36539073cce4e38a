//! A group's node becomes the nodes of its inside.

use std::collections::{BTreeMap, BTreeSet};

use super::{Refusal, graph_and_library, in_graph, refuse};
use crate::document::{
    Document, GROUP_INPUT, GROUP_OUTPUT, Graph, Group, GroupInput, Link, Node, NodeId, Parameter, SocketRef, free_name,
    group_of,
};
use crate::edit::Edit;
use crate::group::output_node;
use crate::library::Library;
use crate::node_def::Default;
use crate::resolve::{Types, resolve_in};
use crate::value::{SocketType, Type, Value};
use crate::wiring::Wiring;

/// Puts a copy of a group's inside in the place of one of its nodes. The group itself stays in the document. The shader stays the
/// same.
///
/// # Errors
/// The node is none of a group; an input reads a context that no node can be told to read; a parameter sets an input that several nodes
/// inside read; a socket of the group changes the type of what goes through it in a way that the wires alone would not.
pub fn ungroup(document: &Document, library: &Library, at: Option<&str>, node: &str) -> Result<Edit, Refusal> {
    let (graph, own) = graph_and_library(document, library, at)?;
    let Some((id, outer)) = graph.nodes.get_key_value(node) else {
        return refuse(format!("there is no node `{node}`; was it removed?"));
    };
    let Some((name, group)) = group_of(&outer.node).and_then(|id| document.groups.get_key_value(id)) else {
        return refuse("only a group can be taken apart into its nodes");
    };
    if at == Some(name) {
        return refuse("the group holds itself; remove this node");
    }
    let wiring = Wiring::new(graph);
    let inner_library = library.of(document).inside(group);
    let inner_wiring = Wiring::new(&group.graph);
    let parts = Parts {
        id,
        outer,
        group,
        outside: resolve_in(graph, &own, &wiring),
        wiring: &wiring,
        inside: resolve_in(&group.graph, &inner_library, &inner_wiring),
        inner_wiring: &inner_wiring,
        ids: ids(graph, group),
    };
    let mut values = BTreeMap::new();
    let inner_links = parts.inner_links(&mut values)?;
    let mut links = Vec::new();
    let mut touched = Vec::new();
    let mut kept = 0;
    for (place, link) in graph.links.iter().enumerate() {
        if link.from.node != *id && link.to.node != *id {
            kept += 1;
            continue;
        }
        touched.push(place);
        if link.from.node == *id
            && wiring.incoming(&link.to.node, &link.to.socket) == Some(&link.from)
            && let Some(from) = parts.outgoing(link, &mut values)?
        {
            links.push((kept + links.len(), Link::new(from, link.to.clone())));
        }
    }
    let end = kept + links.len();
    links.extend(inner_links.into_iter().enumerate().map(|(i, link)| (end + i, link)));

    let mut edits = vec![Edit::RemoveLinksAt { places: touched }];
    let parameters = if at.is_none() { parts.parameters(document)? } else { Vec::new() };
    edits.push(Edit::RemoveNode { id: id.clone() });
    edits.extend(parts.copies(graph.layout.get(id).copied()));
    edits.push(Edit::InsertLinks { links });
    edits.extend(values.into_iter().map(|(socket, value)| Edit::SetValue { socket, value: Some(value) }));
    edits.extend(notes(graph, group, shift(group, graph.layout.get(id).copied())));
    let mut all = parameters;
    all.push(in_graph(at, edits));
    Ok(Edit::Many(all))
}

/// New ids of the nodes inside, by their own.
fn ids<'g>(graph: &Graph, group: &'g Group) -> BTreeMap<&'g str, NodeId> {
    let mut taken = BTreeSet::new();
    let is_part = |node: &Node| node.node != GROUP_INPUT && node.node != GROUP_OUTPUT;
    let mut ids = BTreeMap::new();
    for (id, _) in group.graph.nodes.iter().filter(|(_, node)| is_part(node)) {
        let free = free_name(id, |id| graph.nodes.contains_key(id) || taken.contains(id));
        taken.insert(free.clone());
        ids.insert(id.as_str(), free);
    }
    ids
}

/// How far the inside moves, so that its middle comes to lie where the node lay.
fn shift(group: &Group, position: Option<[f32; 2]>) -> Option<[f32; 2]> {
    let places: Vec<[f32; 2]> = group.graph.layout.values().copied().collect();
    let count = places.len().max(1) as f32;
    position.map(|to| [0, 1].map(|axis| to[axis] - places.iter().map(|place| place[axis]).sum::<f32>() / count))
}

/// Frames and comments of the inside.
fn notes(graph: &Graph, group: &Group, by: Option<[f32; 2]>) -> Vec<Edit> {
    let by = by.unwrap_or_default();
    let mut edits = Vec::new();
    let mut taken: BTreeSet<String> = graph.frames.keys().chain(graph.comments.keys()).cloned().collect();
    let mut free = |id: &str| {
        let id = free_name(id, |id| taken.contains(id));
        taken.insert(id.clone());
        id
    };
    for (id, frame) in &group.graph.frames {
        let mut frame = frame.clone();
        frame.rect.position = [0, 1].map(|axis| frame.rect.position[axis] + by[axis]);
        edits.push(Edit::AddFrame { id: free(id), frame });
    }
    for (id, comment) in &group.graph.comments {
        let mut comment = comment.clone();
        comment.rect.position = [0, 1].map(|axis| comment.rect.position[axis] + by[axis]);
        edits.push(Edit::AddComment { id: free(id), comment });
    }
    edits
}

/// Where something comes from once the group is gone.
enum Source {
    /// An output.
    Output(SocketRef, Option<SocketType>),
    /// A value set on the input.
    Value(Value),
    /// The context that the input reads by itself.
    Context(String),
}

struct Parts<'a> {
    id: &'a NodeId,
    outer: &'a Node,
    group: &'a Group,
    outside: Types<'a>,
    wiring: &'a Wiring<'a>,
    inside: Types<'a>,
    inner_wiring: &'a Wiring<'a>,
    ids: BTreeMap<&'a str, NodeId>,
}

impl Parts<'_> {
    fn input(&self, name: &str) -> Option<&GroupInput> {
        self.group.interface.inputs.iter().find(|input| input.name == name)
    }

    fn is_input(&self, node: &str) -> bool {
        self.group.graph.nodes.get(node).is_some_and(|node| node.node == GROUP_INPUT)
    }

    /// What an input of the group is.
    fn of_input(&self, name: &str) -> Option<Source> {
        let input = self.input(name)?;
        if let Some(from) = self.wiring.incoming(self.id, name) {
            let ty = self.outside.get(&from.node).and_then(|types| types.output(&from.socket));
            return Some(Source::Output(from.clone(), ty));
        }
        Some(match (self.outer.values.get(name), &input.default) {
            (Some(value), _) => Source::Value(spread(value, input.ty)),
            (None, Default::Value(value)) => Source::Value(spread(value, input.ty)),
            (None, Default::Context(name)) => Source::Context(name.clone()),
            // No picture is chosen: none is inside.
            (None, Default::Image(_) | Default::Surface) => return None,
        })
    }

    /// The links of the inside in terms of the outside; values for inputs that the group fed by itself.
    fn inner_links(&self, values: &mut BTreeMap<SocketRef, Value>) -> Result<Vec<Link>, Refusal> {
        let mut links = Vec::new();
        for link in &self.group.graph.links {
            let Some(to) = self.ids.get(link.to.node.as_str()) else { continue };
            if self.inner_wiring.incoming(&link.to.node, &link.to.socket) != Some(&link.from) {
                continue;
            }
            let to = SocketRef::new(to, &link.to.socket);
            if let Some(from) = self.ids.get(link.from.node.as_str()) {
                links.push(Link::new(SocketRef::new(from, &link.from.socket), to));
                continue;
            }
            if !self.is_input(&link.from.node) {
                continue;
            }
            let def = self.inside.get(&link.to.node).map(|types| types.def);
            let def = def.and_then(|def| def.inputs.iter().find(|input| input.name == link.to.socket));
            let is_generic = def.is_some_and(|def| def.ty == SocketType::Generic);
            match self.of_input(&link.from.socket) {
                Some(Source::Output(from, ty)) => {
                    let declared = self.input(&link.from.socket).map(|input| input.ty);
                    if is_generic && ty != declared {
                        return Err(self.changes_type(&link.from.socket));
                    }
                    links.push(Link::new(from, to));
                }
                Some(Source::Value(value)) => {
                    values.insert(to, value);
                }
                Some(Source::Context(name)) => {
                    let reads = def.map(|def| &def.default) == Some(&Default::Context(name.clone()));
                    let is_set = self.group.graph.value(&link.to).is_some();
                    if !reads || is_set {
                        return refuse(format!(
                            "the group's input `{}` reads {name}, which no value can say at {to}; link something to it first",
                            link.from.socket
                        ));
                    }
                }
                None => {}
            }
        }
        Ok(links)
    }

    /// What takes the place of the group's output at the end of a link; none when it is a value.
    fn outgoing(&self, link: &Link, values: &mut BTreeMap<SocketRef, Value>) -> Result<Option<SocketRef>, Refusal> {
        let Some(output) = self.group.interface.outputs.iter().find(|output| output.name == link.from.socket) else {
            return Ok(None);
        };
        let declared = SocketType::Value(output.ty);
        let end = output_node(self.group).unwrap_or_default();
        let source = match self.inner_wiring.incoming(end, &output.name) {
            Some(from) if self.is_input(&from.node) => self.of_input(&from.socket),
            Some(from) => self.ids.get(from.node.as_str()).map(|id| {
                let ty = self.inside.get(&from.node).and_then(|types| types.output(&from.socket));
                Source::Output(SocketRef::new(id, &from.socket), ty)
            }),
            None => {
                let set = self.group.graph.value(&SocketRef::new(end, &output.name)).cloned();
                Some(Source::Value(spread(&set.unwrap_or(Value::Number(0.0)), declared)))
            }
        };
        let def = self.outside.get(&link.to.node).map(|types| types.def);
        let def = def.and_then(|def| def.inputs.iter().find(|input| input.name == link.to.socket));
        match source {
            Some(Source::Output(_, ty))
                if ty != Some(declared) && def.is_some_and(|def| def.ty == SocketType::Generic) =>
            {
                Err(self.changes_type(&output.name))
            }
            Some(Source::Output(from, _)) => Ok(Some(from)),
            Some(Source::Value(value)) => {
                values.insert(link.to.clone(), value);
                Ok(None)
            }
            Some(Source::Context(name)) if def.map(|def| &def.default) == Some(&Default::Context(name.clone())) => {
                Ok(None)
            }
            Some(Source::Context(name)) => refuse(format!(
                "the group hands {name} on to {}, which no value can say; link something else there first",
                link.to
            )),
            None => Ok(None),
        }
    }

    fn changes_type(&self, socket: &str) -> Refusal {
        Refusal(format!(
            "the group's `{socket}` turns what goes through it into another type, and the nodes alone would compute with the old one; give `{socket}` that type first"
        ))
    }

    /// Parameters of the group's inputs go to what reads them.
    fn parameters(&self, document: &Document) -> Result<Vec<Edit>, Refusal> {
        let mut edits = Vec::new();
        for (place, parameter) in document.parameters.iter().enumerate() {
            if parameter.socket.node != *self.id {
                continue;
            }
            let reads = |link: &&Link| self.is_input(&link.from.node) && link.from.socket == parameter.socket.socket;
            let readers: Vec<&Link> = self.group.graph.links.iter().filter(reads).collect();
            let id = match readers.as_slice() {
                [only] => self.ids.get(only.to.node.as_str()).map(|id| SocketRef::new(id, &only.to.socket)),
                _ => None,
            };
            let Some(socket) = id else {
                return refuse(format!(
                    "the parameter `{}` sets an input that {} nodes inside read; remove the parameter first",
                    parameter.name,
                    readers.len()
                ));
            };
            edits.push(Edit::SetParameter { place, parameter: Parameter { socket, ..parameter.clone() } });
        }
        Ok(edits)
    }

    /// The nodes inside, under their new ids.
    fn copies(&self, position: Option<[f32; 2]>) -> Vec<Edit> {
        let by = shift(self.group, position);
        let mut edits = Vec::new();
        for (id, new) in &self.ids {
            edits.push(Edit::AddNode { id: new.clone(), node: self.group.graph.nodes[*id].clone() });
            if let (Some(place), Some(by)) = (self.group.graph.layout.get(*id), by) {
                let position = Some([place[0] + by[0], place[1] + by[1]]);
                edits.push(Edit::MoveNode { id: new.clone(), position });
            }
        }
        edits
    }
}

/// A value as it is after a socket of this type.
fn spread(value: &Value, ty: SocketType) -> Value {
    let SocketType::Value(ty) = ty else { return value.clone() };
    match (ty, value.components_as(ty).as_deref()) {
        (Type::Bool, _) => Value::Bool(value.numbers().is_some_and(|c| c.iter().any(|x| *x != 0.0))),
        (_, Some(&[x, y])) => Value::Vec2([x, y]),
        (_, Some(&[x, y, z])) => Value::Vec3([x, y, z]),
        (_, Some(&[x, y, z, w])) => Value::Vec4([x, y, z, w]),
        _ => value.clone(),
    }
}
