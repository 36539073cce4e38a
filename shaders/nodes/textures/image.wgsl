/// The outputs of the node textures/image.
struct ImageOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// coverage; 1 for an image without it
    alpha: f32,
    /// red channel
    r: f32,
    /// green channel
    g: f32,
    /// blue channel
    b: f32,
}

/// Image
///
/// Reads a picture, with mip levels. Mark colours as sRGB, and everything else (roughness, normals, heights) as linear.
/// @node textures/image   @also texture, picture, bitmap, map
/// - image: the picture [image srgb]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// @vertex node_textures_image_vertex
fn node_textures_image(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs {
    let texel = textureSample(image, image_sampler, uv);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}

/// The image read at its finest level: the vertex stage has no derivatives to choose another one by.
fn node_textures_image_vertex(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs {
    let texel = textureSampleLevel(image, image_sampler, uv, 0.0);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
