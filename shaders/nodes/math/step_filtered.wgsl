/// Filtered Step
///
/// 0 below the edge, 1 above it, and in the pixels through which the edge goes the part of them above it: a threshold without
/// jagged borders. Its ramp is as wide as x changes over a pixel.
/// @node math/step_filtered   @also threshold, antialias, cutoff, mask
/// - edge: where it jumps [0.5; 0..1]
/// - x: a value that changes smoothly over the surface [0; 0..1]
/// - return: 0 to 1
/// @vertex node_math_step_filtered_vertex
fn node_math_step_filtered(edge: f32, x: f32) -> f32 {
    return clamp(0.5 + (x - edge) / max(fwidth(x), DIVISOR_FLOOR), 0.0, 1.0);
}

/// The step at a point: the vertex stage has no pixels.
fn node_math_step_filtered_vertex(edge: f32, x: f32) -> f32 {
    return step(edge, x);
}
