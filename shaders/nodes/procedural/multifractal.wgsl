// Octaves of gradient noise that are multiplied. Each has its own seed and mean 0, so that the mean of the product is that of its factors, and
// an octave that the pixel averages away leaves 1.

/// Multifractal 2D
///
/// Octaves of gradient noise multiplied instead of added: rough where it is high, smooth where it is low, as rock and soil are.
///   product of 1 + gain^i noise_i
/// Musgrave in Ebert et al. 2003, "Texturing and Modeling", chapter 16. Octaves that are finer than pixels fade to their mean.
/// @node procedural/multifractal_2d   @also musgrave, fractal, terrain, rock, erosion, uneven
/// - uv: coordinates [context uv0]
/// - scale: lattice points of the first octave per unit [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 upward, mean 1
/// @vertex node_procedural_multifractal_2d_vertex
fn node_procedural_multifractal_2d(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return multifractal2(p, squared_footprint2(p), octaves, lacunarity, gain, 0.0, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_multifractal_2d_vertex(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return multifractal2(held2(uv * scale), 0.0, octaves, lacunarity, gain, 0.0, seed);
}

/// Terrain 2D
///
/// Heights whose fine octaves grow with the height: plains stay smooth, peaks are rugged. Heterogeneous terrain of Musgrave in Ebert et al. 2003,
/// "Texturing and Modeling", chapter 16, over its mean:
///   (1 + noise_0 / offset) product of 1 + gain^i noise_i / (1 + gain^i offset),  i from 1 on
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/terrain_2d   @also musgrave, hetero terrain, mountains, landscape, height
/// - uv: coordinates [context uv0]
/// - scale: lattice points of the first octave per unit [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - offset: height of the middle over the sea, in heights of the first octave; held in 1..8 [1; 1..4]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 upward, mean 1
/// @vertex node_procedural_terrain_2d_vertex
fn node_procedural_terrain_2d(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return multifractal2(p, squared_footprint2(p), octaves, lacunarity, gain, clamp(offset, 1.0, 8.0), seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_terrain_2d_vertex(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    return multifractal2(held2(uv * scale), 0.0, octaves, lacunarity, gain, clamp(offset, 1.0, 8.0), seed);
}

/// The product over a window of `squared_width`: of a terrain `offset` above the sea, or with 0 of a multifractal.
fn multifractal2(start: vec2f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var product = 1.0;
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        // The first octave of a terrain stands on the offset alone.
        let ground = select(1.0, 0.0, i == 0 && offset > 0.0) + weight * offset;
        product *= 1.0 + weight / ground * gradient_noise2(p, seed + i) * left_of_noise(1.0, window);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return product;
}

/// Multifractal 3D
///
/// Octaves of gradient noise multiplied instead of added: rough where it is high, smooth where it is low, as rock and soil are.
///   product of 1 + gain^i noise_i
/// Musgrave in Ebert et al. 2003, "Texturing and Modeling", chapter 16. Octaves that are finer than pixels fade to their mean.
/// @node procedural/multifractal_3d   @also musgrave, fractal, terrain, rock, erosion, uneven
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 upward, mean 1
/// @vertex node_procedural_multifractal_3d_vertex
fn node_procedural_multifractal_3d(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return multifractal3(p, squared_footprint(p), octaves, lacunarity, gain, 0.0, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_multifractal_3d_vertex(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return multifractal3(held3(position * scale), 0.0, octaves, lacunarity, gain, 0.0, seed);
}

/// Terrain 3D
///
/// Heights whose fine octaves grow with the height: plains stay smooth, peaks are rugged. Heterogeneous terrain of Musgrave in Ebert et al. 2003,
/// "Texturing and Modeling", chapter 16, over its mean:
///   (1 + noise_0 / offset) product of 1 + gain^i noise_i / (1 + gain^i offset),  i from 1 on
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/terrain_3d   @also musgrave, hetero terrain, mountains, landscape, height
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - offset: height of the middle over the sea, in heights of the first octave; held in 1..8 [1; 1..4]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 upward, mean 1
/// @vertex node_procedural_terrain_3d_vertex
fn node_procedural_terrain_3d(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return multifractal3(p, squared_footprint(p), octaves, lacunarity, gain, clamp(offset, 1.0, 8.0), seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_terrain_3d_vertex(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    return multifractal3(held3(position * scale), 0.0, octaves, lacunarity, gain, clamp(offset, 1.0, 8.0), seed);
}

/// The product over a window of `squared_width`: of a terrain `offset` above the sea, or with 0 of a multifractal.
fn multifractal3(start: vec3f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, offset: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var product = 1.0;
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        // The first octave of a terrain stands on the offset alone.
        let ground = select(1.0, 0.0, i == 0 && offset > 0.0) + weight * offset;
        product *= 1.0 + weight / ground * gradient_noise3(p, seed + i) * left_of_noise(1.0, window);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return product;
}
