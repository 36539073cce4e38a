//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Tangent of Degrees
///
/// tan(x) of an angle in degrees, component by component: the slope of a ramp. Limited to +-1e7 at the poles, where the sign is that
/// of the side it comes from.
/// @node math/tan_degrees   @also tangent, slope
/// - x: angle [0; -89..89; deg]
/// - return: the tangent
fn node_math_tan_degrees(x: T) -> T {
    // The tangent repeats after 180 degrees.
    let turned = x - 180.0 * floor(x / 180.0 + 0.5);
    return sin(radians(turned)) / max(sin(radians(90.0 - abs(turned))), T(1e-7));
}
