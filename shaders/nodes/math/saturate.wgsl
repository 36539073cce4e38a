//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Saturate
///
/// x held between 0 and 1, component by component.
/// @node math/saturate   @also clamp01, clip
/// - x: value [0; 0..1]
/// - return: the clamped value
fn node_math_saturate(x: T) -> T {
    return clamp(x, T(0.0), T(1.0));
}
