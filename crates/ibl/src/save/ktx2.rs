//! KTX 2.0 cube maps without supercompression, as every reader takes them.
//!
//! Layout: header, level index (level 0 first), data format descriptor, key/values (sorted), levels (the smallest first),
//! each at a multiple of its texel's bytes.

use super::{CubeContent, CubeLevels, SaveError, face_size};
use crate::cube::Cube;
use crate::ktx2::{
    ALPHA_SLOPE, HEADER_BYTES, IDENTIFIER, KEY_ALPHA, KEY_CONTENT, KEY_ORIENTATION, KEY_ROUGHNESS, KEY_WRITER,
    LEVEL_ENTRY_BYTES, RGB9E5, RGBA16F, RGBA32F, rgb9e5_from_color,
};
use crate::repair::MAX_RADIANCE;
use half::f16;

/// How a texel is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TexelFormat {
    /// Four half-precision numbers, 8 bytes; filtered by every GPU.
    #[default]
    Rgba16F,
    /// Four single-precision numbers, 16 bytes.
    Rgba32F,
    /// Three mantissas of 9 bits with one exponent, 4 bytes; values within 0..=65408, steps of 1/512 of the largest
    /// component at most.
    Rgb9E5,
}

impl TexelFormat {
    fn vk_format(self) -> u32 {
        match self {
            TexelFormat::Rgba16F => RGBA16F,
            TexelFormat::Rgba32F => RGBA32F,
            TexelFormat::Rgb9E5 => RGB9E5,
        }
    }

    /// Bytes of a number as it is swapped on big-endian machines.
    fn type_size(self) -> u32 {
        if self == TexelFormat::Rgba16F { 2 } else { 4 }
    }

    fn texel_bytes(self) -> usize {
        match self {
            TexelFormat::Rgba16F => 8,
            TexelFormat::Rgba32F => 16,
            TexelFormat::Rgb9E5 => 4,
        }
    }

    fn put(self, color: [f32; 3], alpha: f32, bytes: &mut Vec<u8>) {
        let [r, g, b] = color;
        match self {
            TexelFormat::Rgba16F => {
                for x in [r, g, b, alpha] {
                    bytes.extend(f16::from_f32(x.min(MAX_RADIANCE)).to_le_bytes());
                }
            }
            TexelFormat::Rgba32F => [r, g, b, alpha].iter().for_each(|x| bytes.extend(x.to_le_bytes())),
            TexelFormat::Rgb9E5 => bytes.extend(rgb9e5_from_color(color).to_le_bytes()),
        }
    }

    /// Khronos Data Format Specification 1.3, basic descriptor block: linear, BT.709 primaries, straight alpha.
    fn descriptor(self) -> Vec<u8> {
        // Bit offset, number of bits, channel with its qualifiers, lower and upper bound.
        type Sample = (u16, u8, u8, u32, u32);
        const RED_GREEN_BLUE_ALPHA: [u8; 4] = [0, 1, 2, 15];
        const SIGNED_FLOAT: u8 = 0xc0;
        const EXPONENT: u8 = 0x20;
        let floats = |bits: u8| -> Vec<Sample> {
            let channels = RED_GREEN_BLUE_ALPHA.into_iter().enumerate();
            let sample = |(i, channel)| {
                (i as u16 * u16::from(bits), bits, channel | SIGNED_FLOAT, (-1f32).to_bits(), 1f32.to_bits())
            };
            channels.map(sample).collect()
        };
        let samples: Vec<Sample> = match self {
            TexelFormat::Rgba16F => floats(16),
            TexelFormat::Rgba32F => floats(32),
            // A mantissa of 8448 with the exponent's bias stands for 1; the exponent is shared, and named for each channel.
            TexelFormat::Rgb9E5 => {
                (0..3u8).flat_map(|c| [(9 * u16::from(c), 9, c, 0, 8448), (27, 5, c | EXPONENT, 15, 31)]).collect()
            }
        };
        let block_bytes = 24 + 16 * samples.len();
        let mut bytes = Vec::new();
        bytes.extend((block_bytes as u32 + 4).to_le_bytes());
        // Vendor Khronos, basic type; version 1.3.
        bytes.extend(0u32.to_le_bytes());
        bytes.extend(2u16.to_le_bytes());
        bytes.extend((block_bytes as u16).to_le_bytes());
        // RGBSDA, BT.709, linear, no flags; blocks of one texel.
        bytes.extend([1, 1, 1, 0, 0, 0, 0, 0]);
        bytes.extend([self.texel_bytes() as u8, 0, 0, 0, 0, 0, 0, 0]);
        for (offset, bits, channel, lower, upper) in samples {
            bytes.extend(offset.to_le_bytes());
            bytes.extend([bits - 1, channel, 0, 0, 0, 0]);
            bytes.extend(lower.to_le_bytes());
            bytes.extend(upper.to_le_bytes());
        }
        bytes
    }
}

