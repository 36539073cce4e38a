// Sums of gradient noise over octaves. Each octave has its own seed, so that the lattices' common points do not show.

/// Most octaves of a sum.
const MAX_OCTAVES: i32 = 8;

/// Fractal Noise 2D
///
/// Fractional Brownian motion: octaves of gradient noise, each finer by the lacunarity and weaker by the gain, over the
/// sum of their weights. Musgrave, Kolb and Mace 1989, "The synthesis and rendering of eroded fractal terrains".
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/fbm_2d   @also fractal, perlin, clouds, turbulence, fractional brownian motion
/// - uv: coordinates [context uv0]
/// - scale: lattice points of the first octave per unit [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_fbm_2d_vertex
fn node_procedural_fbm_2d(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return fbm2(p, squared_footprint2(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_fbm_2d_vertex(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return fbm2(held2(uv * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Fractal Noise over a window of `squared_width`.
fn fbm2(start: vec2f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise2(p, seed + i);
        total += weight * vec2f(noise * left_of_noise(1.0, window), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}

/// Fractal Noise 3D
///
/// Fractional Brownian motion: octaves of gradient noise, each finer by the lacunarity and weaker by the gain, over the
/// sum of their weights. Musgrave, Kolb and Mace 1989, "The synthesis and rendering of eroded fractal terrains".
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/fbm_3d   @also fractal, perlin, clouds, turbulence, fractional brownian motion
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_fbm_3d_vertex
fn node_procedural_fbm_3d(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return fbm3(p, squared_footprint(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_fbm_3d_vertex(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return fbm3(held3(position * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Fractal Noise over a window of `squared_width`.
fn fbm3(start: vec3f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise3(p, seed + i);
        total += weight * vec2f(noise * left_of_noise(1.0, window), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}
