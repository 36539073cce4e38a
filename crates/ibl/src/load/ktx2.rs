//! KTX 2.0: cube maps of float, half, shared-exponent or 8-bit texels, with their levels; also plain 2D pictures.
//!
//! Zstandard and zlib supercompression are undone; Basis Universal and block compression are refused by name. Of a cube
//! whose key/values do not state each level's roughness (see `save::ktx2`) only level 0 is kept.

mod descriptor;

use super::{Content, Fault, Limits, Picture, StoredLevels, StoredLobe, checked_texels, field, roughness_list};
use crate::bake::STEEPEST;
use crate::cube::Cube;
use crate::equirect::Equirect;
use crate::ktx2::{
    ALPHA_SLOPE, HEADER_BYTES, IDENTIFIER, KEY_ALPHA, KEY_CONTENT, KEY_ORIENTATION, KEY_ROUGHNESS, KEY_SWIZZLE,
    LEVEL_ENTRY_BYTES, RGB9E5, RGBA16F, RGBA32F, color_from_rgb9e5,
};
use crate::save::CubeContent;
use descriptor::Descriptor;
use half::f16;
use halfvector_maps::color::linear_from_srgb;
use std::borrow::Cow;
use std::io::Read;
use std::ops::Range;

pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<Content, Fault> {
    let header = Header::parsed(bytes, limits)?;
    let pairs = KeyValues::parsed(bytes)?;
    if let Some(orientation) = pairs.text(KEY_ORIENTATION)?
        && orientation != "rd"
    {
        return Err(field(KEY_ORIENTATION, format!("\"{orientation}\" is not \"rd\", rows from the top; save it so")));
    }
    let swizzle = pairs.text(KEY_SWIZZLE)?.map_or(Ok(Swizzle::NONE), Swizzle::parsed)?;
    let decoded = |texel: &[u8]| swizzle.colour(header.coding.decoded(texel));
    if header.faces == 1 {
        let plain = header.level_bytes(bytes, 0)?;
        let pixels = plain.chunks_exact(header.coding.bytes()).map(decoded).collect();
        let map = Equirect { width: header.width, height: header.height, pixels };
        let low_dynamic_range = header.coding.low_dynamic_range();
        let notes = header.note.into_iter().collect();
        return Ok(Content::Picture(Picture { map, low_dynamic_range, notes }));
    }
    let mut notes: Vec<String> = header.note.clone().into_iter().collect();
    if pairs.text(KEY_CONTENT)? == Some(CubeContent::IrradianceOverPi.name()) {
        notes.push("it holds diffuse irradiance, and is taken as if that were the light itself".to_owned());
    }
    let roughness = match pairs.text(KEY_ROUGHNESS)? {
        Some(text) => Some(roughness_list(text, header.levels.len()).map_err(|why| field(KEY_ROUGHNESS, why))?),
        None => None,
    };
    let used = if roughness.is_some() { header.levels.len() } else { 1 };
    let is_slope = pairs.text(KEY_ALPHA)? == Some(ALPHA_SLOPE) && swizzle.keeps_alpha;
    let alpha = is_slope.then(|| header.coding.alpha()).flatten();
    let (mut levels, mut slope) = (Vec::new(), Vec::new());
    for level in 0..used {
        let plain = header.level_bytes(bytes, level)?;
        let texels = plain.chunks_exact(header.coding.bytes());
        if let (Some(alpha), true) = (alpha, roughness.is_some()) {
            slope.push(texels.clone().map(|texel| finite(alpha(texel))).collect());
        }
        let texels = texels.map(decoded).collect();
        levels.push(Cube { size: (header.width >> level).max(1), texels });
    }
    let lobe = roughness.map_or(StoredLobe::Unknown, StoredLobe::Ggx);
    Ok(Content::Levels(StoredLevels { levels, lobe, slope, irradiance_sh: None }, notes))
}

struct Header {
    width: usize,
    height: usize,
    faces: usize,
    coding: Coding,
    compression: Compression,
    /// What the file's owner may not expect of its colours.
    note: Option<String>,
    /// Where each level lies in the file, level 0 first.
    levels: Vec<(usize, usize)>,
}

#[derive(Clone, Copy)]
enum Compression {
    None,
    Zstandard,
    Zlib,
}

fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]))
}

