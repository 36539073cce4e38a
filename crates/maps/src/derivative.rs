//! Tangents where a mesh has none: from the derivatives of position and texture coordinates along two directions of the
//! screen. Twin of `shaders/maps/derivative.wgsl`. It takes the derivatives, not the functions: a shader has `dpdx`.

use crate::normal::normal_tbn;
use crate::real::{Real, cross, dot, normalize_or, plus_z, real, scale, sub};

/// The tangent along which u grows, and the handedness (w), of the surface that a pixel shows: what MikkTSpace gives a
/// triangle that shares no vertex. Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU", and Schueler 2013,
/// "Followup: Normal Mapping Without Precomputed Tangents". With p the position, (u, v) the texture coordinates (v runs
/// down the picture) and x, y two directions, commonly the screen's:
///
/// ```text
/// d = u_x v_y - u_y v_x,   p_u = (p_x v_y - p_y v_x) / d,   T = normalize(p_u - N (N . p_u)),
/// w = -sign(d N . (p_x x p_y)),   B = w cross(N, T)
/// ```
///
/// `normal` is made unit; a zero one is +Z. Where texture coordinates do not move, or along one line only, or where the
/// point does not move, T is zero, which [`normal_tbn`] reads as: any tangent will do.
pub fn tangent_from_derivatives<R: Real>(
    position_ddx: [R; 3],
    position_ddy: [R; 3],
    normal: [R; 3],
    uv_ddx: [R; 2],
    uv_ddy: [R; 2],
) -> [R; 4] {
    let n = normalize_or(normal, plus_z());
    let d = uv_ddx[0] * uv_ddy[1] - uv_ddy[0] * uv_ddx[1];
    let sum = sub(scale(position_ddx, uv_ddy[1]), scale(position_ddy, uv_ddx[1]));
    let along_u = if d < real(0.0) { sum.map(|x| -x) } else { sum };
    let in_plane = sub(along_u, scale(n, dot(n, along_u)));
    // Along N but for rounding there is no direction within the surface.
    let usable = dot(in_plane, in_plane) > real::<R>(1e-10) * dot(along_u, along_u) && d.abs() > real(0.0);
    let zero = [real(0.0); 3];
    let [x, y, z] = if usable { normalize_or(in_plane, zero) } else { zero };
    let faces = dot(n, cross(position_ddx, position_ddy));
    [x, y, z, real(if (faces < real(0.0)) == (d < real(0.0)) { -1.0 } else { 1.0 })]
}

/// Normal mapping by the tangent frame of the pixel ([`tangent_from_derivatives`]): it needs no tangents of the mesh. On
/// flat faces it is [`normal_tbn`] with MikkTSpace's tangents; where vertices share tangents, its frame is that of the
/// face instead and turns at edges.
pub fn normal_tbn_derivative<R: Real>(
    n_tangent: [R; 3],
    position_ddx: [R; 3],
    position_ddy: [R; 3],
    normal: [R; 3],
    uv_ddx: [R; 2],
    uv_ddy: [R; 2],
) -> [R; 3] {
    normal_tbn(n_tangent, normal, tangent_from_derivatives(position_ddx, position_ddy, normal, uv_ddx, uv_ddy))
}

/// The tangent-space normal of a height field with these slopes, by distance along T and along B: (-h_t, -h_b, 1), unit.
pub fn normal_from_slopes<R: Real>(slope_along_tangent: R, slope_along_bitangent: R) -> [R; 3] {
    normalize_or([-slope_along_tangent, -slope_along_bitangent, real(1.0)], plus_z())
}
