// Gradient noise of four numbers: a pattern in space that changes in place as the fourth runs.

/// Four random words of four words. Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg4d.
fn pcg4d(v: vec4u) -> vec4u {
    var h = v * 1664525u + 1013904223u;
    h.x += h.y * h.w;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    h.w += h.y * h.z;
    h ^= h >> vec4u(16u);
    h.x += h.y * h.w;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    h.w += h.y * h.z;
    return h;
}

/// How far `offset` lies along the random direction of a lattice point: one of the 32 to the middles of a hypercube's edges, of length
/// sqrt(3), as Perlin 2002 chose them for four numbers.
fn lattice_gradient4(cell: vec4i, seed: i32, offset: vec4f) -> f32 {
    let h = pcg4d(bitcast<vec4u>(cell) + vec4u(0u, 0u, 0u, bitcast<u32>(seed) * 0x9e3779b9u));
    let axis = h.x >> 30u;
    // The last component takes the place of the one that the direction has not.
    let a = select(offset.x, offset.w, axis == 0u);
    let b = select(offset.y, offset.w, axis == 1u);
    let c = select(offset.z, offset.w, axis == 2u);
    return select(a, -a, (h.y >> 31u) != 0u) + select(b, -b, (h.z >> 31u) != 0u) + select(c, -c, (h.w >> 31u) != 0u);
}

/// Gradient noise of four numbers, -1 to 1. The greatest sum over all points and choices of directions is 1.53658, found by search.
fn gradient_noise4(p: vec4f, seed: i32) -> f32 {
    let cell = vec4i(floor(p));
    let f = fract(p);
    let w = vec4f(fade(f.xyz), fade(f.www).x);
    var total = 0.0;
    for (var corner = 0u; corner < 16u; corner++) {
        let bits = (vec4u(corner) >> vec4u(0u, 1u, 2u, 3u)) & vec4u(1u);
        let along = select(1.0 - w, w, bits == vec4u(1u));
        total += along.x * along.y * along.z * along.w * lattice_gradient4(cell + vec4i(bits), seed, f - vec4f(bits));
    }
    return total / 1.53658;
}

/// Gradient Noise 4D
///
/// Perlin's noise in space that changes in place: wire the time, or a random number of the object, into `evolution`. Where a moving pattern
/// would swim through the surface, this one boils. Perlin 2002, "Improving Noise", with the hash of Jarzynski and Olano 2020. Fades to 0 where
/// bumps are smaller than pixels. Twice the cost of that in space.
/// @node procedural/gradient_noise_4d   @also perlin, clouds, animated, evolve, time, boiling
/// - position: the point [context object_position]
/// - scale: lattice points per metre [8; 0..64]
/// - evolution: the fourth coordinate; from one whole number to the next the pattern becomes another [0; 0..10]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_gradient_noise_4d_vertex
fn node_procedural_gradient_noise_4d(position: vec3f, scale: f32, evolution: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return gradient_noise4(held4(vec4f(p, evolution)), seed) * left_of_noise(1.0, squared_footprint(p));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_gradient_noise_4d_vertex(position: vec3f, scale: f32, evolution: f32, seed: i32) -> f32 {
    return gradient_noise4(held4(vec4f(position * scale, evolution)), seed);
}

/// Fractal Noise 4D
///
/// Octaves of gradient noise in space that change in place as `evolution` runs, finer ones faster: fire, smoke, clouds, running
/// water. Each octave is finer by the lacunarity and weaker by the gain, over the sum of their weights. Musgrave, Kolb and Mace 1989, "The
/// synthesis and rendering of eroded fractal terrains". Octaves that are finer than pixels fade to their mean.
/// @node procedural/fbm_4d   @also fractal, perlin, clouds, fire, smoke, animated, evolve, time
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - evolution: the fourth coordinate of the first octave [0; 0..10]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_fbm_4d_vertex
fn node_procedural_fbm_4d(position: vec3f, scale: f32, evolution: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return fbm4(held4(vec4f(p, evolution)), squared_footprint(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_fbm_4d_vertex(position: vec3f, scale: f32, evolution: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return fbm4(held4(vec4f(position * scale, evolution)), 0.0, octaves, lacunarity, gain, seed);
}

/// Fractal Noise over a window of `squared_width`.
fn fbm4(start: vec4f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise4(p, seed + i);
        total += weight * vec2f(noise * left_of_noise(1.0, window), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}
