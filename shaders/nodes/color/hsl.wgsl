/// Colour from HSL
///
/// A linear RGB colour of hue, saturation and lightness, as CSS has it (W3C 2022, "CSS Color Module Level 4"):
///   l + s min(l, 1 - l) (1 - 2 max(0, min(k, 4 - k, 1))) with the k of HSV
/// @node color/rgb_from_hsl   @also hsl to rgb, hue
/// - hue: in turns: 0 red, 1/3 green, 2/3 blue; any number [0; 0..1]
/// - saturation: 0 grey, 1 pure; held in 0..1 [1; 0..1]
/// - lightness: 0 black, 0.5 pure, 1 white; held in 0..1 [0.5; 0..1]
/// - return: the colour
fn node_color_rgb_from_hsl(hue: f32, saturation: f32, lightness: f32) -> vec3f {
    let l = clamp(lightness, 0.0, 1.0);
    let half_spread = clamp(saturation, 0.0, 1.0) * min(l, 1.0 - l);
    // The same hue in HSV goes from 0 to 1; here it swings about l.
    return l + half_spread * (2.0 * rgb_from_hsv(vec3f(hue, 1.0, 1.0)) - 1.0);
}

/// The outputs of the node color/hsl_from_rgb.
struct HslOutputs {
    /// in turns: 0 red, 1/3 green, 2/3 blue; 0 for grey
    hue: f32,
    /// 0 grey, 1 pure
    saturation: f32,
    /// the middle of greatest and least channel
    lightness: f32,
}

/// HSL from Colour
///
/// Hue, saturation and lightness of a linear RGB colour, as CSS has them (W3C 2022, "CSS Color Module Level 4"). Channels are held in
/// 0..1.
/// @node color/hsl_from_rgb   @also rgb to hsl, hue
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
fn node_color_hsl_from_rgb(color: vec3f) -> HslOutputs {
    let hsv = hsv_from_rgb(clamp(color, vec3f(0.0), vec3f(1.0)));
    let spread = hsv.y * hsv.z;
    let l = hsv.z - 0.5 * spread;
    let room = min(l, 1.0 - l);
    return HslOutputs(hsv.x, select(0.0, min(0.5 * spread / room, 1.0), room > DIVISOR_FLOOR), l);
}
