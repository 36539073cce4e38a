/// Image at a Level
///
/// Reads a picture at a chosen mip level: level 1 has half as many texels a side, and so on. For blurring, and for vertices.
/// @node textures/image_level   @also texture, lod, mip, blur
/// - image: the picture [image srgb]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - lod: the level, between two of them a blend [0; 0..12]
fn node_textures_image_level(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, lod: f32) -> ImageOutputs {
    let texel = textureSampleLevel(image, image_sampler, uv, lod);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
