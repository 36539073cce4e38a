/// A random value in 0..1 for a point of the lattice.
fn lattice_value(cell: vec3i, seed: i32) -> f32 {
    return unit_floats(lattice_hash(cell, seed)).x;
}

/// Random values of four neighbours in the plane, mixed.
fn lattice_mix2(cell: vec2i, weights: vec2f, seed: i32) -> f32 {
    let c = vec3i(cell, 0);
    let top = mix(lattice_value(c, seed), lattice_value(c + vec3i(1, 0, 0), seed), weights.x);
    let bottom = mix(lattice_value(c + vec3i(0, 1, 0), seed), lattice_value(c + vec3i(1, 1, 0), seed), weights.x);
    return mix(top, bottom, weights.y);
}

/// Random values of eight neighbours in space, mixed.
fn lattice_mix3(cell: vec3i, weights: vec3f, seed: i32) -> f32 {
    let c = cell;
    let near_top = mix(lattice_value(c, seed), lattice_value(c + vec3i(1, 0, 0), seed), weights.x);
    let near_bottom = mix(lattice_value(c + vec3i(0, 1, 0), seed), lattice_value(c + vec3i(1, 1, 0), seed), weights.x);
    let far_top = mix(lattice_value(c + vec3i(0, 0, 1), seed), lattice_value(c + vec3i(1, 0, 1), seed), weights.x);
    let far_bottom = mix(lattice_value(c + vec3i(0, 1, 1), seed), lattice_value(c + vec3i(1, 1, 1), seed), weights.x);
    return mix(mix(near_top, near_bottom, weights.y), mix(far_top, far_bottom, weights.y), weights.z);
}

/// Value Noise 2D
///
/// Random values on a unit lattice, faded into each other: soft blotches. Quintic fade of Perlin 2002. Fades to its mean where blotches are
/// smaller than pixels.
/// @node procedural/value_noise_2d   @also random, blotches, clouds
/// - uv: coordinates [context uv0]
/// - scale: lattice points per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
/// @vertex node_procedural_value_noise_2d_vertex
fn node_procedural_value_noise_2d(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let left = left_of_noise(0.4, squared_footprint2(held2(uv * scale)));
    return mix(0.5, node_procedural_value_noise_2d_vertex(uv, scale, seed), left);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_value_noise_2d_vertex(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return lattice_mix2(vec2i(floor(p)), fade(vec3f(fract(p), 0.0)).xy, seed);
}

/// Value Noise 3D
///
/// Random values on a unit lattice, faded into each other: soft blotches. Quintic fade of Perlin 2002. Fades to its mean where blotches are
/// smaller than pixels.
/// @node procedural/value_noise_3d   @also random, blotches, clouds
/// - position: the point [context object_position]
/// - scale: lattice points per metre [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
/// @vertex node_procedural_value_noise_3d_vertex
fn node_procedural_value_noise_3d(position: vec3f, scale: f32, seed: i32) -> f32 {
    let left = left_of_noise(0.4, squared_footprint(held3(position * scale)));
    return mix(0.5, node_procedural_value_noise_3d_vertex(position, scale, seed), left);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_value_noise_3d_vertex(position: vec3f, scale: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return lattice_mix3(vec3i(floor(p)), fade(fract(p)), seed);
}
