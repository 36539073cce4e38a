//! Which lines of a shader come from which node of the document or which file of the library.

use crate::Shader;
use crate::emit::text::Origin;

/// Neighbouring lines of one origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lines {
    /// From 1.
    pub first: usize,
    /// The last one, included.
    pub last: usize,
    /// The node or file. Nodes inside groups have paths: `rust/noise`.
    pub origin: Origin,
}

/// The lines of a shader that come from nodes and library files, in order; what stands between them is the frame that codegen writes.
/// Empty lines belong to nothing.
pub fn line_map(shader: &Shader) -> Vec<Lines> {
    let mut map: Vec<Lines> = Vec::new();
    let mut line = 1;
    for segment in &shader.segments {
        let text = &shader.wgsl[segment.range()];
        let before = text.len() - text.trim_start_matches('\n').len();
        let inside = text.trim_matches('\n').matches('\n').count();
        let first = line + before;
        line += text.matches('\n').count();
        if segment.origin == Origin::Frame || text.trim_matches('\n').is_empty() {
            continue;
        }
        let last = first + inside;
        match map.last_mut() {
            Some(above) if above.origin == segment.origin && above.last + 1 >= first => above.last = last,
            _ => map.push(Lines { first, last, origin: segment.origin.clone() }),
        }
    }
    map
}
