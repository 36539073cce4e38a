//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Wrap
///
/// x brought into a range by steps of the range's width, component by component: low is kept, high becomes low. `low` where the range is
/// empty.
/// @node math/wrap   @also modulo, repeat, loop, cycle
/// - x: value [0]
/// - low: start of the range [0]
/// - high: end of the range [1]
/// - return: low to high
fn node_math_wrap(x: T, low: T, high: T) -> T {
    let width = high - low;
    let along = x - low;
    return select(low, low + along - width * floor(along / width), abs(width) > T(DIVISOR_FLOOR));
}
