//! TIFF files: grey, palette, RGB, with alpha or without; 1 to 16 bits, and 16- to 64-bit floats.
//! Does not read separate planes, bytes of reversed bits, CMYK, YCbCr or Lab.

use std::io::Cursor;

use tiff::decoder::ifd::Value;
use tiff::decoder::{Decoder, DecodingResult, Limits as TiffLimits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError, TiffUnsupportedError};

use super::{DecodeError, Limits, NOT_TURNED, Parts, check_size, finite, lzw, spread};
use crate::image::{Channels, Texels};
use crate::profile::{Profile, REC709};

const NAME: &str = "TIFF";
const PHOTOMETRIC: u16 = 262;
const PALETTE: u16 = 3;
const BLACK_IS_ZERO: u16 = 1;
const WIDTH: u16 = 256;
const HEIGHT: u16 = 257;
const BITS: u16 = 258;
const COMPRESSION: u16 = 259;
const NOT_PACKED: usize = 1;
const LZW: usize = 5;
const STRIP_OFFSETS: u16 = 273;
const SAMPLES: u16 = 277;
const STRIP_ROWS: u16 = 278;
const STRIP_BYTES: u16 = 279;
const PLANES: u16 = 284;
const TILE_WIDTH: u16 = 322;
const TILE_HEIGHT: u16 = 323;
const TILE_OFFSETS: u16 = 324;
const TILE_BYTES: u16 = 325;
/// Types of whole numbers of four and of eight bytes.
const LONG: usize = 4;
const LONG8: usize = 16;
const TRANSFER_FUNCTION: Tag = Tag::Unknown(301);
const WHITE_POINT: Tag = Tag::Unknown(318);
const PRIMARIES: Tag = Tag::Unknown(319);
const ICC_PROFILE: Tag = Tag::Unknown(34_675);
/// Largest palette, profile or table of strips in bytes.
const MAX_TAG_BYTES: usize = 16 << 20;

