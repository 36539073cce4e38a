/// Three random numbers of a number, which counts in steps of 1/4096 so that what is computed a little differently gives the same.
fn random_of_number(x: f32, seed: i32) -> vec3f {
    return unit_floats(lattice_hash(vec3i(i32(floor(clamp(x, -1e5, 1e5) * 4096.0 + 0.5)), 0, 1), seed));
}

/// Random Number
///
/// A random number of a number: the same for the same one, unlike for all others. Gives tiles, cells, bricks and objects, which all have a number, their own
/// size, turn or wear. Numbers count in steps of 1/4096, up to 1e5 in size. Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node math/random   @also hash, vary, id, per tile
/// - x: the number of a thing, whole or not: an index, an id in 0..1 [0]
/// - low: least result [0; 0..1]
/// - high: greatest result [1; 0..1]
/// - seed: another one, other numbers [0; 0..100]
/// - return: low to high
fn node_math_random(x: f32, low: f32, high: f32, seed: i32) -> f32 {
    return mix(low, high, random_of_number(x, seed).x);
}
