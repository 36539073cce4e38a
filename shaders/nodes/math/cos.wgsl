//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Cosine
///
/// cos(x), component by component. GPUs lose digits far from 0; stay within some thousand.
/// @node math/cos   @also cosine, wave, oscillate
/// - x: angle [0; -10..10; rad]
/// - return: -1 to 1
fn node_math_cos(x: T) -> T {
    return cos(x);
}
