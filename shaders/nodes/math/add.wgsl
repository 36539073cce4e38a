//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Add
///
/// a + b, component by component.
/// @node math/add   @also plus, sum, +
/// - a: first term [0]
/// - b: second term [0]
/// - return: the sum
fn node_math_add(a: T, b: T) -> T {
    return a + b;
}
