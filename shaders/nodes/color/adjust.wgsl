/// Luminance
///
/// Relative luminance of a linear colour: 0.2126 R + 0.7152 G + 0.0722 B. ITU-R BT.709-6 (2015).
/// @node color/luminance   @also grey, grayscale, brightness, desaturate, rgb to bw
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - return: its luminance
fn node_color_luminance(color: vec3f) -> f32 {
    return luminance(color);
}

/// Saturation
///
/// Moves a colour away from or towards the grey of the same luminance (ITU-R BT.709-6): 0 is grey, 1 changes nothing,
/// above 1 channels may become negative.
/// @node color/saturation   @also vibrance, desaturate
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - amount: 0 grey, 1 as it is [1; 0..2]
/// - return: the changed colour
fn node_color_saturation(color: vec3f, amount: f32) -> vec3f {
    return mix(vec3f(luminance(color)), color, amount);
}

/// Brightness
///
/// Adds one number to each channel. For light use Exposure: it multiplies.
/// @node color/brightness   @also lift, offset
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - amount: what is added [0; -1..1]
/// - return: the changed colour
fn node_color_brightness(color: vec3f, amount: f32) -> vec3f {
    return color + amount;
}

/// Exposure
///
/// Multiplies a linear colour by 2^stops. Stops are held in -60..60.
/// @node color/exposure   @also stops, ev, gain
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - stops: doublings [0; -5..5]
/// - return: the changed colour
fn node_color_exposure(color: vec3f, stops: f32) -> vec3f {
    return color * exp2(clamp(stops, -60.0, 60.0));
}

/// Contrast
///
/// Scales the distance of each channel from a pivot: pivot + (c - pivot) amount. 0.18 is the linear middle grey.
/// Channels may become negative.
/// @node color/contrast   @also spread
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - amount: 1 changes nothing [1; 0..3]
/// - pivot: what stays [0.18; 0..1]
/// - return: the changed colour
fn node_color_contrast(color: vec3f, amount: f32, pivot: f32) -> vec3f {
    return pivot + (color - pivot) * amount;
}

/// Gamma
///
/// Each channel to the power 1 / gamma: above 1 lightens the middle. A negative channel counts as 0; gamma below 0.01
/// counts as 0.01; the result is limited to 2^126.
/// @node color/gamma   @also midtones, power, curve
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - gamma: 1 changes nothing [1; 0.2..5]
/// - return: the changed colour
fn node_color_gamma(color: vec3f, gamma: f32) -> vec3f {
    return power_of_color(color, 1.0 / max(gamma, 0.01));
}

/// Posterize
///
/// Each channel, held in 0..1, brought to one of so many equally spaced values. Not filtered.
/// @node color/posterize   @also quantize, steps, toon
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - steps: number of values, at least 2 [4; 2..16]
/// - return: the stepped colour
fn node_color_posterize(color: vec3f, steps: i32) -> vec3f {
    let highest = f32(max(steps, 2) - 1);
    let c = clamp(color, vec3f(0.0), vec3f(1.0));
    return min(floor(c * (highest + 1.0)), vec3f(highest)) / highest;
}
