// Reading a picture for a height. What is seen of a height is its slope, the small difference of neighbouring reads, and devices blend
// texels by weights of 8 bits (some round the blend to 8 bits, too): of a magnified map that is a staircase, and shows as
// stripes. Here each texel is read at its middle, where weights do not count, and the blend is arithmetic. The sampler still
// says how the picture repeats.

/// One level of a picture: the four texels around the place, blended bilinearly.
fn blended_texels(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, level: u32) -> vec4f {
    let size = vec2f(max(textureDimensions(image) >> vec2u(level), vec2u(1u)));
    let place = uv * size - 0.5;
    let corner = floor(place);
    let weight = place - corner;
    let low = (corner + 0.5) / size;
    let high = (corner + 1.5) / size;
    let lod = f32(level);
    let above_left = textureSampleLevel(image, image_sampler, low, lod);
    let above_right = textureSampleLevel(image, image_sampler, vec2f(high.x, low.y), lod);
    let below_left = textureSampleLevel(image, image_sampler, vec2f(low.x, high.y), lod);
    let below_right = textureSampleLevel(image, image_sampler, high, lod);
    return mix(mix(above_left, above_right, weight.x), mix(below_left, below_right, weight.x), weight.y);
}

/// A picture at a level that may lie between two of its own, which are blended linearly.
fn blended_levels(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, lod: f32) -> vec4f {
    // No texture has more than 2^15 texels a side.
    let level = clamp(lod, 0.0, 15.0);
    let fine = blended_texels(image, image_sampler, uv, u32(level));
    let part = fract(level);
    // Magnified: four reads do.
    if part == 0.0 {
        return fine;
    }
    return mix(fine, blended_texels(image, image_sampler, uv, u32(level) + 1u), part);
}

/// The level whose texels are as wide as a pixel is in `uv`, as a sampler chooses it: one for a block of 2 x 2 pixels, whose difference
/// is then one of places, and not of levels. At least 0.
fn texel_lod(image: texture_2d<f32>, uv: vec2f) -> f32 {
    let size = vec2f(textureDimensions(image));
    let x = dpdxCoarse(uv) * size;
    let y = dpdyCoarse(uv) * size;
    return 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0));
}
