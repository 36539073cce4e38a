//! Colour: the sRGB transfer function, luminance, and the report's plain gamma. Primaries are Rec. 709 throughout.
//! Twin of `shaders/color.wgsl`. Does not read ICC profiles.

use crate::real::{Real, dot, real};

/// sRGB-encoded from linear, per channel. IEC 61966-2-1:1999, section 5.2:
///
/// ```text
/// s = 12.92 c                         where c <= 0.0031308
/// s = 1.055 c^(1/2.4) - 0.055         elsewhere
/// ```
///
/// Below 0 the line goes on, above 1 the power does.
pub fn srgb_from_linear<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|c| {
        if c <= real(0.003_130_8) {
            real::<R>(12.92) * c
        } else {
            real::<R>(1.055) * c.powf(real(1.0 / 2.4)) - real(0.055)
        }
    })
}

/// Linear from sRGB-encoded, per channel. IEC 61966-2-1:1999, section 5.2:
///
/// ```text
/// c = s / 12.92                       where s <= 0.04045
/// c = ((s + 0.055) / 1.055)^2.4       elsewhere
/// ```
///
/// Below 0 the line goes on, above 1 the power does.
pub fn linear_from_srgb<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|s| if s <= real(0.04045) { s / real(12.92) } else { ((s + real(0.055)) / real(1.055)).powf(real(2.4)) })
}

/// Relative luminance of a linear Rec. 709 colour. ITU-R BT.709-6 (2015), item 3.2:
/// Y = 0.2126 R + 0.7152 G + 0.0722 B.
pub fn luminance<R: Real>(c: [R; 3]) -> R {
    dot(c, [real(0.2126), real(0.7152), real(0.0722)])
}

/// Gamma-encoded from linear with one power, the report's encode: c^(1/2.2). Negative values become 0.
pub fn gamma_from_linear<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|c| if c > real(0.0) { c.powf(real(1.0 / 2.2)) } else { real(0.0) })
}