/// Reads the first image of the file.
pub(super) fn decode(bytes: &[u8], limits: Limits) -> Result<Parts, DecodeError> {
    check_claims(bytes, limits)?;
    // The decoder has no palettes: the file is read as grey, which are the indices.
    let patched = palette_as_grey(bytes);
    let source = patched.as_deref().unwrap_or(bytes);
    let mut decoder = decoder(source, limits)?;

    let (width, height) = decoder.dimensions().map_err(explained)?;
    let (channels, bits) = match decoder.colortype().map_err(explained)? {
        ColorType::Gray(bits) => (Channels::Grey, bits),
        ColorType::Multiband { bit_depth: bits, num_samples: 2 } => (Channels::GreyAlpha, bits),
        ColorType::RGB(bits) => (Channels::Rgb, bits),
        ColorType::RGBA(bits) => (Channels::Rgba, bits),
        other => return Err(unsupported(&format!("the colour type {other:?}"))),
    };
    if decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration).map_err(explained)?.is_some_and(|plan| plan != 1) {
        return Err(unsupported("separate planes (PlanarConfiguration 2)"));
    }
    if decoder.find_tag_unsigned::<u16>(Tag::FillOrder).map_err(explained)?.is_some_and(|order| order != 1) {
        return Err(unsupported("bytes whose bits stand in reverse (FillOrder 2)"));
    }
    if patched.is_some() && channels != Channels::Grey {
        return Err(unsupported("a palette with more than one channel"));
    }
    let sample_bytes = usize::from(bits).div_ceil(8);
    // Few bits are unpacked to 8 in a copy of their own.
    let read_bytes = channels.count() * sample_bytes * if bits < 8 { 2 } else { 1 };
    let stored_bytes = if patched.is_some() {
        8
    } else if sample_bytes > 2 {
        16
    } else {
        4 * sample_bytes.max(1)
    };
    let packed = Packed::of(source);
    let expanded_bytes = packed.as_ref().map_or(0, |packed| packed.file_bytes(source));
    let copy_bytes = patched.as_ref().map_or(0, Vec::len).saturating_add(expanded_bytes);
    check_size(NAME, [width, height], read_bytes + stored_bytes, copy_bytes, limits)?;

    let stored = if patched.is_some() { Channels::Rgb } else { channels };
    let profile = profile(&mut decoder, stored == Channels::Grey);
    let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples).map_err(explained)?.unwrap_or_default();
    let mut notes = Vec::new();
    if extra.first() == Some(&1) && stored.has_alpha() {
        notes.push("its colours are multiplied by alpha already and are taken as they are".to_owned());
    }
    if decoder.find_tag_unsigned::<u16>(Tag::Orientation).ok().flatten().is_some_and(|way| matches!(way, 2..=8)) {
        notes.push(NOT_TURNED.to_owned());
    }
    if decoder.more_images() {
        notes.push("it holds several images, of which the first is read".to_owned());
    }
    let palette = match patched {
        Some(_) => Some(decoder.get_tag_u16_vec(Tag::ColorMap).map_err(explained)?),
        None => None,
    };
    let values = match packed {
        Some(packed) => {
            let expanded = packed.expanded(source)?;
            self::decoder(&expanded, limits)?.read_image()
        }
        None => decoder.read_image(),
    };
    let values = match values.map_err(explained)? {
        DecodingResult::U8(packed) if bits < 8 => DecodingResult::U8(unpacked(&packed, bits, width as usize)),
        other => other,
    };
    let texels = match (values, palette) {
        (DecodingResult::U8(values), Some(map)) => colored(values.iter().map(|&i| usize::from(i)), &map),
        (DecodingResult::U16(values), Some(map)) => colored(values.iter().map(|&i| usize::from(i)), &map),
        (DecodingResult::U8(values), None) => {
            let top = (1_u32 << bits.min(8)) - 1;
            Texels::U8(spread(&values, channels, 255, |v| (u32::from(v) * 255 / top) as u8))
        }
        (DecodingResult::U16(values), None) => Texels::U16(spread(&values, channels, 65_535, |v| v)),
        (DecodingResult::F16(values), None) => Texels::F32(spread(&values, channels, 1.0, |v| finite(v.to_f32()))),
        (DecodingResult::F32(values), None) => Texels::F32(spread(&values, channels, 1.0, finite)),
        (DecodingResult::F64(values), None) => Texels::F32(spread(&values, channels, 1.0, |v| finite(v as f32))),
        _ => return Err(unsupported("signed or 32-bit integers")),
    };
    Ok(Parts { width, height, channels: stored, texels, profile, notes })
}

/// A decoder of the file that keeps to the limits.
fn decoder(bytes: &[u8], limits: Limits) -> Result<Decoder<Cursor<&[u8]>>, DecodeError> {
    let max_bytes = usize::try_from(limits.max_bytes).unwrap_or(usize::MAX);
    let mut tiff_limits = TiffLimits::default();
    tiff_limits.decoding_buffer_size = max_bytes;
    tiff_limits.intermediate_buffer_size = max_bytes;
    tiff_limits.ifd_value_size = MAX_TAG_BYTES.min(max_bytes);
    Ok(Decoder::new(Cursor::new(bytes)).map_err(explained)?.with_limits(tiff_limits))
}

/// One entry of the file's first directory.
#[derive(Clone, Copy)]
struct Entry {
    tag: u16,
    /// How many values it says that it has, and the bytes of each.
    count: usize,
    size: usize,
    /// Where its value stands, or the place of its values where they take more than `inline` bytes.
    value: usize,
    inline: usize,
}

/// A number of the file's byte order.
fn number(bytes: &[u8], at: usize, length: usize) -> Option<usize> {
    let field = bytes.get(at..at.checked_add(length)?)?;
    let add = |n: usize, &b: &u8| n.checked_mul(256)?.checked_add(usize::from(b));
    if bytes.starts_with(b"MM") { field.iter().try_fold(0, add) } else { field.iter().rev().try_fold(0, add) }
}

