//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Arc Tangent of a Slope
///
/// The angle of a slope: atan(x), component by component. For the angle of a point use Arc Tangent, which knows all directions.
/// @node math/atan   @also arctangent, inverse tangent, slope
/// - x: slope [0; -10..10]
/// - return: the angle [rad], -pi/2 to pi/2
fn node_math_atan(x: T) -> T {
    return atan(x);
}
