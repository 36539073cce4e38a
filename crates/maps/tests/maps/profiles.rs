//! What files say about their colours: honoured or refused by name, and never passed over in silence.

use std::io::Cursor;

use halfvector_maps::color::srgb_from_linear;
use halfvector_maps::{Channels, DecodeError, Decoded, Image, Limits, Texels};
use image::codecs::{jpeg::JpegEncoder, png::PngEncoder, webp::WebPEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageFormat};
use moxcms::{ColorProfile, ToneReprCurve};

use crate::decode::{crc32, file};

fn decoded(bytes: &[u8]) -> Decoded {
    halfvector_maps::decode(bytes, Limits::default()).unwrap()
}

/// A chunk of a PNG file.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [&kind[..], data].concat();
    [&(data.len() as u32).to_be_bytes()[..], &body, &crc32(&body).to_be_bytes()].concat()
}

/// A PNG file of one row of 8-bit texels, with these chunks before the image data.
fn png(texels: &[[u8; 3]], chunks: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(texels.as_flattened(), texels.len() as u32, 1, ExtendedColorType::Rgb8)
        .unwrap();
    // The signature and IHDR take 33 bytes.
    [&bytes[..33], &chunks.concat(), &bytes[33..]].concat()
}

fn gamma(value: u32) -> Vec<u8> {
    chunk(b"gAMA", &value.to_be_bytes())
}

fn texels(image: &Image) -> &[[u8; 4]] {
    let Texels::U8(texels) = image.texels() else { panic!("8 bits expected") };
    texels
}

/// The notes of a file as colour, or the words of its refusal.
fn as_color(bytes: &[u8]) -> Result<Vec<String>, String> {
    decoded(bytes).into_color().map(|noted| noted.notes).map_err(|error| error.to_string())
}

