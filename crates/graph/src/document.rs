//! The material document as plain data. Meaning only: what a document may be is in `check`, how it changes in `edit`,
//! how it is written in `file`. Positions stand apart (`layout`) and never reach the code generator.

use std::collections::BTreeMap;
use std::fmt;

use crate::FORMAT_VERSION;
use crate::value::Value;

/// Stable name of a node in a document: letters, digits and `_`, first a letter.
pub type NodeId = String;

/// A material: nodes, what joins them, and what is offered to the outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Version of the format that the file was written in; this program writes [`crate::FORMAT_VERSION`].
    pub version: u32,
    /// The material's name, for people.
    pub name: String,
    /// The nodes by id.
    pub nodes: BTreeMap<NodeId, Node>,
    /// The wires, in order of drawing.
    pub links: Vec<Link>,
    /// Inputs that a user of the material may change, in the order shown.
    pub parameters: Vec<Parameter>,
    /// What the rasteriser must know.
    pub surface: SurfaceSettings,
    /// View state of the editor, by node: no meaning for the shader.
    pub layout: BTreeMap<NodeId, [f32; 2]>,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

/// One node.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Id of the definition, such as `math/mix`.
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

/// An unconnected input that the material offers to its user under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name in shaders and on the command line: letters, digits and `_`, first a letter.
    pub name: String,
    /// For people; `name` when absent.
    pub label: Option<String>,
    /// The input that it sets; its value there is the default.
    pub socket: SocketRef,
    /// Soft range of each component, when other than the socket's.
    pub range: Option<[f32; 2]>,
}

/// What happens with opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AlphaMode {
    /// Opacity is ignored.
    #[default]
    Opaque,
    /// Fragments below the cutoff are discarded.
    Mask,
    /// Blended over what lies behind.
    Blend,
}

/// What the rasteriser must know of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSettings {
    /// What opacity does.
    pub alpha_mode: AlphaMode,
    /// Opacity below which `Mask` discards: 0 to 1.
    pub alpha_cutoff: f32,
    /// Back faces are drawn too, with the shading normal turned to the viewer.
    pub double_sided: bool,
}

impl Default for SurfaceSettings {
    fn default() -> Self {
        SurfaceSettings { alpha_mode: AlphaMode::Opaque, alpha_cutoff: 0.5, double_sided: false }
    }
}

/// Id of the surface node that [`Document::with_surface`] makes, and of its definition.
pub const SURFACE_NODE: &str = "surface/surface";

/// Whether `name` may name a node of a document or a parameter: letters, digits and `_` of ASCII, first a letter, at most 128.
pub fn is_name(name: &str) -> bool {
    name.len() <= 128
        && name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

impl Document {
    /// A document without nodes.
    pub fn new(name: &str) -> Document {
        Document {
            version: FORMAT_VERSION,
            name: name.into(),
            nodes: BTreeMap::new(),
            links: Vec::new(),
            parameters: Vec::new(),
            surface: SurfaceSettings::default(),
            layout: BTreeMap::new(),
            unknown: serde_json::Map::new(),
        }
    }

    /// A document with one surface node, `surface`, whose inputs have their defaults.
    pub fn with_surface(name: &str) -> Document {
        let mut document = Document::new(name);
        document.nodes.insert("surface".into(), Node::new(SURFACE_NODE));
        document
    }

    /// The output that feeds an input: of several links the first. It looks through all links; for many questions
    /// use [`crate::wiring::Wiring`].
    pub fn incoming(&self, input: &SocketRef) -> Option<&SocketRef> {
        self.links.iter().find(|link| link.to == *input).map(|link| &link.from)
    }

    /// The value set on an input, if any.
    pub fn value(&self, input: &SocketRef) -> Option<&Value> {
        self.nodes.get(&input.node)?.values.get(&input.socket)
    }

    /// The parameter with this name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// An id that no node has: `base` made a name, with a number behind it when it is taken.
    pub fn free_id(&self, base: &str) -> NodeId {
        let mut name: String = base
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' })
            .take(100)
            .collect();
        if !is_name(&name) {
            name.insert_str(0, "node_");
        }
        let mut id = name.clone();
        let mut number = 2u64;
        while self.nodes.contains_key(&id) {
            id = format!("{name}_{number}");
            number += 1;
        }
        id
    }
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

impl AlphaMode {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            AlphaMode::Opaque => "opaque",
            AlphaMode::Mask => "mask",
            AlphaMode::Blend => "blend",
        }
    }
}
