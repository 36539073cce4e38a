//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Smootherstep
///
/// Rises from 0 to 1 between two edges, level to the second derivative at both: t^3 (t (6 t - 15) + 10), component by component.
/// Perlin 2002, "Improving Noise". Equal edges make a hard border.
/// @node math/smootherstep   @also quintic, fade, ease
/// - low: up to where it is 0 [0]
/// - high: from where it is 1 [1]
/// - x: value [0.5; 0..1]
/// - return: 0 to 1
fn node_math_smootherstep(low: T, high: T, x: T) -> T {
    let width = high - low;
    let inside = clamp((x - low) / width, T(0.0), T(1.0));
    let t = select(step(low, x), inside, abs(width) > T(DIVISOR_FLOOR));
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
