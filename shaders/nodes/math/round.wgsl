//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Round
///
/// The nearest whole number, component by component; halves go to the even one.
/// @node math/round   @also nearest
/// - x: value [0]
/// - return: the whole number
fn node_math_round(x: T) -> T {
    return round(x);
}
