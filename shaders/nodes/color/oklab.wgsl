// Oklab: lightness and two opponent axes in which equal steps look equal. Ottosson 2020, "A perceptual color space for image
// processing", its matrices for linear Rec. 709.

/// Oklab (L, a, b) of a linear Rec. 709 colour. A negative response of a cone counts as 0.
fn oklab_from_linear(c: vec3f) -> vec3f {
    let cones = vec3f(
        dot(c, vec3f(0.4122214708, 0.5363325363, 0.0514459929)),
        dot(c, vec3f(0.2119034982, 0.6806995451, 0.1073969566)),
        dot(c, vec3f(0.0883024619, 0.2817188376, 0.6299787005)),
    );
    let root = power_of_color(cones, 1.0 / 3.0);
    return vec3f(
        dot(root, vec3f(0.2104542553, 0.7936177850, -0.0040720468)),
        dot(root, vec3f(1.9779984951, -2.4285922050, 0.4505937099)),
        dot(root, vec3f(0.0259040371, 0.7827717662, -0.8086757660)),
    );
}

/// The linear Rec. 709 colour of Oklab (L, a, b). Channels of colours outside of the gamut are negative or above 1.
fn linear_from_oklab(lab: vec3f) -> vec3f {
    let root = vec3f(
        dot(lab, vec3f(1.0, 0.3963377774, 0.2158037573)),
        dot(lab, vec3f(1.0, -0.1055613458, -0.0638541728)),
        dot(lab, vec3f(1.0, -0.0894841775, -1.2914855480)),
    );
    let cones = root * root * root;
    return vec3f(
        dot(cones, vec3f(4.0767416621, -3.3077115913, 0.2309699292)),
        dot(cones, vec3f(-1.2684380046, 2.6097574011, -0.3413193965)),
        dot(cones, vec3f(-0.0041960863, -0.7034186147, 1.7076147010)),
    );
}

/// Perceptual Mix
///
/// Blends two colours in Oklab: the way between them is even to the eye and keeps clear of mud. Negative channels of the result become
/// 0. Ottosson 2020, "A perceptual color space for image processing".
/// @node color/mix_oklab   @also lerp, gradient, oklab, blend
/// - a: first colour [0,0,0; 0..1; color]
/// - b: second colour [1,1,1; 0..1; color]
/// - t: weight of b [0.5; 0..1]
/// - return: the blend
fn node_color_mix_oklab(a: vec3f, b: vec3f, t: f32) -> vec3f {
    return max(linear_from_oklab(mix(oklab_from_linear(a), oklab_from_linear(b), t)), vec3f(0.0));
}

/// Perceptual Hue, Chroma, Lightness
///
/// Turns the hue of a colour and scales its chroma and lightness in Oklab: a turned hue looks as light as before, unlike in HSV.
/// Negative channels of the result become 0. Ottosson 2020, "A perceptual color space for image processing".
/// @node color/oklch_adjust   @also hue shift, oklab, recolor, vibrance
/// - color: the colour [0.5,0.5,0.5; 0..1; color]
/// - hue_shift: turns that are added to the hue [0; -0.5..0.5]
/// - chroma: factor of the colourfulness [1; 0..2]
/// - lightness: factor of the perceived lightness [1; 0..2]
/// - return: the changed colour
fn node_color_oklch_adjust(color: vec3f, hue_shift: f32, chroma: f32, lightness: f32) -> vec3f {
    let lab = oklab_from_linear(color);
    let angle = 2.0 * PI * fract(hue_shift);
    let c = cos(angle) * chroma;
    let s = sin(angle) * chroma;
    return max(linear_from_oklab(vec3f(lab.x * lightness, c * lab.y - s * lab.z, s * lab.y + c * lab.z)), vec3f(0.0));
}
