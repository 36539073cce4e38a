//! Bytes to [`Image`]: PNG, JPEG, TIFF, WebP, TGA, BMP and QOI, told apart by their first bytes.
//!
//! Sizes are checked against [`Limits`] before the texels are allocated. A file that is cut short, lies about its size or
//! is not an image gives an error; none gives a panic. What a file says about its colours is kept beside the values and
//! applied when they are taken as colours. EXIF orientation is not applied (a texture is stored as its UVs expect it), nor
//! is alpha divided out; of animations and files of several images one is read; notes say so. Environments (.hdr, .exr,
//! .hdre) are another crate's.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use image::error::{ImageError, UnsupportedErrorKind};
use image::metadata::Orientation;
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader};
use rayon::prelude::*;

mod format;
mod jpeg;
mod lzw;
mod stated;
mod tga;
mod tiff;

use crate::image::{Channels, Image, Texels};
use crate::profile::Profile;

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
    #[error("not an image that can be read here: it starts like no PNG, JPEG, TIFF, WebP, TGA, BMP or QOI file")]
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
    #[error("{format} image: its header says {width} x {height} texels, but {limit}; make it smaller")]
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
    /// The decoder found, before its own count could be made here, that it needs more memory than the limits allow.
    #[error("{format} image: reading it needs more memory than is allowed; make it smaller")]
    Memory {
        /// The format's name.
        format: &'static str,
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
    /// Colours are asked for, and the file says that they are coded in a way that is not understood.
    #[error(
        "{format} image: its {profile} cannot be applied ({reason}); convert the file to sRGB, or remove the profile if \
         the colours are sRGB already; as linear data the values can be read as they are"
    )]
    Profile {
        /// The format's name.
        format: &'static str,
        /// The profile's name.
        profile: String,
        /// Why it is refused.
        reason: String,
    },
}

/// A decoded file: the values as they stand in it, and what it says about them. What is wanted is said by taking the
/// image out: [`Decoded::into_color`] or [`Decoded::into_data`].
#[derive(Clone, Debug)]
pub struct Decoded {
    format: &'static str,
    image: Image,
    profile: Option<Profile>,
    notes: Vec<String>,
}

/// An image and what the user should know of how it was read, each note a clause such as
/// `gAMA 0.45455 is not applied, as the values are data`.
#[derive(Clone, Debug)]
pub struct Noted {
    /// The image.
    pub image: Image,
    /// What was done beyond taking values as they are, or left undone.
    pub notes: Vec<String>,
}

impl Decoded {
    /// The values as they stand in the file.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// What the file says about its colours, if anything.
    pub fn profile(&self) -> Option<&Profile> {
        self.profile.as_ref()
    }

    /// The image as colours in sRGB. Without a profile they are taken to be that. With one of another kind they are
    /// converted, at the file's depth: out-of-gamut colours are clipped, and a note says how many.
    ///
    /// # Errors
    /// [`DecodeError::Profile`] for a profile that cannot be applied: one of tables, of another colour model, for floats,
    /// or damaged.
    pub fn into_color(mut self) -> Result<Noted, DecodeError> {
        let Some(profile) = self.profile else { return Ok(Noted { image: self.image, notes: self.notes }) };
        let (image, clipped) = profile.to_srgb(self.image).map_err(|reason| DecodeError::Profile {
            format: self.format,
            profile: profile.name().to_owned(),
            reason: reason.to_owned(),
        })?;
        if let Some(clipped) = clipped {
            let clipped = match clipped {
                0 => String::new(),
                1 => "; 1 texel lies outside of sRGB and is clipped".to_owned(),
                count => format!("; {count} texels lie outside of sRGB and are clipped"),
            };
            self.notes.push(format!("converted to sRGB from {}{clipped}", profile.name()));
        }
        Ok(Noted { image, notes: self.notes })
    }

    /// The image as data: values as they are. A note names the profile, which is not applied.
    pub fn into_data(mut self) -> Noted {
        if let Some(profile) = self.profile {
            self.notes.push(format!("{} is not applied, as the values are data", profile.name()));
        }
        Noted { image: self.image, notes: self.notes }
    }
}

/// Reads a texture.
///
/// 8-bit files keep 8 bits, 16-bit ones 16, float ones (TIFF) their values, with NaN read as 0 and infinities as +-65504.
/// Fewer bits become 8, palettes their colours.
///
/// A JPEG of which a scan ends early is an error, though it has its end marker; a progressive one whose last scans are not
/// there is the coarser image that it holds, with a note.
///
/// # Errors
/// [`DecodeError`] says what is wrong with the bytes. A profile is no error before colours are asked for.
pub fn decode(bytes: &[u8], limits: Limits) -> Result<Decoded, DecodeError> {
    let format = format::recognised(bytes)?;
    let name = format::name(format);
    // The decoders below are others' and read hostile bytes: a panic inside one must stay one file's error.
    let parts = catch_unwind(AssertUnwindSafe(|| match format {
        ImageFormat::Tga => tga::decode(bytes, limits),
        ImageFormat::Tiff => tiff::decode(bytes, limits),
        _ => decode_as(format, bytes, limits),
    }))
    .unwrap_or_else(|_| Err(DecodeError::Damaged { format: name, reason: "its decoder gave up".to_owned() }))?;
    let image = Image::new(parts.width, parts.height, parts.channels, parts.texels)
        .map_err(|error| DecodeError::Damaged { format: name, reason: error.to_string() })?;
    Ok(Decoded { format: name, image, profile: parts.profile, notes: parts.notes })
}

