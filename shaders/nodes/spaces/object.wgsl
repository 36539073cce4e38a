// Between world space and the space of the object, which moves with it: what is computed there stays on the object.

/// Object from World, Position
///
/// A point of world space in object space, where the mesh was modelled: M^-1 p. A pattern that reads it stays with the object however
/// that is moved, turned and scaled. Of an object that is scaled flat there is no way back: the origin.
/// @node spaces/object_from_world_position   @also transform, local, space, inverse
/// - p: point in world space [context world_position]
/// - return: the point in object space
fn node_spaces_object_from_world_position(p: vec3f, object_from_world: mat4x4f) -> vec3f {
    return (object_from_world * vec4f(p, 1.0)).xyz;
}

/// Object from World, Direction
///
/// A way of world space in object space, such as a tangent or the way to a lamp: the upper 3x3 of M^-1 times v. It is not moved, and
/// its length is scaled as the object is.
/// @node spaces/object_from_world_direction   @also transform, local, space, vector
/// - v: way in world space [context view_dir]
/// - return: the way in object space, not made unit
fn node_spaces_object_from_world_direction(v: vec3f, object_from_world: mat4x4f) -> vec3f {
    return (object_from_world * vec4f(v, 0.0)).xyz;
}

/// Object from World, Normal
///
/// A normal of world space in object space, unit: the transpose of M's upper 3x3 times n, which keeps it at right angles to the surface
/// under uneven scales. 0 where there is no way back, and for 0.
/// @node spaces/object_from_world_normal   @also transform, local, space
/// - n: normal in world space [context world_normal]
/// - return: unit normal in object space
fn node_spaces_object_from_world_normal(n: vec3f, world_from_object: mat4x4f) -> vec3f {
    let m = world_from_object;
    return normalize_or(vec3f(dot(m[0].xyz, n), dot(m[1].xyz, n), dot(m[2].xyz, n)), vec3f(0.0));
}

/// World from Object, Position
///
/// A point of object space in world space: M p.
/// @node spaces/world_from_object_position   @also transform, global, space
/// - p: point in object space [context object_position]
/// - return: the point in world space
fn node_spaces_world_from_object_position(p: vec3f, world_from_object: mat4x4f) -> vec3f {
    return (world_from_object * vec4f(p, 1.0)).xyz;
}

/// World from Object, Direction
///
/// A way of object space in world space: the upper 3x3 of M times v. It is not moved, and its length is scaled as the object is.
/// @node spaces/world_from_object_direction   @also transform, global, space, vector
/// - v: way in object space [0,1,0]
/// - return: the way in world space, not made unit
fn node_spaces_world_from_object_direction(v: vec3f, world_from_object: mat4x4f) -> vec3f {
    return (world_from_object * vec4f(v, 0.0)).xyz;
}

/// World from Object, Normal
///
/// A normal of object space in world space, unit: the transpose of M^-1's upper 3x3 times n. 0 for an object that is scaled flat,
/// and for 0.
/// @node spaces/world_from_object_normal   @also transform, global, space
/// - n: normal in object space [0,1,0]
/// - return: unit normal in world space
fn node_spaces_world_from_object_normal(n: vec3f, object_from_world: mat4x4f) -> vec3f {
    let m = object_from_world;
    return normalize_or(vec3f(dot(m[0].xyz, n), dot(m[1].xyz, n), dot(m[2].xyz, n)), vec3f(0.0));
}
