// Random values of unit cells over a window: where the window crosses a border the two values are mixed by their parts of it, exactly for
// windows up to one cell along the axes; wider ones fade to the mean. The distance to the border is taken first: beside it it is exact, and
// a window may be as narrow as rounding.

/// Cell Noise 2D
///
/// A random value for each unit square, with smooth borders of a pixel's width. Fades to its mean where squares are smaller than pixels.
/// Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node procedural/cell_noise_2d   @also random, mosaic, pixels, blocks
/// - uv: coordinates [context uv0]
/// - scale: squares per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
/// @vertex node_procedural_cell_noise_2d_vertex
fn node_procedural_cell_noise_2d(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    let window = max(fwidth(p), vec2f(1e-6));
    let w = min(window, vec2f(1.0));
    let first = floor(p - 0.5 * w);
    let second = clamp((p - (first + 1.0)) / w + 0.5, vec2f(0.0), vec2f(1.0));
    let left = w / window;
    return mix(0.5, lattice_mix2(vec2i(first), second, seed), left.x * left.y);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_cell_noise_2d_vertex(uv: vec2f, scale: f32, seed: i32) -> f32 {
    return lattice_value(vec3i(vec2i(floor(held2(uv * scale))), 0), seed);
}

/// Cell Noise 3D
///
/// A random value for each unit cube, with smooth borders of a pixel's width. Fades to its mean where cubes are smaller than pixels.
/// Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node procedural/cell_noise_3d   @also random, mosaic, voxels, blocks
/// - position: the point [context object_position]
/// - scale: cubes per metre [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1, mean 0.5
/// @vertex node_procedural_cell_noise_3d_vertex
fn node_procedural_cell_noise_3d(position: vec3f, scale: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    let window = max(fwidth(p), vec3f(1e-6));
    let w = min(window, vec3f(1.0));
    let first = floor(p - 0.5 * w);
    let second = clamp((p - (first + 1.0)) / w + 0.5, vec3f(0.0), vec3f(1.0));
    let left = w / window;
    return mix(0.5, lattice_mix3(vec3i(first), second, seed), left.x * left.y * left.z);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_cell_noise_3d_vertex(position: vec3f, scale: f32, seed: i32) -> f32 {
    return lattice_value(vec3i(floor(held3(position * scale))), seed);
}
