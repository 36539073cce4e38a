//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Clamp
///
/// x held between `low` and `high`, component by component. Where they are the wrong way round, `high` wins.
/// @node math/clamp   @also limit, range
/// - x: value [0; 0..1]
/// - low: least result [0]
/// - high: greatest result [1]
/// - return: the clamped value
fn node_math_clamp(x: T, low: T, high: T) -> T {
    return min(max(x, low), high);
}