/// What a decoder gives.
struct Parts {
    width: u32,
    height: u32,
    channels: Channels,
    texels: Texels,
    profile: Option<Profile>,
    notes: Vec<String>,
}

fn decode_as(format: ImageFormat, bytes: &[u8], limits: Limits) -> Result<Parts, DecodeError> {
    let name = format::name(format);
    let explain = |error| explained(error, name);
    let is_jpeg = format == ImageFormat::Jpeg;
    let jpeg = if is_jpeg { jpeg::stated(bytes) } else { jpeg::Jpeg::default() };
    if is_jpeg && !jpeg.is_complete {
        return Err(DecodeError::Truncated { format: name });
    }
    if jpeg.components == 4 {
        return Err(DecodeError::Unsupported { format: name, what: "CMYK (four inks)".to_owned() });
    }
    if let (ImageFormat::Qoi, Some(&[a, b, c, d, e, f, g, h])) = (format, bytes.get(4..).and_then(<[u8]>::first_chunk))
    {
        // Its decoder calls every size that it does not take damage.
        let size = [[a, b, c, d], [e, f, g, h]].map(u32::from_be_bytes);
        check_size(name, size, 4, 0, limits)?;
    }
    if format == ImageFormat::WebP && webp_is_cut(bytes) {
        return Err(DecodeError::Truncated { format: name });
    }
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut inner = image::Limits::no_limits();
    // A PNG file's profile grows by doubling while it is inflated, before its size is known.
    inner.max_alloc = Some(if format == ImageFormat::Png { limits.max_bytes / 2 } else { limits.max_bytes });
    reader.limits(inner);
    let mut decoder = reader.into_decoder().map_err(explain)?;

    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let (channels, sample_bytes) = layout(color)
        .ok_or_else(|| DecodeError::Unsupported { format: name, what: format!("the colour type {color:?}") })?;
    let is_stored_as_read = color == ColorType::Rgba8;
    let read_bytes = if is_stored_as_read { 0 } else { channels.count() * sample_bytes };
    let (own_bytes, own_copy) = decoders_own(format, &jpeg, bytes.len());
    let mut notes = Vec::new();
    if decoder.orientation().is_ok_and(|orientation| orientation != Orientation::NoTransforms) {
        notes.push(NOT_TURNED.to_owned());
    }
    if is_animated(format, bytes) {
        notes.push("it is an animation, of which one picture is read".to_owned());
    }
    let icc = decoder.icc_profile().ok().flatten();
    // The decoder keeps the profile, too.
    let profiles = icc.as_ref().map_or(0, |icc| 2 * icc.len());
    check_size(name, [width, height], read_bytes + 4 * sample_bytes + own_bytes, own_copy + profiles, limits)?;

    let is_grey = !channels.has_color();
    let profile = match format {
        ImageFormat::Png => stated::png(bytes, icc.as_deref(), is_grey),
        ImageFormat::Bmp => stated::bmp(bytes),
        ImageFormat::Qoi => stated::qoi(bytes),
        _ => match &icc {
            Some(icc) => Some(Profile::from_icc(icc, is_grey)),
            None => jpeg.has_profile.then(|| Profile::refused("ICC profile", "it is damaged")),
        },
    };

    drop(icc);
    let count = width as usize * height as usize;
    let mut flaw = None;
    let read = |buffer: &mut [u8]| {
        // Beside the decoder, which works on one core.
        rayon::in_place_scope(|scope| {
            if is_jpeg {
                scope.spawn(|_| flaw = jpeg::flaw(bytes));
            }
            decoder.read_image(buffer).map_err(explain)
        })
    };
    let texels = match sample_bytes {
        _ if is_stored_as_read => {
            let mut texels = zeroed::<[u8; 4]>(count, name)?;
            read(texels.as_flattened_mut())?;
            Texels::U8(texels)
        }
        1 => {
            let mut values = zeroed::<u8>(count * channels.count(), name)?;
            read(&mut values)?;
            Texels::U8(spread(&values, channels, 255, |v| v))
        }
        _ => {
            let mut values = zeroed::<u16>(count * channels.count(), name)?;
            read(bytemuck::cast_slice_mut(&mut values))?;
            Texels::U16(spread(&values, channels, 65_535, |v| v))
        }
    };
    notes.extend(jpeg_note(flaw)?);
    Ok(Parts { width, height, channels, texels, profile, notes })
}

