/// Flipbook
///
/// Reads an animation whose frames stand in one picture, row by row from the top left, and blends each frame into the next. Frames go
/// round. Two reads.
/// @node textures/flipbook   @also sprite sheet, animation, fire, smoke, frames
/// - image: the picture of all frames [image srgb]
/// - uv: coordinates in a frame, held in 0..1 [context uv0]
/// - columns: frames in a row; at least 1 [4; 1..16]
/// - rows: rows of frames; at least 1 [4; 1..16]
/// - frame: which one; multiply the time by frames per second [0; 0..16]
fn node_textures_flipbook(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, columns: i32, rows: i32, frame: f32) -> ImageOutputs {
    let place = node_coordinates_flipbook(uv, columns, rows, frame);
    let size = vec2f(f32(max(columns, 1)), f32(max(rows, 1)));
    let ddx = dpdx(uv) / size;
    let ddy = dpdy(uv) / size;
    let now = textureSampleGrad(image, image_sampler, place.uv, ddx, ddy);
    let next = textureSampleGrad(image, image_sampler, place.next_uv, ddx, ddy);
    let texel = mix(now, next, place.blend);
    return ImageOutputs(texel.rgb, texel.a, texel.r, texel.g, texel.b);
}
