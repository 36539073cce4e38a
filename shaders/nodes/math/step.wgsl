//! T = f32 | vec2f | vec3f | vec4f
alias T = vec3f;

/// Step
///
/// 0 below the edge, 1 from it on, component by component. Not filtered: the border is a hard one.
/// @node math/step   @also threshold, cutoff
/// - edge: where it jumps [0.5; 0..1]
/// - x: value [0; 0..1]
/// - return: 0 or 1
fn node_math_step(edge: T, x: T) -> T {
    return step(edge, x);
}
