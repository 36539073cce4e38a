//! A material document becomes WGSL: named passes (their order stands in `pipeline`), reflection, export targets.
//!
//! Deterministic: the same document, needs and library give the same bytes. It opens no files and no device, and reads no
//! node positions.

mod blend;
mod cost;
mod emit;
mod error;
mod explain;
mod fate;
mod ir;
mod layout;
mod line_map;
mod link;
mod names;
mod passes;
mod pipeline;
pub mod reflection;
mod slopes;
pub mod target;
pub mod uniforms;
mod unread;
mod validate;

#[cfg(test)]
mod tests;

pub use cost::{Cost, Instructions, NodeCost, cost};
pub use emit::text::{Origin, Part, Segment};
pub use error::CodegenError;
pub use explain::{Remark, explained};
pub use layout::PackError;
pub use line_map::{Lines, line_map};
pub use passes::lower::input_value;
pub use pipeline::{Height, height, material, material_live, shader};
pub use validate::{Place, Valid, ValidationError, place_of, validate};

use halfvector_graph::document::NodeId;

use passes::plan::Keep;
use reflection::Reflection;

/// Which numbers of a document stay open in the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fold {
    /// All: changing a number is a change of uniforms, not of the shader. For editing.
    Live,
    /// The exposed parameters only; the others are folded. For taking home.
    Export,
}

/// A shader and what is to be known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shader {
    /// The text. Of a whole shader the entry points are `vs_main` and `fs_main`.
    pub wgsl: String,
    /// What it wants bound and fed.
    pub reflection: Reflection,
    /// Where each byte of the text comes from: without gaps, in order.
    pub segments: Vec<Segment>,
    /// What was left out, and why.
    pub dropped: Vec<Dropped>,
    /// The nodes that reach the surface and are not in it, in order of id; empty where that was not asked for ([`explained()`] does).
    pub dropped_nodes: Vec<DroppedNode>,
    /// The nodes whose pictures are read by arithmetic because they feed the height, in order of id; empty where that was not asked for.
    pub slope_reads: Vec<SlopeRead>,
    /// The terms of shading that this shader has a part of, each with its method, in the order of the list of terms.
    pub methods: Vec<(&'static str, &'static str)>,
}

impl Shader {
    /// The comment at the top: whole lines, each beginning with `//`.
    pub fn header(&self) -> &str {
        let lines = self.wgsl.split_inclusive('\n').take_while(|line| line.starts_with("//"));
        &self.wgsl[..lines.map(str::len).sum()]
    }
}

/// Something that a shader does without.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// What it is.
    pub what: String,
    /// Why it is not needed here, or what that changes.
    pub why: String,
    /// Instructions of both stages that the shader would have more, estimated as [`cost()`] does on the shader that keeps this
    /// one thing; none where that was not asked for ([`explained()`] does) or no such shader can be made.
    pub instructions: Option<u32>,
    /// What has to be different for it to be there.
    pub(crate) kept_by: Keep,
}

/// A node whose pictures are blended by arithmetic where their slope is seen; other sockets read them by the sampler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlopeRead {
    /// The node; in a group its path.
    pub node: NodeId,
    /// Its label; in a group after the group's.
    pub label: String,
    /// Why the sampler does not do.
    pub why: String,
    /// Instructions of both stages beyond those of reading by the sampler, estimated as [`cost()`] does.
    pub instructions: Option<u32>,
}

/// A node that reaches the surface and that a shader does without.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DroppedNode {
    /// The node; in a group its path.
    pub node: NodeId,
    /// Its label; in a group after the group's.
    pub label: String,
    /// Why it is not needed here.
    pub why: String,
    /// Instructions of its function, estimated as [`cost()`] does; none where naga cannot read the function by itself.
    pub instructions: Option<u32>,
}
