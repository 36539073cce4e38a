//! Pictures as files: PNG for looking at, EXR and HDR for linear radiance.

use std::path::{Path, PathBuf};

use exr::prelude::{
    ImageAttributes, LayerAttributes, ReadChannels as _, ReadLayers as _, ReadSpecificChannel as _, SpecificChannels,
    Vec2, WritableImage as _,
};
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

/// Where an .exr file holds the standard errors of red, green and blue.
const ERROR_CHANNELS: [&str; 3] = ["error.R", "error.G", "error.B"];

/// Where it says what the noise was drawn with, and by how many paths for each pixel: texts, the numbers.
const SEED: &str = "halfvector.seed";
const SAMPLES: &str = "halfvector.samples";

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

/// What is known of the noise of a picture that is written.
#[derive(Clone, Debug)]
pub(crate) struct OwnNoise {
    /// The standard errors of each pixel's red, green and blue; none of a single path.
    pub(crate) errors: Option<Vec<[f32; 3]>>,
    /// What it was drawn with.
    pub(crate) seed: u64,
    /// Paths for each pixel.
    pub(crate) samples: u64,
}

/// Writes a picture in the file's format. Of a noisy one the standard error of each pixel, where it is known, stands in an .exr beside
/// it, in the channels `error.R`, `error.G` and `error.B`, and seed and paths in the attributes `halfvector.seed` and
/// `halfvector.samples`; other formats have no place for them.
pub(crate) fn write(
    file: &PictureFile,
    picture: &Picture,
    noise: Option<&OwnNoise>,
    display: Display,
) -> Result<(), Failure> {
    let bytes = match (file.format, noise) {
        (PictureFormat::Png, _) => png(picture, display),
        (PictureFormat::Exr, None) => exr(picture),
        (PictureFormat::Exr, Some(noise)) => {
            let bytes = noisy_exr(picture, noise);
            let bytes = bytes.map_err(|error| encoding_failed(&file.path, &error))?;
            return write_file(&file.path, &bytes);
        }
        (PictureFormat::Hdr, _) => hdr(picture),
    };
    let bytes = bytes.map_err(|error| encoding_failed(&file.path, &error))?;
    write_file(&file.path, &bytes)
}

fn encoding_failed(path: &Path, error: &dyn std::error::Error) -> Failure {
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

fn noisy_exr(picture: &Picture, noise: &OwnNoise) -> Result<Vec<u8>, exr::error::Error> {
    let size = (picture.width as usize, picture.height as usize);
    let at = |place: Vec2<usize>| place.y() * size.0 + place.x();
    let origin = |layer: &mut LayerAttributes, image: &mut ImageAttributes| {
        // One in each map: two in one are written in another order each time.
        let text = |number: u64| exr::meta::attribute::AttributeValue::Text(number.to_string().as_str().into());
        layer.other.insert(SEED.into(), text(noise.seed));
        image.other.insert(SAMPLES.into(), text(noise.samples));
    };
    let mut bytes = std::io::Cursor::new(Vec::new());
    let channels = SpecificChannels::build().with_channel("R").with_channel("G").with_channel("B").with_channel("A");
    if let Some(errors) = &noise.errors {
        let [of_r, of_g, of_b] = ERROR_CHANNELS;
        let channels = channels.with_channel(of_r).with_channel(of_g).with_channel(of_b).with_pixel_fn(|place| {
            let ([r, g, b, a], [dr, dg, db]) = (picture.pixels[at(place)], errors[at(place)]);
            (r, g, b, a, dr, dg, db)
        });
        let mut image = exr::image::Image::from_channels(size, channels);
        origin(&mut image.layer_data.attributes, &mut image.attributes);
        image.write().to_buffered(&mut bytes)?;
    } else {
        let channels = channels.with_pixel_fn(|place| {
            let [r, g, b, a] = picture.pixels[at(place)];
            (r, g, b, a)
        });
        let mut image = exr::image::Image::from_channels(size, channels);
        origin(&mut image.layer_data.attributes, &mut image.attributes);
        image.write().to_buffered(&mut bytes)?;
    }
    Ok(bytes.into_inner())
}

/// What an .exr file says of the noise of its picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Noise {
    /// The standard errors of each pixel's red, green and blue; none of a single path, whose noise is not known.
    pub(crate) errors: Option<Vec<[f64; 3]>>,
    /// What the noise was drawn with.
    pub(crate) seed: Option<u64>,
    /// Paths for each pixel.
    pub(crate) samples: Option<u64>,
}

