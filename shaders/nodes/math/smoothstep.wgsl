//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Smooth Step
///
/// Rises from 0 at `low` to 1 at `high` with level ends, component by component: with t the clamped way from low to
/// high, t^2 (3 - 2 t). Where low and high are equal it is a step.
/// @node math/smoothstep   @also soft threshold, ease, hermite
/// - low: where the rise begins [0]
/// - high: where it ends [1]
/// - x: value [0.5; 0..1]
/// - return: 0 to 1
fn node_math_smoothstep(low: T, high: T, x: T) -> T {
    let width = high - low;
    let inside = clamp((x - low) / width, T(0.0), T(1.0));
    let t = select(step(low, x), inside, abs(width) > T(DIVISOR_FLOOR));
    return t * t * (3.0 - 2.0 * t);
}
