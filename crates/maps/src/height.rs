//! Height maps: moving a vertex along its normal, and the normal of the moved surface from derivatives.
//! Twin of `shaders/maps/height.wgsl`. Does not sample images.

use crate::real::{Real, add, cross, dot, normalize_or, real, scale, sub};

/// The position moved along its unit normal by `height` (a length in the position's unit).
pub fn displaced<R: Real>(position: [R; 3], normal: [R; 3], height: R) -> [R; 3] {
    add(position, scale(normal, height))
}

/// The unit normal of the surface raised by a height field. Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the
/// GPU": with the derivatives of the position, p_x and p_y, along any two directions (the screen's),
///
/// ```text
/// R1 = p_y x n,  R2 = n x p_x,  det = p_x . R1,   grad = (h_x R1 + h_y R2) / det,   n' = normalize(n - grad)
/// ```
///
/// The derivatives of the height are along the same two directions. `normal` is the old one, unit; an empty footprint keeps it.
/// Of the displaced position p + h n the derivatives along x are p_x + h n_x + h_x n, whose part across n holds how much wider
/// or narrower a curved surface is at that height: with them n' is exact. Those of p alone give the slope that it has at
/// height 0.
pub fn normal_from_height<R: Real>(
    position_ddx: [R; 3],
    position_ddy: [R; 3],
    normal: [R; 3],
    height_ddx: R,
    height_ddy: R,
) -> [R; 3] {
    let r1 = cross(position_ddy, normal);
    let r2 = cross(normal, position_ddx);
    let det = dot(position_ddx, r1);
    // A footprint of no area (under 1e-30, where 1 / det nears overflow in f32) has no gradient.
    if det.abs() > real(1e-30) {
        let gradient = add(scale(r1, height_ddx), scale(r2, height_ddy)).map(|x| x / det);
        normalize_or(sub(normal, gradient), normal)
    } else {
        normalize_or(normal, normal)
    }
}

/// The tangent (w is its handedness) of the surface raised by a height field: moved along the old normal into the new surface,
///
/// ```text
/// t' ~ t - n (t . n') / (n . n')
/// ```
///
/// which for a flat surface is t + n (t . grad h), exactly. Written as t (n . n') - n (t . n'), which divides by nothing; not
/// unit. Both normals are unit.
pub fn displaced_tangent<R: Real>(normal: [R; 3], tangent: [R; 4], displaced_normal: [R; 3]) -> [R; 4] {
    let [x, y, z, w] = tangent;
    let t = [x, y, z];
    let [x, y, z] = sub(scale(t, dot(normal, displaced_normal)), scale(normal, dot(t, displaced_normal)));
    [x, y, z, w]
}
