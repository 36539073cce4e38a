//! Which lines of a shader come from which node of the document, which file of the library, or which part of the frame around them.

use crate::Shader;
use crate::emit::text::Origin;

/// Neighbouring lines of one origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lines {
    /// From 1.
    pub first: usize,
    /// The last one, included.
    pub last: usize,
    /// The node, file or part of the frame. Nodes inside groups have paths: `rust/noise`.
    pub origin: Origin,
}

/// The lines of a shader in order: each that is not empty stands in one entry. Empty lines between entries belong to none.
pub fn line_map(shader: &Shader) -> Vec<Lines> {
    let mut map: Vec<Lines> = Vec::new();
    let mut line = 1;
    for segment in &shader.segments {
        let text = &shader.wgsl[segment.range()];
        let before = text.len() - text.trim_start_matches('\n').len();
        let inside = text.trim_matches('\n').matches('\n').count();
        let first = line + before;
        line += text.matches('\n').count();
        if text.trim_matches('\n').is_empty() {
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
