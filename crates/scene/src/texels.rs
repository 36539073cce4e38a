//! Texels as the bytes that textures take: pictures, cubes and the table of albedos. Nothing is uploaded here.

use std::borrow::Cow;

use half::f16;
use halfvector_ibl::{Cube, DfgTable};
use halfvector_maps::{Image, Texels};

/// The largest finite half float: what is brighter becomes this bright.
const F16_MAX: f32 = 65504.0;

/// How a texel of four channels is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFormat {
    /// 8 bits a channel; only for pictures that have no more.
    Unorm8,
    /// 16-bit floats.
    Float16,
    /// 32-bit floats.
    Float32,
}

/// A level of a picture, row by row.
pub fn image_bytes(image: &Image, format: TexelFormat) -> Cow<'_, [u8]> {
    let coded = |texels: &mut dyn Iterator<Item = [f32; 4]>| match format {
        TexelFormat::Float32 => texels.flatten().flat_map(f32::to_le_bytes).collect(),
        TexelFormat::Float16 => f16_bytes(texels),
        TexelFormat::Unorm8 => texels.flatten().map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8).collect::<Vec<u8>>(),
    };
    match image.texels() {
        Texels::U8(texels) if format == TexelFormat::Unorm8 => Cow::Borrowed(texels.as_flattened()),
        Texels::U8(texels) => Cow::Owned(coded(&mut texels.iter().map(|t| t.map(|c| f32::from(c) / 255.0)))),
        Texels::U16(texels) => Cow::Owned(coded(&mut texels.iter().map(|t| t.map(|c| f32::from(c) / 65535.0)))),
        Texels::F32(texels) => Cow::Owned(coded(&mut texels.iter().copied())),
    }
}

/// A cube in 16-bit floats, face by face. The fourth channel is the level's slopes where there are any, else 1.
pub fn cube_bytes(cube: &Cube, slopes: Option<&[f32]>) -> Vec<u8> {
    let slope = |texel: usize| slopes.map_or(1.0, |slopes| slopes[texel]);
    f16_bytes(&mut cube.texels.iter().enumerate().map(|(i, &[r, g, b])| [r, g, b, slope(i)]))
}

/// The (scale, bias) table in two channels of 16-bit floats: x = n.v, y = perceptual roughness. Their rounding (2e-4) is a
/// tenth of what reading between texels costs.
pub fn dfg_bytes(table: &DfgTable) -> Vec<u8> {
    f16_bytes(&mut table.texels.iter().copied())
}

fn f16_bytes<const N: usize>(texels: &mut dyn Iterator<Item = [f32; N]>) -> Vec<u8> {
    texels.flatten().flat_map(|c| to_f16(c).to_le_bytes()).collect()
}

/// Rounds to a half float; what is too large becomes the largest, and NaN becomes 0.
fn to_f16(x: f32) -> f16 {
    if x.is_nan() { f16::ZERO } else { f16::from_f32(x.clamp(-F16_MAX, F16_MAX)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_stay_finite() {
        assert_eq!(to_f16(1e9).to_f32(), F16_MAX);
        assert_eq!(to_f16(f32::INFINITY).to_f32(), F16_MAX);
        assert_eq!(to_f16(f32::NEG_INFINITY).to_f32(), -F16_MAX);
        assert_eq!(to_f16(f32::NAN).to_f32(), 0.0);
        assert_eq!(to_f16(0.5).to_f32(), 0.5);
    }
}
