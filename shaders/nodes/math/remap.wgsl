//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Remap
///
/// Carries the range `in_low`..`in_high` onto `out_low`..`out_high` linearly, component by component.
///   out_low + (x - in_low) / (in_high - in_low) (out_high - out_low)
/// Where the input range is empty (narrower than 1e-20) the result is `out_low`. `clamped` holds it between the two ends.
/// @node math/remap   @also map range, levels, fit, rescale
/// - x: value [0; 0..1]
/// - in_low: goes to out_low [0]
/// - in_high: goes to out_high [1]
/// - out_low: result at in_low [0]
/// - out_high: result at in_high [1]
/// - clamped: whether x is first held inside of the input range [false]
/// - return: the value in the new range
fn node_math_remap(x: T, in_low: T, in_high: T, out_low: T, out_high: T, clamped: bool) -> T {
    let width = in_high - in_low;
    let along = select(T(0.0), (x - in_low) / width, abs(width) > T(1e-20));
    let t = select(along, clamp(along, T(0.0), T(1.0)), clamped);
    return out_low + t * (out_high - out_low);
}
