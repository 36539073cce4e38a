/// A random value in 0..1 for a point of the lattice.
fn lattice_value(cell: vec3i, seed: i32) -> f32 {
    return unit_floats(lattice_hash(cell, seed)).x;
}

/// Value Noise 2D
///
/// Random values on a unit lattice, faded into each other: soft blotches. Quintic fade of Perlin 2002.
/// @node procedural/value_noise_2d   @also random, blotches, clouds
/// - uv: coordinates [context uv0]
/// - scale: lattice points per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
fn node_procedural_value_noise_2d(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let p = uv * scale;
    let cell = vec3i(vec2i(floor(p)), 0);
    let w = fade(vec3f(fract(p), 0.0));
    let top = mix(lattice_value(cell, seed), lattice_value(cell + vec3i(1, 0, 0), seed), w.x);
    let bottom = mix(lattice_value(cell + vec3i(0, 1, 0), seed), lattice_value(cell + vec3i(1, 1, 0), seed), w.x);
    return mix(top, bottom, w.y);
}

/// Value Noise 3D
///
/// Random values on a unit lattice, faded into each other: soft blotches. Quintic fade of Perlin 2002.
/// @node procedural/value_noise_3d   @also random, blotches, clouds
/// - position: the point [context object_position]
/// - scale: lattice points per metre [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
fn node_procedural_value_noise_3d(position: vec3f, scale: f32, seed: i32) -> f32 {
    let p = position * scale;
    let cell = vec3i(floor(p));
    let w = fade(fract(p));
    let near_top = mix(lattice_value(cell, seed), lattice_value(cell + vec3i(1, 0, 0), seed), w.x);
    let near_bottom = mix(lattice_value(cell + vec3i(0, 1, 0), seed), lattice_value(cell + vec3i(1, 1, 0), seed), w.x);
    let far_top = mix(lattice_value(cell + vec3i(0, 0, 1), seed), lattice_value(cell + vec3i(1, 0, 1), seed), w.x);
    let far_bottom = mix(lattice_value(cell + vec3i(0, 1, 1), seed), lattice_value(cell + vec3i(1, 1, 1), seed), w.x);
    return mix(mix(near_top, near_bottom, w.y), mix(far_top, far_bottom, w.y), w.z);
}
