/// Angle Between
///
/// The angle between two directions of any length: atan2(|a x b|, a . b), which keeps its digits near 0 and 180 degrees. 0 where one of
/// them has no direction.
/// @node vector/angle   @also separation, cosine
/// - a: first direction [1,0,0]
/// - b: second direction [0,1,0]
/// - return: the angle [deg], 0 to 180
fn node_vector_angle(a: vec3f, b: vec3f) -> f32 {
    let first = normalize_or(a, vec3f(0.0));
    let second = normalize_or(b, vec3f(0.0));
    let sine = length(cross(first, second));
    let cosine = dot(first, second);
    let has_angle = max(sine, abs(cosine)) > DIVISOR_FLOOR;
    return select(0.0, degrees(atan2(sine, select(1.0, cosine, has_angle))), has_angle);
}
