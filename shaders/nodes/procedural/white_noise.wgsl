/// The outputs of the nodes procedural/white_noise_2d and procedural/white_noise_3d.
struct WhiteNoiseOutputs {
    /// 0 to 1, 1 excluded
    value: f32,
    /// three independent values
    color: vec3f,
}

/// White Noise 2D
///
/// A random value and colour for each unit square: the same everywhere in it, unlike in its neighbours. For
/// numbers of things (tiles, cells): as a pattern it is not filtered; Cell Noise is.
/// Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node procedural/white_noise_2d   @also random, cell noise, hash
/// - uv: coordinates; scale them up for more squares [context uv0]
/// - seed: another one, another pattern [0; 0..100]
fn node_procedural_white_noise_2d(uv: vec2f, seed: i32) -> WhiteNoiseOutputs {
    let random = unit_floats(lattice_hash(vec3i(vec2i(floor(uv)), 0), seed));
    return WhiteNoiseOutputs(random.x, random);
}

/// White Noise 3D
///
/// A random value and colour for each unit cube: the same everywhere in it, unlike in its neighbours. For
/// numbers of things (tiles, cells): as a pattern it is not filtered; Cell Noise is.
/// Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node procedural/white_noise_3d   @also random, cell noise, hash
/// - position: the point; scale it up for more cubes [context object_position]
/// - seed: another one, another pattern [0; 0..100]
fn node_procedural_white_noise_3d(position: vec3f, seed: i32) -> WhiteNoiseOutputs {
    let random = unit_floats(lattice_hash(vec3i(floor(position)), seed));
    return WhiteNoiseOutputs(random.x, random);
}
