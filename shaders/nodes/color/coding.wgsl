/// sRGB from Linear
///
/// Encodes a linear colour by the sRGB curve, IEC 61966-2-1:1999. The surface wants linear colours: this is for numbers
/// that an encoded picture was compared or mixed in.
/// @node color/srgb_from_linear   @also encode, gamma, linear to srgb
/// - color: linear Rec. 709 [0.5,0.5,0.5; 0..1; color]
/// - return: the encoded colour
fn node_color_srgb_from_linear(color: vec3f) -> vec3f {
    return srgb_from_linear(color);
}

/// Linear from sRGB
///
/// Decodes the sRGB curve, IEC 61966-2-1:1999. Images that are marked as sRGB are decoded already when they are read.
/// @node color/linear_from_srgb   @also decode, degamma, srgb to linear
/// - color: encoded colour [0.5,0.5,0.5; 0..1]
/// - return: linear Rec. 709
fn node_color_linear_from_srgb(color: vec3f) -> vec3f {
    return linear_from_srgb(color);
}

/// Colour of a Temperature
///
/// The colour of a black body that glows, linear Rec. 709, with the greatest channel 1 and none negative. Krystek 1985,
/// "An algorithm to calculate correlated colour temperature": with T in kelvin, in the CIE 1960 diagram
///   u = (0.860117757 + 1.54118254e-4 T + 1.28641212e-7 T^2) / (1 + 8.42420235e-4 T + 7.08145163e-7 T^2)
///   v = (0.317398726 + 4.22806245e-5 T + 4.20481691e-8 T^2) / (1 - 2.89741816e-5 T + 1.61456053e-7 T^2)
/// T is held in 1000..15000, where no channel is further than 0.003 from Planck's law seen by the CIE 1931 observer.
/// @node color/blackbody   @also kelvin, temperature, glow, fire, incandescent
/// - temperature: of the body [6500; 1000..15000; K]
/// - return: the colour, without its brightness
fn node_color_blackbody(temperature: f32) -> vec3f {
    let t = clamp(temperature, 1000.0, 15000.0);
    let u = (0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) / (1.0 + t * (8.42420235e-4 + t * 7.08145163e-7));
    let v = (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) / (1.0 + t * (-2.89741816e-5 + t * 1.61456053e-7));
    // CIE 1960 to 1931: x = 3u / d, y = 2v / d, d = 2u - 8v + 4; then XYZ of Y = 1 times d is left out with the brightness.
    let xyz = vec3f(3.0 * u, 2.0 * v, 4.0 - u - 10.0 * v);
    let rgb = vec3f(
        dot(xyz, vec3f(3.2404542, -1.5371385, -0.4985314)),
        dot(xyz, vec3f(-0.9692660, 1.8760108, 0.0415560)),
        dot(xyz, vec3f(0.0556434, -0.2040259, 1.0572252)),
    );
    // The greatest channel is red or blue and stays above 0.5 in the whole range.
    return max(rgb, vec3f(0.0)) / max(rgb.r, max(rgb.g, rgb.b));
}