/// One row of texels with an ICC profile: as PNG and as WebP.
pub(crate) fn with_profile(texels: &[[u8; 3]], icc: &[u8]) -> [(&'static str, Vec<u8>); 2] {
    let (raw, width) = (texels.as_flattened(), texels.len() as u32);
    let (mut png, mut webp) = (Vec::new(), Vec::new());
    let mut encoder = PngEncoder::new(&mut png);
    encoder.set_icc_profile(icc.to_vec()).unwrap();
    encoder.write_image(raw, width, 1, ExtendedColorType::Rgb8).unwrap();
    let mut encoder = WebPEncoder::new_lossless(&mut webp);
    encoder.set_icc_profile(icc.to_vec()).unwrap();
    encoder.write_image(raw, width, 1, ExtendedColorType::Rgb8).unwrap();
    [("png", png), ("webp", webp)]
}

const COLORS: [[u8; 3]; 4] = [[0, 0, 0], [255, 255, 255], [200, 100, 50], [10, 20, 30]];

/// Nothing said is sRGB; sRGB said, or the gAMA that stands for it, changes nothing. As data each is named.
#[test]
fn srgb_is_taken_as_it_is() {
    assert_eq!(as_color(&png(&COLORS, &[])), Ok(vec![]));
    assert!(decoded(&png(&COLORS, &[])).into_data().notes.is_empty());
    let icc = ColorProfile::new_srgb().encode().unwrap();
    let [(_, with_icc), _] = with_profile(&COLORS, &icc);
    for (bytes, name) in [
        (png(&COLORS, &[chunk(b"sRGB", &[0])]), "sRGB chunk is"),
        (png(&COLORS, &[chunk(b"sRGB", &[0]), gamma(45_455)]), "sRGB chunk and gAMA 0.45455 is"),
        (png(&COLORS, &[gamma(45_455)]), "gAMA 0.45455 is"),
        (with_icc, "ICC profile \"sRGB IEC61966-2.1\" is"),
    ] {
        let color = decoded(&bytes).into_color().unwrap();
        assert_eq!((color.notes.len(), &texels(&color.image)[2][..3]), (0, &[200, 100, 50][..]), "{name}");
        let data = decoded(&bytes).into_data();
        assert!(data.notes.len() == 1 && data.notes[0].starts_with(name), "{:?}", data.notes);
        assert_eq!(&texels(&data.image)[2][..3], &[200, 100, 50]);
    }
}

/// gAMA 1 is linear: as colour its codes become sRGB's, as data they stay. gAMA 1/1.8 is a power.
#[test]
fn gamma_is_honoured() {
    for (value, exponent) in [(100_000, 1.0), (55_556, 1.8)] {
        let bytes = png(&COLORS, &[gamma(value)]);
        let noted = decoded(&bytes).into_color().unwrap();
        assert!(noted.notes[0].contains("converted to sRGB from gAMA"), "{:?}", noted.notes);
        for (got, from) in texels(&noted.image).iter().zip(COLORS) {
            let linear = from.map(|c| (f64::from(c) / 255.0).powf(exponent));
            let want = srgb_from_linear(linear).map(|c| (c * 255.0).round() as u8);
            assert_eq!(got[..3], want);
        }
        assert_eq!(texels(&decoded(&bytes).into_data().image)[2], [200, 100, 50, 255]);
    }
    assert!(as_color(&png(&COLORS, &[gamma(0)])).unwrap_err().contains("gAMA 0.00000 cannot be applied"));
}

/// 16 bits stay 16 bits, alpha stays, and grey too.
#[test]
fn depth_and_alpha_stay() {
    let mut bytes = Cursor::new(Vec::new());
    let buffer = image::ImageBuffer::<image::LumaA<u16>, _>::from_raw(2, 1, vec![1000, 7, 30_000, 9]).unwrap();
    image::DynamicImage::ImageLumaA16(buffer).write_to(&mut bytes, ImageFormat::Png).unwrap();
    let bytes = bytes.into_inner();
    let bytes = [&bytes[..33], &gamma(100_000), &bytes[33..]].concat();
    let image = decoded(&bytes).into_color().unwrap().image;
    let code = |c: f64| (srgb_from_linear([c / 65_535.0; 3])[0] * 65_535.0).round() as u16;
    let (a, b) = (code(1000.0), code(30_000.0));
    assert_eq!(image.texels(), &Texels::U16(vec![[a, a, a, 7], [b, b, b, 9]]));
    assert_eq!(image.channels(), Channels::GreyAlpha);
}

/// Display P3 in a PNG, a JPEG and a WebP file, and by cICP and by cHRM: converted by the matrix of the two primaries
/// (SMPTE EG 432-1 and Rec. 709, both D65), and what sRGB cannot show is counted.
#[test]
fn wide_colours_are_converted() {
    const REC709_FROM_P3: [[f64; 3]; 3] =
        [[1.224_940, -0.224_940, 0.0], [-0.042_057, 1.042_057, 0.0], [-0.019_638, -0.078_636, 1.098_274]];
    let colors = [[200, 100, 50], [0, 255, 0], [128, 128, 128]];
    let icc = ColorProfile::new_display_p3().encode().unwrap();
    let primaries = [31_270_u32, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6000].map(u32::to_be_bytes);
    let [(_, in_png), (_, in_webp)] = with_profile(&colors, &icc);
    let files = [
        in_png,
        in_webp,
        png(&colors, &[chunk(b"cICP", &[12, 13, 0, 1])]),
        png(&colors, &[gamma(45_455), chunk(b"cHRM", primaries.as_flattened())]),
    ];
    for (i, bytes) in files.iter().enumerate() {
        let noted = decoded(bytes).into_color().unwrap();
        assert!(noted.notes[0].contains("1 texel lies outside of sRGB"), "{i}: {:?}", noted.notes);
        for (got, from) in texels(&noted.image).iter().zip(colors) {
            let linear = halfvector_maps::color::linear_from_srgb(from.map(|c| f64::from(c) / 255.0));
            let mixed = REC709_FROM_P3.map(|row| (0..3).map(|k| row[k] * linear[k]).sum::<f64>());
            let want = srgb_from_linear(mixed.map(|c| c.clamp(0.0, 1.0))).map(|c| (c * 255.0).round());
            assert!((0..3).all(|k| (f64::from(got[k]) - want[k]).abs() <= 1.0), "{i}: {got:?} is not {want:?}");
        }
    }
    let mut jpeg = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut jpeg, 100);
    encoder.set_icc_profile(icc).unwrap();
    encoder.write_image(&[[200_u8, 100, 50]; 64].concat(), 8, 8, ExtendedColorType::Rgb8).unwrap();
    let noted = decoded(&jpeg).into_color().unwrap();
    assert!(noted.notes[0].contains("ICC profile \"Display P3\""), "{:?}", noted.notes);
    assert!(texels(&noted.image)[9][0].abs_diff(213) <= 2, "{:?}", texels(&noted.image)[9]);
}

