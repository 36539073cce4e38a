/// A bell with its own width on each side of its top, 1 there: exp(-((x - top) / width)^2 / 2).
fn two_sided_bell(x: f32, top: f32, width_below: f32, width_above: f32) -> f32 {
    let d = (x - top) / select(width_above, width_below, x < top);
    return exp(-0.5 * d * d);
}

/// Colour of a Wavelength
///
/// The colour of light of one wavelength, as bright as the eye takes it to be. CIE 1931 observer in the fit of Wyman, Sloan and Shirley
/// 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions"; negative channels become 0. Black outside of the
/// visible 380 to 780 nm. The brightest channel, red at 605 nm, is 2.5.
/// @node color/wavelength   @also spectrum, rainbow, nanometre, laser, dispersion
/// - wavelength: in air [550; 380..780; nm]
/// - return: the colour, linear Rec. 709
fn node_color_wavelength(wavelength: f32) -> vec3f {
    let w = clamp(wavelength, 300.0, 900.0);
    let xyz = vec3f(
        1.056 * two_sided_bell(w, 599.8, 37.9, 31.0) + 0.362 * two_sided_bell(w, 442.0, 16.0, 26.7)
            - 0.065 * two_sided_bell(w, 501.1, 20.4, 26.2),
        0.821 * two_sided_bell(w, 568.8, 46.9, 40.5) + 0.286 * two_sided_bell(w, 530.9, 16.3, 31.1),
        1.217 * two_sided_bell(w, 437.0, 11.8, 36.0) + 0.681 * two_sided_bell(w, 459.0, 26.0, 13.8),
    );
    let rgb = vec3f(
        dot(xyz, vec3f(3.2404542, -1.5371385, -0.4985314)),
        dot(xyz, vec3f(-0.9692660, 1.8760108, 0.0415560)),
        dot(xyz, vec3f(0.0556434, -0.2040259, 1.0572252)),
    );
    return max(rgb, vec3f(0.0));
}
