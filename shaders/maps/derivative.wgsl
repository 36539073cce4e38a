// Tangents where a mesh has none: from the derivatives of position and texture coordinates along two directions of the
// screen. The functions take the derivatives, so that they may be called anywhere.

/// The tangent along which u grows, and the handedness (w), of the surface that a pixel shows: what MikkTSpace gives a
/// triangle that shares no vertex. Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU", and Schueler 2013,
/// "Followup: Normal Mapping Without Precomputed Tangents". With p the position, (u, v) the texture coordinates (v runs
/// down the picture) and x, y two directions, commonly the screen's:
///   d = u_x v_y - u_y v_x,   p_u = (p_x v_y - p_y v_x) / d,   T = normalize(p_u - N (N . p_u)),
///   w = -sign(d N . (p_x x p_y)),   B = w cross(N, T)
/// `normal` is made unit; a zero one is +Z. Where texture coordinates do not move, or along one line only, or where the
/// point does not move, T is zero, which `normal_tbn` reads as: any tangent will do.
fn tangent_from_derivatives(position_ddx: vec3f, position_ddy: vec3f, normal: vec3f, uv_ddx: vec2f, uv_ddy: vec2f) -> vec4f {
    let n = normalize_or(normal, vec3f(0.0, 0.0, 1.0));
    let d = uv_ddx.x * uv_ddy.y - uv_ddy.x * uv_ddx.y;
    let sum = position_ddx * uv_ddy.y - position_ddy * uv_ddx.y;
    let along_u = select(sum, -sum, d < 0.0);
    let in_plane = along_u - n * dot(n, along_u);
    // Along N but for rounding there is no direction within the surface.
    let usable = (dot(in_plane, in_plane) > 1e-10 * dot(along_u, along_u)) & (abs(d) > 0.0);
    let t = select(vec3f(0.0), normalize_or(in_plane, vec3f(0.0)), usable);
    let faces = dot(n, cross(position_ddx, position_ddy));
    return vec4f(t, f32(select(1.0, -1.0, (faces < 0.0) == (d < 0.0))));
}

/// Normal mapping by the tangent frame of the pixel (`tangent_from_derivatives`): it needs no tangents of the mesh. On
/// flat faces it is `normal_tbn` with MikkTSpace's tangents; where vertices share tangents, its frame is that of the
/// face instead and turns at edges.
fn normal_tbn_derivative(n_tangent: vec3f, position_ddx: vec3f, position_ddy: vec3f, normal: vec3f, uv_ddx: vec2f, uv_ddy: vec2f) -> vec3f {
    return normal_tbn(n_tangent, normal, tangent_from_derivatives(position_ddx, position_ddy, normal, uv_ddx, uv_ddy));
}

/// The tangent-space normal of a height field with these slopes, by distance along T and along B: (-h_t, -h_b, 1), unit.
fn normal_from_slopes(slope_along_tangent: f32, slope_along_bitangent: f32) -> vec3f {
    return normalize_or(vec3f(-slope_along_tangent, -slope_along_bitangent, 1.0), vec3f(0.0, 0.0, 1.0));
}