/// A flaw of a JPEG file as an error, or as a note where all of the image is there.
fn jpeg_note(flaw: Option<jpeg::Flaw>) -> Result<Option<String>, DecodeError> {
    let reason = match flaw {
        None => return Ok(None),
        Some(jpeg::Flaw::Coarse) => {
            let note = "the last scans of the progressive JPEG are not there: it is coarser than it was";
            return Ok(Some(note.to_owned()));
        }
        Some(jpeg::Flaw::Short) => "a scan ends before all of the image is in it",
        Some(jpeg::Flaw::NoCode) => "a scan holds bits that mean nothing",
        Some(jpeg::Flaw::Missing) => "one of its colour components is not there",
    };
    Err(DecodeError::Damaged { format: "JPEG", reason: reason.to_owned() })
}

/// Said of a file whose rows and columns are not what its owner sees.
const NOT_TURNED: &str = "its orientation is not applied, as texture coordinates mean the rows and columns of the file";

/// Whether a WebP file has fewer bytes than it says (all but the last, which may be padding): its decoder takes zeros for
/// the last few of a lossy one. RFC 9649 (2024), 2.4.
fn webp_is_cut(bytes: &[u8]) -> bool {
    let stated = bytes.get(4..).and_then(|rest| rest.first_chunk::<4>()).map(|&size| u32::from_le_bytes(size));
    stated.is_some_and(|size| bytes.len() + 1 < 8 + size as usize)
}

/// Whether a PNG or WebP file holds several pictures: acTL before the image data (W3C 2025, "Portable Network Graphics (PNG)
/// Specification (Third Edition)", 11.3.6.1), or the second bit of the extended header (RFC 9649, 2.7).
fn is_animated(format: ImageFormat, bytes: &[u8]) -> bool {
    match format {
        ImageFormat::Png => stated::png_is_animated(bytes),
        ImageFormat::WebP => bytes.get(12..16) == Some(b"VP8X") && bytes.get(20).is_some_and(|flags| flags & 2 != 0),
        _ => false,
    }
}

/// What a decoder allocates beside what it is given, at most: bytes per texel, and bytes. JPEG keeps a copy of the file and,
/// where it is progressive, coefficients of 16 bits, and a bit for each in `jpeg::flaw`; WebP keeps its planes, or its own copy of the texels.
fn decoders_own(format: ImageFormat, jpeg: &jpeg::Jpeg, length: usize) -> (usize, usize) {
    match format {
        ImageFormat::Jpeg if jpeg.is_progressive => (2 * usize::from(jpeg.components) + 1, length),
        ImageFormat::Jpeg => (0, length),
        ImageFormat::WebP => (4, 0),
        _ => (0, 0),
    }
}

/// Channels, and bytes per sample, of what is read through the crate image: no floats.
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
        _ => return None,
    })
}

/// Refuses a size before anything is allocated for it: `texel_bytes` per texel and `more_bytes` beside.
fn check_size(
    format: &'static str,
    [width, height]: [u32; 2],
    texel_bytes: usize,
    more_bytes: usize,
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
    let bytes = texels.saturating_mul(texel_bytes as u64).saturating_add(more_bytes as u64);
    if bytes > limits.max_bytes || usize::try_from(bytes).is_err() {
        return too_large(format!("that takes {bytes} bytes and at most {} are allowed", limits.max_bytes));
    }
    Ok(())
}

/// Memory that may be refused, as an error.
fn zeroed<T: bytemuck::Zeroable>(count: usize, format: &'static str) -> Result<Vec<T>, DecodeError> {
    bytemuck::allocation::try_zeroed_vec(count).map_err(|()| DecodeError::Unsupported {
        format,
        what: format!("an image that needs {} bytes when there are not so many", count * size_of::<T>()),
    })
}

/// Samples spread to four channels.
fn spread<S: Copy + Sync, T: Copy + Send + Sync>(
    samples: &[S],
    channels: Channels,
    opaque: T,
    value: impl Fn(S) -> T + Sync,
) -> Vec<[T; 4]> {
    let texel = |texel: &[S]| {
        let at = |i: usize| value(texel[i]);
        match channels {
            Channels::Grey => [at(0), at(0), at(0), opaque],
            Channels::GreyAlpha => [at(0), at(0), at(0), at(1)],
            Channels::Rgb => [at(0), at(1), at(2), opaque],
            Channels::Rgba => [at(0), at(1), at(2), at(3)],
        }
    };
    samples.par_chunks_exact(channels.count()).with_min_len(1 << 14).map(texel).collect()
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

fn explained(error: ImageError, format: &'static str) -> DecodeError {
    match error {
        ImageError::Limits(_) => DecodeError::Memory { format },
        ImageError::Unsupported(what) => {
            let what = match what.kind() {
                UnsupportedErrorKind::Color(color) => format!("the colour type {color:?}"),
                _ => format!("what it holds ({what})"),
            };
            DecodeError::Unsupported { format, what }
        }
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
