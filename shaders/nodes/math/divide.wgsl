//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Divide
///
/// a / b, component by component. Where b is 0 (nearer to it than 1e-30) the result is 0, so that a mask
/// that reaches zero leaves black and no hole.
/// @node math/divide   @also quotient, ratio, /
/// - a: dividend [1]
/// - b: divisor [1]
/// - return: the quotient; 0 for a divisor of 0
fn node_math_divide(a: T, b: T) -> T {
    return select(T(0.0), a / b, abs(b) > T(DIVISOR_FLOOR));
}
