//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Logarithm to Base 2
///
/// log2(x), component by component: factors to stops. x below 1e-30 counts as 1e-30, whose logarithm is -99.66.
/// @node math/log2   @also binary logarithm, stops
/// - x: value [1; 0..16]
/// - return: the logarithm
fn node_math_log2(x: T) -> T {
    return log2(max(x, T(DIVISOR_FLOOR)));
}
