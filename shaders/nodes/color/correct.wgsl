/// Colour Correct
///
/// The usual corrections in one node, as MaterialX's `colorcorrect` computes them, in this order: hue (turned in HSV), saturation,
/// gamma, lift, gain, contrast, exposure.
///   grey = luminance(c),   toned = grey + (c - grey) saturation,   bent = sign(toned) |toned|^(1/gamma),
///   lifted = gain (bent (1 - lift) + lift),   out = (pivot + (lifted - pivot) contrast) 2^exposure
/// The luminance is that of the colours' own primaries, Rec. 709, as MaterialX asks; its default weights are those of ACEScg. Gamma
/// below 0.01 counts as 0.01.
/// @node color/correct   @also grade, lift gamma gain, hue, adjust, color correction
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - hue_shift: turns that are added to the hue [0; -0.5..0.5]
/// - saturation: 0 grey of the same luminance, 1 as it is [1; 0..2]
/// - gamma: above 1 lightens the middle [1; 0.2..5]
/// - lift: how far black is lifted towards white [0; 0..1]
/// - gain: factor after the lift [1; 0..2]
/// - contrast: factor of the distance from the pivot [1; 0..3]
/// - pivot: what contrast leaves as it is [0.18; 0..1]
/// - exposure: doublings, held in -60..60 [0; -5..5; stops]
/// - return: the corrected colour
fn node_color_correct(color: vec3f, hue_shift: f32, saturation: f32, gamma: f32, lift: f32, gain: f32, contrast: f32, pivot: f32, exposure: f32) -> vec3f {
    let hsv = hsv_from_rgb(color);
    let turned = rgb_from_hsv(vec3f(hsv.x + hue_shift, hsv.yz));
    let toned = mix(vec3f(luminance(turned)), turned, saturation);
    let bent = sign(toned) * min(power_of_color(abs(toned), 1.0 / max(gamma, 0.01)), vec3f(1e8));
    let lifted = (bent * (1.0 - lift) + lift) * gain;
    return (pivot + (lifted - pivot) * contrast) * exp2(clamp(exposure, -60.0, 60.0));
}
