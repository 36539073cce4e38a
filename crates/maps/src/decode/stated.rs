//! What the headers of PNG, BMP, TGA and QOI files say about colours, beside ICC profiles. Does not decode.

use crate::profile::Profile;

/// What a PNG file says in its own chunks, before the image data; `icc` is its decoded iCCP chunk.
/// ISO/IEC 15948 (2003) and its third edition (W3C 2025), 4.3: cICP before iCCP before sRGB before gAMA and cHRM.
///
/// The decoder passes over damaged chunks that it can do without. Where one may have said how colours are coded, and no
/// sound chunk goes before it, colours are refused.
pub(super) fn png(bytes: &[u8], icc: Option<&[u8]>, is_grey: bool) -> Option<Profile> {
    let (mut srgb, mut iccp, mut gamma, mut cicp, mut primaries) = (false, false, None, None, None);
    // Place in the order, and name.
    let mut damaged: Option<(usize, String)> = None;
    let mut rest = bytes.get(8..)?;
    while let Some((&[a, b, c, d], after)) = rest.split_first_chunk::<4>() {
        let Some((kind, contents)) = after.split_first_chunk::<4>() else { break };
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        let Some(data) = contents.get(..length) else { break };
        if kind == b"IDAT" {
            break;
        }
        let sum = contents.get(length..).and_then(|rest| rest.first_chunk::<4>()).map(|&sum| u32::from_be_bytes(sum));
        // Large chunks of other kinds are not summed up; those that end the decoder's reading are not ours to judge.
        let place = match kind {
            b"cICP" => Some(0),
            b"iCCP" => Some(1),
            b"sRGB" => Some(2),
            b"gAMA" | b"cHRM" => Some(3),
            b"IHDR" | b"PLTE" | b"tRNS" | b"bKGD" | b"hIST" | b"pHYs" | b"sBIT" | b"sPLT" | b"tIME" | b"tEXt"
            | b"zTXt" | b"iTXt" | b"eXIf" | b"acTL" | b"fcTL" | b"mDCV" | b"cLLI" | b"oFFs" | b"vpAg" | b"caNv"
            | b"orNT" => None,
            // Perhaps a name that was damaged.
            _ => Some(0),
        };
        let has_length = match kind {
            b"cICP" | b"gAMA" => length == 4,
            b"cHRM" => length == 32,
            _ => true,
        };
        rest = contents.get(length + 4..).unwrap_or_default();
        if let Some(place) = place
            && !(has_length && sum == Some(crc32(after.get(..4 + length).unwrap_or_default())))
        {
            if damaged.as_ref().is_none_or(|(first, _)| place < *first) {
                damaged = Some((place, format!("{} chunk", kind.escape_ascii())));
            }
            continue;
        }
        match kind {
            b"sRGB" => srgb = true,
            b"iCCP" => iccp = true,
            b"gAMA" => gamma = data.first_chunk::<4>().map(|&value| u32::from_be_bytes(value)),
            b"cICP" => cicp = data.first_chunk::<4>().copied(),
            b"cHRM" => primaries = chromaticities(data),
            _ => {}
        }
    }
    let sound = [cicp.is_some(), iccp, srgb].into_iter().position(|is_there| is_there).unwrap_or(3);
    if let Some((place, name)) = damaged
        && (place < sound || place == 3 && sound == 3)
    {
        return Some(Profile::refused(name, "it is damaged"));
    }
    if let Some(cicp) = cicp {
        return Some(Profile::from_cicp(cicp));
    }
    if iccp {
        return Some(
            icc.map_or_else(|| Profile::refused("iCCP chunk", "it is damaged"), |icc| Profile::from_icc(icc, is_grey)),
        );
    }
    let gamma_name = gamma.map(|gamma| format!("gAMA {:.5}", f64::from(gamma) / 1e5));
    if srgb {
        return Some(Profile::srgb(
            gamma_name.map_or("sRGB chunk".to_owned(), |name| format!("sRGB chunk and {name}")),
        ));
    }
    let name = match (gamma_name, primaries.is_some()) {
        (Some(name), true) => format!("{name} and cHRM"),
        (Some(name), false) => name,
        (None, true) => "cHRM".to_owned(),
        (None, false) => return None,
    };
    Some(Profile::from_gamma(name, gamma, primaries.filter(|_| !is_grey)))
}

