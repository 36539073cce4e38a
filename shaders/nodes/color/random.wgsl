/// Random Colour
///
/// A random colour of a number: the same for the same one, unlike for all others; hue, saturation and value each within their range. For the stones of a wall,
/// leaves, tiles. Numbers count in steps of 1/4096, up to 1e5 in size. Hash pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
/// @node color/random   @also hash, vary, id, per tile, confetti
/// - x: the number of a thing, whole or not: an index, an id in 0..1 [0]
/// - hue: least and greatest, in turns; past 1 it begins again [0,1; 0..1]
/// - saturation: least and greatest [0.5,1; 0..1]
/// - value: least and greatest [0.5,1; 0..1]
/// - seed: another one, other colours [0; 0..100]
/// - return: the colour
fn node_color_random(x: f32, hue: vec2f, saturation: vec2f, value: vec2f, seed: i32) -> vec3f {
    let random = random_of_number(x, seed);
    return rgb_from_hsv(vec3f(mix(hue.x, hue.y, random.x), mix(saturation.x, saturation.y, random.y), mix(value.x, value.y, random.z)));
}