fn long(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(std::array::from_fn(|i| bytes[at + i]))
}

impl Header {
    fn parsed(bytes: &[u8], limits: Limits) -> Result<Header, Fault> {
        if !bytes.starts_with(&IDENTIFIER) && bytes.len() >= IDENTIFIER.len() {
            let reason = if bytes[4..7] == *b" 11" {
                "it is a KTX 1 file; convert it to KTX2"
            } else {
                "it is not that of KTX 2.0; was the file changed in transfer?"
            };
            return Err(field("identifier", reason));
        }
        if bytes.len() < HEADER_BYTES {
            return Err(Fault::Truncated("its header".to_owned()));
        }
        let [vk_format, type_size, width, height, depth, layers, faces, levels, scheme] =
            std::array::from_fn(|i| number(bytes, 12 + 4 * i));
        let coding = Coding::of(vk_format)?;
        if depth != 0 {
            return Err(field("pixelDepth", format!("{depth} where cube maps and pictures have 0")));
        }
        if layers > 1 {
            return Err(field("layerCount", format!("{layers} cubes in one file; save one alone")));
        }
        if faces != 6 && faces != 1 {
            return Err(field("faceCount", format!("{faces} is neither 6, a cube map, nor 1, a picture")));
        }
        if faces == 6 && width != height {
            return Err(field("pixelHeight", format!("faces must be square and this says {width} x {height}")));
        }
        checked_texels(u64::from(width), u64::from(height), limits)?;
        // 0 asks the reader to make the smaller levels; only the first is in the file.
        let count = levels.max(1);
        if count > width.max(height).ilog2() + 1 {
            return Err(field("levelCount", format!("{levels} levels are more than {width} x {height} can have")));
        }
        let compression = match scheme {
            0 => Compression::None,
            2 => Compression::Zstandard,
            3 => Compression::Zlib,
            1 => return Err(field("supercompressionScheme", "1 (BasisLZ) is not read; save it uncompressed")),
            other => {
                return Err(field("supercompressionScheme", format!("{other} is not known; save it uncompressed")));
            }
        };
        if bytes.len() < HEADER_BYTES + LEVEL_ENTRY_BYTES * count as usize {
            return Err(Fault::Truncated("its level index".to_owned()));
        }
        if long(bytes, 72) != 0 {
            let reason = format!("{} where supercompressionScheme {scheme} has no global data", long(bytes, 72));
            return Err(field("sgdByteLength", reason));
        }
        let descriptor = Descriptor::parsed(bytes, count as usize)?;
        descriptor.check(vk_format, type_size, coding)?;
        let mut header = Header {
            width: width as usize,
            height: height as usize,
            faces: faces as usize,
            coding,
            compression,
            note: descriptor.note(),
            levels: Vec::new(),
        };
        let all: u64 = (0..count as usize).map(|level| header.level_texels(level) as u64).sum();
        checked_texels(all, 1, Limits { max_edge: u64::MAX, ..limits })?;
        header.levels = header.level_index(bytes, count as usize, key_value_range(bytes)?.end)?;
        Ok(header)
    }

    fn level_texels(&self, level: usize) -> usize {
        self.faces * (self.width >> level).max(1) * (self.height >> level).max(1)
    }

