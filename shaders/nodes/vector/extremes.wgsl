/// Greatest Component
///
/// The greatest of three components, or the brightest channel of a colour.
/// @node vector/max_component   @also maximum, value, brightest
/// - v: vector [0,0,0]
/// - return: the greatest
fn node_vector_max_component(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

/// Least Component
///
/// The least of three components, or the darkest channel of a colour.
/// @node vector/min_component   @also minimum, darkest
/// - v: vector [0,0,0]
/// - return: the least
fn node_vector_min_component(v: vec3f) -> f32 {
    return min(v.x, min(v.y, v.z));
}
