/// Blur
///
/// Reads a picture blurred, by a Gaussian of half the radius as its standard deviation s: 5 x 5 reads, s apart, of the mip level whose texels
/// are as wide, with the weights exp(-i^2/1.5). Together with the texels' own width the spread is that of the Gaussian to 1 %, at the cost of
/// 25 reads for any radius. Of a picture that is not square the blur is the same in both directions of the coordinates, and softer
/// along the short side.
/// @node textures/blur   @also gaussian, soften, smooth, defocus, diffuse
/// - image: the picture [image srgb]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - radius: how far the blur reaches, in units of the picture's edge; below 0 counts as 0 [0.02; 0..0.25]
/// @vertex node_textures_blur_vertex
fn node_textures_blur(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, radius: f32) -> ImageOutputs {
    let texels = vec2f(textureDimensions(image));
    let x = dpdx(uv) * texels;
    let y = dpdy(uv) * texels;
    return blurred(image, image_sampler, uv, radius, sqrt(max(dot(x, x), dot(y, y))));
}

/// The vertex stage has no pixels: texels as wide as the reads are apart.
fn node_textures_blur_vertex(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, radius: f32) -> ImageOutputs {
    return blurred(image, image_sampler, uv, radius, 0.0);
}

/// A picture blurred, for pixels of a width in texels.
fn blurred(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, radius: f32, pixel: f32) -> ImageOutputs {
    let apart = 0.5 * max(radius, 0.0);
    let texels = vec2f(textureDimensions(image));
    // 1: nothing is finer than a texel.
    let lod = log2(max(max(apart * max(texels.x, texels.y), pixel), 1.0));
    var total = vec4f(0.0);
    for (var y = -2; y <= 2; y++) {
        for (var x = -2; x <= 2; x++) {
            let place = vec2f(f32(x), f32(y));
            let weight = exp(dot(place, place) * (-1.0 / 1.5));
            total += weight * textureSampleLevel(image, image_sampler, uv + apart * place, lod);
        }
    }
    // The square of 1 + 2 exp(-1/1.5) + 2 exp(-4/1.5).
    let texel = total / 4.690695;
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
