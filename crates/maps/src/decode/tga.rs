//! TGA: palettes, true colour of 15 to 32 bits and grey, plain or run-length coded, from any corner.
//! Truevision 1991, "TGA File Format Specification 2.0".
//!
//! The number of attribute bits in the header says whether the last bits of a texel are alpha: with none they are not,
//! whatever stands there. The gamma of the extension area is `stated`'s; its statement about alpha is not read.

use super::{Channels, DecodeError, Limits, Parts, Texels, check_size, stated, zeroed};

const NAME: &str = "TGA";
const HEADER: usize = 18;

/// How the bytes of a texel, or of a palette's entry, become red, green, blue and alpha.
#[derive(Clone, Copy)]
enum Coding {
    Grey,
    GreyAlpha,
    /// Five bits each; the sixteenth is alpha or nothing.
    Fives {
        alpha: bool,
    },
    /// Blue first; of four bytes the last is alpha or nothing.
    Bytes {
        count: usize,
        alpha: bool,
    },
}

impl Coding {
    fn of(is_grey: bool, bits: u8, attribute_bits: u8) -> Result<Coding, DecodeError> {
        match (is_grey, bits, attribute_bits) {
            (true, 8, 0) => Ok(Coding::Grey),
            (true, 16, 8) => Ok(Coding::GreyAlpha),
            (false, 15, 0 | 1) | (false, 16, 0) => Ok(Coding::Fives { alpha: false }),
            (false, 16, 1) => Ok(Coding::Fives { alpha: true }),
            (false, 24, 0) => Ok(Coding::Bytes { count: 3, alpha: false }),
            (false, 32, 0) => Ok(Coding::Bytes { count: 4, alpha: false }),
            (false, 32, 8) => Ok(Coding::Bytes { count: 4, alpha: true }),
            _ => {
                let kind = if is_grey { "grey" } else { "colour" };
                Err(unsupported(format!("{kind} of {bits} bits, {attribute_bits} of them for attributes,")))
            }
        }
    }

    fn bytes(self) -> usize {
        match self {
            Coding::Grey => 1,
            Coding::GreyAlpha | Coding::Fives { .. } => 2,
            Coding::Bytes { count, .. } => count,
        }
    }

    fn channels(self) -> Channels {
        match self {
            Coding::Grey => Channels::Grey,
            Coding::GreyAlpha => Channels::GreyAlpha,
            Coding::Fives { alpha: true } | Coding::Bytes { alpha: true, .. } => Channels::Rgba,
            Coding::Fives { .. } | Coding::Bytes { .. } => Channels::Rgb,
        }
    }

    fn texel(self, bytes: &[u8]) -> [u8; 4] {
        match self {
            Coding::Grey => [bytes[0], bytes[0], bytes[0], 255],
            Coding::GreyAlpha => [bytes[0], bytes[0], bytes[0], bytes[1]],
            Coding::Fives { alpha } => {
                let bits = u16::from_le_bytes([bytes[0], bytes[1]]);
                // 31 is 255: the nearest of 256 steps.
                let five = |shift: u16| (((bits >> shift & 31) * 255 + 15) / 31) as u8;
                [five(10), five(5), five(0), if alpha && bits >> 15 == 0 { 0 } else { 255 }]
            }
            Coding::Bytes { alpha, .. } => [bytes[2], bytes[1], bytes[0], if alpha { bytes[3] } else { 255 }],
        }
    }
}

fn unsupported(what: String) -> DecodeError {
    DecodeError::Unsupported { format: NAME, what }
}

fn damaged(reason: &str) -> DecodeError {
    DecodeError::Damaged { format: NAME, reason: reason.to_owned() }
}