/// The entries of the first directory, as far as they lie in the file. TIFF 6.0 (1992), section 2: a count and entries of tag,
/// type, count, value; BigTIFF widens all but tag and type.
fn directory(bytes: &[u8]) -> Option<Vec<Entry>> {
    let (start, count_length, wide) = match number(bytes, 2, 2)? {
        42 => (number(bytes, 4, 4)?, 2, 4),
        43 => (number(bytes, 8, 8)?, 8, 8),
        _ => return None,
    };
    let first = start.checked_add(count_length)?;
    let entry = |i: usize| -> Option<Entry> {
        let at = first.checked_add(i * (4 + 2 * wide))?;
        let size = match number(bytes, at + 2, 2)? {
            3 | 8 => 2,
            4 | 9 | 11 | 13 => 4,
            5 | 10 | 12 | 16 | 17 | 18 => 8,
            _ => 1,
        };
        let count = number(bytes, at + 4, wide)?;
        let tag = u16::try_from(number(bytes, at, 2)?).ok()?;
        Some(Entry { tag, count, size, value: at + 4 + wide, inline: wide })
    };
    Some((0..number(bytes, start, count_length)?.min(65_536)).map_while(entry).collect())
}

/// Refuses a file whose directory claims values that it has not: its decoder makes room for them, 32 bytes each, before it
/// reads.
fn check_claims(bytes: &[u8], limits: Limits) -> Result<(), DecodeError> {
    for entry in directory(bytes).unwrap_or_default() {
        let values = entry.count.saturating_mul(entry.size);
        let start = if values > entry.inline { number(bytes, entry.value, entry.inline) } else { Some(entry.value) };
        if start.and_then(|start| start.checked_add(values)).is_none_or(|end| end > bytes.len()) {
            return Err(DecodeError::Truncated { format: NAME });
        }
        if (entry.count as u64).saturating_mul(32) > limits.max_bytes {
            return Err(DecodeError::Memory { format: NAME });
        }
    }
    Ok(())
}

/// A copy of the file that says grey where it says palette, or nothing for other files.
fn palette_as_grey(bytes: &[u8]) -> Option<Vec<u8>> {
    let value = directory(bytes)?.into_iter().find(|entry| entry.tag == PHOTOMETRIC)?.value;
    if number(bytes, value, 2)? != usize::from(PALETTE) {
        return None;
    }
    let mut patched = bytes.to_vec();
    let grey = if bytes.starts_with(b"MM") { BLACK_IS_ZERO.to_be_bytes() } else { BLACK_IS_ZERO.to_le_bytes() };
    patched.get_mut(value..value + 2)?.copy_from_slice(&grey);
    Some(patched)
}

impl Entry {
    /// Where its values stand.
    fn start(&self, bytes: &[u8]) -> Option<usize> {
        let is_inline = self.count.checked_mul(self.size)? <= self.inline;
        if is_inline { Some(self.value) } else { number(bytes, self.value, self.inline) }
    }

    /// Its values, whole numbers of the file.
    fn numbers(&self, bytes: &[u8]) -> Option<Vec<usize>> {
        let start = self.start(bytes)?;
        (0..self.count).map(|i| number(bytes, start + i * self.size, self.size)).collect()
    }
}

/// The strips or tiles of a file that are packed by LZW.
struct Packed {
    compression: Entry,
    /// Where each begins, and how many bytes it has.
    offsets: Entry,
    counts: Entry,
    /// Bytes that each holds.
    expanded: Vec<usize>,
}

