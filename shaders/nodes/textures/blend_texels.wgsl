// Reading a picture whose slope counts: that of a height. A slope is the small difference of neighbouring reads, and devices blend
// texels by weights of 8 bits (some round the blend to 8 bits, too): of a magnified map that is a staircase, and shows as
// stripes. Here each texel is read at its middle, where weights do not count, and the blend is arithmetic. The sampler still
// says how the picture repeats. These stand where a function has textureSample, textureSampleLevel and textureSampleGrad.

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
fn blended_level(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, lod: f32) -> vec4f {
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

/// A picture at the level whose texels are as wide as a pixel is, as a sampler chooses it, at least 0; the pixel's sides are given in
/// coordinates of the picture.
fn blended_grad(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, uv_ddx: vec2f, uv_ddy: vec2f) -> vec4f {
    let size = vec2f(textureDimensions(image));
    let x = uv_ddx * size;
    let y = uv_ddy * size;
    return blended_level(image, image_sampler, uv, 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0)));
}

/// A picture at the pixel's own level: one for a block of 2 x 2 pixels, whose difference is then one of places, and not of levels.
fn blended_sample(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> vec4f {
    return blended_grad(image, image_sampler, uv, dpdxCoarse(uv), dpdyCoarse(uv));
}
