//! Files: every format and depth comes back as it was written; limits, cut, lying and mutated files give errors.

use std::io::Cursor;

use halfvector_maps::{Channels, DecodeError, Image, Limits, Texels};
use image::{DynamicImage, ExtendedColorType, ImageFormat};
use proptest::prelude::*;

/// The values of a file as they stand in it.
pub(crate) fn decode(bytes: &[u8], limits: Limits) -> Result<Image, DecodeError> {
    halfvector_maps::decode(bytes, limits).map(|decoded| decoded.into_data().image)
}

const WIDTH: u32 = 19;
const HEIGHT: u32 = 11;

/// How many cases a property is tried with: few, or `PROPTEST_CASES`.
pub(crate) fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(48)
}

/// A gradient with some texture, so that compressed files have content.
fn sample(x: u32, y: u32, channel: u32) -> f64 {
    f64::from((x * 7 + y * 13 + channel * 29 + (x * y) % 5) % 101) / 100.0
}

fn dynamic(color: ExtendedColorType) -> DynamicImage {
    let channels = u32::from(color.channel_count());
    let values =
        || (0..HEIGHT).flat_map(move |y| (0..WIDTH).flat_map(move |x| (0..channels).map(move |c| sample(x, y, c))));
    let u8s = || values().map(|x| (x * 255.0).round() as u8).collect();
    let u16s = || values().map(|x| (x * 65535.0).round() as u16).collect();
    let f32s = || values().map(|x| (x * 9.0 - 2.0) as f32).collect();
    let fits = "the buffer has the size";
    match color {
        ExtendedColorType::L8 => {
            DynamicImage::ImageLuma8(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u8s()).expect(fits))
        }
        ExtendedColorType::La8 => {
            DynamicImage::ImageLumaA8(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u8s()).expect(fits))
        }
        ExtendedColorType::Rgb8 => {
            DynamicImage::ImageRgb8(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u8s()).expect(fits))
        }
        ExtendedColorType::Rgba8 => {
            DynamicImage::ImageRgba8(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u8s()).expect(fits))
        }
        ExtendedColorType::L16 => {
            DynamicImage::ImageLuma16(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u16s()).expect(fits))
        }
        ExtendedColorType::La16 => {
            DynamicImage::ImageLumaA16(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u16s()).expect(fits))
        }
        ExtendedColorType::Rgb16 => {
            DynamicImage::ImageRgb16(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u16s()).expect(fits))
        }
        ExtendedColorType::Rgba16 => {
            DynamicImage::ImageRgba16(image::ImageBuffer::from_raw(WIDTH, HEIGHT, u16s()).expect(fits))
        }
        ExtendedColorType::Rgb32F => {
            DynamicImage::ImageRgb32F(image::ImageBuffer::from_raw(WIDTH, HEIGHT, f32s()).expect(fits))
        }
        _ => DynamicImage::ImageRgba32F(image::ImageBuffer::from_raw(WIDTH, HEIGHT, f32s()).expect(fits)),
    }
}

pub(crate) fn file(format: ImageFormat, color: ExtendedColorType) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    dynamic(color).write_to(&mut bytes, format).expect("the encoder takes this colour type");
    bytes.into_inner()
}

/// What each writer can write.
pub(crate) const KINDS: [(ImageFormat, ExtendedColorType); 26] = {
    use ExtendedColorType::{L8, L16, La8, La16, Rgb8, Rgb16, Rgb32F, Rgba8, Rgba16, Rgba32F};
    use ImageFormat::{Bmp, Jpeg, Png, Qoi, Tga, Tiff, WebP};
    [
        (Png, L8),
        (Png, La8),
        (Png, Rgb8),
        (Png, Rgba8),
        (Png, L16),
        (Png, La16),
        (Png, Rgb16),
        (Png, Rgba16),
        (Tiff, L8),
        (Tiff, Rgb8),
        (Tiff, Rgba8),
        (Tiff, L16),
        (Tiff, Rgb16),
        (Tiff, Rgba16),
        (Tiff, Rgb32F),
        (Tiff, Rgba32F),
        (WebP, Rgb8),
        (WebP, Rgba8),
        (Tga, L8),
        (Tga, Rgb8),
        (Tga, Rgba8),
        (Bmp, Rgb8),
        (Bmp, Rgba8),
        (Qoi, Rgb8),
        (Qoi, Rgba8),
        (Jpeg, Rgb8),
    ]
};

