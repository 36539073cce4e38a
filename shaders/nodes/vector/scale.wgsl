//! T = vec2f | vec3f | vec4f
alias T = vec3f;

/// Scale
///
/// Each component times one number.
/// @node vector/scale   @also multiply, stretch
/// - v: vector [0]
/// - factor: how many times as long [1; 0..10]
/// - return: the scaled vector
fn node_vector_scale(v: T, factor: f32) -> T {
    return v * factor;
}
