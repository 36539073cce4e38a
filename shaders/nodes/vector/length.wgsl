//! T = vec2f | vec3f | vec4f
alias T = vec3f;

/// Length
///
/// sqrt(v . v).
/// @node vector/length   @also magnitude, norm
/// - v: vector [0]
/// - return: the length
fn node_vector_length(v: T) -> f32 {
    return length(v);
}
