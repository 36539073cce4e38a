//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Tangent of an Angle
///
/// tan(x) = sin(x) / cos(x), component by component, limited to +-1e7 at the poles.
/// @node math/tan   @also tangent
/// - x: angle [0; -1.5..1.5; rad]
/// - return: the tangent
fn node_math_tan(x: T) -> T {
    let c = cos(x);
    // 1e-7 is the rounding of x near pi/2: nearer to the pole there is no digit left.
    let away_from_zero = select(T(-1.0), T(1.0), c >= T(0.0)) * max(abs(c), T(1e-7));
    return sin(x) / away_from_zero;
}
