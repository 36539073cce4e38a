//! Two normal maps as one, and a normal map made stronger or weaker. Twin of `shaders/maps/blend.wgsl`.
//!
//! Normals are unit, in tangent space, +Z up; results are unit and finite for every input. The README has the error of
//! each form against the true composite of two height fields: [`blend_partial_derivatives`] is exact for heights that are
//! added; [`blend_rnm`] for a detail raised on the base that is not stretched by its slopes.
//! Barre-Brisebois and Hill 2012, "Blending in Detail", has the history of all forms.

use crate::real::{Real, dot, normalize_or, plus_z, real, scale, sub};

/// The normal with its slopes times `strength`: 0 is flat, 1 leaves it, -1 turns bumps into dents. Of a height field this
/// is the normal of `strength` times the height. A normal with z = 0 stays where it is.
pub fn normal_with_strength<R: Real>(n_tangent: [R; 3], strength: R) -> [R; 3] {
    normalize_or([n_tangent[0] * strength, n_tangent[1] * strength, n_tangent[2]], plus_z())
}

/// The colour that a normal has in a +Y map: 0.5 n + 0.5. The inverse of
/// [`normal_from_texel`](crate::normal::normal_from_texel) with strength 1.
pub fn texel_from_normal<R: Real>(n_tangent: [R; 3]) -> [R; 3] {
    n_tangent.map(|x| real::<R>(0.5) * x + real(0.5))
}

/// Linear: normalize(base + detail). Flattens both: a flat detail halves the base's tilt. Opposed normals give the base.
pub fn blend_linear<R: Real>(base: [R; 3], detail: [R; 3]) -> [R; 3] {
    blended([base[0] + detail[0], base[1] + detail[1], base[2] + detail[2]], base)
}

/// Partial derivatives: the slopes of the two height fields are added, as those of their sum are.
///
/// ```text
/// n = normalize(b.xy d.z + d.xy b.z, b.z d.z)
/// ```
///
/// Exact for added heights. Where both are upright walls (z = 0) there is no sum: the base.
pub fn blend_partial_derivatives<R: Real>(base: [R; 3], detail: [R; 3]) -> [R; 3] {
    let along = |axis: usize| base[axis] * detail[2] + detail[axis] * base[2];
    blended([along(0), along(1), base[2] * detail[2]], base)
}

/// Whiteout, from AMD's demo of that name (2007): normalize(b.xy + d.xy, b.z d.z).
pub fn blend_whiteout<R: Real>(base: [R; 3], detail: [R; 3]) -> [R; 3] {
    blended([base[0] + detail[0], base[1] + detail[1], base[2] * detail[2]], base)
}

/// UDN, from the Unreal Developer Network: normalize(b.xy + d.xy, b.z). The cheapest; weakens detail on slopes.
pub fn blend_udn<R: Real>(base: [R; 3], detail: [R; 3]) -> [R; 3] {
    blended([base[0] + detail[0], base[1] + detail[1], base[2]], base)
}

/// Reoriented: the detail turned by the shortest rotation that takes +Z to the base. Barre-Brisebois and Hill 2012.
///
/// ```text
/// t = b + (0, 0, 1),   u = d (-1, -1, 1),   n = normalize(t (t . u) - u t.z)
/// ```
///
/// A base of -Z has no shortest rotation: the base.
pub fn blend_rnm<R: Real>(base: [R; 3], detail: [R; 3]) -> [R; 3] {
    let t = [base[0], base[1], base[2] + real(1.0)];
    let u = [-detail[0], -detail[1], detail[2]];
    blended(sub(scale(t, dot(t, u)), scale(u, t[2])), base)
}

/// The blend as a unit vector; the base, or +Z, where there is none.
fn blended<R: Real>(sum: [R; 3], base: [R; 3]) -> [R; 3] {
    normalize_or(sum, normalize_or(base, plus_z()))
}
