//! Pictures as the window shows them: radiance through exposure and tone map to the display's codes.

use eframe::egui::{Color32, ColorImage};
use halfvector_scene::{Display, Picture};
use rayon::prelude::*;

/// The codes of a picture. Where nothing is, it is transparent.
pub(crate) fn coded(picture: &Picture, display: Display) -> ColorImage {
    let pixels = picture.pixels.par_iter().map(|&pixel| {
        let [r, g, b, a] = display.codes(pixel);
        Color32::from_rgba_unmultiplied(r, g, b, a)
    });
    ColorImage::new([picture.width as usize, picture.height as usize], pixels.collect())
}
