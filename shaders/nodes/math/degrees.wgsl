//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Degrees from Radians
///
/// x 180 / pi, component by component.
/// @node math/degrees   @also radians to degrees
/// - x: angle [0; -10..10; rad]
/// - return: the angle [deg]
fn node_math_degrees(x: T) -> T {
    return degrees(x);
}
