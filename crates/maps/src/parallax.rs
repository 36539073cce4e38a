//! Parallax occlusion: where the line of sight meets a height field below the mesh, as texture coordinates.
//! Twin of `shaders/maps/parallax.wgsl`. The mesh lies at the field's top (value 1); nothing sticks out, so silhouettes
//! stay those of the mesh. Shadows of the relief on itself are not traced.

use crate::normal::tangent_from_normal;
use crate::real::{Real, cross, dot, normalize_or, plus_z, real, scale, sub};

/// Steps of the linear search. A ridge narrower than a 32nd of the way is stepped over.
pub const PARALLAX_STEPS: u32 = 32;
/// Halvings of the last step.
pub const PARALLAX_HALVINGS: u32 = 5;
/// Least cosine between view and normal that the way is computed with, so that it has an end: 2.9 degrees.
const LEAST_COSINE: f64 = 0.05;

/// How far the texture coordinates move on the way from value 1 to value 0 along the line of sight:
///
/// ```text
/// -depth (v.T, -v.B) / max(v.N, 0.05),   B = w cross(N, T)
/// ```
///
/// `depth` is the distance between white and black, in units of the texture's edge. `view_dir` points to the viewer.
/// v runs down the picture, against B. A tangent that is zero or along N is replaced as in
/// [`normal_tbn`](crate::normal::normal_tbn).
pub fn parallax_offset<R: Real>(view_dir: [R; 3], normal: [R; 3], tangent: [R; 4], depth: R) -> [R; 2] {
    let n = normalize_or(normal, plus_z());
    let [x, y, z, w] = tangent;
    let in_plane = sub([x, y, z], scale(n, dot(n, [x, y, z])));
    let usable = dot(in_plane, in_plane) > real::<R>(1e-12) * dot([x, y, z], [x, y, z]);
    let fallback = tangent_from_normal(n);
    let t = if usable { normalize_or(in_plane, fallback) } else { fallback };
    let b = scale(cross(n, t), real(if usable && w < real(0.0) { -1.0 } else { 1.0 }));
    let v = normalize_or(view_dir, n);
    let cosine = dot(v, n);
    let least = real(LEAST_COSINE);
    let reach = depth / if cosine > least { cosine } else { least };
    [-reach * dot(v, t), reach * dot(v, b)]
}

/// Where the line of sight meets the height field that `height` says (0..1), on the way from `uv` to `uv + offset`: the
/// first of [`PARALLAX_STEPS`] equal steps that is not above the field, halved [`PARALLAX_HALVINGS`] times, and the chord
/// between its ends. Tatarchuk 2006, "Practical Parallax Occlusion Mapping". A black field is met at the end of the
/// way, the floor; a height that is no number ends the search where it stands.
pub fn parallax_occlusion<R: Real>(height: impl Fn([R; 2]) -> R, uv: [R; 2], offset: [R; 2]) -> [R; 2] {
    let at = |t: R| [uv[0] + offset[0] * t, uv[1] + offset[1] * t];
    // How far the line is above the field.
    let above = |t: R| real::<R>(1.0) - t - height(at(t));
    let step = real::<R>(1.0 / f64::from(PARALLAX_STEPS));
    let (mut low, mut above_low) = (real::<R>(0.0), above(real(0.0)));
    let (mut high, mut above_high) = (low, above_low);
    for _ in 0..PARALLAX_STEPS {
        if above_high > real(0.0) {
            (low, above_low) = (high, above_high);
            high = high + step;
            above_high = above(high);
        }
    }
    for _ in 0..PARALLAX_HALVINGS {
        let middle = real::<R>(0.5) * (low + high);
        let above_middle = above(middle);
        if above_middle > real(0.0) {
            (low, above_low) = (middle, above_middle);
        } else {
            (high, above_high) = (middle, above_middle);
        }
    }
    // Both are at one place, or the line leaves the field there, when the denominator is 0.
    let gap = above_low - above_high;
    let part = if gap > real(1e-12) { above_low / gap } else { real(1.0) };
    at(low + (high - low) * if part < real(1.0) { part } else { real(1.0) })
}