impl Packed {
    /// None for files of other kinds, and for those that the decoder will refuse.
    fn of(bytes: &[u8]) -> Option<Self> {
        let directory = directory(bytes)?;
        let entry = |tag: u16| directory.iter().find(|entry| entry.tag == tag).copied();
        let first = |tag: u16| entry(tag).and_then(|entry| number(bytes, entry.start(bytes)?, entry.size));
        let compression = entry(COMPRESSION)?;
        if first(COMPRESSION)? != LZW || first(PLANES).is_some_and(|planes| planes != 1) {
            return None;
        }
        let bits = first(BITS).unwrap_or(1).checked_mul(first(SAMPLES).unwrap_or(1))?;
        let (width, height) = (first(WIDTH)?, first(HEIGHT)?);
        let expanded = |width: usize, rows: usize| width.checked_mul(bits)?.div_ceil(8).checked_mul(rows);
        let (offsets, counts, expanded) = match entry(TILE_OFFSETS) {
            Some(offsets) => {
                let tile = expanded(first(TILE_WIDTH)?, first(TILE_HEIGHT)?)?;
                (offsets, entry(TILE_BYTES)?, vec![tile; offsets.count])
            }
            None => {
                let rows = first(STRIP_ROWS).unwrap_or(height).min(height);
                let rows_of = |strip: usize| height.saturating_sub(strip.saturating_mul(rows)).min(rows);
                let offsets = entry(STRIP_OFFSETS)?;
                let strips = (0..offsets.count).map(|strip| expanded(width, rows_of(strip))).collect::<Option<_>>()?;
                (offsets, entry(STRIP_BYTES)?, strips)
            }
        };
        (offsets.count == counts.count).then_some(Self { compression, offsets, counts, expanded })
    }

    /// Bytes of the file when it is expanded, with two numbers for each strip or tile.
    fn file_bytes(&self, bytes: &[u8]) -> usize {
        let strips = self.expanded.iter().fold(0, |sum: usize, &n| sum.saturating_add(n));
        bytes.len().saturating_add(strips).saturating_add(2 * self.offsets.inline * (self.expanded.len() + 1))
    }

    /// The file with the same values, not packed: strips or tiles and their places are appended, and the directory says so.
    fn expanded(&self, bytes: &[u8]) -> Result<Vec<u8>, DecodeError> {
        let truncated = || DecodeError::Truncated { format: NAME };
        let places = self.offsets.numbers(bytes).zip(self.counts.numbers(bytes)).ok_or_else(truncated)?;
        let mut file = Vec::with_capacity(self.file_bytes(bytes));
        file.extend_from_slice(bytes);
        let mut offsets = Vec::new();
        for ((&start, &count), &expanded) in places.0.iter().zip(&places.1).zip(&self.expanded) {
            let codes = bytes.get(start..).and_then(|rest| rest.get(..count)).ok_or_else(truncated)?;
            offsets.push(file.len());
            if !lzw::expand(codes, expanded, &mut file) {
                let reason = "a part of it holds less than its size says".to_owned();
                return Err(DecodeError::Damaged { format: NAME, reason });
            }
        }
        let is_big_endian = bytes.starts_with(b"MM");
        let write = |file: &mut Vec<u8>, at: usize, length: usize, number: usize| {
            let wide = (number as u64).to_le_bytes();
            let field = file.get_mut(at..at + length)?;
            field.copy_from_slice(&wide[..length]);
            if is_big_endian {
                field.reverse();
            }
            Some(())
        };
        let mut write_all = || {
            write(&mut file, self.compression.value, 2, NOT_PACKED)?;
            for (entry, numbers) in [(self.offsets, &offsets), (self.counts, &self.expanded)] {
                let (wide, kind) = (entry.inline, if entry.inline == 4 { LONG } else { LONG8 });
                write(&mut file, entry.value - wide - 2, 2, kind)?;
                let at = if numbers.len() == 1 { entry.value } else { file.len() };
                if numbers.len() > 1 {
                    write(&mut file, entry.value, wide, at)?;
                    file.resize(at + wide * numbers.len(), 0);
                }
                numbers.iter().enumerate().try_for_each(|(i, &n)| write(&mut file, at + i * wide, wide, n))?;
            }
            // Places of four bytes reach no further.
            (self.offsets.inline == 8 || u32::try_from(file.len()).is_ok()).then_some(())
        };
        write_all().ok_or(DecodeError::Memory { format: NAME })?;
        Ok(file)
    }
}

