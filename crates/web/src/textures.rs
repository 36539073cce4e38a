//! Textures, samplers and vertices as the page's script takes them: WebGPU's names, and bytes as base64 of zlib.

use halfvector_codegen::reflection::SamplerSource;
use halfvector_graph::value::{ColorSpace, Filter, Type, Wrap};
use halfvector_ibl::{BakedEnvironment, Cube, Visibility, dfg_table_of_shaders};
use halfvector_maps::{Image, Texels};
use halfvector_scene::texels::{TexelFormat, cube_bytes, dfg_bytes, image_bytes};
use halfvector_scene::texture_levels;
use serde_json::{Value, json};

/// zlib's level: the next ones are slower by more than they are smaller.
const COMPRESSION: u8 = 6;

/// Bytes as base64 (RFC 4648, section 4) of zlib.
pub(crate) fn blob(bytes: &[u8]) -> Value {
    Value::from(base64(&miniz_oxide::deflate::compress_to_vec_zlib(bytes, COMPRESSION)))
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let word = three.iter().enumerate().fold(0_u32, |word, (i, &byte)| word | u32::from(byte) << (16 - 8 * i));
        for digit in 0..4 {
            let six = (word >> (18 - 6 * digit)) & 63;
            text.push(if digit <= three.len() { char::from(DIGITS[six as usize]) } else { '=' });
        }
    }
    text
}

/// A picture with its mip levels. More than 8 bits become 16-bit floats, which every device filters.
pub(crate) fn image(image: &Image, color_space: ColorSpace) -> Value {
    let levels = texture_levels(image, color_space);
    let (format, texels, size) = match (image.texels(), levels.color_space) {
        (Texels::U8(_), ColorSpace::Srgb) => ("rgba8unorm-srgb", TexelFormat::Unorm8, 4),
        (Texels::U8(_), ColorSpace::Linear) => ("rgba8unorm", TexelFormat::Unorm8, 4),
        _ => ("rgba16float", TexelFormat::Float16, 8),
    };
    let mut bytes = Vec::new();
    levels.all().for_each(|level| bytes.extend_from_slice(&image_bytes(level, texels)));
    let sizes = levels.all().map(|level| [level.width(), level.height()]).collect();
    texture(format, size, 1, sizes, &bytes)
}

/// The prefiltered radiance: a cube with one level for each roughness.
pub(crate) fn radiance(baked: &BakedEnvironment) -> Value {
    cube(&baked.radiance, &baked.slope)
}

/// The irradiance over pi.
pub(crate) fn irradiance(baked: &BakedEnvironment) -> Value {
    cube(std::slice::from_ref(&baked.irradiance_over_pi), &[])
}

fn cube(levels: &[Cube], slopes: &[Vec<f32>]) -> Value {
    let mut bytes = Vec::new();
    for (level, cube) in levels.iter().enumerate() {
        bytes.extend(cube_bytes(cube, slopes.get(level).map(Vec::as_slice)));
    }
    let sizes = levels.iter().map(|cube| [cube.size as u32; 2]).collect();
    texture("rgba16float", 8, 6, sizes, &bytes)
}

/// The table of (scale, bias).
pub(crate) fn dfg(visibility: Visibility) -> Value {
    let table = dfg_table_of_shaders(visibility);
    texture("rg16float", 4, 1, vec![[table.size as u32; 2]], &dfg_bytes(table))
}

/// `texel`: bytes of one. Half floats stand in the page as `differences`, and the page is told how many a texel has.
fn texture(format: &str, texel: u32, layers: u32, levels: Vec<[u32; 2]>, bytes: &[u8]) -> Value {
    let halves = if format.ends_with("16float") { texel / 2 } else { 0 };
    let blob = if halves > 0 { blob(&differences(bytes, &levels, layers, halves)) } else { blob(bytes) };
    json!({ "format": format, "texel": texel, "layers": layers, "levels": levels, "halves": halves, "blob": blob })
}

