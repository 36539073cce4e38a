/// The outputs of the nodes procedural/wave and procedural/rings.
struct WaveOutputs {
    /// sine, 0 to 1
    sine: f32,
    /// ramp that jumps back, 0 to 1
    saw: f32,
    /// up and down evenly, 0 to 1
    triangle: f32,
}

/// The waves at a phase in periods, over a window.
fn waves(phase: f32, window: f32) -> WaveOutputs {
    return WaveOutputs(0.5 + 0.5 * sine_wave(phase, window), saw_wave(phase, window), triangle_wave(phase, window));
}

/// Wave
///
/// Bands along u that rise and fall, bent by a value: wire noise into `distortion`. Turn the coordinates for another direction. Averaged over
/// the pixel, with the distortion.
/// @node procedural/wave   @also bands, sine, saw, triangle, ripples
/// - uv: coordinates [context uv0]
/// - count: periods per unit [8; 1..64]
/// - distortion: moves the bands, in periods [0; -2..2]
/// @vertex node_procedural_wave_vertex
fn node_procedural_wave(uv: vec2f, count: f32, distortion: f32) -> WaveOutputs {
    let phase = held1(uv.x * count + distortion);
    return waves(phase, fwidth(phase));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_wave_vertex(uv: vec2f, count: f32, distortion: f32) -> WaveOutputs {
    return waves(held1(uv.x * count + distortion), 0.0);
}

/// Rings
///
/// Rings around a centre that rise and fall, bent by a value: wire noise into `distortion`. Averaged over the pixel, with the distortion.
/// @node procedural/rings   @also circles, concentric, ripples, target, turned metal
/// - uv: coordinates [context uv0]
/// - center: of the rings [0.5,0.5; 0..1]
/// - count: rings per unit [8; 1..64]
/// - distortion: moves the rings, in periods [0; -2..2]
/// @vertex node_procedural_rings_vertex
fn node_procedural_rings(uv: vec2f, center: vec2f, count: f32, distortion: f32) -> WaveOutputs {
    let phase = held1(length(held2(uv - center)) * count + distortion);
    return waves(phase, fwidth(phase));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_rings_vertex(uv: vec2f, center: vec2f, count: f32, distortion: f32) -> WaveOutputs {
    return waves(held1(length(held2(uv - center)) * count + distortion), 0.0);
}
