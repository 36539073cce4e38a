/// Marble
///
/// Layers along the x axis, folded by turbulence: a sine of x plus octaves of |noise|. Perlin 1985, "An Image Synthesizer". The sine is averaged
/// over the pixel, with its folds. A power or a ramp makes the veins thin.
/// @node procedural/marble   @also veins, stone, layers
/// - position: the point [context object_position]
/// - scale: layers per metre [3; 0..32]
/// - distortion: how far layers are folded, in layers [1.5; 0..5]
/// - octaves: of the turbulence; held in 1..8 [5; 1..8]
/// - seed: another one, another stone [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_marble_vertex
fn node_procedural_marble(position: vec3f, scale: f32, distortion: f32, octaves: i32, seed: i32) -> f32 {
    let p = held3(position * scale);
    let phase = held1(p.x + distortion * turbulence3(p, squared_footprint(p), octaves, 2.0, 0.5, seed));
    return 0.5 + 0.5 * sine_wave(phase, fwidth(phase));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_marble_vertex(position: vec3f, scale: f32, distortion: f32, octaves: i32, seed: i32) -> f32 {
    let p = held3(position * scale);
    let phase = held1(p.x + distortion * turbulence3(p, 0.0, octaves, 2.0, 0.5, seed));
    return 0.5 + 0.5 * sine_wave(phase, 0.0);
}
