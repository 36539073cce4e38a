//! T = i32 | f32 | bool | vec2f | vec3f | vec4f
alias T = vec3f;

/// Reroute
///
/// Bends a wire: what comes in goes out. It leaves nothing in the shader.
/// @node utility/reroute   @also dot, knot, elbow, bend, pass
/// - value: what goes through [0]
/// - return: the same
fn node_utility_reroute(value: T) -> T {
    return value;
}
