//! T = vec2f | vec3f | vec4f
alias T = vec3f;

/// Distance
///
/// The length of a - b.
/// @node vector/distance   @also far, gap
/// - a: first point [0]
/// - b: second point [0]
/// - return: the distance
fn node_vector_distance(a: T, b: T) -> f32 {
    return distance(a, b);
}
