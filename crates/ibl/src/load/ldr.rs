//! Ordinary images as environments: PNG, JPEG, TIFF, WebP, TGA, BMP, QOI, read by the crate of texture maps.
//!
//! Codes are sRGB, or what the file's profile says, and become linear radiance 0..1; float TIFF files are taken as linear.
//! Alpha is ignored.

use super::{Fault, Limits, Picture, checked_texels};
use crate::equirect::Equirect;
use halfvector_maps::{Texels, color::linear_from_srgb};

pub(super) fn read(bytes: &[u8], limits: Limits) -> Result<Picture, Fault> {
    let edge = u32::try_from(limits.max_edge).unwrap_or(u32::MAX);
    let limits_of_image = halfvector_maps::Limits {
        max_width: edge,
        max_height: edge,
        max_texels: limits.max_texels,
        ..halfvector_maps::Limits::default()
    };
    let decoded = halfvector_maps::decode(bytes, limits_of_image).and_then(halfvector_maps::Decoded::into_color);
    let image = decoded.map_err(Fault::Image)?.image;
    let (width, height) = (image.width() as usize, image.height() as usize);
    checked_texels(width as u64, height as u64, limits)?;
    let linear = |codes: [f32; 3]| linear_from_srgb(codes);
    let (pixels, low_dynamic_range) = match image.texels() {
        Texels::U8(texels) => {
            let table: Vec<f32> = (0..=255u8).map(|code| linear([f32::from(code) / 255.0; 3])[0]).collect();
            (texels.iter().map(|&[r, g, b, _]| [r, g, b].map(|code| table[usize::from(code)])).collect(), true)
        }
        Texels::U16(texels) => {
            (texels.iter().map(|&[r, g, b, _]| linear([r, g, b].map(|code| f32::from(code) / 65535.0))).collect(), true)
        }
        Texels::F32(texels) => (texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect(), false),
    };
    Ok(Picture { map: Equirect { width, height, pixels }, low_dynamic_range, notes: Vec::new() })
}
