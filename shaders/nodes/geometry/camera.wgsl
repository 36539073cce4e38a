/// The outputs of the node geometry/camera.
struct CameraOutputs {
    /// from the viewer to the point in a straight line [m]
    view_distance: f32,
    /// along the line of sight [m]; the same all over a wall that stands across it
    depth: f32,
}

/// Camera
///
/// How far away from the viewer the point is: for fog, for detail that fades out, for what is only shown near by.
/// @node geometry/camera   @also camera data, view distance, depth, fog, fade
/// - position: point in world space [context world_position]
fn node_geometry_camera(position: vec3f, view_from_world: mat4x4f) -> CameraOutputs {
    let seen = (view_from_world * vec4f(position, 1.0)).xyz;
    return CameraOutputs(length(seen), -seen.z);
}