fn channels_of(color: ExtendedColorType) -> Channels {
    match color.channel_count() {
        1 => Channels::Grey,
        2 => Channels::GreyAlpha,
        3 => Channels::Rgb,
        _ => Channels::Rgba,
    }
}

/// Every lossless kind keeps its depth and its values; grey is spread, a missing alpha is opaque.
#[test]
fn every_format_and_depth_comes_back() {
    for (format, color) in KINDS.into_iter().filter(|kind| kind.0 != ImageFormat::Jpeg) {
        let image =
            decode(&file(format, color), Limits::default()).unwrap_or_else(|e| panic!("{format:?} {color:?}: {e}"));
        assert_eq!(
            (image.width(), image.height(), image.channels()),
            (WIDTH, HEIGHT, channels_of(color)),
            "{format:?}"
        );
        let bits = color.bits_per_pixel() / u16::from(color.channel_count());
        let is_kept = match image.texels() {
            Texels::U8(_) => bits == 8,
            Texels::U16(_) => bits == 16,
            Texels::F32(_) => bits == 32,
        };
        assert!(is_kept, "{format:?} {color:?}");
        for (x, y) in [(0, 0), (WIDTH - 1, 0), (0, HEIGHT - 1), (7, 5), (WIDTH - 1, HEIGHT - 1)] {
            let c = |channel| sample(x, y, channel);
            let (mut want, steps) = match image.channels() {
                Channels::Grey => ([c(0), c(0), c(0), 1.0], 4),
                Channels::GreyAlpha => ([c(0), c(0), c(0), c(1)], 4),
                Channels::Rgb => ([c(0), c(1), c(2), 1.0], 3),
                Channels::Rgba => ([c(0), c(1), c(2), c(3)], 4),
            };
            if bits == 32 {
                want[..steps].iter_mut().for_each(|x| *x = *x * 9.0 - 2.0);
            }
            let tolerance = match bits {
                8 => 0.51 / 255.0,
                16 => 0.51 / 65535.0,
                _ => 1e-5,
            };
            for (got, want) in image.texel(x, y).into_iter().zip(want) {
                assert!((f64::from(got) - want).abs() <= tolerance, "{format:?} {color:?} at {x}, {y}");
            }
        }
    }
}

#[test]
fn jpeg_is_read() {
    let image = decode(&file(ImageFormat::Jpeg, ExtendedColorType::Rgb8), Limits::default()).unwrap();
    assert_eq!((image.width(), image.height(), image.channels()), (WIDTH, HEIGHT, Channels::Rgb));
}

/// Row "HDR inf*0": NaN and infinity in a float file are read as 0 and as the largest half-precision number.
#[test]
fn float_files_are_made_finite() {
    let texels = vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9];
    let buffer = image::Rgba32FImage::from_raw(1, 1, texels).unwrap();
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::ImageRgba32F(buffer).write_to(&mut bytes, ImageFormat::Tiff).unwrap();
    let image = decode(&bytes.into_inner(), Limits::default()).unwrap();
    assert_eq!(image.texels(), &Texels::F32(vec![[0.0, 65504.0, -65504.0, 1e9]]));
}

/// Each limit by itself refuses, before anything is allocated for the texels.
#[test]
fn limits_are_kept() {
    let roomy = Limits::default();
    for (format, color) in KINDS {
        let bytes = file(format, color);
        for (limits, words) in [
            (Limits { max_width: WIDTH - 1, ..roomy }, "18 x 16384"),
            (Limits { max_height: HEIGHT - 1, ..roomy }, "16384 x 10"),
            (Limits { max_texels: 208, ..roomy }, "208 texels"),
        ] {
            let error = decode(&bytes, limits).unwrap_err();
            assert!(
                matches!(error, DecodeError::TooLarge { width: WIDTH, height: HEIGHT, .. }),
                "{format:?}: {error:?}"
            );
            assert!(error.to_string().contains(words), "{error}");
        }
        assert!(decode(&bytes, Limits { max_bytes: 800, ..roomy }).is_err(), "{format:?} {color:?}");
    }
}

