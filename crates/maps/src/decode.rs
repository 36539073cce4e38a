//! Bytes to [`Image`]: PNG, JPEG, TIFF, WebP, TGA and BMP, told apart by their first bytes.
//!
//! Sizes are checked against [`Limits`] before the texels are allocated. A file that is cut short, lies about its size or
//! is not an image gives an error; none gives a panic. Colour profiles are not applied, EXIF orientation neither (a
//! texture is stored as its UVs expect it). Environments (.hdr, .exr, .hdre) are another crate's.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use image::error::{ImageError, LimitErrorKind};
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader};
use rayon::prelude::*;

use crate::image::{Channels, Image, Texels};

/// What an image may cost at most. The default takes 16384 texels a side and 1 GiB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest width in texels.
    pub max_width: u32,
    /// Largest height in texels.
    pub max_height: u32,
    /// Largest number of texels.
    pub max_texels: u64,
    /// Most memory in bytes, of the RGBA image and of the decoder's own copy together.
    pub max_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_width: 16_384, max_height: 16_384, max_texels: 1 << 28, max_bytes: 1 << 30 }
    }
}

/// Why bytes did not become an image. The file's name is the caller's to add.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// There are no bytes.
    #[error("the image file is empty")]
    Empty,
    /// The bytes start like none of the formats.
    #[error("not an image that can be read here: it starts like no PNG, JPEG, TIFF, WebP, TGA or BMP file")]
    UnknownFormat,
    /// An image format that is not a texture's, or a variant that the decoder has not.
    #[error("{format} image: {what} cannot be read; save it as 8- or 16-bit PNG")]
    Unsupported {
        /// The format's name.
        format: &'static str,
        /// What is not supported.
        what: String,
    },
    /// Larger than the limits allow; nothing was allocated for it.
    #[error(
        "{format} image: its header says {width} x {height} texels, but {limit}; make it smaller or raise the limit"
    )]
    TooLarge {
        /// The format's name.
        format: &'static str,
        /// Width in the header.
        width: u32,
        /// Height in the header.
        height: u32,
        /// The limit that it breaks, in words.
        limit: String,
    },
    /// The bytes end before the image does.
    #[error("{format} image: the file ends before the image does; copy or download it again")]
    Truncated {
        /// The format's name.
        format: &'static str,
    },
    /// The bytes contradict the format.
    #[error("{format} image: the file is damaged ({reason}); save or download it again")]
    Damaged {
        /// The format's name.
        format: &'static str,
        /// What the decoder found.
        reason: String,
    },
}

/// Reads a texture.
///
/// 8-bit files keep 8 bits, 16-bit ones 16, float ones (TIFF) their values, with NaN read as 0 and infinities as +-65504.
///
/// # Errors
/// [`DecodeError`] says what is wrong with the bytes.
pub fn decode(bytes: &[u8], limits: Limits) -> Result<Image, DecodeError> {
    let format = recognised(bytes)?;
    let name = format_name(format);
    if format == ImageFormat::Jpeg && !jpeg_is_complete(bytes) {
        return Err(DecodeError::Truncated { format: name });
    }
    // The decoders below are others' and read hostile bytes: a panic inside one must stay one file's error.
    catch_unwind(AssertUnwindSafe(|| decode_as(format, bytes, limits)))
        .unwrap_or_else(|_| Err(DecodeError::Damaged { format: name, reason: "its decoder gave up".to_owned() }))
}

fn decode_as(format: ImageFormat, bytes: &[u8], limits: Limits) -> Result<Image, DecodeError> {
    let name = format_name(format);
    let explain = |error| explained(error, name);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut inner = image::Limits::no_limits();
    inner.max_alloc = Some(limits.max_bytes);
    reader.limits(inner);
    let decoder = reader.into_decoder().map_err(explain)?;

    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let (channels, sample_bytes) = layout(color)
        .ok_or_else(|| DecodeError::Unsupported { format: name, what: format!("the colour type {color:?}") })?;
    check_size(name, [width, height], channels, sample_bytes, limits)?;

    let count = width as usize * height as usize;
    let texels = if color == ColorType::Rgba8 {
        // Already as it is stored: no second copy.
        let mut texels = zeroed::<[u8; 4]>(count, name)?;
        decoder.read_image(texels.as_flattened_mut()).map_err(explain)?;
        Texels::U8(texels)
    } else {
        let mut raw = zeroed::<u8>(count * sample_count(channels) * sample_bytes, name)?;
        decoder.read_image(&mut raw).map_err(explain)?;
        match sample_bytes {
            1 => Texels::U8(spread(&raw, channels, 255, |[b]: [u8; 1]| b)),
            2 => Texels::U16(spread(&raw, channels, 65535, u16::from_ne_bytes)),
            _ => Texels::F32(spread(&raw, channels, 1.0, |b| finite(f32::from_ne_bytes(b)))),
        }
    };
    Image::new(width, height, channels, texels)
        .map_err(|error| DecodeError::Damaged { format: name, reason: error.to_string() })
}

