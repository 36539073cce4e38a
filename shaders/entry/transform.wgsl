// From object space to world space, by vertex.

/// A point of the object in world space: M p.
fn position_in_world(world_from_object: mat4x4f, position: vec3f) -> vec3f {
    return (world_from_object * vec4f(position, 1.0)).xyz;
}

/// A normal of the object in world space, unit. `normal_from_object` is |det M| (M^-1)^T of the upper 3x3 M, which exists
/// for flat transforms too. A vertex without a normal gives zero, which the interpolation then ignores.
fn normal_in_world(normal_from_object: mat3x3f, normal: vec3f) -> vec3f {
    return normalize_or(normal_from_object * normal, vec3f(0.0));
}

/// A tangent of the object in world space, unit, with the handedness in w: a tangent lies in the surface, so M carries it.
/// A transform that mirrors (det M < 0) turns cross(N, T) over, and so the handedness.
fn tangent_in_world(world_from_object: mat4x4f, tangent: vec4f) -> vec4f {
    let m = mat3x3f(world_from_object[0].xyz, world_from_object[1].xyz, world_from_object[2].xyz);
    let handedness = select(tangent.w, -tangent.w, determinant(m) < 0.0);
    return vec4f(normalize_or(m * tangent.xyz, vec3f(0.0)), handedness);
}
