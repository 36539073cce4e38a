/// Detail
///
/// A fine picture multiplied onto a colour that was read from a coarse one; its grey 0.5 changes nothing. Fades with its own mip levels, whose
/// mean it becomes. Read the picture as linear.
/// @node textures/detail   @also detail map, overlay, microstructure
/// - image: the fine picture [image linear]
/// - uv: coordinates of the coarse picture [context uv0]
/// - color: the colour read from it [0.5,0.5,0.5; 0..1; color]
/// - scale: repeats of the fine one per unit, across and down [8,8; 1..64]
/// - strength: 0 nothing, 1 all [1; 0..2]
/// - return: the detailed colour, none below 0
/// @vertex node_textures_detail_vertex
fn node_textures_detail(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, color: vec3f, scale: vec2f, strength: f32) -> vec3f {
    return with_detail(color, textureSample(image, image_sampler, uv * scale).rgb, strength);
}

/// The detail read at its finest level: the vertex stage has no derivatives to choose another one by.
fn node_textures_detail_vertex(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, color: vec3f, scale: vec2f, strength: f32) -> vec3f {
    return with_detail(color, textureSampleLevel(image, image_sampler, uv * scale, 0.0).rgb, strength);
}

/// A colour times twice a detail, by strength.
fn with_detail(color: vec3f, detail: vec3f, strength: f32) -> vec3f {
    return max(color * (1.0 + strength * (2.0 * detail - 1.0)), vec3f(0.0));
}
