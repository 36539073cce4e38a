//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Mix
///
/// Blends linearly: a at t = 0, b at t = 1.
///   a (1 - t) + b t
/// t may lie outside of 0 to 1; the line goes on.
/// @node math/mix   @also lerp, blend, interpolate
/// - a: first value [0]
/// - b: second value [1]
/// - t: weight of b [0.5; 0..1]
/// - return: the blend
fn node_math_mix(a: T, b: T, t: f32) -> T {
    return mix(a, b, t);
}