/// Row "65535 x 65535 headers": a small file that claims to be huge is refused by its claim.
#[test]
fn lying_headers_are_refused() {
    let too_large = |bytes: &[u8]| match decode(bytes, Limits::default()) {
        Err(DecodeError::TooLarge { .. }) => (),
        other => panic!("{other:?}"),
    };
    let mut png = file(ImageFormat::Png, ExtendedColorType::Rgb8);
    png[16..24].copy_from_slice(&[0x00, 0x00, 0xff, 0xff, 0x00, 0x00, 0xff, 0xff]);
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    too_large(&png);

    let mut tga = file(ImageFormat::Tga, ExtendedColorType::Rgb8);
    tga[12..16].fill(0xff);
    too_large(&tga);

    let mut bmp = file(ImageFormat::Bmp, ExtendedColorType::Rgb8);
    bmp[18..26].copy_from_slice(&[0xff, 0xff, 0x00, 0x00, 0xff, 0xff, 0x00, 0x00]);
    too_large(&bmp);

    let mut jpeg = file(ImageFormat::Jpeg, ExtendedColorType::Rgb8);
    let frame = jpeg.windows(2).position(|w| w[0] == 0xff && matches!(w[1], 0xc0..=0xc2)).unwrap();
    jpeg[frame + 5..frame + 9].fill(0xff);
    too_large(&jpeg);

    let mut qoi = file(ImageFormat::Qoi, ExtendedColorType::Rgb8);
    qoi[4..12].copy_from_slice(&[0x00, 0x00, 0xff, 0xff, 0x00, 0x00, 0xff, 0xff]);
    too_large(&qoi);

    let mut webp = file(ImageFormat::WebP, ExtendedColorType::Rgba8);
    let stream = webp.windows(4).position(|w| w == b"VP8L").unwrap() + 8;
    // 14 bits each of width - 1 and height - 1: 16384, the most there is, which the texels' memory refuses.
    webp[stream + 1..stream + 5].copy_from_slice(&[0xff, 0xff, 0xff, 0x0f]);
    assert!(decode(&webp, Limits { max_bytes: 1 << 24, ..Limits::default() }).is_err());
}

/// PNG's CRC (ISO/IEC 15948, annex D).
pub(crate) fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

/// Cut at any byte: an error, or, where only a trailer is gone, the whole image.
#[test]
fn cut_files_give_errors() {
    for (format, color) in KINDS {
        let bytes = file(format, color);
        let whole = decode(&bytes, Limits::default()).unwrap();
        let mut accepted = 0;
        for length in 0..bytes.len() {
            if let Ok(image) = decode(&bytes[..length], Limits::default()) {
                assert_eq!(image, whole, "{format:?} {color:?} cut at {length} of {}", bytes.len());
                accepted += 1;
            }
        }
        assert!(accepted <= 32, "{format:?} {color:?}: {accepted} cut files were taken");
        let error = decode(&bytes[..bytes.len() / 2], Limits::default()).unwrap_err();
        assert!(!error.to_string().contains("gave up"), "{format:?} {color:?}: {error}");
    }
}

/// A TIFF file whose SampleFormat has no values makes tiff 0.10.3 index an empty list: it stays that file's error.
#[test]
fn a_panic_of_a_decoder_is_an_error() {
    let mut bytes = file(ImageFormat::Tiff, ExtendedColorType::Rgb8);
    let directory = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]) as usize;
    let entries = usize::from(u16::from_le_bytes([bytes[directory], bytes[directory + 1]]));
    let entry = (0..entries)
        .map(|i| directory + 2 + 12 * i)
        .find(|&at| bytes[at..at + 2] == 339_u16.to_le_bytes())
        .expect("the encoder writes SampleFormat");
    bytes[entry + 4..entry + 8].fill(0);
    assert!(matches!(decode(&bytes, Limits::default()), Err(DecodeError::Damaged { format: "TIFF", .. })));
}

