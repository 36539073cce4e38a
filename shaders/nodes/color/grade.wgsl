/// Levels
///
/// Each channel's range in_low..in_high carried onto out_low..out_high, with the middle bent by gamma: above 1 lightens it.
/// Channels are held inside of the input range; equal ends make a step. Gamma below 0.01 counts as 0.01.
/// @node color/levels   @also black point, white point, remap, auto levels
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - in_low: becomes out_low [0; 0..1]
/// - in_high: becomes out_high [1; 0..1]
/// - gamma: 1 changes nothing [1; 0.2..5]
/// - out_low: darkest result [0; 0..1]
/// - out_high: lightest result [1; 0..1]
/// - return: the changed colour
fn node_color_levels(color: vec3f, in_low: f32, in_high: f32, gamma: f32, out_low: f32, out_high: f32) -> vec3f {
    let along = vec3f(linear_step(in_low, in_high, color.r), linear_step(in_low, in_high, color.g), linear_step(in_low, in_high, color.b));
    return mix(vec3f(out_low), vec3f(out_high), power_of_color(along, 1.0 / max(gamma, 0.01)));
}

/// Colour Decision List
///
/// Slope, offset and power for each channel, then saturation: the grading that films exchange. ASC 2009, "Color Decision List 1.2":
///   max(0, color slope + offset)^power
/// without its upper limit, for colours here may pass 1; saturation is about the luminance of ITU-R BT.709-6. Powers below 0.01 count as
/// 0.01; the power's result is limited to 1e8.
/// @node color/cdl   @also grade, lift gamma gain, slope offset power, asc
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - slope: factor of each channel [1,1,1; 0..2]
/// - offset: what is added to each channel [0,0,0; -0.5..0.5]
/// - power: exponent of each channel [1,1,1; 0.2..5]
/// - saturation: 0 grey, 1 as it is [1; 0..2]
/// - return: the graded colour
fn node_color_cdl(color: vec3f, slope: vec3f, offset: vec3f, power: vec3f, saturation: f32) -> vec3f {
    let scaled = color * slope + offset;
    let p = max(power, vec3f(0.01));
    let powers = vec3f(power_of_color(scaled, p.r).r, power_of_color(scaled, p.g).g, power_of_color(scaled, p.b).b);
    let graded = min(powers, vec3f(1e8));
    return mix(vec3f(luminance(graded)), graded, saturation);
}

/// Channel Mixer
///
/// Each channel of the result is a sum of all channels, weighted.
/// @node color/channel_mixer   @also matrix, swap channels, black and white
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - red: weights of red, green and blue in the new red [1,0,0; -1..2]
/// - green: weights of red, green and blue in the new green [0,1,0; -1..2]
/// - blue: weights of red, green and blue in the new blue [0,0,1; -1..2]
/// - return: the mixed colour
fn node_color_channel_mixer(color: vec3f, red: vec3f, green: vec3f, blue: vec3f) -> vec3f {
    return vec3f(dot(color, red), dot(color, green), dot(color, blue));
}

/// Colour Key
///
/// A mask of what resembles a colour: 1 at the colour, 0 from `reach` on, by the distance of linear RGB.
/// @node color/key   @also mask, select by color, chroma key, similarity
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - wanted: the colour that is looked for [1,0,0; 0..1; color]
/// - tolerance: up to which distance it is 1 [0.1; 0..1]
/// - reach: from which distance it is 0 [0.3; 0..1.7]
/// - return: 0 to 1
fn node_color_key(color: vec3f, wanted: vec3f, tolerance: f32, reach: f32) -> f32 {
    return 1.0 - linear_step(tolerance, reach, distance(color, wanted));
}
