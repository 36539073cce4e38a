//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Negate
///
/// -x, component by component.
/// @node math/negate   @also minus, opposite
/// - x: value [0]
/// - return: the opposite
fn node_math_negate(x: T) -> T {
    return -x;
}
