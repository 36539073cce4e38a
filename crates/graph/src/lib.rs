//! The material document: nodes, links, edits, checks, files; node definitions read from WGSL.
//!
//! Reading order: `value`, `document` (the plain data), `node_def` and `library` (what a node is and where it comes from), `resolve` and
//! `check` (what a document means), `group` and `flatten` (groups, and a document without them), `edit`, `operation` (what an editor does in
//! one step), `file`. Nothing here makes a shader, looks at a picture or opens a window.

pub mod check;
pub mod context;
pub mod docs;
pub mod document;
pub mod edit;
pub mod figures;
pub mod file;
pub mod flatten;
pub mod group;
mod json;
pub mod library;
pub mod method;
pub mod needs;
pub mod node_def;
pub mod operation;
pub mod resolve;
pub mod value;
pub mod wiring;

/// The version of the document format that this program writes.
pub const FORMAT_VERSION: u32 = 1;

#[cfg(test)]
mod tests;
