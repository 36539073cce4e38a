/// Panorama
///
/// Reads an equirectangular picture in a direction: u = atan2(z, x) / (2 pi) + 1/2, v = acos(y) / pi. No seam where u jumps: the level is
/// chosen by the smaller of the changes of u and of u half a turn on. For pictures in glass, fake rooms and skies.
/// @node textures/panorama   @also environment, latlong, equirectangular, sky, reflection
/// - image: the picture [image srgb]
/// - dir: the direction, of any length; 0 counts as +Y [context world_normal]
fn node_textures_panorama(image: texture_2d<f32>, image_sampler: sampler, dir: vec3f) -> ImageOutputs {
    let uv = uv_from_direction(dir);
    let other = fract(uv.x + 0.5);
    let u_x = select(dpdx(other), dpdx(uv.x), abs(dpdx(uv.x)) < abs(dpdx(other)));
    let u_y = select(dpdy(other), dpdy(uv.x), abs(dpdy(uv.x)) < abs(dpdy(other)));
    let texel = textureSampleGrad(image, image_sampler, uv, vec2f(u_x, dpdx(uv.y)), vec2f(u_y, dpdy(uv.y)));
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
