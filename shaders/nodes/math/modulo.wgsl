//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Modulo
///
/// x - y floor(x / y), component by component: x wrapped into 0 to y, for negative x too (the sign is y's).
/// 0 where y is 0.
/// @node math/modulo   @also mod, remainder, wrap, %
/// - x: value [0]
/// - y: period [1]
/// - return: the remainder
fn node_math_modulo(x: T, y: T) -> T {
    return select(T(0.0), x - y * floor(x / y), abs(y) > T(DIVISOR_FLOOR));
}