/// Linear light of a code in 0..1.
type Formula = Box<dyn Fn(f64) -> f64>;

/// ICC curves of every kind, from their own formulas (ISO 15076-1, 10.6 and 10.18), with channels of 0 beside others.
#[test]
fn curves_of_icc_profiles_are_followed() {
    let table: Vec<u16> = (0..=16_u16).map(|i| i * i * 255).collect();
    let in_table = |x: f64| {
        let (i, place) = ((x * 16.0).floor().min(15.0), x * 16.0);
        let at = |i: f64| i * i * 255.0 / 65_535.0;
        at(i) + (at(i + 1.0) - at(i)) * (place - i)
    };
    let mut curves: Vec<(ToneReprCurve, Formula)> = vec![
        (ToneReprCurve::Lut(vec![]), Box::new(|x| x)),
        (ToneReprCurve::Lut(table), Box::new(in_table)),
        (ToneReprCurve::Parametric(vec![1.8]), Box::new(|x| x.powf(1.8))),
        (ToneReprCurve::Parametric(vec![2.0, 0.75, 0.25]), Box::new(|x| (0.75 * x + 0.25).powi(2))),
        (ToneReprCurve::Parametric(vec![2.0, 0.5, 0.25, 0.125]), Box::new(|x| (0.5 * x + 0.25).powi(2) + 0.125)),
        (
            ToneReprCurve::Parametric(vec![2.0, 0.5, 0.5, 0.25, 0.5]),
            Box::new(|x| if x >= 0.5 { (0.5 * x + 0.5).powi(2) } else { 0.25 * x }),
        ),
    ];
    for tenths in 10..=26_u16 {
        let gamma = tenths * 256 / 10;
        let exponent = f64::from(gamma) / 256.0;
        curves.push((ToneReprCurve::Lut(vec![gamma]), Box::new(move |x| x.powf(exponent))));
    }
    let colors = [[0, 128, 0], [255, 0, 0], [128, 0, 0], [1, 30, 0], [60, 120, 240], [255, 255, 255]];
    for (curve, value) in curves {
        let mut profile = ColorProfile::new_srgb();
        [profile.red_trc, profile.green_trc, profile.blue_trc] = [0; 3].map(|_| Some(curve.clone()));
        let [(_, bytes), _] = with_profile(&colors, &profile.encode().unwrap());
        let noted = decoded(&bytes).into_color().unwrap();
        for (got, from) in texels(&noted.image).iter().zip(colors) {
            let want = srgb_from_linear(from.map(|c| value(f64::from(c) / 255.0))).map(|c| (c * 255.0).round());
            // The profile's matrix is rounded to 1 / 65536.
            let near = (0..3).all(|k| (f64::from(got[k]) - want[k]).abs() <= 1.0);
            assert!(near, "{curve:?}: {from:?} is {got:?} and not {want:?}");
        }
    }
}

