//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Fraction
///
/// x - floor(x), component by component: 0 to 1, rising in each whole step, for negative x too.
/// @node math/fract   @also fraction, sawtooth, frac
/// - x: value [0]
/// - return: the fraction
fn node_math_fract(x: T) -> T {
    return fract(x);
}
