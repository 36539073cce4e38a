/// Rotate 2D
///
/// A vector of two turned about a centre, counter-clockwise where y runs up (texture coordinates, whose v runs down: clockwise).
/// @node vector/rotate_2d   @also turn, spin
/// - v: vector [0,0]
/// - angle: how far [0; -360..360; deg]
/// - center: what stays [0,0]
/// - return: the turned vector
fn node_vector_rotate_2d(v: vec2f, angle: f32, center: vec2f) -> vec2f {
    let c = cos(radians(angle));
    let s = sin(radians(angle));
    let d = v - center;
    return center + vec2f(c * d.x - s * d.y, s * d.x + c * d.y);
}

/// Rotate by Angles
///
/// A vector turned about the x axis, then y, then z, each counter-clockwise when the axis points at the viewer.
/// @node vector/rotate_euler   @also turn, euler, pitch yaw roll
/// - v: vector [1,0,0]
/// - angles: about x, y and z [0,0,0; -360..360; deg]
/// - return: the turned vector
fn node_vector_rotate_euler(v: vec3f, angles: vec3f) -> vec3f {
    let c = cos(radians(angles));
    let s = sin(radians(angles));
    let about_x = vec3f(v.x, c.x * v.y - s.x * v.z, s.x * v.y + c.x * v.z);
    let about_y = vec3f(c.y * about_x.x + s.y * about_x.z, about_x.y, c.y * about_x.z - s.y * about_x.x);
    return vec3f(c.z * about_y.x - s.z * about_y.y, s.z * about_y.x + c.z * about_y.y, about_y.z);
}