/// A gamma alone, or with the primaries of Rec. 709, mixes no channels: to half a code, and nothing is clipped.
#[test]
fn saturated_colours_of_16_bits_stay_saturated() {
    let colors = [[65_535_u16, 0, 0], [0, 65_535, 0], [0, 0, 65_535], [1000, 30_000, 65_535]];
    let mut bytes = Cursor::new(Vec::new());
    let buffer = image::ImageBuffer::<image::Rgb<u16>, _>::from_raw(4, 1, colors.as_flattened().to_vec()).unwrap();
    image::DynamicImage::ImageRgb16(buffer).write_to(&mut bytes, ImageFormat::Png).unwrap();
    let bytes = bytes.into_inner();
    let primaries = [31_270_u32, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6000].map(u32::to_be_bytes);
    for chunks in [gamma(100_000), [gamma(100_000), chunk(b"cHRM", primaries.as_flattened())].concat()] {
        let noted = decoded(&[&bytes[..33], &chunks, &bytes[33..]].concat()).into_color().unwrap();
        assert!(!noted.notes[0].contains("clipped"), "{:?}", noted.notes);
        let Texels::U16(texels) = noted.image.texels() else { panic!("16 bits stay") };
        for (got, from) in texels.iter().zip(colors) {
            let want = srgb_from_linear(from.map(|c| f64::from(c) / 65_535.0)).map(|c| (c * 65_535.0).round() as u16);
            assert_eq!(got[..3], want);
        }
    }
}

/// A grey profile on a grey file is a curve; on a coloured file it is refused.
#[test]
fn grey_profiles_are_for_grey() {
    let icc = ColorProfile::new_gray_with_gamma(1.0).encode().unwrap();
    let with = |color, raw: &[u8]| {
        let mut bytes = Vec::new();
        let mut encoder = PngEncoder::new(&mut bytes);
        encoder.set_icc_profile(icc.clone()).unwrap();
        encoder.write_image(raw, 1, 1, color).unwrap();
        bytes
    };
    let grey = decoded(&with(ExtendedColorType::L8, &[55])).into_color().unwrap();
    assert_eq!(texels(&grey.image), [[128, 128, 128, 255]]);
    let refused = as_color(&with(ExtendedColorType::Rgb8, &[1, 2, 3])).unwrap_err();
    assert!(refused.contains("for grey"), "{refused}");
}

/// What cannot be applied is named, with the way out; as data the values are read all the same.
#[test]
fn refusals_name_the_profile() {
    let mut cmyk = ColorProfile::new_display_p3().encode().unwrap();
    cmyk[16..20].copy_from_slice(b"CMYK");
    let [(_, with_cmyk), _] = with_profile(&COLORS, &cmyk);
    for (bytes, words) in [
        (png(&COLORS, &[chunk(b"cICP", &[9, 16, 0, 1])]), "cICP 9/16/0/1"),
        (png(&COLORS, &[chunk(b"cICP", &[1, 13, 0, 0])]), "full-range"),
        (png(&COLORS, &[chunk(b"iCCP", b"name\0\0no zlib stream")]), "iCCP chunk"),
        (png(&COLORS, &[gamma(45_455), chunk(b"cHRM", &[0; 32])]), "no colours"),
        (png(&COLORS, &[chunk(b"gAMA", &[0, 1, 2])]), "gAMA chunk"),
        (png(&COLORS, &[gamma(45_455), chunk(b"cHRM", &[0; 31])]), "cHRM chunk"),
        (png(&COLORS, &[chunk(b"cICP", &[1, 13, 0])]), "cICP chunk"),
        (with_cmyk, "ICC profile"),
    ] {
        let decoded = decoded(&bytes);
        let error = decoded.clone().into_color().unwrap_err();
        assert!(matches!(error, DecodeError::Profile { format: "PNG", .. }), "{error:?}");
        let text = error.to_string();
        assert!(text.contains(words) && text.contains("convert the file to sRGB"), "{text}");
        assert_eq!(decoded.into_data().notes.len(), 1);
    }
}

