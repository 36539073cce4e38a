//! The material document as plain data. Meaning only: what a document may be is in `check`, how it changes in `edit`,
//! how it is written in `file`. Positions stand apart (`layout`) and never reach the code generator.

use std::collections::BTreeMap;

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
