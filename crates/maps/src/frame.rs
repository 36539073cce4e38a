//! Frames under transforms: the matrix that carries normals, and what a mirror does to handedness.
//! Does not interpolate and does not build tangents ([`crate::tangents()`] does).
//!
//! A matrix is three columns. Directions within the surface, tangents among them, go by the matrix itself; normals go by
//! [`normal_from_object`]; the handedness w of a tangent is multiplied by [`handedness`].

use crate::real::{Real, cross, dot, real, scale};

/// The cofactor matrix, det(M) M^-T, which exists for singular matrices too: its columns are m1 x m2, m2 x m0, m0 x m1.
pub fn cofactor<R: Real>(m: [[R; 3]; 3]) -> [[R; 3]; 3] {
    [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])]
}

/// -1 where the matrix mirrors (negative determinant), otherwise 1, also for a singular one.
pub fn handedness<R: Real>(m: [[R; 3]; 3]) -> R {
    let m = unit_range(m);
    real(if dot(m[0], cross(m[1], m[2])) < real(0.0) { -1.0 } else { 1.0 })
}

/// The matrix that takes normals from object to world space: sign(det M) cof(M), a positive multiple of the inverse
/// transpose where there is one, so that a normal still points out of a mirrored object. Only the direction of a
/// transformed normal means anything; normalise it. For a matrix that flattens to a plane it gives the plane's normal.
pub fn normal_from_object<R: Real>(world_from_object: [[R; 3]; 3]) -> [[R; 3]; 3] {
    let s = handedness(world_from_object);
    cofactor(unit_range(world_from_object)).map(|column| scale(column, s))
}

/// m times v.
pub fn transformed<R: Real>(m: [[R; 3]; 3], v: [R; 3]) -> [R; 3] {
    [0, 1, 2].map(|row| m[0][row] * v[0] + m[1][row] * v[1] + m[2][row] * v[2])
}

/// The matrix divided by its largest element, so that products of three elements neither overflow nor vanish.
fn unit_range<R: Real>(m: [[R; 3]; 3]) -> [[R; 3]; 3] {
    let largest = m.as_flattened().iter().fold(real::<R>(0.0), |a, x| if x.abs() > a { x.abs() } else { a });
    if largest > real(0.0) { m.map(|column| column.map(|x| x / largest)) } else { m }
}
