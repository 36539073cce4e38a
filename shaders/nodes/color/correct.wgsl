/// Colour Correct
///
/// The usual corrections in one node, in this order: hue, saturation, gamma, lift, gain, contrast, exposure.
///   lifted = gain (c (1 - lift) + lift),   out = (pivot + (lifted - pivot) contrast) 2^exposure
/// A negative channel counts as 0 before gamma; gamma below 0.01 counts as 0.01. The order of MaterialX's node of this name.
/// @node color/correct   @also grade, lift gamma gain, hue, adjust, color correction
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - hue_shift: turns that are added to the hue [0; -0.5..0.5]
/// - saturation: 0 grey, 1 as it is [1; 0..2]
/// - gamma: above 1 lightens the middle [1; 0.2..5]
/// - lift: how far black is lifted towards white [0; 0..1]
/// - gain: factor after the lift [1; 0..2]
/// - contrast: factor of the distance from the pivot [1; 0..3]
/// - pivot: what contrast leaves as it is [0.18; 0..1]
/// - exposure: doublings, held in -60..60 [0; -5..5; stops]
/// - return: the corrected colour
fn node_color_correct(color: vec3f, hue_shift: f32, saturation: f32, gamma: f32, lift: f32, gain: f32, contrast: f32, pivot: f32, exposure: f32) -> vec3f {
    let hsv = hsv_from_rgb(color);
    let toned = rgb_from_hsv(vec3f(hsv.x + hue_shift, hsv.y * saturation, hsv.z));
    let bent = min(power_of_color(toned, 1.0 / max(gamma, 0.01)), vec3f(1e8));
    let lifted = (bent * (1.0 - lift) + lift) * gain;
    return (pivot + (lifted - pivot) * contrast) * exp2(clamp(exposure, -60.0, 60.0));
}