/// Whichever bit of a chunk about colours is turned over, the colours are the same, or refused: never others in silence.
#[test]
fn a_damaged_chunk_changes_no_colours() {
    let icc = ColorProfile::new_display_p3().encode().unwrap();
    let [(_, with_icc), _] = with_profile(&COLORS, &icc);
    let icc_length = u32::from_be_bytes(with_icc[33..37].try_into().unwrap()) as usize;
    assert_eq!(&with_icc[37..41], b"iCCP");
    let files = [
        (png(&COLORS, &[gamma(100_000)]), 16),
        (png(&COLORS, &[chunk(b"sRGB", &[0]), gamma(45_455)]), 13),
        (png(&COLORS, &[gamma(100_000), chunk(b"sRGB", &[0])]), 16),
        (png(&COLORS, &[chunk(b"cICP", &[1, 8, 0, 1]), chunk(b"sRGB", &[0])]), 16),
        (with_icc, icc_length + 12),
    ];
    let color = |bytes: &[u8]| {
        let decoded = halfvector_maps::decode(bytes, Limits::default()).ok()?;
        decoded.into_color().ok().map(|noted| noted.image)
    };
    for (whole, length) in files {
        let sound = color(&whole).expect("it is sound");
        let mut refused = 0;
        // Behind the chunk's length, which the decoder judges.
        for bit in 8 * 37..8 * (33 + length) {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            match color(&bytes) {
                Some(image) => assert_eq!(image, sound, "bit {} of byte {}", bit % 8, bit / 8 - 33),
                None => refused += 1,
            }
        }
        println!("{refused} of {} damaged files are refused", 8 * (length - 4));
        assert!(refused > 0 || length == 16, "{length}");
    }
}

/// The other formats' own words: QOI's linear, a TGA's gamma, a BMP header's colour space.
#[test]
fn other_formats_are_heard() {
    let mut qoi = file(ImageFormat::Qoi, ExtendedColorType::Rgb8);
    assert_eq!(as_color(&qoi), Ok(vec![]));
    qoi[13] = 1;
    assert!(as_color(&qoi).unwrap()[0].contains("QOI header linear"));

    let bmp = file(ImageFormat::Bmp, ExtendedColorType::Rgba8);
    assert!(decoded(&bmp).into_data().notes[0].contains("BMP header sRGB"));
    let mut linked = bmp.clone();
    linked[70..74].copy_from_slice(&0x4c49_4e4b_u32.to_le_bytes());
    assert!(as_color(&linked).unwrap_err().contains("another file"));

    let tga = file(ImageFormat::Tga, ExtendedColorType::Rgb8);
    let with_gamma = |over: u16, under: u16| {
        let mut bytes = tga.clone();
        let start = bytes.len() as u32;
        let mut extension = [0; 495];
        extension[478..480].copy_from_slice(&over.to_le_bytes());
        extension[480..482].copy_from_slice(&under.to_le_bytes());
        bytes.extend(extension);
        bytes.extend(start.to_le_bytes());
        bytes.extend([0; 4]);
        bytes.extend(b"TRUEVISION-XFILE.\0");
        bytes
    };
    assert_eq!(as_color(&with_gamma(0, 0)), Ok(vec![]));
    assert_eq!(as_color(&with_gamma(22, 10)), Ok(vec![]));
    assert!(as_color(&with_gamma(9, 5)).unwrap_err().contains("TGA gamma 1.80"));
}

/// The data folder's own: a height map with gAMA as data, grey JPEGs with a print profile's curve.
#[test]
fn the_data_folder_s_profiles_are_named() {
    let folder = crate::data();
    let read = |path: &str| std::fs::read(folder.join(path));
    let (Ok(height), Ok(roughness)) =
        (read("textures/Metal_Mesh_008/heightmap.png"), read("mtlx/resources/Images/brick_roughness.jpg"))
    else {
        println!("skipped: no textures in {}", folder.display());
        return;
    };
    let notes = decoded(&height).into_data().notes;
    assert!(notes.len() == 1 && notes[0].contains("gAMA 0.45455"), "{notes:?}");
    let brick = decoded(&roughness);
    assert_eq!(brick.image().channels(), Channels::Grey);
    let notes = brick.clone().into_data().notes;
    assert!(notes.len() == 1 && notes[0].contains("ICC profile \"Dot Gain"), "{notes:?}");
    let color = brick.into_color().map(|noted| noted.notes);
    println!("as colour: {color:?}");
    assert!(color.is_ok_and(|notes| notes[0].contains("converted")));
}