/// Half floats as what they differ from left + above - left above, each channel of a level by itself, 0 outside: light changes little
/// from texel to texel, and zlib finds little in numbers of few equal bytes. The bits of a half float count up with its value. First
/// the high bytes of all differences, then the low ones; the sign stands in the last bit.
fn differences(bytes: &[u8], levels: &[[u32; 2]], layers: u32, channels: u32) -> Vec<u8> {
    let half = |i: usize| u16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]]);
    let (layers, channels) = (layers as usize, channels as usize);
    let (mut high, mut low, mut first) = (Vec::with_capacity(bytes.len()), Vec::with_capacity(bytes.len() / 2), 0);
    for [width, height] in levels.iter().map(|size| size.map(|side| side as usize)) {
        let row = width * channels;
        for channel in 0..channels {
            for (y, x) in (0..layers * height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                let i = first + y * row + x * channels + channel;
                let has_above = y % height > 0;
                let left = if x > 0 { half(i - channels) } else { 0 };
                let above = if has_above { half(i - row) } else { 0 };
                let corner = if has_above && x > 0 { half(i - row - channels) } else { 0 };
                let off = half(i).wrapping_sub(left.wrapping_add(above).wrapping_sub(corner)).cast_signed();
                let [l, h] = ((off << 1) ^ (off >> 15)).to_le_bytes();
                high.push(h);
                low.push(l);
            }
        }
        first += layers * height * row;
    }
    high.append(&mut low);
    high
}

/// A sampler's descriptor.
pub(crate) fn sampler(source: &SamplerSource) -> Value {
    let (wrap_u, wrap_v, filter) = match source {
        SamplerSource::Image { wrap_u, wrap_v, filter } => (*wrap_u, *wrap_v, *filter),
        SamplerSource::LinearClamp => (Wrap::Clamp, Wrap::Clamp, Filter::Linear),
    };
    let mode = |wrap| match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp-to-edge",
        Wrap::Mirror => "mirror-repeat",
    };
    let filter = match filter {
        Filter::Linear => "linear",
        Filter::Nearest => "nearest",
    };
    json!({
        "addressModeU": mode(wrap_u),
        "addressModeV": mode(wrap_v),
        "magFilter": filter,
        "minFilter": filter,
        "mipmapFilter": filter,
    })
}

/// A vertex attribute's format and its bytes.
pub(crate) fn vertex_format(ty: Type) -> (String, usize) {
    let format = match ty.components() {
        1 => "float32".to_owned(),
        count => format!("float32x{count}"),
    };
    (format, 4 * ty.components())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the page's script reads them.
    fn read(coded: &[u8], levels: &[[u32; 2]], layers: usize, channels: usize) -> Vec<u16> {
        let count = coded.len() / 2;
        let (mut halves, mut first, mut next) = (vec![0u16; count], 0, 0);
        for [width, height] in levels.iter().map(|size| size.map(|side| side as usize)) {
            let row = width * channels;
            for channel in 0..channels {
                for y in 0..layers * height {
                    for x in 0..width {
                        let code = u16::from_be_bytes([coded[next], coded[count + next]]);
                        next += 1;
                        let off = (code >> 1) ^ 0u16.wrapping_sub(code & 1);
                        let i = first + y * row + x * channels + channel;
                        let (in_row, in_face) = (x > 0, y % height > 0);
                        let left = if in_row { halves[i - channels] } else { 0 };
                        let above = if in_face { halves[i - row] } else { 0 };
                        let corner = if in_row && in_face { halves[i - row - channels] } else { 0 };
                        halves[i] = off.wrapping_add(left).wrapping_add(above).wrapping_sub(corner);
                    }
                }
            }
            first += layers * height * row;
        }
        halves
    }

    #[test]
    fn differences_give_the_halves_back() {
        let levels = [[4, 4], [2, 2], [1, 1]];
        for channels in [2u32, 4] {
            let count = (16 + 4 + 1) * 6 * channels;
            let halves: Vec<u16> = (0..count).map(|i| (i.wrapping_mul(2_654_435_761) >> 16) as u16).collect();
            let bytes: Vec<u8> = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
            let coded = differences(&bytes, &levels, 6, channels);
            assert_eq!(read(&coded, &levels, 6, channels as usize), halves);
        }
        // A gradient in both directions is nothing but zeros after the first texel.
        let ramp: Vec<u8> = (0..64u16).flat_map(|i| (100 * (i / 8) + 7 * (i % 8)).to_le_bytes()).collect();
        let coded = differences(&ramp, &[[8, 8]], 1, 1);
        assert!(coded.iter().filter(|byte| **byte != 0).count() <= 16, "{coded:?}");
    }

    #[test]
    fn base64_of_the_standard() {
        let cases =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("fooba", "Zm9vYmE=")];
        for (bytes, text) in cases {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xfe]), "+//+");
    }
}
