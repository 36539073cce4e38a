/// Rotate about Axis
///
/// A vector turned about an axis through the origin, counter-clockwise when the axis points at the viewer. Rodrigues 1840:
///   v cos t + (a x v) sin t + a (a . v) (1 - cos t)
/// An axis of length 0 counts as +Y.
/// @node vector/rotate_about_axis   @also turn, spin, rodrigues
/// - v: vector [1,0,0]
/// - axis: axis of rotation, of any length [0,1,0]
/// - angle: how far [0; -360..360; deg]
/// - return: the turned vector
fn node_vector_rotate_about_axis(v: vec3f, axis: vec3f, angle: f32) -> vec3f {
    let a = normalize_or(axis, vec3f(0.0, 1.0, 0.0));
    let c = cos(radians(angle));
    let s = sin(radians(angle));
    return v * c + cross(a, v) * s + a * (dot(a, v) * (1.0 - c));
}