/// The bytes of a KTX2 cube map.
///
/// Key/values: `KTXorientation` "rd", `KTXwriter`, `halfvector.content` and, for radiance, `halfvector.roughness` with each
/// level's perceptual roughness between commas; `halfvector.alpha` when alpha holds the slope.
///
/// # Errors
/// When there is no level, when one has not half of the size of the one before (rounded down), or when the roughness or
/// the slopes of a level are missing.
pub fn ktx2(cube: CubeLevels<'_>, format: TexelFormat) -> Result<Vec<u8>, SaveError> {
    let size = face_size(cube.levels)?;
    let most = size.ilog2() as usize + 1;
    let count = cube.levels.len();
    if count > most || cube.content == CubeContent::Radiance && cube.roughness.len() != count {
        return Err(SaveError::Levels { found: count, needed: format!("at most {most} with a roughness for each") });
    }
    for (level, found) in cube.levels.iter().map(|level| level.size).enumerate() {
        let needed = size >> level;
        if found != needed {
            return Err(SaveError::Size { level, found, needed });
        }
    }

    let slope = if format == TexelFormat::Rgb9E5 { &[] } else { cube.slope };
    let fits = |(level, slopes): (&Cube, &Vec<f32>)| level.texels.len() == slopes.len();
    if !slope.is_empty() && (slope.len() != count || !cube.levels.iter().zip(slope).all(fits)) {
        return Err(SaveError::Levels { found: slope.len(), needed: format!("slopes for each texel of {count}") });
    }

    let descriptor = format.descriptor();
    let key_values = key_values(cube, !slope.is_empty());
    let descriptor_at = HEADER_BYTES + LEVEL_ENTRY_BYTES * count;
    let key_values_at = descriptor_at + descriptor.len();
    let alignment = format.texel_bytes();
    let mut bytes = IDENTIFIER.to_vec();
    let size = size as u32;
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression.
    for number in [format.vk_format(), format.type_size(), size, size, 0, 0, 6, count as u32, 0] {
        bytes.extend(number.to_le_bytes());
    }
    for number in [descriptor_at, descriptor.len(), key_values_at, key_values.len()] {
        bytes.extend((number as u32).to_le_bytes());
    }
    // No global data of a supercompression.
    bytes.extend([0; 16]);

    let level_bytes = |level: &Cube| level.texels.len() * format.texel_bytes();
    let mut at = key_values_at + key_values.len();
    let mut places = vec![0; count];
    for (level, place) in cube.levels.iter().zip(&mut places).rev() {
        *place = at.next_multiple_of(alignment);
        at = *place + level_bytes(level);
    }
    bytes.reserve_exact(at - bytes.len());
    for (level, place) in cube.levels.iter().zip(&places) {
        for number in [*place, level_bytes(level), level_bytes(level)] {
            bytes.extend((number as u64).to_le_bytes());
        }
    }
    bytes.extend(descriptor);
    bytes.extend(key_values);
    for (k, level) in cube.levels.iter().enumerate().rev() {
        bytes.resize(places[k], 0);
        for (i, &color) in level.texels.iter().enumerate() {
            format.put(color, slope.get(k).map_or(1.0, |slopes| slopes[i]), &mut bytes);
        }
    }
    Ok(bytes)
}

/// Keys with their values as texts that end with NUL, sorted by key, each padded to four bytes.
fn key_values(cube: CubeLevels<'_>, slope: bool) -> Vec<u8> {
    let mut pairs = vec![
        (KEY_ORIENTATION, "rd".to_owned()),
        (KEY_WRITER, concat!("halfvector ", env!("CARGO_PKG_VERSION")).to_owned()),
        (KEY_CONTENT, cube.content.name().to_owned()),
    ];
    if cube.content == CubeContent::Radiance {
        let numbers: Vec<String> = cube.roughness.iter().map(f32::to_string).collect();
        pairs.push((KEY_ROUGHNESS, numbers.join(",")));
    }
    if slope {
        pairs.push((KEY_ALPHA, ALPHA_SLOPE.to_owned()));
    }
    pairs.sort();
    let mut bytes = Vec::new();
    for (key, value) in pairs {
        bytes.extend((key.len() as u32 + value.len() as u32 + 2).to_le_bytes());
        bytes.extend(key.as_bytes());
        bytes.push(0);
        bytes.extend(value.as_bytes());
        bytes.push(0);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}
