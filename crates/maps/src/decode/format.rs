//! Which format bytes are in. Does not decode.

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