    /// Where each level begins and ends, as the level index says, once that is found true. They may stand in any order
    /// behind the other parts, which end at `parts_end`.
    fn level_index(&self, bytes: &[u8], count: usize, parts_end: usize) -> Result<Vec<(usize, usize)>, Fault> {
        let entries =
            (0..count).map(|level| self.level_entry(bytes, level)).collect::<Result<Vec<(u64, u64)>, Fault>>()?;
        // Texels of a supercompressed file are not read in place.
        let alignment = match self.compression {
            Compression::None => self.coding.alignment(),
            Compression::Zstandard | Compression::Zlib => 1,
        };
        // How long the file is when its levels stand as writers put them, the smallest first.
        let whole = entries.iter().rev().try_fold(parts_end as u64, |at, (_, length)| {
            at.checked_next_multiple_of(alignment).and_then(|at| at.checked_add(*length))
        });
        let is_cut = whole.is_none_or(|whole| whole > bytes.len() as u64);
        let name = |level: usize| format!("byteOffset of level {level}");
        for (level, &(offset, length)) in entries.iter().enumerate() {
            if offset < parts_end as u64 {
                return Err(field(
                    name(level),
                    format!("{offset} lies before byte {parts_end}, where the header and the key/values end"),
                ));
            }
            if offset.checked_add(length).is_none_or(|end| end > bytes.len() as u64) {
                return Err(if is_cut && offset < bytes.len() as u64 {
                    Fault::Truncated(format!("level {level}"))
                } else {
                    let reason =
                        format!("from {offset} its {length} bytes lie outside of the file of {} bytes", bytes.len());
                    field(name(level), reason)
                });
            }
            if !offset.is_multiple_of(alignment) {
                return Err(field(name(level), format!("{offset} is no multiple of {alignment}, as its texels need")));
            }
        }
        let mut order: Vec<usize> = (0..entries.len()).collect();
        order.sort_by_key(|&level| entries[level].0);
        for pair in order.windows(2) {
            let [(before, length), (offset, _)] = [entries[pair[0]], entries[pair[1]]];
            if before + length > offset {
                let reason = format!("{offset} lies within level {}, the {length} bytes from {before}", pair[0]);
                return Err(field(name(pair[1]), reason));
            }
        }
        Ok(entries.into_iter().map(|(offset, length)| (offset as usize, (offset + length) as usize)).collect())
    }

    /// Where a level begins and how long it is, as the level index says, once its lengths are found true.
    fn level_entry(&self, bytes: &[u8], level: usize) -> Result<(u64, u64), Fault> {
        let at = HEADER_BYTES + LEVEL_ENTRY_BYTES * level;
        let [offset, length, whole] = [0, 8, 16].map(|i| long(bytes, at + i));
        let needed = (self.level_texels(level) * self.coding.bytes()) as u64;
        let other_faces = if self.faces == 6 { needed / 6 } else { 6 * needed };
        if whole == other_faces && whole != needed {
            let (said, found) = if self.faces == 6 { (6, 1) } else { (1, 6) };
            return Err(field("faceCount", format!("{said} where level {level} has the bytes of {found}")));
        }
        if whole != needed {
            return Err(field(
                format!("uncompressedByteLength of level {level}"),
                format!("{whole} where the level has {needed}"),
            ));
        }
        if matches!(self.compression, Compression::None) && length != needed {
            return Err(field(
                format!("byteLength of level {level}"),
                format!("{length} where the level has {needed}"),
            ));
        }
        Ok((offset, length))
    }

    /// The texels of a level, face by face, without supercompression.
    fn level_bytes<'a>(&self, bytes: &'a [u8], level: usize) -> Result<Cow<'a, [u8]>, Fault> {
        let (start, end) = self.levels[level];
        let stored = &bytes[start..end];
        let needed = self.level_texels(level) * self.coding.bytes();
        let plain = match self.compression {
            Compression::None => Cow::Borrowed(stored),
            Compression::Zstandard => Cow::Owned(zstandard(stored, needed).map_err(|why| damaged(level, &why))?),
            Compression::Zlib => Cow::Owned(
                miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(stored, needed)
                    .map_err(|why| damaged(level, &why.to_string()))?,
            ),
        };
        if plain.len() != needed {
            return Err(damaged(level, &format!("it becomes {} bytes and should become {needed}", plain.len())));
        }
        Ok(plain)
    }
}

/// The number, held within what a bake writes as a slope; 0 for what is no number.
fn finite(slope: f32) -> f32 {
    if slope.is_nan() { 0.0 } else { slope.clamp(-STEEPEST, STEEPEST) }
}

fn damaged(level: usize, why: &str) -> Fault {
    field(format!("level {level}"), format!("the compressed data are damaged ({why}); copy or save the file again"))
}

/// One Zstandard stream, up to a byte more than is needed.
fn zstandard(stored: &[u8], needed: usize) -> Result<Vec<u8>, String> {
    let decoder = ruzstd::decoding::StreamingDecoder::new(stored).map_err(|why| why.to_string())?;
    let mut plain = Vec::new();
    decoder.take(needed as u64 + 1).read_to_end(&mut plain).map_err(|why| why.to_string())?;
    Ok(plain)
}

/// How a texel is stored.
#[derive(Clone, Copy)]
enum Coding {
    Half {
        channels: usize,
    },
    Float {
        channels: usize,
    },
    Rgb9E5,
    R11G11B10,
    /// Eight bits a channel.
    Codes {
        channels: usize,
        srgb: bool,
        blue_first: bool,
    },
}

