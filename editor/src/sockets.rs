//! The sockets of a group as a person handles them: renamed, moved, added, given another type, removed; as edits of the document
//! that take along the links, values and parameters of all uses of the group. It shows nothing.

use halfvector_graph::document::{
    Document, GROUP_INPUT, GROUP_OUTPUT, Graph, GroupInput, GroupOutput, Interface, Link, Parameter, SocketRef,
    free_name, is_name,
};
use halfvector_graph::edit::Edit;
use halfvector_graph::node_def::Default as InputDefault;
use halfvector_graph::value::{SocketType, Type, Value};

/// Which sockets of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Inputs,
    Outputs,
}

impl Side {
    /// One of them, for people.
    pub(crate) fn one(self) -> &'static str {
        match self {
            Side::Inputs => "input",
            Side::Outputs => "output",
        }
    }

    /// Their names, in order.
    pub(crate) fn names(self, interface: &Interface) -> Vec<&str> {
        match self {
            Side::Inputs => interface.inputs.iter().map(|input| input.name.as_str()).collect(),
            Side::Outputs => interface.outputs.iter().map(|output| output.name.as_str()).collect(),
        }
    }
}

/// A socket of a group in a document.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Socket<'d> {
    pub(crate) document: &'d Document,
    pub(crate) group: &'d str,
    pub(crate) side: Side,
    pub(crate) name: &'d str,
}

impl Socket<'_> {
    /// Gives it another name, wherever it is used.
    ///
    /// # Errors
    /// Why it cannot be called that.
    pub(crate) fn renamed(self, to: &str) -> Result<Edit, String> {
        let mut interface = self.interface().ok_or("the group is gone")?;
        if !is_name(to) {
            return Err(format!("“{to}” is no name of a socket: letters, digits and _, first a letter"));
        }
        if self.side.names(&interface).contains(&to) {
            return Err(format!("there is an {} “{to}” already; choose another name", self.side.one()));
        }
        match self.side {
            Side::Inputs => {
                interface.inputs.iter_mut().filter(|it| it.name == self.name).for_each(|it| it.name = to.into())
            }
            Side::Outputs => {
                interface.outputs.iter_mut().filter(|it| it.name == self.name).for_each(|it| it.name = to.into());
            }
        }
        Ok(self.with_uses(interface, Some(to)))
    }

    /// Removes it, with the links, values and parameters of all its uses.
    pub(crate) fn removed(self) -> Option<Edit> {
        let mut interface = self.interface()?;
        match self.side {
            Side::Inputs => interface.inputs.retain(|input| input.name != self.name),
            Side::Outputs => interface.outputs.retain(|output| output.name != self.name),
        }
        Some(self.with_uses(interface, None))
    }

    /// Moves it one place up or down; none where there is no place.
    pub(crate) fn moved(self, down: bool) -> Option<Edit> {
        let mut interface = self.interface()?;
        let names = self.side.names(&interface);
        let from = names.iter().position(|name| *name == self.name)?;
        let to = if down { from + 1 } else { from.checked_sub(1)? };
        if to >= names.len() {
            return None;
        }
        match self.side {
            Side::Inputs => interface.inputs.swap(from, to),
            Side::Outputs => interface.outputs.swap(from, to),
        }
        Some(self.set(interface))
    }

    /// Gives it another type. The default of an input becomes a value of it; links that no longer fit are told by the problems.
    pub(crate) fn with_type(self, ty: Type) -> Option<Edit> {
        let mut interface = self.interface()?;
        for input in interface.inputs.iter_mut().filter(|input| self.side == Side::Inputs && input.name == self.name) {
            let fits = matches!(&input.default, InputDefault::Value(value) if value.components_as(ty).is_some());
            input.ty = SocketType::Value(ty);
            if !fits {
                input.default = InputDefault::Value(zero(ty));
            }
        }
        for output in interface.outputs.iter_mut().filter(|it| self.side == Side::Outputs && it.name == self.name) {
            output.ty = ty;
        }
        Some(self.set(interface))
    }

    /// Sets what an input reads when nothing is connected to it.
    pub(crate) fn with_default(self, value: Value) -> Option<Edit> {
        let mut interface = self.interface()?;
        let input = interface.inputs.iter_mut().find(|input| input.name == self.name)?;
        input.default = InputDefault::Value(value);
        Some(self.set(interface))
    }

    fn interface(self) -> Option<Interface> {
        self.document.groups.get(self.group).map(|group| group.interface.clone())
    }

    fn set(self, interface: Interface) -> Edit {
        Edit::SetInterface { group: self.group.to_owned(), interface }
    }

    /// The interface, and what follows in all graphs: the socket has another name, or is gone.
    fn with_uses(self, interface: Interface, to: Option<&str>) -> Edit {
        let mut edits = vec![self.set(interface)];
        let definition = format!("group/{}", self.group);
        let (inner, gives_inside) = match self.side {
            Side::Inputs => (GROUP_INPUT, true),
            Side::Outputs => (GROUP_OUTPUT, false),
        };
        if let Some(group) = self.document.groups.get(self.group) {
            let inside = followed(&group.graph, inner, gives_inside, self.name, to);
            edits.extend(within(Some(self.group), inside));
        }
        edits.extend(within(None, followed(&self.document.graph, &definition, !gives_inside, self.name, to)));
        for (id, group) in &self.document.groups {
            edits.extend(within(Some(id), followed(&group.graph, &definition, !gives_inside, self.name, to)));
        }
        if self.side == Side::Inputs {
            edits.extend(self.parameters(&definition, to));
        }
        Edit::Many(edits)
    }

    fn parameters(self, definition: &str, to: Option<&str>) -> Vec<Edit> {
        let nodes = &self.document.graph.nodes;
        let is_ours = |parameter: &Parameter| {
            let of = &parameter.socket;
            of.socket == self.name && nodes.get(&of.node).is_some_and(|node| node.node == definition)
        };
        // From the end, so that places stay what they are.
        let ours = self.document.parameters.iter().enumerate().rev().filter(|(_, parameter)| is_ours(parameter));
        let edits = ours.map(|(place, parameter)| match to {
            None => Edit::RemoveParameter { place },
            Some(to) => {
                let socket = SocketRef::new(&parameter.socket.node, to);
                Edit::SetParameter { place, parameter: Parameter { socket, ..parameter.clone() } }
            }
        });
        edits.collect()
    }
}

