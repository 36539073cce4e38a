//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Ceiling
///
/// The least whole number that is not below x, component by component.
/// @node math/ceil   @also ceiling, round up
/// - x: value [0]
/// - return: the whole number
fn node_math_ceil(x: T) -> T {
    return ceil(x);
}
