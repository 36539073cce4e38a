//! The material document: nodes, links, edits, checks, files; node definitions read from WGSL.
pub mod context;
pub mod document;
pub mod method;
pub mod needs;
pub mod node_def;
pub mod value;

/// The version of the document format that this program writes.
pub const FORMAT_VERSION: u32 = 1;
