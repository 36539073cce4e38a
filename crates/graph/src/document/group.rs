//! Groups: graphs with sockets of their own, used as nodes.

use super::Graph;
use crate::node_def::Default as InputDefault;
use crate::value::{SocketType, Type};

/// A group of nodes: a node of the definition `group/<id>` stands for it wherever the document wants it, and a change inside
/// is a change of all of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// How it looks from outside.
    pub interface: Interface,
    /// Its inside. The nodes of [`GROUP_INPUT`] have the group's inputs as their outputs, the one of
    /// [`GROUP_OUTPUT`] has its outputs as its inputs.
    pub graph: Graph,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// What a group shows to the outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interface {
    /// For people; the group's id when empty.
    pub label: String,
    /// What it computes; Markdown.
    pub help: String,
    /// Inputs, in the order shown.
    pub inputs: Vec<GroupInput>,
    /// Outputs, in the order shown.
    pub outputs: Vec<GroupOutput>,
}

/// An input of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupInput {
    /// Name in links: letters, digits and `_`, first a letter.
    pub name: String,
    /// For people; the name when absent.
    pub label: Option<String>,
    /// [`SocketType::Value`] or [`SocketType::Texture`].
    pub ty: SocketType,
    /// What it reads when nothing is connected or set.
    pub default: InputDefault,
    /// Soft range of each component.
    pub range: Option<[f32; 2]>,
    /// Unit or kind: `color`, `deg`, `m`, ...; empty for a plain number.
    pub unit: String,
    /// For people.
    pub help: String,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// An output of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupOutput {
    /// Name in links: letters, digits and `_`, first a letter.
    pub name: String,
    /// For people; the name when absent.
    pub label: Option<String>,
    /// Its type.
    pub ty: Type,
    /// For people.
    pub help: String,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// Definition of the nodes inside a group that give its inputs.
pub const GROUP_INPUT: &str = "group/input";
/// Definition of the node inside a group that takes its outputs.
pub const GROUP_OUTPUT: &str = "group/output";

/// Whether `id` may name a group: a name, and neither `input` nor `output`.
pub fn is_group_id(id: &str) -> bool {
    super::is_name(id) && id != "input" && id != "output"
}

/// The group that a definition's id names: `rust` of `group/rust`.
pub fn group_of(definition: &str) -> Option<&str> {
    definition.strip_prefix("group/").filter(|id| *id != "input" && *id != "output")
}

/// The document's WGSL function that a definition's id names: `stripes` of `custom/stripes`.
pub fn function_of(definition: &str) -> Option<&str> {
    definition.strip_prefix("custom/")
}

impl Group {
    /// A group with a label and nothing in it but the node of its outputs.
    pub fn new(label: &str) -> Group {
        let mut group =
            Group { interface: Interface { label: label.into(), ..Interface::default() }, ..Group::default() };
        group.graph.nodes.insert("output".into(), super::Node::new(GROUP_OUTPUT));
        group
    }
}

impl GroupInput {
    /// A number or vector with a default.
    pub fn new(name: &str, ty: Type, default: crate::value::Value) -> GroupInput {
        GroupInput {
            name: name.into(),
            label: None,
            ty: SocketType::Value(ty),
            default: InputDefault::Value(default),
            range: None,
            unit: String::new(),
            help: String::new(),
            unknown: serde_json::Map::new(),
        }
    }
}

impl GroupOutput {
    /// An output without label and help.
    pub fn new(name: &str, ty: Type) -> GroupOutput {
        GroupOutput { name: name.into(), label: None, ty, help: String::new(), unknown: serde_json::Map::new() }
    }
}
