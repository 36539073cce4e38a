//! Definitions of the nodes that a document brings along: its groups as they look from outside and from inside.

use crate::document::{GROUP_INPUT, GROUP_OUTPUT, Group, GroupInput, GroupOutput};
use crate::node_def::{Default, Function, Input, NodeDef, Output};
use crate::value::{SocketType, Value};

/// A group as a node: `group/<id>`.
pub(crate) fn group(id: &str, group: &Group) -> NodeDef {
    let interface = &group.interface;
    let label = if interface.label.is_empty() { id } else { &interface.label };
    NodeDef {
        help: interface.help.clone(),
        inputs: interface.inputs.iter().map(input).collect(),
        outputs: interface.outputs.iter().map(output).collect(),
        ..plain(&format!("group/{id}"), label)
    }
}

/// The two nodes of a group's inside.
pub(crate) fn inside(group: &Group) -> [NodeDef; 2] {
    let interface = &group.interface;
    let outputs = interface.inputs.iter().map(given).collect();
    let inputs = interface.outputs.iter().map(taken).collect();
    [
        NodeDef { help: "The inputs of the group.".into(), outputs, ..plain(GROUP_INPUT, "Group Input") },
        NodeDef { help: "The outputs of the group.".into(), inputs, ..plain(GROUP_OUTPUT, "Group Output") },
    ]
}

/// What stands where a group was taken apart: a node with the group's inputs that hands each one on to its inside.
pub(crate) fn enter(id: &str, of: &Group) -> NodeDef {
    let mut def = group(id, of);
    def.id = format!("enter/{id}");
    def.outputs = of.interface.inputs.iter().map(given).collect();
    def.forwards = true;
    def
}

/// What stands for a group's output node: it hands its inputs on to the outside.
pub(crate) fn leave(id: &str, of: &Group) -> NodeDef {
    let inputs = of.interface.outputs.iter().map(taken).collect();
    let outputs = of.interface.outputs.iter().map(output).collect();
    NodeDef { inputs, outputs, forwards: true, ..plain(&format!("leave/{id}"), "Group Output") }
}

fn plain(id: &str, label: &str) -> NodeDef {
    NodeDef {
        id: id.into(),
        label: label.into(),
        help: String::new(),
        synonyms: Vec::new(),
        inputs: Vec::new(),
        outputs: Vec::new(),
        generic: Vec::new(),
        file: String::new(),
        function: Function {
            name: String::new(),
            arguments: Vec::new(),
            returns_struct: false,
            implicit_derivatives: false,
        },
        vertex_function: None,
        slopes: Vec::new(),
        method_functions: Vec::new(),
        output_functions: Vec::new(),
        forwards: false,
    }
}

fn input(input: &GroupInput) -> Input {
    Input {
        name: input.name.clone(),
        label: input.label.clone(),
        ty: input.ty,
        default: input.default.clone(),
        range: input.range,
        unit: input.unit.clone(),
        help: input.help.clone(),
    }
}

fn output(output: &GroupOutput) -> Output {
    Output {
        name: output.name.clone(),
        label: output.label.clone(),
        ty: SocketType::Value(output.ty),
        help: output.help.clone(),
    }
}

/// An input of the group, as its inside sees it.
fn given(input: &GroupInput) -> Output {
    Output { name: input.name.clone(), label: input.label.clone(), ty: input.ty, help: input.help.clone() }
}

/// An output of the group, as its inside sees it: 0 where nothing is wired to it.
fn taken(output: &GroupOutput) -> Input {
    let default = if output.ty == crate::value::Type::Bool { Value::Bool(false) } else { Value::Number(0.0) };
    Input {
        name: output.name.clone(),
        label: output.label.clone(),
        ty: SocketType::Value(output.ty),
        default: Default::Value(default),
        range: None,
        unit: String::new(),
        help: output.help.clone(),
    }
}
