//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Exponential
///
/// e^x, component by component. x above 80 counts as 80: e^80 = 5.5e34 is near the end of f32.
/// @node math/exp   @also exponential, e
/// - x: exponent [0; -10..10]
/// - return: the exponential
fn node_math_exp(x: T) -> T {
    return exp(min(x, T(80.0)));
}
