//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Multiply
///
/// a b, component by component.
/// @node math/multiply   @also times, product, scale, *
/// - a: first factor [1]
/// - b: second factor [1]
/// - return: the product
fn node_math_multiply(a: T, b: T) -> T {
    return a * b;
}