/// Whether an acTL chunk stands before the image data.
pub(super) fn png_is_animated(bytes: &[u8]) -> bool {
    let mut rest = bytes.get(8..).unwrap_or_default();
    while let Some((&[a, b, c, d, kind @ ..], after)) = rest.split_first_chunk::<8>() {
        match &kind {
            b"acTL" => return true,
            b"IDAT" => return false,
            _ => {}
        }
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        rest = after.get(length.saturating_add(4)..).unwrap_or_default();
    }
    false
}

/// The check sum of a chunk's kind and data (ISO/IEC 15948, annex D).
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut byte = 0;
        while byte < 256 {
            let mut crc = byte as u32;
            let mut bit = 0;
            while bit < 8 {
                crc = (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
                bit += 1;
            }
            table[byte] = crc;
            byte += 1;
        }
        table
    };
    !bytes.iter().fold(!0, |crc, &byte| (crc >> 8) ^ TABLE[usize::from((crc as u8) ^ byte)])
}

/// cHRM: white, red, green, blue, each x and y in hundred thousandths.
fn chromaticities(data: &[u8]) -> Option<[[f64; 2]; 4]> {
    let data = data.first_chunk::<32>()?;
    let value = |i: usize| f64::from(u32::from_be_bytes(std::array::from_fn(|k| data[4 * i + k]))) / 1e5;
    Some(std::array::from_fn(|i| [value(2 * i), value(2 * i + 1)]))
}

/// What the header of a BMP file says. Microsoft, "BITMAPV5HEADER": from version 4 on (108 bytes) a kind of colour space
/// at byte 56 of the header, then endpoints (36 bytes) and three gammas; version 5 adds an ICC profile's place and size.
pub(super) fn bmp(bytes: &[u8]) -> Option<Profile> {
    let header = bytes.get(14..)?;
    let word = |at: usize| header.get(at..)?.first_chunk::<4>().map(|&b| u32::from_le_bytes(b));
    let size = word(0)?;
    if size < 108 {
        return None;
    }
    match word(56)?.to_be_bytes().as_slice() {
        b"sRGB" | b"Win " => Some(Profile::srgb("BMP header sRGB")),
        b"MBED" if size >= 124 => {
            let (start, length) = (word(112)? as usize, word(116)? as usize);
            let icc = header.get(start..).and_then(|rest| rest.get(..length));
            Some(icc.map_or_else(
                || Profile::refused("ICC profile", "it lies outside of the file"),
                |icc| Profile::from_icc(icc, false),
            ))
        }
        b"LINK" => Some(Profile::refused("linked ICC profile", "it is in another file")),
        // Calibrated; many writers leave all of it 0, which says nothing.
        b"\0\0\0\0" if header.get(60..108)?.iter().any(|&byte| byte != 0) => {
            Some(Profile::refused("BMP header's calibrated RGB", "no writer that is known here means it"))
        }
        _ => None,
    }
}

/// The gamma of a TGA file's extension area. Truevision 1991, "TGA File Format Specification 2.0": the last 26 bytes tell
/// where it is; bytes 478 to 481 of it are a fraction, over 0 when there is none.
pub(super) fn tga(bytes: &[u8]) -> Option<Profile> {
    let footer = bytes.last_chunk::<26>()?;
    if !footer.ends_with(b"TRUEVISION-XFILE.\0") {
        return None;
    }
    let start = u32::from_le_bytes([footer[0], footer[1], footer[2], footer[3]]) as usize;
    let &[a, b, c, d] = bytes.get(start.checked_add(478)?..)?.first_chunk::<4>()?;
    let (over, under) = (u16::from_le_bytes([a, b]), u16::from_le_bytes([c, d]));
    if start == 0 || over == 0 || under == 0 {
        return None;
    }
    let gamma = f64::from(over) / f64::from(under);
    let name = format!("TGA gamma {gamma:.2}");
    // 2.2 is said for sRGB; programs differ on which way any other number is meant.
    Some(if (gamma - 2.2).abs() < 0.01 {
        Profile::srgb(name)
    } else {
        Profile::refused(name, "programs disagree about what it means")
    })
}

/// The colour space byte of a QOI header: 0 is sRGB, which goes without saying, 1 all linear. It and the channels byte before
/// it are statements that change no value: texels are coded alike for three channels and for four, but one with alpha in a
/// file that states three is damage. So are bytes other than 0 and 1, and than 3 and 4.
/// Szablewski 2022, "The Quite OK Image Format Specification 1.0".
pub(super) fn qoi(bytes: &[u8]) -> Option<Profile> {
    (bytes.get(13) == Some(&1)).then(|| Profile::linear("QOI header linear"))
}
