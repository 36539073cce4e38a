/// Normal of Two Channels
///
/// A normal map that keeps x and y only (BC5, ATI2, or red and green of a packed texture), as the colour of a whole one:
/// z = sqrt(1 - x^2 - y^2).
/// @node textures/normal_two_channel   @also bc5, reconstruct z, derive, packed
/// - x: red of the map [0.5; 0..1]
/// - y: green of the map [0.5; 0..1]
/// - return: the colour of the whole normal map
fn node_textures_normal_two_channel(x: f32, y: f32) -> vec3f {
    return texel_from_normal(normal_from_texel_two_channel(vec3f(x, y, 1.0), 1.0, false));
}

/// Turn Normal
///
/// A colour of a normal map whose picture lies turned on the surface: bumps still catch the light from the right side. The angle is that
/// of Place 2D.
/// @node textures/normal_rotate   @also normal map, rotation, uv rotate
/// - color: a colour of a normal map [0.5,0.5,1]
/// - rotation: how far the picture is turned, counter-clockwise [0; -360..360; deg]
/// - return: the turned colour
fn node_textures_normal_rotate(color: vec3f, rotation: f32) -> vec3f {
    let n = 2.0 * color.xy - 1.0;
    let c = cos(radians(rotation));
    let s = sin(radians(rotation));
    return vec3f(0.5 + 0.5 * vec2f(c * n.x - s * n.y, s * n.x + c * n.y), color.z);
}

/// Height Blend
///
/// The weight of a second material over a first one, decided by their heights: sand fills the joints before it covers the stones. Mishkinis
/// 2013, "Advanced Terrain Texture Splatting". With a = height_a + 1 - t and b = height_b + t, both less the greater of them and plus the
/// softness, at least 0: b / (a + b). A softness below 0.001 counts as 0.001.
/// @node textures/height_blend   @also mask, splat, terrain, blend materials, displacement blend
/// - height_a: height of the first [0.5; 0..1]
/// - height_b: height of the second [0.5; 0..1]
/// - t: how much of the second there is [0.5; 0..1]
/// - softness: how wide the border is, in heights [0.1; 0..1]
/// - return: weight of the second, 0 to 1
fn node_textures_height_blend(height_a: f32, height_b: f32, t: f32, softness: f32) -> f32 {
    let lead = clamp(height_b + t - (height_a + 1.0 - t), -4.0, 4.0);
    let width = max(softness, 0.001);
    let a = max(width - max(lead, 0.0), 0.0);
    let b = max(width + min(lead, 0.0), 0.0);
    return b / (a + b);
}
