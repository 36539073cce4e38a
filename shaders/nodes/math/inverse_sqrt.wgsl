//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Inverse Square Root
///
/// 1 / sqrt(x), component by component; 0 for x = 0 and below.
/// @node math/inverse_sqrt   @also rsqrt, reciprocal root
/// - x: value [1; 0..10]
/// - return: the reciprocal of the root; 0 where there is none
fn node_math_inverse_sqrt(x: T) -> T {
    return select(T(0.0), inverseSqrt(x), x > T(DIVISOR_FLOOR));
}
