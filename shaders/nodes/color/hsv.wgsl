/// RGB from hue, saturation and value. Smith 1978, "Color Gamut Transform Pairs", as one formula for n = 5, 3, 1:
///   k = (n + 6 h) mod 6,   c_n = v - v s max(0, min(k, 4 - k, 1))
/// h in turns, any number; s is held in 0..1.
fn rgb_from_hsv(hsv: vec3f) -> vec3f {
    let n = vec3f(5.0, 3.0, 1.0) + 6.0 * fract(hsv.x);
    let k = n - 6.0 * floor(n / 6.0);
    let ramp = clamp(min(k, 4.0 - k), vec3f(0.0), vec3f(1.0));
    return hsv.z * (1.0 - clamp(hsv.y, 0.0, 1.0) * ramp);
}

/// Hue (turns, 0 to 1), saturation and value of an RGB colour. Smith 1978, "Color Gamut Transform Pairs": v is the greatest
/// channel, s the spread over v, h which channel is greatest and where the others lie. Grey has hue 0, black
/// saturation 0; a negative channel counts as 0.
fn hsv_from_rgb(rgb: vec3f) -> vec3f {
    let c = max(rgb, vec3f(0.0));
    let value = max(c.r, max(c.g, c.b));
    let chroma = value - min(c.r, min(c.g, c.b));
    let toward = select(select((c.r - c.g) / chroma + 4.0, (c.b - c.r) / chroma + 2.0, c.g >= value),
                        (c.g - c.b) / chroma, c.r >= value);
    let hue = select(0.0, fract(toward / 6.0), chroma > DIVISOR_FLOOR);
    return vec3f(hue, select(0.0, chroma / value, value > DIVISOR_FLOOR), value);
}

/// Colour from HSV
///
/// A linear RGB colour of hue, saturation and value. Smith 1978, "Color Gamut Transform Pairs".
/// @node color/rgb_from_hsv   @also hsv to rgb, hue
/// - hue: in turns: 0 red, 1/3 green, 2/3 blue; any number [0; 0..1]
/// - saturation: 0 grey, 1 pure; held in 0..1 [1; 0..1]
/// - value: the greatest channel [1; 0..1]
/// - return: the colour
fn node_color_rgb_from_hsv(hue: f32, saturation: f32, value: f32) -> vec3f {
    return rgb_from_hsv(vec3f(hue, saturation, value));
}

/// The outputs of the node color/hsv_from_rgb.
struct HsvOutputs {
    /// in turns: 0 red, 1/3 green, 2/3 blue; 0 for grey
    hue: f32,
    /// 0 grey, 1 pure
    saturation: f32,
    /// the greatest channel
    value: f32,
}

/// HSV from Colour
///
/// Hue, saturation and value of a linear RGB colour. Smith 1978, "Color Gamut Transform Pairs". A negative channel
/// counts as 0.
/// @node color/hsv_from_rgb   @also rgb to hsv, hue
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
fn node_color_hsv_from_rgb(color: vec3f) -> HsvOutputs {
    let hsv = hsv_from_rgb(color);
    return HsvOutputs(hsv.x, hsv.y, hsv.z);
}

/// Hue, Saturation, Value
///
/// Turns the hue of a colour and scales its saturation and value. Smith 1978, "Color Gamut Transform Pairs".
/// A negative channel counts as 0.
/// @node color/hsv_adjust   @also hue shift, recolor, tint
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - hue_shift: turns that are added to the hue [0; -0.5..0.5]
/// - saturation: factor of the saturation, whose product is held in 0..1 [1; 0..2]
/// - value: factor of the value [1; 0..2]
/// - return: the changed colour
fn node_color_hsv_adjust(color: vec3f, hue_shift: f32, saturation: f32, value: f32) -> vec3f {
    let hsv = hsv_from_rgb(color);
    return rgb_from_hsv(vec3f(hsv.x + hue_shift, hsv.y * saturation, hsv.z * value));
}
