//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Truncate
///
/// x without its fraction, component by component: rounded towards 0.
/// @node math/truncate   @also trunc, integer part
/// - x: value [0]
/// - return: the whole number
fn node_math_truncate(x: T) -> T {
    return trunc(x);
}
