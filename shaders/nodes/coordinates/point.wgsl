/// UV
///
/// The mesh's texture coordinates; (0,0) is the top left of an image.
/// @node coordinates/uv   @also texture coordinates, uv map
/// - uv: coordinates [context uv0]
/// - return: the coordinates
fn node_coordinates_uv(uv: vec2f) -> vec2f {
    return uv;
}

/// Second UV
///
/// The mesh's second set of texture coordinates.
/// @node coordinates/uv1   @also texture coordinates, lightmap
/// - uv: coordinates [context uv1]
/// - return: the coordinates
fn node_coordinates_uv1(uv: vec2f) -> vec2f {
    return uv;
}

/// World Position
///
/// The shaded point in world space.
/// @node coordinates/world_position   @also point, location
/// - position: the point [context world_position]
/// - return: the point [m]
fn node_coordinates_world_position(position: vec3f) -> vec3f {
    return position;
}

/// Object Position
///
/// The shaded point in the object's own space: a pattern in it moves with the object.
/// @node coordinates/object_position   @also point, local, generated
/// - position: the point [context object_position]
/// - return: the point [m]
fn node_coordinates_object_position(position: vec3f) -> vec3f {
    return position;
}
