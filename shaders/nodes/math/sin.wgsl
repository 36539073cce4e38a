//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Sine
///
/// sin(x), component by component. GPUs lose digits far from 0; stay within some thousand.
/// @node math/sin   @also sine, wave, oscillate
/// - x: angle [0; -10..10; rad]
/// - return: -1 to 1
fn node_math_sin(x: T) -> T {
    return sin(x);
}
