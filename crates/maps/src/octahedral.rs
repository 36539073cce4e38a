//! Directions in two numbers of -1..1, for normals and tangents in two 16- or 8-bit halves of a word.
//! Twin of `shaders/maps/octahedral.wgsl`. Rounding to bits is the caller's: WGSL has `pack2x16snorm` and `pack2x16float`.

use crate::real::{Real, normalize_or, plus_z, real};

/// The octahedron |x| + |y| + |z| = 1, its lower half folded out over the corners of the square. Meyer, Suessmuth, Sussner,
/// Stamminger, Greiner 2010, "On Floating-Point Normal Vectors".
///
/// ```text
/// p = n.xy / (|n.x| + |n.y| + |n.z|),   below z = 0: (1 - |p.yx|) sign(p)
/// ```
///
/// The length of `n` does not matter; a vector without a direction is coded as +Z, (0, 0).
pub fn octahedral_from_direction<R: Real>(n: [R; 3]) -> [R; 2] {
    let [x, y, z] = normalize_or(n, plus_z());
    let sum = x.abs() + y.abs() + z.abs();
    let (px, py) = (x / sum, y / sum);
    if z < real(0.0) { folded(px, py) } else { [px, py] }
}

/// The unit direction that two numbers stand for: the inverse of [`octahedral_from_direction`], finite for every input.
/// Stored in 16 bits a number it is within 0.0037 degrees, in 8 bits within 0.95.
pub fn direction_from_octahedral<R: Real>(p: [R; 2]) -> [R; 3] {
    let z = real::<R>(1.0) - p[0].abs() - p[1].abs();
    let [x, y] = if z < real(0.0) { folded(p[0], p[1]) } else { p };
    normalize_or([x, y, z], plus_z())
}

/// The point mirrored at the edge |x| + |y| = 1 of its quadrant.
fn folded<R: Real>(x: R, y: R) -> [R; 2] {
    let mirrored = |a: R, other: R| {
        let size = real::<R>(1.0) - other.abs();
        if a < real(0.0) { -size } else { size }
    };
    [mirrored(x, y), mirrored(y, x)]
}
