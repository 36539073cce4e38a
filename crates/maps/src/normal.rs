//! Normal maps: from a texel to a tangent-space direction, and from there onto the surface, by tangent frame or by the
//! report's rotations. Twin of `shaders/maps/normal.wgsl`.
//!
//! A texel's +Y is the bitangent's way (OpenGL); a -Y (DirectX) map is flipped when it is read. Every function returns a
//! finite unit vector for every input, NaN and infinity included. Nothing here knows images; [`crate::mip`] averages them.

use crate::real::{Real, add, cross, dot, normalize_or, plus_z, real, scale};

/// The tangent-space unit normal that a texel says. `color` is the texel in 0..1: t = 2 c - 1, x and y scaled by
/// `strength` (1 leaves them), y turned over by `flip_y`. A texel that says nothing, such as (.5, .5, .5), is straight up.
/// Read as unorm: 8-bit (128, 128, 255) leans by 0.32 degrees.
#[inline]
pub fn normal_from_texel<R: Real>(color: [R; 3], strength: R, flip_y: bool) -> [R; 3] {
    let t = color.map(|c| real::<R>(2.0) * c - real(1.0));
    let y = if flip_y { -t[1] } else { t[1] };
    normalize_or([t[0] * strength, y * strength, t[2]], plus_z())
}

/// A unit tangent of any unit normal, without a pole. Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin 2017,
/// "Building an Orthonormal Basis, Revisited": with s = +-1, the sign of n.z,
///
/// ```text
/// a = -1 / (s + n.z),  T = (1 + s n.x^2 a, s n.x n.y a, -s n.x),  and B = cross(n, T)
/// ```
pub fn tangent_from_normal<R: Real>(normal: [R; 3]) -> [R; 3] {
    let s: R = real(if normal[2] >= real(0.0) { 1.0 } else { -1.0 });
    let a = real::<R>(-1.0) / (s + normal[2]);
    [real::<R>(1.0) + s * normal[0] * normal[0] * a, s * normal[0] * normal[1] * a, -s * normal[0]]
}

/// Normal mapping by tangent frame. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited": with N and T as they
/// come interpolated, not made orthonormal again, and w the handedness (+-1 in `tangent[3]`),
///
/// ```text
/// B = w cross(N, T),   n = normalize(t.x T + t.y B + t.z N)
/// ```
///
/// A tangent that is zero or along N is replaced by any across N; a zero normal is +Z.
pub fn normal_tbn<R: Real>(n_tangent: [R; 3], normal: [R; 3], tangent: [R; 4]) -> [R; 3] {
    let unit_normal = normalize_or(normal, plus_z());
    let normal = if dot(normal, normal) > real(0.0) { normal } else { unit_normal };
    let [x, y, z, w] = tangent;
    let t = [x, y, z];
    let across = cross(unit_normal, t);
    // |N x T| <= 1e-6 |N| |T|: the direction of B would be rounding noise, or 0 / 0.
    let usable = dot(across, across) > real::<R>(1e-12) * dot(t, t);
    let (t, n) = if usable { (t, normal) } else { (any_tangent(unit_normal), unit_normal) };
    let b = scale(cross(n, t), if w < real(0.0) { real(-1.0) } else { real(1.0) });
    let sum = add(add(scale(t, n_tangent[0]), scale(b, n_tangent[1])), scale(n, n_tangent[2]));
    normalize_or(sum, unit_normal)
}

/// A unit direction across a unit normal, any.
fn any_tangent<R: Real>(normal: [R; 3]) -> [R; 3] {
    let (zero, one) = (real(0.0), real(1.0));
    let aside = if normal[0].abs() > real(0.7) { [zero, one, zero] } else { [one, zero, zero] };
    normalize_or(cross(normal, aside), aside)
}

/// (cos, sin) of atan2(y, x), without the angle: (x, y) / |(x, y)|. Both zero is the angle 0.
fn cos_sin_atan2<R: Real>(y: R, x: R) -> [R; 2] {
    let length_squared = x * x + y * y;
    if length_squared > real(0.0) {
        let inverse = real::<R>(1.0) / length_squared.sqrt();
        [x * inverse, y * inverse]
    } else {
        [real(1.0), real(0.0)]
    }
}

/// (cos, sin) of atan(y / x), without the angle: atan2 with the fraction's sign carried by y.
/// atan(y / 0) = sign(y) pi/2 and atan(0 / 0) = 0.
fn cos_sin_atan<R: Real>(y: R, x: R) -> [R; 2] {
    cos_sin_atan2(if x < real(0.0) { -y } else { y }, x.abs())
}

/// Normal mapping by rotation, exactly as the report gives it: with t the texel's direction,
///
/// ```text
/// ax = atan(t.y / t.z),  ay = atan(t.x / t.z),  az = atan(t.y / t.z),   n = Rz(az) Ry(ay) Rx(ax) N
/// ```
///
/// about the axes of the space that N is in (world). Only cosine and sine of the angles are needed, and those are
/// algebraic. It is kept to be measured: it needs no tangents. On N = +X it is near the truth (Rz is the turn that lifts
/// that normal); on +Z a tilt in y becomes a tilt of twice itself the other way. The README has the table.
pub fn normal_rotation_report<R: Real>(n_tangent: [R; 3], normal: [R; 3]) -> [R; 3] {
    let n = normalize_or(normal, plus_z());
    let x = cos_sin_atan(n_tangent[1], n_tangent[2]);
    let y = cos_sin_atan(n_tangent[0], n_tangent[2]);
    let z = x;
    let about_x = [n[0], x[0] * n[1] - x[1] * n[2], x[1] * n[1] + x[0] * n[2]];
    let about_y = [y[0] * about_x[0] + y[1] * about_x[2], about_x[1], y[0] * about_x[2] - y[1] * about_x[0]];
    let about_z = [z[0] * about_y[0] - z[1] * about_y[1], z[1] * about_y[0] + z[0] * about_y[1], about_y[2]];
    normalize_or(about_z, n)
}

/// Normal mapping by rotation with its signs mended: Ry(ay) Rx(-ax) N, without Rz. On N = +Z this is
///
/// ```text
/// (cos ax sin ay, sin ax, cos ax cos ay)
/// ```
///
/// whose x / z = t.x / t.z is the texel's own and whose y / z = (t.y / t.z) / cos ay is not quite, since the second
/// rotation shortens what the first one did. ax = atan(t.y / |t.z|) and ay = atan2(t.x, t.z) keep the quadrant of a texel
/// that points below the surface. On +Z the error is at most 0.2 degrees for a tilt of 15, 1.7 for 30, 5.9 for 45. The axes
/// are still those of N's space, so away from +Z the tilt goes astray: the README has the table.
pub fn normal_rotation_fixed<R: Real>(n_tangent: [R; 3], normal: [R; 3]) -> [R; 3] {
    let n = normalize_or(normal, plus_z());
    let x = cos_sin_atan2(n_tangent[1], n_tangent[2].abs());
    let y = cos_sin_atan2(n_tangent[0], n_tangent[2]);
    let about_x = [n[0], x[0] * n[1] + x[1] * n[2], x[0] * n[2] - x[1] * n[1]];
    let about_y = [y[0] * about_x[0] + y[1] * about_x[2], about_x[1], y[0] * about_x[2] - y[1] * about_x[0]];
    normalize_or(about_y, n)
}
