//! Which format bytes are in, and where JPEG's segments lie. Does not decode.

use image::ImageFormat;

use super::DecodeError;

/// The format that the first bytes show. TGA has no signature: its header only has to be one.
pub(super) fn recognised(bytes: &[u8]) -> Result<ImageFormat, DecodeError> {
    use ImageFormat::{Bmp, Jpeg, OpenExr, Png, Qoi, Tga, Tiff, WebP};
    if bytes.is_empty() {
        return Err(DecodeError::Empty);
    }
    if is_big_tiff(bytes) {
        return Ok(Tiff);
    }
    match image::guess_format(bytes) {
        Ok(format @ (Png | Jpeg | Tiff | WebP | Bmp | Qoi)) => Ok(format),
        Ok(ImageFormat::Hdr) | Ok(OpenExr) => Err(DecodeError::Unsupported {
            format: if bytes.starts_with(b"#?") { "HDR" } else { "OpenEXR" },
            what: "a high-dynamic-range environment as a texture".to_owned(),
        }),
        _ if looks_like_tga(bytes) => Ok(Tga),
        Ok(format) => Err(DecodeError::Unsupported { format: name(format), what: "this format".to_owned() }),
        Err(_) => Err(DecodeError::UnknownFormat),
    }
}

/// TIFF with 64-bit offsets: version 43 instead of 42.
fn is_big_tiff(bytes: &[u8]) -> bool {
    bytes.starts_with(b"II\x2b\0\x08\0\0\0") || bytes.starts_with(b"MM\0\x2b\0\x08\0\0")
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
        // 1 bit is read by none, and refused by name.
        && matches!(header[16], 1 | 8 | 15 | 16 | 24 | 32)
}

/// The format's name for people.
pub(super) fn name(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::WebP => "WebP",
        ImageFormat::Tga => "TGA",
        ImageFormat::Bmp => "BMP",
        ImageFormat::Qoi => "QOI",
        other => other.extensions_str().first().copied().unwrap_or("unknown"),
    }
}

/// What the segments of a JPEG file say.
#[derive(Debug, Default)]
pub(super) struct Jpeg {
    /// Whether they run through to the end marker. The decoder fills what is missing with grey.
    pub(super) is_complete: bool,
    /// Number of colour components in the frame.
    pub(super) components: u8,
    /// Whether it is progressive, so that all coefficients are held at once.
    pub(super) is_progressive: bool,
    /// Whether an ICC profile is there.
    pub(super) has_profile: bool,
}

/// Walks through the segments. ITU-T T.81 (1992), annex B: a marker is FF and a code; most carry a length; after SOS (DA)
/// come entropy-coded bytes in which FF is followed by 0 or by a restart marker (D0..D7), until the next marker.
pub(super) fn jpeg(bytes: &[u8]) -> Jpeg {
    let mut found = Jpeg::default();
    let mut at = 2;
    while let Some(&[first, code]) = bytes.get(at..).and_then(|rest| rest.first_chunk::<2>()) {
        match (first, code) {
            (0xff, 0xd9) => {
                found.is_complete = true;
                return found;
            }
            // Fill bytes, and markers that stand alone.
            (0xff, 0xff) => at += 1,
            (0xff, 0x01 | 0xd0..=0xd8) => at += 2,
            (0xff, 0x02..) => {
                let Some(&[high, low]) = bytes.get(at + 2..).and_then(|rest| rest.first_chunk::<2>()) else {
                    return found;
                };
                let content = bytes.get(at + 4..).unwrap_or_default();
                match code {
                    0xc0..=0xc3 => {
                        found.components = content.get(5).copied().unwrap_or(0);
                        found.is_progressive |= code == 0xc2;
                    }
                    0xe2 => found.has_profile |= content.starts_with(b"ICC_PROFILE\0"),
                    _ => {}
                }
                at += 2 + usize::from(u16::from_be_bytes([high, low])).max(2);
                if code == 0xda {
                    let Some(scan) = bytes.get(at..) else { return found };
                    let end = scan.windows(2).position(|w| w[0] == 0xff && !matches!(w[1], 0x00 | 0xd0..=0xd7 | 0xff));
                    let Some(end) = end else { return found };
                    at += end;
                }
            }
            // Not a marker: some writers pad between segments.
            _ => at += 1,
        }
    }
    found
}