impl Coding {
    /// By VkFormat.
    fn of(vk_format: u32) -> Result<Coding, Fault> {
        let codes = |channels, srgb, blue_first| Ok(Coding::Codes { channels, srgb, blue_first });
        match vk_format {
            23 => codes(3, false, false),
            29 => codes(3, true, false),
            37 => codes(4, false, false),
            43 => codes(4, true, false),
            44 => codes(4, false, true),
            50 => codes(4, true, true),
            90 => Ok(Coding::Half { channels: 3 }),
            RGBA16F => Ok(Coding::Half { channels: 4 }),
            106 => Ok(Coding::Float { channels: 3 }),
            RGBA32F => Ok(Coding::Float { channels: 4 }),
            122 => Ok(Coding::R11G11B10),
            RGB9E5 => Ok(Coding::Rgb9E5),
            other => {
                let kind = match other {
                    0 => "Basis Universal or another format without a number",
                    131..=146 => "BC block compression",
                    147..=156 => "ETC2 or EAC block compression",
                    157..=184 | 1_000_066_000..=1_000_066_013 => "ASTC block compression",
                    _ => "a format of texels",
                };
                Err(field(
                    "vkFormat",
                    format!(
                        "{other} ({kind}) is not read; save it as R16G16B16A16_SFLOAT (97), R32G32B32A32_SFLOAT (109) \
                         or E5B9G9R9_UFLOAT_PACK32 (123)"
                    ),
                ))
            }
        }
    }

    fn bytes(self) -> usize {
        match self {
            Coding::Half { channels } => 2 * channels,
            Coding::Float { channels } => 4 * channels,
            Coding::Rgb9E5 | Coding::R11G11B10 => 4,
            Coding::Codes { channels, .. } => channels,
        }
    }

    /// Bytes of a number as it is swapped on big-endian machines: the header's typeSize.
    fn type_size(self) -> u32 {
        match self {
            Coding::Half { .. } => 2,
            Coding::Float { .. } | Coding::Rgb9E5 | Coding::R11G11B10 => 4,
            Coding::Codes { .. } => 1,
        }
    }

    /// The number that places of uncompressed levels are multiples of: the least that the bytes of a texel and 4 divide.
    fn alignment(self) -> u64 {
        let bytes = self.bytes() as u64;
        match bytes % 4 {
            0 => bytes,
            2 => 2 * bytes,
            _ => 4 * bytes,
        }
    }

    fn is_srgb(self) -> bool {
        matches!(self, Coding::Codes { srgb: true, .. })
    }

    /// Reads alpha, where there is one of full precision.
    fn alpha(self) -> Option<fn(&[u8]) -> f32> {
        match self {
            Coding::Half { channels: 4 } => Some(|texel| f16::from_le_bytes([texel[6], texel[7]]).to_f32()),
            Coding::Float { channels: 4 } => Some(|texel| f32::from_bits(number(texel, 12))),
            _ => None,
        }
    }

    fn low_dynamic_range(self) -> bool {
        matches!(self, Coding::Codes { .. })
    }

    fn decoded(self, texel: &[u8]) -> [f32; 3] {
        match self {
            Coding::Half { .. } => {
                std::array::from_fn(|i| f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32())
            }
            Coding::Float { .. } => std::array::from_fn(|i| f32::from_bits(number(texel, 4 * i))),
            Coding::Rgb9E5 => color_from_rgb9e5(number(texel, 0)),
            Coding::R11G11B10 => {
                let bits = number(texel, 0);
                [small_float(bits & 2047, 6), small_float(bits >> 11 & 2047, 6), small_float(bits >> 22, 5)]
            }
            Coding::Codes { srgb, blue_first, .. } => {
                let codes: [f32; 3] =
                    std::array::from_fn(|i| f32::from(texel[if blue_first { 2 - i } else { i }]) / 255.0);
                if srgb { linear_from_srgb(codes) } else { codes }
            }
        }
    }
}

/// An unsigned float of five bits of exponent (bias 15, as half precision) above `mantissa_bits`: a half without its sign
/// and lowest bits.
fn small_float(bits: u32, mantissa_bits: u32) -> f32 {
    f16::from_bits((bits << (10 - mantissa_bits)) as u16).to_f32()
}

