//! One graph of nodes: the document's own, or the inside of a group. Everything that shows or changes nodes works on it.

use std::collections::BTreeMap;
use std::fmt;

use super::{NodeId, is_name};
use crate::value::Value;

/// Nodes and what joins them, and beside them how they are shown. The view (`layout`, `frames`, `comments`) has no
/// meaning for a shader.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// The nodes by id.
    pub nodes: BTreeMap<NodeId, Node>,
    /// The wires, in order of drawing.
    pub links: Vec<Link>,
    /// Where the nodes lie on the canvas: x to the right, y down.
    pub layout: BTreeMap<NodeId, [f32; 2]>,
    /// Titled rectangles behind the nodes, by id.
    pub frames: BTreeMap<String, Frame>,
    /// Notes on the canvas, by id.
    pub comments: BTreeMap<String, Comment>,
    /// Parts of the file's sections that this version does not know, by section, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// One node.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Id of the definition, such as `math/mix`, or `group/rust` for a group of the document.
    pub node: String,
    /// The user's name for it; the definition's label when absent.
    pub label: Option<String>,
    /// Values of unconnected inputs; absent ones have the definition's default.
    pub values: BTreeMap<String, Value>,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// A socket of a node; written `node.socket`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SocketRef {
    /// Whose.
    pub node: NodeId,
    /// Which input or output.
    pub socket: String,
}

/// A wire from an output to an input. An input has at most one.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Link {
    /// The output.
    pub from: SocketRef,
    /// The input.
    pub to: SocketRef,
}

/// A rectangle of the canvas, in its units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rect {
    /// The corner with the smallest x and y.
    pub position: [f32; 2],
    /// Width and height.
    pub size: [f32; 2],
}

/// A titled rectangle behind nodes. It is a place, not a list of members: a node belongs to it while it lies in it, so that
/// renaming or removing a node never touches a frame, and an empty frame has a place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// For people, in any script.
    pub title: String,
    /// Red, green, blue in sRGB; the editor's own colour when absent.
    pub color: Option<[u8; 3]>,
    /// Where it lies.
    pub rect: Rect,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// A note on the canvas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comment {
    /// What it says; may have several lines.
    pub text: String,
    /// Where it lies.
    pub rect: Rect,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

impl Graph {
    /// The output that feeds an input: of several links the first. It looks through all links; for many questions
    /// use [`crate::wiring::Wiring`].
    pub fn incoming(&self, input: &SocketRef) -> Option<&SocketRef> {
        self.links.iter().find(|link| link.to == *input).map(|link| &link.from)
    }

    /// The value set on an input, if any.
    pub fn value(&self, input: &SocketRef) -> Option<&Value> {
        self.nodes.get(&input.node)?.values.get(&input.socket)
    }

    /// An id that no node has: `base` made a name, with a number behind it when it is taken.
    pub fn free_id(&self, base: &str) -> NodeId {
        free_name(base, |id| self.nodes.contains_key(id))
    }
}

/// A name like `base` that is not taken: `base` in lower case with `_` for what no name has, and a number behind it where needed.
/// One that has a number counts on: after `grain_2` comes `grain_3`.
pub fn free_name(base: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut name: String =
        base.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).take(100).collect();
    if !is_name(&name) {
        name.insert_str(0, "node_");
    }
    let mut id = name.clone();
    let stem = name.rsplit_once('_').filter(|(stem, end)| is_name(stem) && !end.starts_with('0'));
    let counted = stem.and_then(|(stem, end)| Some((stem, end.parse::<u32>().ok()?)));
    let (name, mut number) = counted.map_or((name.as_str(), 2), |(stem, last)| (stem, u64::from(last) + 1));
    while is_taken(&id) {
        id = format!("{name}_{number}");
        number += 1;
    }
    id
}

impl Node {
    /// A node of this definition, such as `math/mix`, with all defaults.
    pub fn new(node: &str) -> Node {
        Node { node: node.into(), label: None, values: BTreeMap::new(), unknown: serde_json::Map::new() }
    }

    /// The same node with a value set.
    pub fn with(mut self, socket: &str, value: Value) -> Node {
        self.values.insert(socket.into(), value);
        self
    }
}

impl SocketRef {
    /// The socket `socket` of the node `node`.
    pub fn new(node: &str, socket: &str) -> SocketRef {
        SocketRef { node: node.into(), socket: socket.into() }
    }

    /// Reads `node.socket`. Sockets have no dot in their names, so that even a node with one in its id is found again.
    pub fn parse(written: &str) -> Option<SocketRef> {
        let (node, socket) = written.rsplit_once('.')?;
        Some(SocketRef::new(node, socket))
    }
}

impl fmt::Display for SocketRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.node, self.socket)
    }
}

impl Link {
    /// A link from the output `from` to the input `to`.
    pub fn new(from: SocketRef, to: SocketRef) -> Link {
        Link { from, to }
    }
}
