//! Pictures as files: PNG for looking at, EXR and HDR for linear radiance.

use std::path::{Path, PathBuf};

use halfvector_scene::{Display, Picture};
use image::{ExtendedColorType, ImageEncoder};

use crate::failure::Failure;
use crate::output::write_file;

/// A picture file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PictureFile {
    /// Where.
    pub(crate) path: PathBuf,
    /// What the extension says.
    pub(crate) format: PictureFormat,
}

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureFormat {
    /// 8-bit sRGB, straight alpha.
    Png,
    /// 32-bit floats, linear, premultiplied alpha.
    Exr,
    /// Radiance RGBE, linear, without alpha.
    Hdr,
}

/// Reads a file name by its extension.
pub(crate) fn parse_picture_file(text: &str) -> Result<PictureFile, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    let format = match extension.as_deref() {
        Some("png") => PictureFormat::Png,
        Some("exr") => PictureFormat::Exr,
        Some("hdr") => PictureFormat::Hdr,
        _ => return Err("the file name must end in .png, .exr or .hdr".to_owned()),
    };
    Ok(PictureFile { path, format })
}

/// Writes a picture in the file's format.
pub(crate) fn write(file: &PictureFile, picture: &Picture, display: Display) -> Result<(), Failure> {
    let bytes = match file.format {
        PictureFormat::Png => png(picture, display),
        PictureFormat::Exr => exr(picture),
        PictureFormat::Hdr => hdr(picture),
    };
    let bytes = bytes.map_err(|error| encoding_failed(&file.path, &error))?;
    write_file(&file.path, &bytes)
}

fn encoding_failed(path: &Path, error: &image::ImageError) -> Failure {
    Failure::input("the picture could not be coded")
        .at(path)
        .because(error)
        .try_to("a smaller --size, or another format")
}

/// The bytes of a PNG file.
pub(crate) fn png(picture: &Picture, display: Display) -> Result<Vec<u8>, image::ImageError> {
    let codes: Vec<u8> = picture.pixels.iter().flat_map(|&pixel| display.codes(pixel)).collect();
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes).write_image(
        &codes,
        picture.width,
        picture.height,
        ExtendedColorType::Rgba8,
    )?;
    Ok(bytes)
}

fn exr(picture: &Picture) -> Result<Vec<u8>, image::ImageError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let floats: Vec<u8> = picture.pixels.iter().flatten().flat_map(|channel| channel.to_ne_bytes()).collect();
    image::codecs::openexr::OpenExrEncoder::new(&mut bytes).write_image(
        &floats,
        picture.width,
        picture.height,
        ExtendedColorType::Rgba32F,
    )?;
    Ok(bytes.into_inner())
}

fn hdr(picture: &Picture) -> Result<Vec<u8>, image::ImageError> {
    let mut bytes = Vec::new();
    let pixels: Vec<_> = picture.pixels.iter().map(|&pixel| image::Rgb(rounded_for_rgbe(pixel))).collect();
    image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, picture.width as usize, picture.height as usize)?;
    Ok(bytes)
}

/// The colour half a step brighter: RGBE keeps 8 bits below the power of two above the largest channel, and the encoder
/// cuts off what is finer, which alone would darken a picture by up to 0.8 %.
fn rounded_for_rgbe([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    let color = [r, g, b].map(|c| c.max(0.0));
    let largest = color[0].max(color[1]).max(color[2]);
    if !largest.is_normal() {
        return color;
    }
    let half_step = (largest.log2().floor() - 8.0).exp2();
    color.map(|c| c + half_step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_by_the_extension() {
        assert_eq!(parse_picture_file("a/b.PNG").expect("png").format, PictureFormat::Png);
        assert_eq!(parse_picture_file("b.exr").expect("exr").format, PictureFormat::Exr);
        assert!(parse_picture_file("b.jpg").is_err() && parse_picture_file("png").is_err());
    }

    #[test]
    fn radiance_survives_the_files() {
        let picture = Picture { width: 2, height: 1, pixels: vec![[0.5, 7.0, 1e-3, 0.25], [1e4, 0.0, 2.0, 1.0]] };
        let read = |bytes: Vec<u8>| image::load_from_memory(&bytes).expect("readable").into_rgba32f();
        let exr = read(exr(&picture).expect("coded"));
        assert_eq!(exr.as_raw().as_slice(), picture.pixels.as_flattened());
        let hdr = read(hdr(&picture).expect("coded"));
        // Steps of 1/32 and 64 at these exponents; half of one at most is lost.
        assert!((hdr.get_pixel(0, 0)[1] - 7.0).abs() < 0.016 && (hdr.get_pixel(1, 0)[0] - 1e4).abs() < 32.1);
    }
}
