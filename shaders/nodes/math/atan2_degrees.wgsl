//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Arc Tangent in Degrees
///
/// The angle of the point (x, y) seen from the origin, counter-clockwise from +x, component by component. 0 at the origin.
/// @node math/atan2_degrees   @also arctangent, atan, angle
/// - y: up [0; -1..1]
/// - x: right [1; -1..1]
/// - return: the angle [deg], -180 to 180
fn node_math_atan2_degrees(y: T, x: T) -> T {
    // WGSL leaves atan2(0, 0) open, and a GPU may compute atan(y / x) and meet 0 / 0.
    let at_origin = max(abs(x), abs(y)) <= T(DIVISOR_FLOOR);
    return select(degrees(atan2(y, select(x, T(1.0), at_origin))), T(0.0), at_origin);
}
