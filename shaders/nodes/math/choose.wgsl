//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Choose
///
/// One of eight values by number. All are computed. A number outside of 0..7 takes the nearest.
/// @node math/choose   @also switch, index, select, menu
/// - index: which one, 0 to 7 [0; 0..7]
/// - v0: the first value [0]
/// - v1: the second value [0]
/// - v2: the third value [0]
/// - v3: the fourth value [0]
/// - v4: the fifth value [0]
/// - v5: the sixth value [0]
/// - v6: the seventh value [0]
/// - v7: the eighth value [0]
/// - return: the chosen value
fn node_math_choose(index: i32, v0: T, v1: T, v2: T, v3: T, v4: T, v5: T, v6: T, v7: T) -> T {
    let low = select(select(v0, v1, index > 0), select(v2, v3, index > 2), index > 1);
    let high = select(select(v4, v5, index > 4), select(v6, v7, index > 6), index > 5);
    return select(low, high, index > 3);
}
