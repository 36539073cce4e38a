//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Arc Sine
///
/// The angle whose sine is x, component by component. x is held in -1..1.
/// @node math/asin   @also arcsine, inverse sine
/// - x: sine [0; -1..1]
/// - return: the angle [rad], -pi/2 to pi/2
fn node_math_asin(x: T) -> T {
    return asin(clamp(x, T(-1.0), T(1.0)));
}
