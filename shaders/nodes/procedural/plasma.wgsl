/// Plasma
///
/// Sines of sines: bands of colour that flow into each other. Three rounds, in each of which every axis is bent by the sine of another. Fades
/// to grey where bands are smaller than pixels.
/// @node procedural/plasma   @also magic, psychedelic, oil, swirls
/// - position: the point [context object_position]
/// - scale: bands per metre [2; 0..16]
/// - distortion: how far each round bends [1; 0..3]
/// - return: colour, each channel 0 to 1
/// @vertex node_procedural_plasma_vertex
fn node_procedural_plasma(position: vec3f, scale: f32, distortion: f32) -> vec3f {
    let q = plasma_phase(held3(position * scale), held1(distortion));
    let x = fwidth(q.x);
    let y = fwidth(q.y);
    let z = fwidth(q.z);
    return 0.5 + 0.5 * vec3f(sine_wave(q.x, x), sine_wave(q.y, y), sine_wave(q.z, z));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_plasma_vertex(position: vec3f, scale: f32, distortion: f32) -> vec3f {
    let q = plasma_phase(held3(position * scale), held1(distortion));
    return 0.5 + 0.5 * vec3f(sine_wave(q.x, 0.0), sine_wave(q.y, 0.0), sine_wave(q.z, 0.0));
}

/// The bent point, in turns.
fn plasma_phase(p: vec3f, distortion: f32) -> vec3f {
    let first = p + distortion * 0.3 * sin(2.0 * PI * fract(p.yzx));
    let second = first + distortion * 0.2 * sin(2.0 * PI * fract(1.7 * first.zxy + 0.31));
    return second + distortion * 0.15 * sin(2.0 * PI * fract(2.3 * second.yzx + 0.67));
}
