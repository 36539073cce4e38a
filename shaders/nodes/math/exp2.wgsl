//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Power of Two
///
/// 2^x, component by component: stops to factors. x above 126 counts as 126, near the end of f32.
/// @node math/exp2   @also exponential, stops, doubling
/// - x: exponent [0; -10..10]
/// - return: the power
fn node_math_exp2(x: T) -> T {
    return exp2(min(x, T(EXPONENT_CEILING)));
}
