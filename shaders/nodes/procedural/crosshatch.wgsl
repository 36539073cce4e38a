/// Crosshatch
///
/// Lines along both diagonals whose width follows a tone, as ink does in an engraving: white paper at 1; towards 0.5 one set of lines grows, below it the
/// other. The mean over the lines is the tone. Averaged over the pixel.
/// @node procedural/crosshatch   @also hatching, ink, engraving, drawing, lines
/// - uv: coordinates [context uv0]
/// - count: lines per unit along each axis [16; 1..64]
/// - tone: 0 black, 1 white; held in 0..1 [0.5; 0..1]
/// - return: 0 on a line, 1 beside
/// @vertex node_procedural_crosshatch_vertex
fn node_procedural_crosshatch(uv: vec2f, count: f32, tone: f32) -> f32 {
    let lines = held2(count * vec2f(uv.x + uv.y, uv.x - uv.y));
    return hatching(lines, fwidth(lines), clamp(tone, 0.0, 1.0));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_crosshatch_vertex(uv: vec2f, count: f32, tone: f32) -> f32 {
    return hatching(held2(count * vec2f(uv.x + uv.y, uv.x - uv.y)), vec2f(0.0), clamp(tone, 0.0, 1.0));
}

/// The part of a window that two sets of lines leave white: the first leaves at least half, the second takes what is wanted of the rest.
fn hatching(lines: vec2f, window: vec2f, tone: f32) -> f32 {
    let first = max(tone, 0.5);
    return pulse_wave(lines.x, window.x, first) * pulse_wave(lines.y, window.y, tone / first);
}
