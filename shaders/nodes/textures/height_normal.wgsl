/// Normal from Height
///
/// The colour of the +Y normal map of a height map: slopes by central differences over a texel, or over a pixel where that
/// is more. Four reads.
///   n = normalize(-h_x, -h_y, 1)
/// @node textures/height_normal   @also bump, relief, height to normal, displacement
/// - image: the height map; its red is read [image linear]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - depth: height between black and white, in units of the picture's edge [0.05; 0..0.5]
/// - return: a colour of a normal map
/// @slope image
fn node_textures_height_normal(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, depth: f32) -> vec3f {
    // Never 0: a texture has at most 2^15 texels a side.
    let reach = max(1.0 / vec2f(textureDimensions(image)), 0.5 * (abs(dpdx(uv)) + abs(dpdy(uv))));
    let right = textureSample(image, image_sampler, uv + vec2f(reach.x, 0.0)).r;
    let left = textureSample(image, image_sampler, uv - vec2f(reach.x, 0.0)).r;
    let below = textureSample(image, image_sampler, uv + vec2f(0.0, reach.y)).r;
    let above = textureSample(image, image_sampler, uv - vec2f(0.0, reach.y)).r;
    let slope = 0.5 * depth * vec2f(right - left, above - below) / reach;
    return texel_from_normal(normal_from_slopes(slope.x, slope.y));
}
