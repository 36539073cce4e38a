// Height maps: moving a vertex along its normal, and the normal of the moved surface from screen-space derivatives.

/// The position moved along its unit normal by `height` (a length in the position's unit).
fn displaced(position: vec3f, normal: vec3f, height: f32) -> vec3f {
    return position + normal * height;
}

/// The unit normal of the surface raised by a height field. Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the
/// GPU": with the derivatives of the position, p_x and p_y, along any two directions (the screen's),
///   R1 = p_y x n,  R2 = n x p_x,  det = p_x . R1,   grad = (h_x R1 + h_y R2) / det,   n' = normalize(n - grad)
/// The derivatives of the height are along the same two directions. `normal` is the old one, unit; an empty footprint keeps it.
/// Of the displaced position p + h n the derivatives along x are p_x + h n_x + h_x n, whose part across n holds how much wider or
/// narrower a curved surface is at that height: with them n' is exact. Those of p alone give the slope that it has at height 0.
fn normal_from_height(position_ddx: vec3f, position_ddy: vec3f, normal: vec3f, height_ddx: f32, height_ddy: f32) -> vec3f {
    let r1 = cross(position_ddy, normal);
    let r2 = cross(normal, position_ddx);
    let det = dot(position_ddx, r1);
    let gradient = (height_ddx * r1 + height_ddy * r2) / det;
    // A footprint of no area (under 1e-30, where 1 / det nears overflow) has no gradient.
    return normalize_or(normal - select(vec3f(0.0), gradient, abs(det) > 1e-30), normal);
}

/// The tangent (w is its handedness) of the surface raised by a height field: moved along the old normal into the new surface,
///   t' ~ t - n (t . n') / (n . n')
/// which for a flat surface is t + n (t . grad h), exactly. Written as t (n . n') - n (t . n'), which divides by nothing; not unit. Both
/// normals are unit.
fn displaced_tangent(normal: vec3f, tangent: vec4f, displaced_normal: vec3f) -> vec4f {
    let moved = tangent.xyz * dot(normal, displaced_normal) - normal * dot(tangent.xyz, displaced_normal);
    return vec4f(moved, tangent.w);
}
