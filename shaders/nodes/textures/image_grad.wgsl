/// Image at Moved Coordinates
///
/// Reads a picture at coordinates that may jump from pixel to pixel (parallax, tiles, cells), with the mip level of
/// coordinates that do not: no seams where they jump.
/// @node textures/image_grad   @also texture, parallax, level, gradient
/// - image: the picture [image srgb]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - smooth_uv: the coordinates before they were moved; their derivatives choose the level [context uv0]
fn node_textures_image_grad(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, smooth_uv: vec2f) -> ImageOutputs {
    let texel = textureSampleGrad(image, image_sampler, uv, dpdx(smooth_uv), dpdy(smooth_uv));
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
