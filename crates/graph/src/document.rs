//! The material document as plain data. Meaning only: what a document may be is in `check`, how it changes in `edit`,
//! how it is written in `file`. What belongs to the editor's view stands apart and never reaches the code generator.

mod graph;
mod group;

use std::collections::BTreeMap;

use crate::FORMAT_VERSION;

pub use graph::{Comment, Frame, Graph, Link, Node, Rect, SocketRef, free_name};
pub use group::{
    GROUP_INPUT, GROUP_OUTPUT, Group, GroupInput, GroupOutput, Interface, function_of, group_of, is_group_id,
};

/// Stable name of a node in a document: letters, digits and `_`, first a letter.
pub type NodeId = String;

/// A material: nodes, what joins them, and what is offered to the outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Version of the format that the file was written in; this program writes [`crate::FORMAT_VERSION`].
    pub version: u32,
    /// The material's name, for people.
    pub name: String,
    /// The nodes, and how they are shown.
    pub graph: Graph,
    /// Groups of nodes by id: letters, digits and `_`, first a letter.
    pub groups: BTreeMap<String, Group>,
    /// WGSL functions of the user's by id: nodes of the definition `custom/<id>`. See [`crate::library::custom`].
    pub functions: BTreeMap<String, String>,
    /// Inputs of the top level's nodes that a user of the material may change, in the order shown.
    pub parameters: Vec<Parameter>,
    /// What the rasteriser must know.
    pub surface: SurfaceSettings,
    /// Fields of the file that this version does not know, kept for saving.
    pub unknown: serde_json::Map<String, serde_json::Value>,
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
    /// What transmits light is a sheet, which light leaves in the direction in which it came, and not the surface of a
    /// solid body, which refracts it (`geometry_thin_walled` of OpenPBR).
    pub thin_walled: bool,
}

impl Default for SurfaceSettings {
    fn default() -> Self {
        SurfaceSettings { alpha_mode: AlphaMode::Opaque, alpha_cutoff: 0.5, double_sided: false, thin_walled: false }
    }
}

/// Id of the surface node that [`Document::with_surface`] makes, and of its definition.
pub const SURFACE_NODE: &str = "surface/surface";

/// The node that mixes two surfaces.
pub const SURFACE_MIX: &str = "surface/mix";

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
            graph: Graph::default(),
            groups: BTreeMap::new(),
            functions: BTreeMap::new(),
            parameters: Vec::new(),
            surface: SurfaceSettings::default(),
            unknown: serde_json::Map::new(),
        }
    }

    /// A document with one surface node, `surface`, whose inputs have their defaults.
    pub fn with_surface(name: &str) -> Document {
        let mut document = Document::new(name);
        document.graph.nodes.insert("surface".into(), Node::new(SURFACE_NODE));
        document
    }

    /// The top level's graph, or the inside of a group.
    pub fn graph_of(&self, group: Option<&str>) -> Option<&Graph> {
        match group {
            None => Some(&self.graph),
            Some(id) => self.groups.get(id).map(|group| &group.graph),
        }
    }

    /// The parameter with this name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
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
