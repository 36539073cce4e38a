// Octaves of gradient noise that is folded at 0, where its valleys or ridges are.

// Means of the absolute value of gradient noise in the plane and in space, measured.
const MEAN_OF_BILLOWS: vec2f = vec2f(0.266, 0.212);
// Means of the square of 1 less that, measured.
const MEAN_OF_RIDGES: vec2f = vec2f(0.574, 0.643);

/// Turbulence 2D
///
/// Octaves of the absolute value of gradient noise: billows with sharp valleys. Perlin 1985, "An Image Synthesizer".
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/turbulence_2d   @also billow, marble, smoke, veins
/// - uv: coordinates [context uv0]
/// - scale: lattice points of the first octave per unit [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_turbulence_2d_vertex
fn node_procedural_turbulence_2d(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return turbulence2(p, squared_footprint2(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_turbulence_2d_vertex(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return turbulence2(held2(uv * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Turbulence over a window of `squared_width`.
fn turbulence2(start: vec2f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise2(p, seed + i);
        total += weight * vec2f(mix(MEAN_OF_BILLOWS.x, abs(noise), left_of_noise(2.2, window)), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}

/// Turbulence 3D
///
/// Octaves of the absolute value of gradient noise: billows with sharp valleys. Perlin 1985, "An Image Synthesizer".
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/turbulence_3d   @also billow, marble, smoke, veins
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_turbulence_3d_vertex
fn node_procedural_turbulence_3d(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return turbulence3(p, squared_footprint(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_turbulence_3d_vertex(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return turbulence3(held3(position * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Turbulence over a window of `squared_width`.
fn turbulence3(start: vec3f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise3(p, seed + i);
        total += weight * vec2f(mix(MEAN_OF_BILLOWS.y, abs(noise), left_of_noise(2.2, window)), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}

/// Ridged Noise 2D
///
/// Octaves of (1 - |noise|)^2: sharp ridges with round valleys, for mountains, cracks and veins. After Musgrave in Ebert et al. 2003,
/// "Texturing and Modeling", chapter 16, each octave by itself.
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/ridged_2d   @also musgrave, multifractal, mountains, cracks, lightning
/// - uv: coordinates [context uv0]
/// - scale: lattice points of the first octave per unit [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_ridged_2d_vertex
fn node_procedural_ridged_2d(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    return ridged2(p, squared_footprint2(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_ridged_2d_vertex(uv: vec2f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return ridged2(held2(uv * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Ridged Noise over a window of `squared_width`.
fn ridged2(start: vec2f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise2(p, seed + i);
        total += weight * vec2f(mix(MEAN_OF_RIDGES.x, (1.0 - abs(noise)) * (1.0 - abs(noise)), left_of_noise(2.4, window)), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}

/// Ridged Noise 3D
///
/// Octaves of (1 - |noise|)^2: sharp ridges with round valleys, for mountains, cracks and veins. After Musgrave in Ebert et al. 2003,
/// "Texturing and Modeling", chapter 16, each octave by itself.
/// Octaves that are finer than pixels fade to their mean.
/// @node procedural/ridged_3d   @also musgrave, multifractal, mountains, cracks, lightning
/// - position: the point [context object_position]
/// - scale: lattice points of the first octave per metre [4; 0..64]
/// - octaves: how many; held in 1..8 [5; 1..8]
/// - lacunarity: how much finer each octave is; held in 1..4 [2; 1..4]
/// - gain: how much weaker each octave is; held in 0..1 [0.5; 0..1]
/// - seed: another one, another pattern [0; 0..100]
/// - return: 0 to 1
/// @vertex node_procedural_ridged_3d_vertex
fn node_procedural_ridged_3d(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    return ridged3(p, squared_footprint(p), octaves, lacunarity, gain, seed);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_ridged_3d_vertex(position: vec3f, scale: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    return ridged3(held3(position * scale), 0.0, octaves, lacunarity, gain, seed);
}

/// Ridged Noise over a window of `squared_width`.
fn ridged3(start: vec3f, squared_width: f32, octaves: i32, lacunarity: f32, gain: f32, seed: i32) -> f32 {
    let finer = clamp(lacunarity, 1.0, 4.0);
    var p = start;
    var window = squared_width;
    var weight = 1.0;
    var total = vec2f(0.0);
    for (var i = 0; i < clamp(octaves, 1, MAX_OCTAVES); i++) {
        let noise = gradient_noise3(p, seed + i);
        total += weight * vec2f(mix(MEAN_OF_RIDGES.y, (1.0 - abs(noise)) * (1.0 - abs(noise)), left_of_noise(2.4, window)), 1.0);
        p *= finer;
        window *= finer * finer;
        weight *= clamp(gain, 0.0, 1.0);
    }
    return total.x / total.y;
}
