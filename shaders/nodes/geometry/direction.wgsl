/// Normal
///
/// Unit shading normal of the mesh in world space.
/// @node geometry/normal   @also surface direction
/// - normal: the normal [context world_normal]
/// - return: unit direction
fn node_geometry_normal(normal: vec3f) -> vec3f {
    return normal;
}

/// Surface Tangent
///
/// Unit direction in which u grows over the surface, in world space. Zero where the mesh has none.
/// @node geometry/tangent   @also u direction, anisotropy
/// - tangent: tangent and handedness [context world_tangent]
/// - return: unit direction
fn node_geometry_tangent(tangent: vec4f) -> vec3f {
    return normalize_or(tangent.xyz, vec3f(0.0));
}

/// Bitangent
///
/// Unit direction in which v falls over the surface (up on the image), in world space: the handedness times n x t. Zero
/// where the mesh has no tangents.
/// @node geometry/bitangent   @also binormal, v direction
/// - normal: unit normal [context world_normal]
/// - tangent: tangent and handedness [context world_tangent]
/// - return: unit direction
fn node_geometry_bitangent(normal: vec3f, tangent: vec4f) -> vec3f {
    return normalize_or(cross(normal, tangent.xyz) * tangent.w, vec3f(0.0));
}

/// View Direction
///
/// Unit direction from the shaded point to the viewer, in world space.
/// @node geometry/view_dir   @also camera, eye, incoming
/// - view_dir: the direction [context view_dir]
/// - return: unit direction
fn node_geometry_view_dir(view_dir: vec3f) -> vec3f {
    return view_dir;
}

/// Mirror Direction
///
/// Unit direction from which a mirror would show its light: 2 (n . v) n - v.
/// @node geometry/mirror_dir   @also reflection, reflected
/// - normal: unit normal [context world_normal]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - return: unit direction away from the surface
fn node_geometry_mirror_dir(normal: vec3f, view_dir: vec3f) -> vec3f {
    return 2.0 * dot(normal, view_dir) * normal - view_dir;
}
