// Colour: the sRGB transfer function, luminance, and the report's plain gamma. Primaries are Rec. 709 throughout.

const LUMINANCE_WEIGHTS = vec3f(0.2126, 0.7152, 0.0722);

/// sRGB-encoded from linear. IEC 61966-2-1:1999, section 5.2:
///   s = 12.92 c                         where c <= 0.0031308
///   s = 1.055 c^(1/2.4) - 0.055         elsewhere
/// Below 0 the line goes on, above 1 the power does; the max keeps pow off negative numbers in the unused branch.
fn srgb_from_linear(c: vec3f) -> vec3f {
    let power = 1.055 * pow(max(c, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055;
    return select(power, 12.92 * c, c <= vec3f(0.0031308));
}

/// Linear from sRGB-encoded. IEC 61966-2-1:1999, section 5.2:
///   c = s / 12.92                       where s <= 0.04045
///   c = ((s + 0.055) / 1.055)^2.4       elsewhere
/// Below 0 the line goes on, above 1 the power does; the max keeps pow off negative numbers in the unused branch.
fn linear_from_srgb(c: vec3f) -> vec3f {
    let power = pow((max(c, vec3f(0.0)) + 0.055) / 1.055, vec3f(2.4));
    return select(power, c / 12.92, c <= vec3f(0.04045));
}

/// Relative luminance of a linear Rec. 709 colour. ITU-R BT.709-6 (2015), item 3.2:
///   Y = 0.2126 R + 0.7152 G + 0.0722 B
fn luminance(c: vec3f) -> f32 {
    return dot(c, LUMINANCE_WEIGHTS);
}

/// Gamma-encoded from linear with one power, the report's encode: c^(1/2.2). Negative values become 0.
fn gamma_from_linear(c: vec3f) -> vec3f {
    return pow(max(c, vec3f(0.0)), vec3f(1.0 / 2.2));
}
