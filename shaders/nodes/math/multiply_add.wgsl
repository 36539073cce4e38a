//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Multiply Add
///
/// a b + c, component by component: scale and offset in one node.
/// @node math/multiply_add   @also fma, mad, scale and offset
/// - a: first factor [1]
/// - b: second factor [1]
/// - c: what is added [0]
/// - return: the sum
fn node_math_multiply_add(a: T, b: T, c: T) -> T {
    return a * b + c;
}
