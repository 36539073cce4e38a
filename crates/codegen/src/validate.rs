//! The judge of every shader before it is used: naga parses and validates the text, and an error is told of the node or
//! library file that caused it.

use std::fmt;

use halfvector_graph::library::CAPABILITIES;
use naga::valid::{ModuleInfo, ValidationFlags, Validator};

use crate::Shader;
use crate::emit::text::Origin;

/// A shader that naga accepts, with what naga knows of it.
pub struct Valid {
    pub(crate) module: naga::Module,
    pub(crate) info: ModuleInfo,
}

impl fmt::Debug for Valid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Valid").field("entry_points", &self.module.entry_points.len()).finish_non_exhaustive()
    }
}

/// A place in a shader's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Byte of the text.
    pub offset: usize,
    /// From 1.
    pub line: usize,
    /// The node or file that the text comes from.
    pub origin: Origin,
}

/// What naga has against a shader.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}", place.as_ref().map(|p| p.to_string()).unwrap_or_default())]
pub struct ValidationError {
    /// naga's words.
    pub message: String,
    /// Where, when naga says so.
    pub place: Option<Place>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.origin {
            Origin::Node(id) => write!(f, "node `{id}`, line {}: ", self.line),
            Origin::Library(file) if file.starts_with("custom/") => {
                write!(
                    f,
                    "the material's own function `{}`, line {} of the shader: ",
                    &file["custom/".len()..],
                    self.line
                )
            }
            Origin::Library(file) => write!(f, "shaders/{file}, line {} of the shader: ", self.line),
            Origin::Frame(_) => write!(f, "line {} of the shader: ", self.line),
        }
    }
}

/// Parses and validates a shader.
///
/// # Errors
/// naga's first complaint, with the node or file that it falls on.
pub fn validate(shader: &Shader) -> Result<Valid, ValidationError> {
    let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|e| {
        let spans = e.labels().filter_map(|(span, _)| span.to_range()).map(|range| range.start);
        let labels: Vec<&str> = e.labels().map(|(_, label)| label).filter(|label| !label.is_empty()).collect();
        let message =
            if labels.is_empty() { e.message().to_owned() } else { format!("{} ({})", e.message(), labels.join("; ")) };
        ValidationError { message, place: place(shader, spans) }
    })?;
    let info = validate_module(&module)
        .map_err(|(message, offsets)| ValidationError { message, place: place(shader, offsets.into_iter()) })?;
    Ok(Valid { module, info })
}

/// Validates a module; an error comes with the bytes it is about, the most precise last.
pub(crate) fn validate_module(module: &naga::Module) -> Result<ModuleInfo, (String, Vec<usize>)> {
    Validator::new(ValidationFlags::all(), CAPABILITIES).validate(module).map_err(|e| {
        let offsets = e.spans().filter_map(|(span, _)| span.to_range()).map(|range| range.start).collect();
        let mut message = e.as_inner().to_string();
        let mut source = std::error::Error::source(e.as_inner());
        while let Some(cause) = source {
            message = format!("{message}: {cause}");
            source = cause.source();
        }
        (message, offsets)
    })
}

/// The place of an error: the first of its offsets that falls on a node, else on a library file, else the first.
fn place(shader: &Shader, offsets: impl Iterator<Item = usize>) -> Option<Place> {
    let places: Vec<Place> = offsets.filter_map(|offset| place_of(shader, offset)).collect();
    let rank = |place: &Place| match place.origin {
        Origin::Node(_) => 0,
        Origin::Library(_) => 1,
        Origin::Frame(_) => 2,
    };
    places.into_iter().min_by_key(rank)
}

/// Where a byte of a shader's text comes from.
pub fn place_of(shader: &Shader, offset: usize) -> Option<Place> {
    let segment = shader.segments.iter().find(|segment| segment.range().contains(&offset))?;
    let line = 1 + shader.wgsl.as_bytes()[..offset].iter().filter(|b| **b == b'\n').count();
    Some(Place { offset, line, origin: segment.origin.clone() })
}
