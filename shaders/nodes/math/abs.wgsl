//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Absolute
///
/// |x|, component by component.
/// @node math/abs   @also absolute value, magnitude
/// - x: value [0]
/// - return: the value without its sign
fn node_math_abs(x: T) -> T {
    return abs(x);
}
