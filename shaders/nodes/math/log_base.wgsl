//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Logarithm to a Base
///
/// ln(x) / ln(base), component by component. x below 1e-30 counts as 1e-30; a base below 1.001 counts as 1.001.
/// @node math/log_base   @also decadic logarithm, log10
/// - x: value [1; 0..100]
/// - base: whose powers are meant [10; 2..10]
/// - return: the logarithm
fn node_math_log_base(x: T, base: T) -> T {
    return log2(max(x, T(DIVISOR_FLOOR))) / log2(max(base, T(1.001)));
}
