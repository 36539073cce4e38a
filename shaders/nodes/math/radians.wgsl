//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Radians from Degrees
///
/// x pi / 180, component by component.
/// @node math/radians   @also degrees to radians
/// - x: angle [0; -360..360; deg]
/// - return: the angle [rad]
fn node_math_radians(x: T) -> T {
    return radians(x);
}
