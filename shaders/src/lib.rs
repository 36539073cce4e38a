//! The WGSL library of Halfvector: every file of it, embedded, and the slicer that cuts a file into items.
//!
//! The WGSL is ordinary and hand-written; a function whose doc comment says `@node` is a node of the editor. This crate
//! lists and slices text. It does not parse WGSL (naga does, in the crates that need meaning).

mod emit;
mod slicer;
mod token;

pub use emit::{emit, without_grammar};
pub use slicer::{Item, ItemKind, MAX_NESTING, MAX_OPERATORS, SliceError, SliceErrorKind, generic_types, slice};
pub use token::{Token, TokenKind, tokens};

/// A WGSL file of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct File {
    /// Path below `shaders/`, such as `brdf/ggx.wgsl`.
    pub path: &'static str,
    /// The text.
    pub source: &'static str,
}

macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$(File { path: $path, source: include_str!(concat!("../", $path)) }),*]
    };
}

/// All files, sorted by path. A tidy test holds this list against the folder.
pub const FILES: &[File] = files![
    "brdf/dfg.wgsl",
    "brdf/diffuse.wgsl",
    "brdf/frame.wgsl",
    "brdf/fresnel.wgsl",
    "brdf/ggx.wgsl",
    "brdf/lobe_diffuse.wgsl",
    "brdf/lobe_specular.wgsl",
    "brdf/metallic_roughness.wgsl",
    "brdf/multiscatter.wgsl",
    "color.wgsl",
    "entry/background.wgsl",
    "ibl/environment.wgsl",
    "light.wgsl",
    "maps/height.wgsl",
    "maps/normal.wgsl",
    "math.wgsl",
    "tone_map.wgsl",
];
