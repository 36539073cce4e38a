/// Gradient noise on a line, -1 to 1: each whole number has a random slope, and each point's value lies along the slopes around it. The
/// greatest is 1/2, between slopes of 1 and -1.
fn gradient_noise1(x: f32, seed: i32) -> f32 {
    let cell = i32(floor(x));
    let f = fract(x);
    let left = (2.0 * unit_floats(lattice_hash(vec3i(cell, 0, 0), seed)).x - 1.0) * f;
    let right = (2.0 * unit_floats(lattice_hash(vec3i(cell + 1, 0, 0), seed)).x - 1.0) * (f - 1.0);
    return 2.0 * mix(left, right, fade(vec3f(f)).x);
}

/// Gradient Noise 1D
///
/// Smooth bumps along a number, 0 at each whole one: a lamp that flickers with the time, bands along one coordinate, an uneven edge.
/// Perlin 2002, "Improving Noise", on a line. Fades to 0 where bumps are smaller than pixels.
/// @node procedural/gradient_noise_1d   @also perlin, flicker, wiggle, line, time
/// - x: where on the line [0]
/// - scale: bumps per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_gradient_noise_1d_vertex
fn node_procedural_gradient_noise_1d(x: f32, scale: f32, seed: i32) -> f32 {
    let p = held1(x * scale);
    let width = min(fwidth(p), 1e3);
    return gradient_noise1(p, seed) * left_of_noise(1.0, width * width);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_gradient_noise_1d_vertex(x: f32, scale: f32, seed: i32) -> f32 {
    return gradient_noise1(held1(x * scale), seed);
}
