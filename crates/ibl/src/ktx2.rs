//! What the reader and the writer of KTX 2.0 share: the names of numbers, and texels of shared exponent.
//!
//! Khronos 2020, "KTX File Format Specification", version 2.0; Khronos 2019, "Khronos Data Format Specification" 1.3.

/// The first bytes of every file.
pub(crate) const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Bytes up to the level index.
pub(crate) const HEADER_BYTES: usize = 80;

/// Bytes of one entry of the level index.
pub(crate) const LEVEL_ENTRY_BYTES: usize = 24;

/// Key of which way rows and columns run; its value for cube maps is "rd", right and down.
pub(crate) const KEY_ORIENTATION: &str = "KTXorientation";

/// Key of which stored channel is read as which: four letters for red, green, blue and alpha.
pub(crate) const KEY_SWIZZLE: &str = "KTXswizzle";

/// Key of the program that wrote the file.
pub(crate) const KEY_WRITER: &str = "KTXwriter";

/// Key of what the texels are: the `name` of a [`CubeContent`](crate::save::CubeContent).
pub(crate) const KEY_CONTENT: &str = "halfvector.content";

/// Key of each level's perceptual roughness, as text: numbers between commas, level 0 first.
pub(crate) const KEY_ROUGHNESS: &str = "halfvector.roughness";

/// Key that says what alpha is when it is not 1.
pub(crate) const KEY_ALPHA: &str = "halfvector.alpha";

/// The value of [`KEY_ALPHA`]: how log2(red + green + blue) changes from level to level, as a derivative.
pub(crate) const ALPHA_SLOPE: &str = "slope by level of log2(red + green + blue)";

/// VK_FORMAT_R16G16B16A16_SFLOAT.
pub(crate) const RGBA16F: u32 = 97;
/// VK_FORMAT_R32G32B32A32_SFLOAT.
pub(crate) const RGBA32F: u32 = 109;
/// VK_FORMAT_E5B9G9R9_UFLOAT_PACK32.
pub(crate) const RGB9E5: u32 = 123;

/// Bits of each mantissa.
const MANTISSA_BITS: i32 = 9;
/// Bias of the exponent.
const BIAS: i32 = 15;
/// The largest number: (511 / 512) * 2^16.
const MAX_RGB9E5: f32 = 65408.0;

/// Red, green and blue, each mantissa * 2^(exponent - 24), red in the lowest nine bits, the exponent in the highest five.
/// OpenGL 4.6 specification, section 8.5.2; values are held within 0..=65408.
pub(crate) fn rgb9e5_from_color(color: [f32; 3]) -> u32 {
    let color = color.map(|x| if x > 0.0 { x.min(MAX_RGB9E5) } else { 0.0 });
    let largest = color[0].max(color[1]).max(color[2]);
    // The exponent of a number comes from its bits: a logarithm may round up to the next one. Numbers below 2^-16 are
    // mantissas of the smallest exponent.
    let floor_log2 = (largest.to_bits() >> 23) as i32 - 127;
    let mut exponent = floor_log2.max(-BIAS - 1) + 1 + BIAS;
    let scale = |exponent: i32| f64::from(exponent - BIAS - MANTISSA_BITS).exp2();
    let rounded = |x: f32, exponent: i32| (f64::from(x) / scale(exponent) + 0.5).floor() as u32;
    if rounded(largest, exponent) == 1 << MANTISSA_BITS {
        exponent += 1;
    }
    let [r, g, b] = color.map(|x| rounded(x, exponent));
    r | g << 9 | b << 18 | (exponent as u32) << 27
}

/// The inverse of [`rgb9e5_from_color`].
pub(crate) fn color_from_rgb9e5(bits: u32) -> [f32; 3] {
    let scale = ((bits >> 27) as f32 - (BIAS + MANTISSA_BITS) as f32).exp2();
    [0, 9, 18].map(|shift| (bits >> shift & 511) as f32 * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each value comes back within half a step of the largest one's mantissa, and the limits are met exactly.
    #[test]
    fn shared_exponents() {
        assert_eq!(color_from_rgb9e5(rgb9e5_from_color([65504.0, 1e9, f32::NAN])), [65408.0, 65408.0, 0.0]);
        assert_eq!(color_from_rgb9e5(rgb9e5_from_color([1.0, 0.5, 0.25])), [1.0, 0.5, 0.25]);
        assert_eq!(rgb9e5_from_color([0.0, -1.0, 1e-9]), 0);
        // 1.0 is 256 / 512 * 2^1: exponent 16.
        assert_eq!(rgb9e5_from_color([1.0, 0.0, 0.0]), 16 << 27 | 256);
        let mut value = 3e-8f32;
        while value < 65000.0 {
            let color = [value, value * 0.3, value * 0.01];
            let back = color_from_rgb9e5(rgb9e5_from_color(color));
            let half_step = (value / 512.0).max(0.51 * 2f32.powi(-24));
            for c in 0..3 {
                assert!((back[c] - color[c]).abs() <= half_step, "{color:?} came back as {back:?}");
            }
            value *= 1.37;
        }
    }
}
