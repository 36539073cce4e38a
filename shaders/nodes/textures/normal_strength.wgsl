/// Normal Strength
///
/// A colour of a normal map with its slopes times a factor: the normal map of a relief as many times as high.
/// @node textures/normal_strength   @also normal intensity, flatten, bump
/// - color: a colour of a normal map [0.5,0.5,1]
/// - strength: factor of the slopes; below 0 bumps become dents [1; 0..2]
/// - return: the colour of the stronger normal
fn node_textures_normal_strength(color: vec3f, strength: f32) -> vec3f {
    return texel_from_normal(normal_with_strength(normal_from_texel(color, 1.0, false), strength));
}
