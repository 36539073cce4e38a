//! The WGSL library of Halfvector: every file of it, embedded, and the slicer that cuts a file into items.
//!
//! The WGSL is ordinary and hand-written; a function whose doc comment says `@node` is a node of the editor. This crate
//! lists and slices text. It does not parse WGSL (naga does, in the crates that need meaning).

mod emit;
pub mod slicer;
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
    "brdf/anisotropic.wgsl",
    "brdf/beckmann.wgsl",
    "brdf/coupling.wgsl",
    "brdf/dfg.wgsl",
    "brdf/diffuse.wgsl",
    "brdf/frame.wgsl",
    "brdf/fresnel.wgsl",
    "brdf/ggx.wgsl",
    "brdf/lobe_anisotropic.wgsl",
    "brdf/lobe_coat.wgsl",
    "brdf/lobe_diffuse.wgsl",
    "brdf/lobe_multiscatter.wgsl",
    "brdf/lobe_sheen.wgsl",
    "brdf/lobe_specular.wgsl",
    "brdf/lobe_transmission.wgsl",
    "brdf/metallic_roughness.wgsl",
    "brdf/multiscatter.wgsl",
    "brdf/sheen.wgsl",
    "brdf/thin_film.wgsl",
    "brdf/visibility.wgsl",
    "color.wgsl",
    "entry/background.wgsl",
    "entry/bake.wgsl",
    "entry/transform.wgsl",
    "ibl/environment.wgsl",
    "ibl/occlusion.wgsl",
    "light.wgsl",
    "maps/blend.wgsl",
    "maps/derivative.wgsl",
    "maps/height.wgsl",
    "maps/normal.wgsl",
    "maps/octahedral.wgsl",
    "maps/parallax.wgsl",
    "maps/texel.wgsl",
    "math.wgsl",
    "nodes/color/adjust.wgsl",
    "nodes/color/blend.wgsl",
    "nodes/color/coding.wgsl",
    "nodes/color/hsv.wgsl",
    "nodes/color/ramp.wgsl",
    "nodes/common.wgsl",
    "nodes/coordinates/point.wgsl",
    "nodes/coordinates/polar.wgsl",
    "nodes/coordinates/tile.wgsl",
    "nodes/coordinates/uv_transform.wgsl",
    "nodes/geometry/direction.wgsl",
    "nodes/geometry/facing.wgsl",
    "nodes/input/constant.wgsl",
    "nodes/input/time.wgsl",
    "nodes/math/abs.wgsl",
    "nodes/math/acos.wgsl",
    "nodes/math/add.wgsl",
    "nodes/math/asin.wgsl",
    "nodes/math/atan2.wgsl",
    "nodes/math/bias.wgsl",
    "nodes/math/ceil.wgsl",
    "nodes/math/clamp.wgsl",
    "nodes/math/compare.wgsl",
    "nodes/math/cos.wgsl",
    "nodes/math/degrees.wgsl",
    "nodes/math/divide.wgsl",
    "nodes/math/exp.wgsl",
    "nodes/math/floor.wgsl",
    "nodes/math/fract.wgsl",
    "nodes/math/gain.wgsl",
    "nodes/math/inverse_sqrt.wgsl",
    "nodes/math/invert.wgsl",
    "nodes/math/log.wgsl",
    "nodes/math/logic.wgsl",
    "nodes/math/max.wgsl",
    "nodes/math/min.wgsl",
    "nodes/math/mix.wgsl",
    "nodes/math/modulo.wgsl",
    "nodes/math/multiply.wgsl",
    "nodes/math/multiply_add.wgsl",
    "nodes/math/negate.wgsl",
    "nodes/math/ping_pong.wgsl",
    "nodes/math/power.wgsl",
    "nodes/math/radians.wgsl",
    "nodes/math/remap.wgsl",
    "nodes/math/round.wgsl",
    "nodes/math/saturate.wgsl",
    "nodes/math/sign.wgsl",
    "nodes/math/sin.wgsl",
    "nodes/math/smooth_min.wgsl",
    "nodes/math/smoothstep.wgsl",
    "nodes/math/sqrt.wgsl",
    "nodes/math/step.wgsl",
    "nodes/math/subtract.wgsl",
    "nodes/math/switch.wgsl",
    "nodes/math/tan.wgsl",
    "nodes/math/truncate.wgsl",
    "nodes/procedural/brick.wgsl",
    "nodes/procedural/checker.wgsl",
    "nodes/procedural/fbm.wgsl",
    "nodes/procedural/gradient.wgsl",
    "nodes/procedural/gradient_noise.wgsl",
    "nodes/procedural/hash.wgsl",
    "nodes/procedural/hexagons.wgsl",
    "nodes/procedural/shapes.wgsl",
    "nodes/procedural/simplex_noise.wgsl",
    "nodes/procedural/value_noise.wgsl",
    "nodes/procedural/white_noise.wgsl",
    "nodes/procedural/worley.wgsl",
    "nodes/surface/surface.wgsl",
    "nodes/textures/height.wgsl",
    "nodes/textures/height_normal.wgsl",
    "nodes/textures/image.wgsl",
    "nodes/textures/image_grad.wgsl",
    "nodes/textures/normal_blend.wgsl",
    "nodes/textures/normal_map.wgsl",
    "nodes/textures/normal_strength.wgsl",
    "nodes/textures/parallax.wgsl",
    "nodes/textures/triplanar.wgsl",
    "nodes/vector/combine.wgsl",
    "nodes/vector/cross.wgsl",
    "nodes/vector/distance.wgsl",
    "nodes/vector/dot.wgsl",
    "nodes/vector/length.wgsl",
    "nodes/vector/normalize.wgsl",
    "nodes/vector/reflect.wgsl",
    "nodes/vector/refract.wgsl",
    "nodes/vector/rotate_about_axis.wgsl",
    "nodes/vector/scale.wgsl",
    "nodes/vector/separate.wgsl",
    "tone_map.wgsl",
];

/// The shader of the environment behind the objects: `entry/background.wgsl` with the files that it calls. Its entry points
/// are `vs_background` and `fs_background`.
pub fn background() -> String {
    let parts = ["color.wgsl", "ibl/environment.wgsl", "entry/background.wgsl"];
    let texts: Vec<&str> = FILES.iter().filter(|file| parts.contains(&file.path)).map(|file| file.source).collect();
    texts.join("\n")
}
