//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Snap
///
/// The nearest multiple of a step, component by component; halves go up. x itself for a step of 0.
/// @node math/snap   @also quantize, round to, grid, increment
/// - x: value [0]
/// - increment: size of a step [0.1; 0..1]
/// - return: the nearest multiple
fn node_math_snap(x: T, increment: T) -> T {
    return select(x, increment * floor(x / increment + 0.5), abs(increment) > T(DIVISOR_FLOOR));
}
