//! The pictures of `examples/textures`, made from nothing.

use image::{DynamicImage, ImageBuffer, Luma};

mod cobbles;
mod noise;
mod panel;

/// File name and picture of each.
pub(crate) fn maps() -> Vec<(&'static str, DynamicImage)> {
    panel::maps().into_iter().chain(cobbles::maps()).collect()
}

fn byte(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Grey of 16 bits; of those 12 are used, as what the eye cannot see would only make the file larger.
fn height_map(size: u32, height: fn([f64; 2]) -> f64) -> DynamicImage {
    let texel = |i: u32| (f64::from(i) + 0.5) / f64::from(size);
    let map: ImageBuffer<Luma<u16>, Vec<u16>> = ImageBuffer::from_fn(size, size, |x, y| {
        let code = (height([texel(x), texel(y)]).clamp(0.0, 1.0) * 4095.0 + 0.5) as u16;
        Luma([code << 4 | code >> 8])
    });
    map.into()
}
