// Gradient noise: each lattice point has a random direction, and a point's value is how far it lies along the directions
// around it. Perlin 1985, "An Image Synthesizer"; 2002, "Improving Noise".

// cos and sin of 22.5 degrees: eight directions of length 1, none along an axis or a diagonal.
const COMPASS_LONG: f32 = 0.92387953;
const COMPASS_SHORT: f32 = 0.38268343;

/// How far `offset` lies along the random direction of a lattice point of the plane: one of eight, 45 degrees apart.
fn lattice_gradient2(cell: vec2i, seed: i32, offset: vec2f) -> f32 {
    let h = lattice_hash(vec3i(cell, 0), seed).x >> 29u;
    let steep = (h & 1u) != 0u;
    let x = select(COMPASS_LONG, COMPASS_SHORT, steep) * offset.x;
    let y = select(COMPASS_SHORT, COMPASS_LONG, steep) * offset.y;
    return select(x, -x, (h & 2u) != 0u) + select(y, -y, (h & 4u) != 0u);
}

/// How far `offset` lies along the random direction of a lattice point of space: one of the twelve to the middles of a
/// cube's edges, of length sqrt(2), as Perlin 2002 chose them.
fn lattice_gradient3(cell: vec3i, seed: i32, offset: vec3f) -> f32 {
    let h = lattice_hash(cell, seed);
    let axis = (h.x >> 8u) % 3u;
    let a = select(offset.x, offset.y, axis == 0u);
    let b = select(offset.z, offset.y, axis == 2u);
    return select(a, -a, (h.y >> 31u) != 0u) + select(b, -b, (h.z >> 31u) != 0u);
}

/// Gradient noise in the plane, -1 to 1. The greatest sum over all points and choices of directions is 0.66082, found by
/// search.
fn gradient_noise2(p: vec2f, seed: i32) -> f32 {
    let cell = vec2i(floor(p));
    let f = fract(p);
    let w = fade(vec3f(f, 0.0));
    let top = mix(lattice_gradient2(cell, seed, f),
                  lattice_gradient2(cell + vec2i(1, 0), seed, f - vec2f(1.0, 0.0)), w.x);
    let bottom = mix(lattice_gradient2(cell + vec2i(0, 1), seed, f - vec2f(0.0, 1.0)),
                     lattice_gradient2(cell + vec2i(1, 1), seed, f - vec2f(1.0, 1.0)), w.x);
    return mix(top, bottom, w.y) / 0.66082;
}

/// Gradient noise in space, -1 to 1. The greatest sum over all points and choices of directions is 1.03636, found by search.
fn gradient_noise3(p: vec3f, seed: i32) -> f32 {
    let cell = vec3i(floor(p));
    let f = fract(p);
    let w = fade(f);
    let near_top = mix(lattice_gradient3(cell, seed, f),
                       lattice_gradient3(cell + vec3i(1, 0, 0), seed, f - vec3f(1.0, 0.0, 0.0)), w.x);
    let near_bottom = mix(lattice_gradient3(cell + vec3i(0, 1, 0), seed, f - vec3f(0.0, 1.0, 0.0)),
                          lattice_gradient3(cell + vec3i(1, 1, 0), seed, f - vec3f(1.0, 1.0, 0.0)), w.x);
    let far_top = mix(lattice_gradient3(cell + vec3i(0, 0, 1), seed, f - vec3f(0.0, 0.0, 1.0)),
                      lattice_gradient3(cell + vec3i(1, 0, 1), seed, f - vec3f(1.0, 0.0, 1.0)), w.x);
    let far_bottom = mix(lattice_gradient3(cell + vec3i(0, 1, 1), seed, f - vec3f(0.0, 1.0, 1.0)),
                         lattice_gradient3(cell + vec3i(1, 1, 1), seed, f - vec3f(1.0, 1.0, 1.0)), w.x);
    return mix(mix(near_top, near_bottom, w.y), mix(far_top, far_bottom, w.y), w.z) / 1.03636;
}

/// Gradient Noise 2D
///
/// Perlin's noise: smooth bumps of one size, 0 at each lattice point. Perlin 2002, "Improving Noise", with eight
/// directions and the hash of Jarzynski and Olano 2020. Fades to 0 where bumps are smaller than pixels.
/// @node procedural/gradient_noise_2d   @also perlin, clouds, bumps
/// - uv: coordinates [context uv0]
/// - scale: lattice points per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_gradient_noise_2d_vertex
fn node_procedural_gradient_noise_2d(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return gradient_noise2(p, seed) * left_of_noise(1.0, squared_footprint2(p));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_gradient_noise_2d_vertex(uv: vec2f, scale: f32, seed: i32) -> f32 {
    return gradient_noise2(held2(uv * scale), seed);
}

/// Gradient Noise 3D
///
/// Perlin's noise: smooth bumps of one size, 0 at each lattice point. Perlin 2002, "Improving Noise", with the hash of
/// Jarzynski and Olano 2020. Fades to 0 where bumps are smaller than pixels.
/// @node procedural/gradient_noise_3d   @also perlin, clouds, bumps
/// - position: the point [context object_position]
/// - scale: lattice points per metre [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_gradient_noise_3d_vertex
fn node_procedural_gradient_noise_3d(position: vec3f, scale: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return gradient_noise3(p, seed) * left_of_noise(1.0, squared_footprint(p));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_gradient_noise_3d_vertex(position: vec3f, scale: f32, seed: i32) -> f32 {
    return gradient_noise3(held3(position * scale), seed);
}