/// What an .exr file says of its noise; none where it has no word on that.
///
/// # Errors
/// Why what it says is not to be used: channels that are missing, or hold what no standard error is.
pub(crate) fn noise(path: &Path) -> Result<Option<Noise>, String> {
    let meta = exr::meta::MetaData::read_from_file(path, false).map_err(|error| error.to_string())?;
    let has = |header: &exr::meta::header::Header, name: &str| {
        header.channels.list.iter().any(|channel| channel.name == *name)
    };
    let number = |header: &exr::meta::header::Header, name: &str| -> Option<u64> {
        let name = exr::meta::attribute::Text::from(name);
        match header.own_attributes.other.get(&name).or_else(|| header.shared_attributes.other.get(&name)) {
            Some(exr::meta::attribute::AttributeValue::Text(text)) => text.to_string().parse().ok(),
            _ => None,
        }
    };
    let Some(header) = meta.headers.iter().find(|header| ERROR_CHANNELS.iter().any(|name| has(header, name))) else {
        let noisy = meta.headers.iter().find(|header| number(header, SAMPLES).is_some());
        let unknown = |header| Noise { errors: None, seed: number(header, SEED), samples: number(header, SAMPLES) };
        return Ok(noisy.map(unknown));
    };
    let missing: Vec<&str> = ERROR_CHANNELS.into_iter().filter(|name| !has(header, name)).collect();
    if !missing.is_empty() {
        return Err(format!("it has standard errors, but no channel {}", missing.join(", ")));
    }
    let (seed, samples) = (number(header, SEED), number(header, SAMPLES));
    let [of_r, of_g, of_b] = ERROR_CHANNELS;
    let channels = exr::image::read::read().no_deep_data().largest_resolution_level().specific_channels();
    let pixels = channels.required(of_r).required(of_g).required(of_b).collect_pixels(
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, all): &mut (usize, Vec<[f64; 3]>), place, (r, g, b): (f32, f32, f32)| {
            all[place.y() * *width + place.x()] = [r, g, b].map(f64::from);
        },
    );
    let image = pixels.first_valid_layer().all_attributes().from_file(path).map_err(|error| error.to_string())?;
    let (width, errors) = image.layer_data.channel_data.pixels;
    let is_wrong = |error: &[f64; 3]| !error.iter().all(|x| x.is_finite() && *x >= 0.0);
    if let Some(at) = errors.iter().position(is_wrong) {
        return Err(format!(
            "its standard errors are not all numbers from 0: the first that is none is at column {}, row {}",
            at % width.max(1),
            at / width.max(1)
        ));
    }
    // An older file of a single path has zeros, which no spread of any has.
    let is_known = samples.is_some() || errors.as_flattened().iter().any(|error| *error > 0.0);
    Ok(Some(Noise { errors: is_known.then_some(errors), seed, samples }))
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
    fn standard_errors_stand_beside_the_colours() {
        let picture = Picture { width: 1, height: 2, pixels: vec![[0.5, 7.0, 1e-3, 0.25], [1e4, 0.0, 2.0, 1.0]] };
        let error = [[0.1, 0.2, 0.3], [4.0, 0.0, 6.0]];
        let folder = tempfile::tempdir().expect("a folder");
        let [with, without] = ["with.exr", "without.exr"].map(|name| folder.path().join(name));
        let own = |errors: Option<Vec<[f32; 3]>>| OwnNoise { errors, seed: u64::MAX, samples: 9 };
        let bytes = noisy_exr(&picture, &own(Some(error.to_vec()))).expect("coded");
        std::fs::write(&with, &bytes).expect("written");
        std::fs::write(&without, exr(&picture).expect("coded")).expect("written");
        let colors = image::load_from_memory(&bytes).expect("readable").into_rgba32f();
        assert_eq!(colors.as_raw().as_slice(), picture.pixels.as_flattened());
        let errors = error.map(|e| e.map(f64::from)).to_vec();
        let seed = Some(u64::MAX);
        assert_eq!(noise(&with), Ok(Some(Noise { errors: Some(errors), seed, samples: Some(9) })));
        assert_eq!(noise(&without), Ok(None));
        // A single path: no channels, and it is said that there is noise.
        let bytes = noisy_exr(&picture, &OwnNoise { samples: 1, ..own(None) }).expect("coded");
        std::fs::write(&with, &bytes).expect("written");
        assert_eq!(noise(&with), Ok(Some(Noise { errors: None, seed, samples: Some(1) })));
        let colors = image::load_from_memory(&bytes).expect("readable").into_rgba32f();
        assert_eq!(colors.as_raw().as_slice(), picture.pixels.as_flattened());
    }

    #[test]
    fn broken_standard_errors_are_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("wrong.exr");
        let picture = Picture { width: 2, height: 1, pixels: vec![[1.0; 4]; 2] };
        for wrong in [f32::NAN, -1.0, f32::INFINITY] {
            let error = [[0.1; 3], [0.1, wrong, 0.1]];
            let noise_of = OwnNoise { errors: Some(error.to_vec()), seed: 1, samples: 4 };
            std::fs::write(&path, noisy_exr(&picture, &noise_of).expect("coded")).expect("written");
            let why = noise(&path).expect_err("told");
            assert!(why.contains("column 1, row 0"), "{why}");
        }
        let channels = SpecificChannels::build().with_channel("R").with_channel("G").with_channel("B");
        let channels = channels.with_channel("error.R").with_pixel_fn(|_| (1.0_f32, 1.0_f32, 1.0_f32, 0.1_f32));
        let image = exr::image::Image::from_channels((2, 1), channels);
        image.write().to_file(&path).expect("written");
        let why = noise(&path).expect_err("told");
        assert!(why.contains("error.G, error.B") && !why.contains("error.R"), "{why}");
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