/// The format that the first bytes show. TGA has no signature: its header only has to be one.
fn recognised(bytes: &[u8]) -> Result<ImageFormat, DecodeError> {
    use ImageFormat::{Bmp, Jpeg, OpenExr, Png, Tga, Tiff, WebP};
    if bytes.is_empty() {
        return Err(DecodeError::Empty);
    }
    match image::guess_format(bytes) {
        Ok(format @ (Png | Jpeg | Tiff | WebP | Bmp)) => Ok(format),
        Ok(ImageFormat::Hdr) | Ok(OpenExr) => Err(DecodeError::Unsupported {
            format: if bytes.starts_with(b"#?") { "HDR" } else { "OpenEXR" },
            what: "a high-dynamic-range environment as a texture".to_owned(),
        }),
        _ if looks_like_tga(bytes) => Ok(Tga),
        Ok(format) => Err(DecodeError::Unsupported { format: format_name(format), what: "this format".to_owned() }),
        Err(_) => Err(DecodeError::UnknownFormat),
    }
}

fn looks_like_tga(bytes: &[u8]) -> bool {
    let Some(header) = bytes.first_chunk::<18>() else { return false };
    let [_, map_type, image_type, ..] = *header;
    let width = u16::from_le_bytes([header[12], header[13]]);
    let height = u16::from_le_bytes([header[14], header[15]]);
    map_type <= 1
        && matches!(image_type, 1..=3 | 9..=11)
        && width > 0
        && height > 0
        && matches!(header[16], 8 | 15 | 16 | 24 | 32)
}

fn format_name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::WebP => "WebP",
        ImageFormat::Tga => "TGA",
        ImageFormat::Bmp => "BMP",
        other => other.extensions_str().first().copied().unwrap_or("unknown"),
    }
}

/// Channels, and bytes per sample.
fn layout(color: ColorType) -> Option<(Channels, usize)> {
    Some(match color {
        ColorType::L8 => (Channels::Grey, 1),
        ColorType::La8 => (Channels::GreyAlpha, 1),
        ColorType::Rgb8 => (Channels::Rgb, 1),
        ColorType::Rgba8 => (Channels::Rgba, 1),
        ColorType::L16 => (Channels::Grey, 2),
        ColorType::La16 => (Channels::GreyAlpha, 2),
        ColorType::Rgb16 => (Channels::Rgb, 2),
        ColorType::Rgba16 => (Channels::Rgba, 2),
        ColorType::Rgb32F => (Channels::Rgb, 4),
        ColorType::Rgba32F => (Channels::Rgba, 4),
        _ => return None,
    })
}

fn sample_count(channels: Channels) -> usize {
    match channels {
        Channels::Grey => 1,
        Channels::GreyAlpha => 2,
        Channels::Rgb => 3,
        Channels::Rgba => 4,
    }
}

fn check_size(
    format: &'static str,
    [width, height]: [u32; 2],
    channels: Channels,
    sample_bytes: usize,
    limits: Limits,
) -> Result<(), DecodeError> {
    let too_large = |limit| Err(DecodeError::TooLarge { format, width, height, limit });
    if width == 0 || height == 0 {
        return Err(DecodeError::Damaged { format, reason: format!("its size is {width} x {height}") });
    }
    if width > limits.max_width || height > limits.max_height {
        return too_large(format!("at most {} x {} are allowed", limits.max_width, limits.max_height));
    }
    let texels = u64::from(width) * u64::from(height);
    if texels > limits.max_texels {
        return too_large(format!("at most {} texels are allowed", limits.max_texels));
    }
    let own_samples = if sample_bytes == 1 && channels == Channels::Rgba { 0 } else { sample_count(channels) };
    let bytes = texels.saturating_mul((4 + own_samples as u64) * sample_bytes as u64);
    if bytes > limits.max_bytes || usize::try_from(bytes).is_err() {
        return too_large(format!("that takes {bytes} bytes and at most {} are allowed", limits.max_bytes));
    }
    Ok(())
}

