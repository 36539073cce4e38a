/// Vector Noise 2D
///
/// Two independent gradient noises: add them to coordinates, and what is read there is warped. Fades to 0 where bumps are smaller than
/// pixels.
/// @node procedural/vector_noise_2d   @also perlin, warp, distort, displace coordinates
/// - uv: coordinates [context uv0]
/// - scale: lattice points per unit [4; 0..64]
/// - amount: factor of the result [1; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: each -amount to amount, mean 0
/// @vertex node_procedural_vector_noise_2d_vertex
fn node_procedural_vector_noise_2d(uv: vec2f, scale: f32, amount: f32, seed: i32) -> vec2f {
    let left = left_of_noise(1.0, squared_footprint2(held2(uv * scale)));
    return left * node_procedural_vector_noise_2d_vertex(uv, scale, amount, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_vector_noise_2d_vertex(uv: vec2f, scale: f32, amount: f32, seed: i32) -> vec2f {
    let p = held2(uv * scale);
    return amount * vec2f(gradient_noise2(p, seed), gradient_noise2(p, seed + 1));
}

/// Vector Noise 3D
///
/// Three independent gradient noises: add them to a point, and what is read there is warped. Fades to 0 where bumps are smaller than
/// pixels.
/// @node procedural/vector_noise_3d   @also perlin, warp, distort, displace coordinates, color noise
/// - position: the point [context object_position]
/// - scale: lattice points per metre [4; 0..64]
/// - amount: factor of the result [1; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: each -amount to amount, mean 0
/// @vertex node_procedural_vector_noise_3d_vertex
fn node_procedural_vector_noise_3d(position: vec3f, scale: f32, amount: f32, seed: i32) -> vec3f {
    let left = left_of_noise(1.0, squared_footprint(held3(position * scale)));
    return left * node_procedural_vector_noise_3d_vertex(position, scale, amount, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_vector_noise_3d_vertex(position: vec3f, scale: f32, amount: f32, seed: i32) -> vec3f {
    let p = held3(position * scale);
    return amount * vec3f(gradient_noise3(p, seed), gradient_noise3(p, seed + 1), gradient_noise3(p, seed + 2));
}