/// Where the key/values lie: directly behind the descriptor, which has been found true.
fn key_value_range(bytes: &[u8]) -> Result<Range<usize>, Fault> {
    let [descriptor, descriptor_length, start, length] = [48, 52, 56, 60].map(|at| number(bytes, at) as usize);
    let descriptor_end = descriptor + descriptor_length;
    // Without key/values the place is 0.
    if start != descriptor_end && (start, length) != (0, 0) {
        return Err(field(
            "kvdByteOffset",
            format!("{start} is not {descriptor_end}, where the data format descriptor ends; the header is damaged"),
        ));
    }
    if length > bytes.len() - descriptor_end {
        return Err(field("kvdByteLength", "the key/values go beyond the file's end; the header is damaged"));
    }
    // Each pair is filled up to four bytes, the last one, too.
    if !length.is_multiple_of(4) {
        return Err(field(
            "kvdByteLength",
            format!("{length} is no multiple of 4, as pairs are; the header is damaged"),
        ));
    }
    Ok(descriptor_end..descriptor_end + length)
}

/// The key/value data of a file.
struct KeyValues<'a>(Vec<(&'a [u8], &'a [u8])>);

impl<'a> KeyValues<'a> {
    fn parsed(bytes: &'a [u8]) -> Result<KeyValues<'a>, Fault> {
        let wrong = |what: &str, reason: &str| field(what, format!("{reason}; the header is damaged"));
        let mut rest = &bytes[key_value_range(bytes)?];
        let mut pairs = Vec::new();
        while rest.len() >= 4 {
            let length = number(rest, 0) as usize;
            let pair = rest[4..]
                .get(..length)
                .ok_or_else(|| wrong("keyAndValueByteLength", "a pair goes beyond their end"))?;
            let end = pair.iter().position(|&b| b == 0).ok_or_else(|| wrong("keyAndValue", "a key does not end"))?;
            pairs.push((&pair[..end], &pair[end + 1..]));
            rest = rest.get(4 + length.next_multiple_of(4)..).unwrap_or_default();
        }
        Ok(KeyValues(pairs))
    }

    /// The text of a key, without the NUL that may end it.
    fn text(&self, key: &str) -> Result<Option<&'a str>, Fault> {
        let Some((_, value)) = self.0.iter().find(|(found, _)| *found == key.as_bytes()) else { return Ok(None) };
        match std::str::from_utf8(value) {
            Ok(text) => Ok(Some(text.trim_end_matches('\0'))),
            Err(_) => Err(field(key, "its value is no text in UTF-8; the file is damaged")),
        }
    }
}

/// Which stored channel is to be read as which colour: the four letters of [`KEY_SWIZZLE`].
#[derive(Clone, Copy)]
struct Swizzle {
    /// For red, green and blue a stored colour, or the number that stands for it.
    colours: [Result<usize, f32>; 3],
    keeps_alpha: bool,
}

impl Swizzle {
    const NONE: Swizzle = Swizzle { colours: [Ok(0), Ok(1), Ok(2)], keeps_alpha: true };

    fn parsed(text: &str) -> Result<Swizzle, Fault> {
        let &[r, g, b, alpha] = text.as_bytes() else {
            return Err(field(KEY_SWIZZLE, format!("\"{text}\" is not four letters")));
        };
        if !text.bytes().all(|letter| b"rgba01".contains(&letter)) {
            return Err(field(KEY_SWIZZLE, format!("\"{text}\" has other letters than r, g, b, a, 0 and 1")));
        }
        let channel = |letter: u8| match letter {
            b'r' => Ok(Ok(0)),
            b'g' => Ok(Ok(1)),
            b'b' => Ok(Ok(2)),
            b'0' => Ok(Err(0.0)),
            b'1' => Ok(Err(1.0)),
            _ => Err(field(KEY_SWIZZLE, format!("\"{text}\" takes a colour from alpha; save colours as colours"))),
        };
        Ok(Swizzle { colours: [channel(r)?, channel(g)?, channel(b)?], keeps_alpha: alpha == b'a' })
    }

    fn colour(&self, stored: [f32; 3]) -> [f32; 3] {
        self.colours.map(|channel| channel.map_or_else(|number| number, |c| stored[c]))
    }
}
