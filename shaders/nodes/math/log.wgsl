//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Logarithm
///
/// ln(x), component by component. x below 1e-30 counts as 1e-30, whose logarithm is -69.08.
/// @node math/log   @also ln, natural logarithm
/// - x: value [1; 0..10]
/// - return: the natural logarithm
fn node_math_log(x: T) -> T {
    return log(max(x, T(DIVISOR_FLOOR)));
}
