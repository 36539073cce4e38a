// Between world space and view space: the viewer at the origin, +x right, +y up, looking along -z. It is only turned and moved.

/// View from World, Position
///
/// A point of world space as the viewer has it: +x to the right, +y up, and -z the distance along the line of sight.
/// @node spaces/view_from_world_position   @also transform, camera, eye, space, depth
/// - p: point in world space [context world_position]
/// - return: the point in view space
fn node_spaces_view_from_world_position(p: vec3f, view_from_world: mat4x4f) -> vec3f {
    return (view_from_world * vec4f(p, 1.0)).xyz;
}

/// View from World, Direction
///
/// A direction or normal of world space as the viewer has it; its length stays. A normal's z is near 1 where the surface faces the viewer.
/// @node spaces/view_from_world_direction   @also transform, camera, eye, space, normal, vector
/// - v: direction in world space [context world_normal]
/// - return: the direction in view space
fn node_spaces_view_from_world_direction(v: vec3f, view_from_world: mat4x4f) -> vec3f {
    return (view_from_world * vec4f(v, 0.0)).xyz;
}

/// World from View, Position
///
/// A point as the viewer has it in world space: what is made of it follows the viewer.
/// @node spaces/world_from_view_position   @also transform, camera, eye, space
/// - p: point in view space [0,0,-1; -inf..inf; m]
/// - return: the point in world space
fn node_spaces_world_from_view_position(p: vec3f, view_from_world: mat4x4f) -> vec3f {
    let m = view_from_world;
    let q = p - m[3].xyz;
    return vec3f(dot(m[0].xyz, q), dot(m[1].xyz, q), dot(m[2].xyz, q));
}

/// World from View, Direction
///
/// A direction as the viewer has it in world space; its length stays. (0, 0, 1) is the way back along the line of sight.
/// @node spaces/world_from_view_direction   @also transform, camera, eye, space, normal, vector
/// - v: direction in view space [0,0,1]
/// - return: the direction in world space
fn node_spaces_world_from_view_direction(v: vec3f, view_from_world: mat4x4f) -> vec3f {
    let m = view_from_world;
    return vec3f(dot(m[0].xyz, v), dot(m[1].xyz, v), dot(m[2].xyz, v));
}
