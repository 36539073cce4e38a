//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Cosine of Degrees
///
/// cos(x) of an angle in degrees, component by component; exact at multiples of 90 degrees, and as good far from 0 as near it.
/// @node math/cos_degrees   @also cosine, wave
/// - x: angle [0; -360..360; deg]
/// - return: -1 to 1
fn node_math_cos_degrees(x: T) -> T {
    let turned = x - 360.0 * floor(x / 360.0 + 0.5);
    return sin(radians(90.0 - abs(turned)));
}
