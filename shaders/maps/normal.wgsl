// Normal maps: from a texel to a tangent-space direction, and from there onto the surface, by tangent frame or by the
// report's rotations. A texel's +Y is the bitangent's way (OpenGL); a -Y (DirectX) map is flipped when it is read.

/// The tangent-space unit normal that a texel says: t = 2 c - 1, x and y scaled by `strength`, y turned over by
/// `flip_y`. A texel that says nothing, such as (.5, .5, .5), is straight up. Read as unorm: 8-bit (128, 128, 255) leans
/// by 0.32 degrees.
fn normal_from_texel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    return normalize_or(tilt_from_texel(color, strength, flip_y), vec3f(0.0, 0.0, 1.0));
}

/// normal_from_texel before it is made unit; zero for a texel that says nothing.
fn tilt_from_texel(color: vec3f, strength: f32, flip_y: bool) -> vec3f {
    let t = fma(color, vec3f(2.0), vec3f(-1.0));
    let y = select(t.y, -t.y, flip_y);
    return vec3f(t.x * strength, y * strength, t.z);
}

/// A unit tangent of any unit normal, without a pole. Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin 2017,
/// "Building an Orthonormal Basis, Revisited": with s = +-1, the sign of n.z,
///   a = -1 / (s + n.z),  T = (1 + s n.x^2 a, s n.x n.y a, -s n.x),  and B = cross(n, T).
fn tangent_from_normal(normal: vec3f) -> vec3f {
    let s = f32(select(-1.0, 1.0, normal.z >= 0.0));
    let a = -1.0 / (s + normal.z);
    return vec3f(1.0 + s * normal.x * normal.x * a, s * normal.x * normal.y * a, -s * normal.x);
}

/// Normal mapping by tangent frame. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited": with N and T as they
/// come interpolated, not made orthonormal again, and w the handedness (+-1 in `tangent.w`),
///   B = w cross(N, T),   n = normalize(t.x T + t.y B + t.z N)
/// A tangent that is zero or along N is replaced by any across N; a zero normal is +Z.
fn normal_tbn(n_tangent: vec3f, normal: vec3f, tangent: vec4f) -> vec3f {
    let unit_normal = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    return bent_normal(n_tangent, select(unit_normal, normal, dot(normal, normal) > 0.0), unit_normal, tangent);
}

/// normal_tbn of a direction `n_tangent` of any length, zero being straight up, where the unit normal is known.
fn bent_normal(n_tangent: vec3f, normal: vec3f, unit_normal: vec3f, tangent: vec4f) -> vec3f {
    let across = cross(unit_normal, tangent.xyz);
    // |N x T| <= 1e-6 |N| |T|: the direction of B would be rounding noise, or 0 / 0.
    let usable = dot(across, across) > 1e-12 * dot(tangent.xyz, tangent.xyz);
    let t = select(any_tangent(unit_normal), tangent.xyz, usable);
    let n = select(unit_normal, normal, usable);
    let b = f32(select(1.0, -1.0, tangent.w < 0.0)) * cross(n, t);
    return normalize_or(mat3x3f(t, b, n) * n_tangent, unit_normal);
}

// (cos, sin) of atan2(y, x), without the angle: (x, y) / |(x, y)|. Both zero is the angle 0.
fn cos_sin_atan2(y: f32, x: f32) -> vec2f {
    let length_squared = x * x + y * y;
    return select(vec2f(1.0, 0.0), vec2f(x, y) * inverseSqrt(length_squared), length_squared > 0.0);
}

// (cos, sin) of atan(y / x), without the angle: atan2 with the fraction's sign carried by y.
// atan(y / 0) = sign(y) pi/2 and atan(0 / 0) = 0.
fn cos_sin_atan(y: f32, x: f32) -> vec2f {
    return cos_sin_atan2(select(y, -y, x < 0.0), abs(x));
}

/// Normal mapping by rotation, exactly as the report gives it: with t the texel's direction,
///   ax = atan(t.y / t.z),  ay = atan(t.x / t.z),  az = atan(t.y / t.z),   n = Rz(az) Ry(ay) Rx(ax) N
/// about the axes of the space that N is in (world). Only cosine and sine of the angles are needed, and those are
/// algebraic. It is kept to be measured: it needs no tangents. On N = +X it is near the truth (Rz is the turn that lifts
/// that normal); on +Z a tilt in y becomes a tilt of twice itself the other way.
fn normal_rotation_report(n_tangent: vec3f, normal: vec3f) -> vec3f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let x = cos_sin_atan(n_tangent.y, n_tangent.z);
    let y = cos_sin_atan(n_tangent.x, n_tangent.z);
    let z = x;
    let about_x = vec3f(n.x, x.x * n.y - x.y * n.z, x.y * n.y + x.x * n.z);
    let about_y = vec3f(y.x * about_x.x + y.y * about_x.z, about_x.y, y.x * about_x.z - y.y * about_x.x);
    let about_z = vec3f(z.x * about_y.x - z.y * about_y.y, z.y * about_y.x + z.x * about_y.y, about_y.z);
    return normalize_or(about_z, n);
}

/// Normal mapping by rotation with its signs mended: Ry(ay) Rx(-ax) N, without Rz. On N = +Z this is
///   (cos ax sin ay, sin ax, cos ax cos ay)
/// whose x / z = t.x / t.z is the texel's own and whose y / z = (t.y / t.z) / cos ay is not quite, since the second
/// rotation shortens what the first one did. ax = atan(t.y / |t.z|) and ay = atan2(t.x, t.z) keep the quadrant of a texel
/// that points below the surface. On +Z the error is at most 0.2 degrees for a tilt of 15, 1.7 for 30, 5.9 for 45. The axes
/// are still those of N's space, so away from +Z the tilt goes astray.
fn normal_rotation_fixed(n_tangent: vec3f, normal: vec3f) -> vec3f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let x = cos_sin_atan2(n_tangent.y, abs(n_tangent.z));
    let y = cos_sin_atan2(n_tangent.x, n_tangent.z);
    let about_x = vec3f(n.x, x.x * n.y + x.y * n.z, x.x * n.z - x.y * n.y);
    let about_y = vec3f(y.x * about_x.x + y.y * about_x.z, about_x.y, y.x * about_x.z - y.y * about_x.x);
    return normalize_or(about_y, n);
}