/// Adds a socket at the end: a number.
pub(crate) fn added(document: &Document, group: &str, side: Side) -> Option<Edit> {
    let mut interface = document.groups.get(group)?.interface.clone();
    let name = free_name(side.one(), |name| side.names(&interface).contains(&name));
    match side {
        Side::Inputs => interface.inputs.push(GroupInput::new(&name, Type::F32, Value::Number(0.0))),
        Side::Outputs => interface.outputs.push(GroupOutput::new(&name, Type::F32)),
    }
    Some(Edit::SetInterface { group: group.to_owned(), interface })
}

/// What follows in a graph for the nodes of a definition: their links, by place, and their values.
fn followed(graph: &Graph, definition: &str, gives: bool, name: &str, to: Option<&str>) -> Vec<Edit> {
    let is_node = |id: &str| graph.nodes.get(id).is_some_and(|node| node.node == definition);
    let end = |link: &Link| if gives { link.from.clone() } else { link.to.clone() };
    let is_ours = |link: &Link| end(link).socket == name && is_node(&end(link).node);
    let links: Vec<(usize, &Link)> = graph.links.iter().enumerate().filter(|(_, link)| is_ours(link)).collect();
    let mut edits = Vec::new();
    if !links.is_empty() {
        edits.push(Edit::RemoveLinksAt { places: links.iter().map(|(place, _)| *place).collect() });
        if let Some(to) = to {
            let renamed = links.iter().map(|(place, link)| {
                let mut link = (*link).clone();
                let end = if gives { &mut link.from } else { &mut link.to };
                end.socket = to.to_owned();
                (*place, link)
            });
            edits.push(Edit::InsertLinks { links: renamed.collect() });
        }
    }
    if !gives {
        for (id, node) in graph.nodes.iter().filter(|(_, node)| node.node == definition) {
            let Some(value) = node.values.get(name) else { continue };
            edits.push(Edit::SetValue { socket: SocketRef::new(id, name), value: None });
            edits.extend(to.map(|to| Edit::SetValue { socket: SocketRef::new(id, to), value: Some(value.clone()) }));
        }
    }
    edits
}

fn within(group: Option<&str>, edits: Vec<Edit>) -> Option<Edit> {
    let edit = (!edits.is_empty()).then_some(Edit::Many(edits))?;
    Some(match group {
        Some(group) => Edit::In { group: group.to_owned(), edit: Box::new(edit) },
        None => edit,
    })
}

fn zero(ty: Type) -> Value {
    if ty == Type::Bool { Value::Bool(false) } else { Value::Number(0.0) }
}
