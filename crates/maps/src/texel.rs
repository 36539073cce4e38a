//! Other readings of a normal map's texel than 2 c - 1: centred on code 128, and from two channels.
//! Twin of `shaders/maps/texel.wgsl`. The plain reading is [`crate::normal::normal_from_texel`]; all have its signature.

use crate::real::{Real, normalize_or, plus_z, real};

/// The tangent-space unit normal of a texel whose zero is code 128 of 255: signed 8-bit numbers moved up by 128, as many
/// bakers write them.
///
/// ```text
/// t = max((255 c - 128) / 127, -1)
/// ```
///
/// (128, 128, 255) is straight up, where 2 c - 1 leans by 0.318 degrees; codes 0 and 1 are both -1. x and y are scaled by
/// `strength`, y is turned over by `flip_y`. For 16-bit maps 2 c - 1 leans by 0.0012 degrees only, and this reading is not
/// meant.
pub fn normal_from_texel_snorm<R: Real>(color: [R; 3], strength: R, flip_y: bool) -> [R; 3] {
    let t = color.map(|c| {
        let t = (real::<R>(255.0) * c - real(128.0)) / real(127.0);
        if t < real(-1.0) { real(-1.0) } else { t }
    });
    let y = if flip_y { -t[1] } else { t[1] };
    normalize_or([t[0] * strength, y * strength, t[2]], plus_z())
}

/// The colour that a normal has in a map whose zero is code 128: (127 n + 128) / 255. The inverse of
/// [`normal_from_texel_snorm`] with strength 1, as [`texel_from_normal`](crate::blend::texel_from_normal) is of the plain
/// reading; what writes a texel has to be what reads it.
pub fn texel_from_normal_snorm<R: Real>(n_tangent: [R; 3]) -> [R; 3] {
    n_tangent.map(|x| (real::<R>(127.0) * x + real(128.0)) / real(255.0))
}

/// The tangent-space unit normal of a texel with x and y only (BC5, ATI2, 3Dc; red and green), the third channel not read:
///
/// ```text
/// (x, y) = 2 c - 1,   z = sqrt(max(0, 1 - x^2 - y^2))
/// ```
///
/// Where compression has made x^2 + y^2 > 1, z is 0 and the result lies on the horizon, made unit. x and y are scaled by
/// `strength` after z is found, y is turned over by `flip_y`.
pub fn normal_from_texel_two_channel<R: Real>(color: [R; 3], strength: R, flip_y: bool) -> [R; 3] {
    let x = real::<R>(2.0) * color[0] - real(1.0);
    let y = real::<R>(2.0) * color[1] - real(1.0);
    let z_squared = real::<R>(1.0) - x * x - y * y;
    let z = if z_squared > real(0.0) { z_squared.sqrt() } else { real(0.0) };
    let y = if flip_y { -y } else { y };
    normalize_or([x * strength, y * strength, z], plus_z())
}
