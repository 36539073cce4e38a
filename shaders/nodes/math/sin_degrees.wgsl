//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Sine of Degrees
///
/// sin(x) of an angle in degrees, component by component; exact at multiples of 90 degrees, and as good far from 0 as near it.
/// @node math/sin_degrees   @also sine, wave
/// - x: angle [0; -360..360; deg]
/// - return: -1 to 1
fn node_math_sin_degrees(x: T) -> T {
    let turned = x - 360.0 * floor(x / 360.0 + 0.5);
    // Beyond 90 degrees the sine is that of the rest to 180.
    let folded = select(turned, sign(turned) * 180.0 - turned, abs(turned) > T(90.0));
    return sin(radians(folded));
}
