//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Ping-Pong
///
/// x folded back and forth between 0 and `length_of_way`, component by component: a triangle wave. 0 for a way of 0.
/// @node math/ping_pong   @also triangle wave, mirror, zigzag
/// - x: value [0]
/// - length_of_way: where it turns [1; 0..10]
/// - return: the folded value
fn node_math_ping_pong(x: T, length_of_way: T) -> T {
    let period = 2.0 * length_of_way;
    let along = x - period * floor(x / period);
    return select(T(0.0), length_of_way - abs(along - length_of_way), abs(length_of_way) > T(DIVISOR_FLOOR));
}