/// Memory that may be refused, as an error.
fn zeroed<T: Clone + Default>(count: usize, format: &'static str) -> Result<Vec<T>, DecodeError> {
    let mut memory = Vec::new();
    memory.try_reserve_exact(count).map_err(|_| DecodeError::Unsupported {
        format,
        what: format!("an image that needs {} bytes when there are not so many", count * size_of::<T>()),
    })?;
    memory.resize(count, T::default());
    Ok(memory)
}

/// Raw samples of N bytes each, spread to four channels.
fn spread<T: Copy + Send + Sync, const N: usize>(
    raw: &[u8],
    channels: Channels,
    opaque: T,
    sample: impl Fn([u8; N]) -> T + Sync,
) -> Vec<[T; 4]> {
    let samples = sample_count(channels);
    raw.par_chunks_exact(N * samples)
        .with_min_len(1 << 14)
        .map(|texel| {
            let at = |i: usize| sample(std::array::from_fn(|byte| texel[i * N + byte]));
            match channels {
                Channels::Grey => [at(0), at(0), at(0), opaque],
                Channels::GreyAlpha => [at(0), at(0), at(0), at(1)],
                Channels::Rgb => [at(0), at(1), at(2), opaque],
                Channels::Rgba => [at(0), at(1), at(2), at(3)],
            }
        })
        .collect()
}

/// One bad texel would spread through every filter: NaN is 0 and infinity the largest half-precision number.
fn finite(x: f32) -> f32 {
    if x.is_nan() {
        0.0
    } else if x.is_infinite() {
        65504.0_f32.copysign(x)
    } else {
        x
    }
}

/// Whether the segments of a JPEG file run through to its end marker. The decoder fills what is missing with grey.
/// ITU-T T.81 (1992), annex B: a marker is FF and a code; most carry a length; after SOS (DA) come entropy-coded bytes in
/// which FF is followed by 0 or by a restart marker (D0..D7), until the next marker.
fn jpeg_is_complete(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(&[first, code]) = bytes.get(at..).and_then(|rest| rest.first_chunk::<2>()) {
        match (first, code) {
            (0xff, 0xd9) => return true,
            // Fill bytes, and markers that stand alone.
            (0xff, 0xff) => at += 1,
            (0xff, 0x01 | 0xd0..=0xd8) => at += 2,
            (0xff, 0x02..) => {
                let Some(&[high, low]) = bytes.get(at + 2..).and_then(|rest| rest.first_chunk::<2>()) else {
                    return false;
                };
                at += 2 + usize::from(u16::from_be_bytes([high, low])).max(2);
                if code == 0xda {
                    let Some(scan) = bytes.get(at..) else { return false };
                    let end = scan.windows(2).position(|w| w[0] == 0xff && !matches!(w[1], 0x00 | 0xd0..=0xd7 | 0xff));
                    let Some(end) = end else { return false };
                    at += end;
                }
            }
            // Not a marker: some writers pad between segments.
            _ => at += 1,
        }
    }
    false
}

fn explained(error: ImageError, format: &'static str) -> DecodeError {
    match error {
        ImageError::Limits(limit) => match limit.kind() {
            LimitErrorKind::InsufficientMemory => {
                DecodeError::Unsupported { format, what: "an image that needs more memory than the limit".to_owned() }
            }
            _ => DecodeError::Unsupported { format, what: "an image larger than the limit".to_owned() },
        },
        ImageError::Unsupported(what) => DecodeError::Unsupported { format, what: what.to_string() },
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            DecodeError::Truncated { format }
        }
        other => {
            let reason = reason(&other);
            if ["unexpected end", "unexpected eof", "eof", "failed to fill whole buffer", "exhausted"]
                .iter()
                .any(|words| reason.to_lowercase().contains(words))
            {
                DecodeError::Truncated { format }
            } else {
                DecodeError::Damaged { format, reason }
            }
        }
    }
}

/// The innermost cause, without the wrappers' prefixes.
fn reason(error: &dyn std::error::Error) -> String {
    let mut innermost = error;
    while let Some(source) = innermost.source() {
        innermost = source;
    }
    innermost.to_string()
}