/// What is no texture is named for what it is.
#[test]
fn other_files_are_named() {
    let message = |bytes: &[u8]| decode(bytes, Limits::default()).unwrap_err().to_string();
    assert!(message(b"").contains("empty"));
    assert!(message(b"just some text that is long enough").contains("PNG, JPEG, TIFF, WebP, TGA, BMP or QOI"));
    assert!(message(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n").starts_with("HDR image"));
    assert!(message(&[0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]).starts_with("OpenEXR image"));
    assert!(message(b"GIF89a\x01\x00\x01\x00\x00\x00\x00").starts_with("gif image"));
    let png = file(ImageFormat::Png, ExtendedColorType::Rgb8);
    assert!(message(&png[..60]).contains("ends before"), "{}", message(&png[..60]));
}

/// The two bytes of a QOI header that state something change no value: without alpha, three channels or four are the same.
#[test]
fn qoi_statements_change_no_values() {
    let sound = file(ImageFormat::Qoi, ExtendedColorType::Rgb8);
    let values = |place: usize, byte: u8| {
        let mut bytes = sound.clone();
        bytes[place] = byte;
        decode(&bytes, Limits::default())
    };
    let (three, four) = (values(12, 3).unwrap(), values(12, 4).unwrap());
    assert_eq!((three.channels(), four.channels()), (Channels::Rgb, Channels::Rgba));
    assert_eq!(three.texels(), four.texels());
    assert_eq!(values(13, 1).unwrap(), values(13, 0).unwrap());
    for (place, byte) in [(12, 0), (12, 5), (13, 2)] {
        assert!(values(place, byte).is_err(), "byte {place}: {byte}");
    }
    let mut with_alpha = file(ImageFormat::Qoi, ExtendedColorType::Rgba8);
    with_alpha[12] = 3;
    assert!(matches!(decode(&with_alpha, Limits::default()), Err(DecodeError::Damaged { format: "QOI", .. })));
}

#[test]
fn images_need_their_texels() {
    let texels = || Texels::U8(vec![[0; 4]; 6]);
    assert!(Image::new(3, 2, Channels::Rgb, texels()).is_ok());
    assert!(Image::new(3, 3, Channels::Rgb, texels()).is_err());
    assert!(Image::new(0, 0, Channels::Rgb, Texels::U8(vec![])).is_err());
    assert!(Image::new(u32::MAX, u32::MAX, Channels::Rgb, texels()).is_err());
}

/// Small enough that no mutated header can make a test slow.
const SMALL: Limits = Limits { max_width: 4096, max_height: 4096, max_texels: 1 << 20, max_bytes: 1 << 24 };

proptest! {
    #![proptest_config(ProptestConfig { cases: cases() * 4, failure_persistence: None, ..ProptestConfig::default() })]

    /// Bytes changed, cut out, put in: an image within the limits or an error, and no panic.
    #[test]
    fn mutated_files_do_not_panic(
        kind in 0..KINDS.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..12),
        cut in prop::option::of(any::<prop::sample::Index>()),
        near_start in any::<bool>(),
    ) {
        let mut bytes = file(KINDS[kind].0, KINDS[kind].1);
        for (place, value, how) in changes {
            // Headers are where the lies are.
            let end = if near_start { bytes.len().min(64) } else { bytes.len() };
            if end == 0 {
                break;
            }
            let at = place.index(end);
            match how {
                0 => bytes[at] = value,
                1 => bytes[at] ^= 1 << (value % 8),
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, value),
            }
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len() + 1));
        }
        if let Ok(image) = decode(&bytes, SMALL) {
            prop_assert!(u64::from(image.width()) * u64::from(image.height()) <= SMALL.max_texels);
        }
    }

    /// Noise behind each signature.
    #[test]
    fn noise_does_not_panic(
        signature in prop::sample::select(vec![
            &b"\x89PNG\r\n\x1a\n"[..], b"\xff\xd8\xff\xe0", b"II*\0", b"MM\0*", b"RIFF\0\0\0\0WEBPVP8 ", b"RIFF\0\0\0\0WEBPVP8L",
            b"RIFF\0\0\0\0WEBPVP8X", b"BM", b"\0\0\x02", b"\0\x01\x01", b"qoif", b"MM\0\x2b\0\x08\0\0", b"",
        ]),
        noise in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        let bytes = [signature, &noise].concat();
        if let Ok(image) = decode(&bytes, SMALL) {
            prop_assert!(u64::from(image.width()) * u64::from(image.height()) <= SMALL.max_texels);
        }
    }
}
