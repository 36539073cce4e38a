//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Subtract
///
/// a - b, component by component.
/// @node math/subtract   @also minus, difference, -
/// - a: what is taken from [0]
/// - b: what is taken away [0]
/// - return: the difference
fn node_math_subtract(a: T, b: T) -> T {
    return a - b;
}
