/// World from Tangent
///
/// A direction of tangent space (x along the tangent, y along the bitangent, z along the normal) in world space, by the frame of the
/// mesh, as normal maps are read. Where the mesh has no tangents some frame about the normal is taken.
/// @node vector/world_from_tangent   @also transform, space, tbn
/// - v: direction in tangent space [0,0,1]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: unit direction in world space
fn node_vector_world_from_tangent(v: vec3f, normal: vec3f, tangent: vec4f) -> vec3f {
    return normal_tbn(v, normal, tangent);
}

/// Tangent from World
///
/// A direction of world space in tangent space: how far it lies along tangent, bitangent and normal. The way back of World from Tangent
/// where the tangent is at right angles to the normal. Along tangent and bitangent 0 where the mesh has no tangents.
/// @node vector/tangent_from_world   @also transform, space, tbn
/// - v: direction in world space [context view_dir]
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: unit direction in tangent space
fn node_vector_tangent_from_world(v: vec3f, normal: vec3f, tangent: vec4f) -> vec3f {
    let bitangent = cross(normal, tangent.xyz) * select(1.0, -1.0, tangent.w < 0.0);
    return normalize_or(vec3f(dot(v, tangent.xyz), dot(v, bitangent), dot(v, normal)), vec3f(0.0, 0.0, 1.0));
}
