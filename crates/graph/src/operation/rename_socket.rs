//! A group's input or output under another name: the interface and all that names it, inside and outside, in one edit.

use super::{Refusal, in_graph, refuse};
use crate::document::{Document, GROUP_INPUT, GROUP_OUTPUT, Graph, Interface, Link, is_name};
use crate::edit::Edit;

/// Which side of a group a socket is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupSide {
    /// What nodes outside feed.
    Input,
    /// What feeds nodes outside.
    Output,
}

/// Gives a socket of a group another name. Wires, values and parameters of every node that stands for the group go along, as
/// do the wires at the border inside. The label stays.
///
/// # Errors
/// There is no such group or socket, the name is taken on that side, or it is none.
pub fn rename_socket(document: &Document, group: &str, side: GroupSide, from: &str, to: &str) -> Result<Edit, Refusal> {
    let Some(renamed) = document.groups.get(group) else {
        return refuse(format!("there is no group `{group}`; was it removed?"));
    };
    let interface = interface_with(&renamed.interface, side, from, to)?;
    let rename = Rename { definition: format!("group/{group}"), side, from, to };
    let mut edits = vec![Edit::SetInterface { group: group.into(), interface }];
    edits.extend(rename.in_graph(&document.graph, false));
    for (place, parameter) in document.parameters.iter().enumerate() {
        let socket = &parameter.socket;
        if side == GroupSide::Input && socket.socket == from && rename.is_user(&document.graph, &socket.node) {
            let mut parameter = parameter.clone();
            parameter.socket.socket = to.into();
            edits.push(Edit::SetParameter { place, parameter });
        }
    }
    for (id, other) in &document.groups {
        let inside = rename.in_graph(&other.graph, id == group);
        if !inside.is_empty() {
            edits.push(in_graph(Some(id), inside));
        }
    }
    Ok(Edit::Many(edits))
}

fn interface_with(interface: &Interface, side: GroupSide, from: &str, to: &str) -> Result<Interface, Refusal> {
    let mut interface = interface.clone();
    let mut names: Vec<&mut String> = match side {
        GroupSide::Input => interface.inputs.iter_mut().map(|input| &mut input.name).collect(),
        GroupSide::Output => interface.outputs.iter_mut().map(|output| &mut output.name).collect(),
    };
    let kind = if side == GroupSide::Input { "input" } else { "output" };
    let Some(at) = names.iter().position(|name| *name == from) else {
        return refuse(format!("the group has no {kind} `{from}`"));
    };
    if !is_name(to) {
        return refuse(format!("`{to}` is no name: letters, digits and _ are, with a letter first"));
    }
    if names.iter().enumerate().any(|(other, name)| other != at && *name == to) {
        return refuse(format!("the group has an {kind} `{to}` already"));
    }
    to.clone_into(names[at]);
    Ok(interface)
}

struct Rename<'a> {
    definition: String,
    side: GroupSide,
    from: &'a str,
    to: &'a str,
}

impl Rename<'_> {
    /// Whether a node stands for the group.
    fn is_user(&self, graph: &Graph, node: &str) -> bool {
        graph.nodes.get(node).is_some_and(|node| node.node == self.definition)
    }

    /// The edits of a graph. `inside`: it is the group's own.
    fn in_graph(&self, graph: &Graph, inside: bool) -> Vec<Edit> {
        let is = |node: &str, definition: &str| graph.nodes.get(node).is_some_and(|node| node.node == definition);
        let named = |socket: &str| socket == self.from;
        let (mut places, mut links) = (Vec::new(), Vec::new());
        for (place, link) in graph.links.iter().enumerate() {
            let mut new: Link = link.clone();
            let (at_from, at_to) = match self.side {
                GroupSide::Input => (inside && is(&link.from.node, GROUP_INPUT), self.is_user(graph, &link.to.node)),
                GroupSide::Output => (self.is_user(graph, &link.from.node), inside && is(&link.to.node, GROUP_OUTPUT)),
            };
            if at_from && named(&link.from.socket) {
                new.from.socket = self.to.into();
            }
            if at_to && named(&link.to.socket) {
                new.to.socket = self.to.into();
            }
            if new != *link {
                places.push(place);
                links.push((place, new));
            }
        }
        let mut edits = Vec::new();
        if !places.is_empty() {
            edits.extend([Edit::RemoveLinksAt { places }, Edit::InsertLinks { links }]);
        }
        // What is set on an unconnected input: of the group's nodes, or of the node that takes its outputs.
        for (id, node) in &graph.nodes {
            let holds = match self.side {
                GroupSide::Input => node.node == self.definition,
                GroupSide::Output => inside && node.node == GROUP_OUTPUT,
            };
            if let Some(value) = node.values.get(self.from).filter(|_| holds) {
                let socket = |name: &str| crate::document::SocketRef::new(id, name);
                edits.push(Edit::SetValue { socket: socket(self.from), value: None });
                edits.push(Edit::SetValue { socket: socket(self.to), value: Some(value.clone()) });
            }
        }
        edits
    }
}