/// Reads a file whose header `format` has found to be one.
pub(super) fn decode(bytes: &[u8], limits: Limits) -> Result<Parts, DecodeError> {
    let truncated = || DecodeError::Truncated { format: NAME };
    let header = bytes.first_chunk::<HEADER>().ok_or_else(truncated)?;
    let [id_bytes, map_type, image_type, ..] = *header;
    let short = |at: usize| u16::from_le_bytes([header[at], header[at + 1]]);
    let (width, height) = (u32::from(short(12)), u32::from(short(14)));
    let (bits, flags) = (header[16], header[17]);
    let (kind, is_packed) = (image_type & 7, image_type & 8 != 0);
    if bits == 1 {
        return Err(unsupported("black and white of 1 bit".to_owned()));
    }
    if flags & 0xc0 != 0 {
        return Err(unsupported("interleaved rows".to_owned()));
    }
    let map_length = if map_type == 1 { usize::from(short(5)) } else { 0 };
    let map_bytes = map_length * usize::from(header[7]).div_ceil(8);
    let is_mapped = kind == 1;
    let coding = Coding::of(kind == 3, if is_mapped { header[7] } else { bits }, flags & 15)?;
    let stored_bytes = match (is_mapped, bits) {
        (false, _) => coding.bytes(),
        (true, 8) => 1,
        (true, 16) => 2,
        (true, _) => return Err(unsupported(format!("palette indices of {bits} bits"))),
    };
    check_size(NAME, [width, height], 4, 0, limits)?;

    let map_at = HEADER + usize::from(id_bytes);
    let palette: Vec<[u8; 4]> = if is_mapped {
        let stored = bytes.get(map_at..map_at + map_bytes).ok_or_else(truncated)?;
        stored.chunks_exact(coding.bytes()).map(|entry| coding.texel(entry)).collect()
    } else {
        Vec::new()
    };
    let first = usize::from(short(3));
    let texel = |stored: &[u8]| {
        if !is_mapped {
            return Ok(coding.texel(stored));
        }
        let index = stored.iter().rev().fold(0, |index, &byte| index << 8 | usize::from(byte));
        let entry = index.checked_sub(first).and_then(|index| palette.get(index));
        entry.copied().ok_or_else(|| damaged("a texel's index lies outside of its palette"))
    };

    let mut data = bytes.get(map_at + map_bytes..).ok_or_else(truncated)?;
    let (columns, count) = (width as usize, width as usize * height as usize);
    if !is_packed && data.len() < count * stored_bytes {
        return Err(truncated());
    }
    let mut texels = zeroed::<[u8; 4]>(count, NAME)?;
    // Rows are stored from the bottom and columns from the left unless the flags say otherwise.
    let (from_right, from_top) = (flags & 0x10 != 0, flags & 0x20 != 0);
    let place = |k: usize| {
        let (row, column) = (k / columns, k % columns);
        let row = if from_top { row } else { height as usize - 1 - row };
        row * columns + if from_right { columns - 1 - column } else { column }
    };
    let mut done = 0;
    while done < count {
        let (run, is_repeated) = if is_packed {
            let (&packet, rest) = data.split_first().ok_or_else(truncated)?;
            data = rest;
            (usize::from(packet & 127) + 1, packet & 128 != 0)
        } else {
            (columns, false)
        };
        if run > count - done {
            return Err(damaged("a run goes beyond the last texel"));
        }
        let stored = if is_repeated { stored_bytes } else { run * stored_bytes };
        let (packet, rest) = data.split_at_checked(stored).ok_or_else(truncated)?;
        data = rest;
        if is_repeated {
            let value = texel(packet)?;
            (done..done + run).for_each(|k| texels[place(k)] = value);
        } else {
            for (k, stored) in (done..).zip(packet.chunks_exact(stored_bytes)) {
                texels[place(k)] = texel(stored)?;
            }
        }
        done += run;
    }
    let ignored = matches!(coding, Coding::Bytes { count: 4, alpha: false });
    let notes = ignored.then(|| "the fourth byte of a texel is not alpha, as the header gives it no bits".to_owned());
    let profile = stated::tga(bytes);
    let notes = notes.into_iter().collect();
    Ok(Parts { width, height, channels: coding.channels(), texels: Texels::U8(texels), profile, notes })
}