/// One byte per sample from rows that are packed tightly and begin on whole bytes.
fn unpacked(packed: &[u8], bits: u8, width: usize) -> Vec<u8> {
    let per_byte = usize::from(8 / bits.clamp(1, 8));
    let mask = ((1_u32 << bits) - 1) as u8;
    let row = |row: &[u8]| {
        let sample = |x: usize| (row[x / per_byte] >> (8 - usize::from(bits) * (x % per_byte + 1))) & mask;
        (0..width).map(sample).collect::<Vec<_>>()
    };
    packed.chunks_exact(width.div_ceil(per_byte)).flat_map(row).collect()
}

/// The palette's colours: all reds, all greens, all blues, 16 bits each. Most writers have 8 bits and repeat them or put
/// them in the upper half; such become 8-bit images. An index past the end is black.
fn colored(indices: impl Iterator<Item = usize>, map: &[u16]) -> Texels {
    let size = map.len() / 3;
    let has_8_bits = map.iter().all(|&c| c & 0xff == 0) || map.iter().all(|&c| c & 0xff == c >> 8);
    let color = |i: usize| {
        let channel = |k: usize| if i < size { map[k * size + i] } else { 0 };
        [channel(0), channel(1), channel(2), 65_535]
    };
    if has_8_bits {
        Texels::U8(indices.map(|i| color(i).map(|c| (c >> 8) as u8)).collect())
    } else {
        Texels::U16(indices.map(color).collect())
    }
}

/// An ICC profile, or what TIFF 6.0 (1992), section 20, has instead.
fn profile(decoder: &mut Decoder<Cursor<&[u8]>>, is_grey: bool) -> Option<Profile> {
    if let Ok(Some(value)) = decoder.find_tag(ICC_PROFILE) {
        return Some(match value.into_u8_vec() {
            Ok(icc) => Profile::from_icc(&icc, is_grey),
            Err(_) => Profile::refused("ICC profile", "it is damaged"),
        });
    }
    if let Ok(Some(_)) = decoder.find_tag(TRANSFER_FUNCTION) {
        return Some(Profile::refused("TIFF TransferFunction", "only ICC profiles are read"));
    }
    let primaries = rationals(decoder.find_tag(PRIMARIES).ok()??);
    let white = decoder.find_tag(WHITE_POINT).ok().flatten().map_or_else(|| REC709[0].to_vec(), rationals);
    let (&[rx, ry, gx, gy, bx, by], &[wx, wy]) = (primaries.as_slice(), white.as_slice()) else {
        return Some(Profile::refused("TIFF PrimaryChromaticities", "they are not six fractions and a white of two"));
    };
    let xy = [[wx, wy], [rx, ry], [gx, gy], [bx, by]];
    Some(Profile::from_gamma("TIFF PrimaryChromaticities".to_owned(), None, Some(xy)))
}

/// Fractions of whole numbers; anything else is left out.
fn rationals(value: Value) -> Vec<f64> {
    let number = |value: &Value| match *value {
        Value::Rational(over, under) if under > 0 => Some(f64::from(over) / f64::from(under)),
        _ => None,
    };
    match value {
        Value::List(values) => values.iter().filter_map(number).collect(),
        value => number(&value).into_iter().collect(),
    }
}

fn unsupported(what: &str) -> DecodeError {
    DecodeError::Unsupported { format: NAME, what: what.to_owned() }
}

fn explained(error: TiffError) -> DecodeError {
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            DecodeError::Truncated { format: NAME }
        }
        TiffError::UnsupportedError(TiffUnsupportedError::UnsupportedCompressionMethod(method)) => {
            unsupported(&format!("the compression {method:?}"))
        }
        TiffError::UnsupportedError(what) => unsupported(&format!("what it holds ({what})")),
        TiffError::LimitsExceeded => DecodeError::Memory { format: NAME },
        other => DecodeError::Damaged { format: NAME, reason: other.to_string() },
    }
}
