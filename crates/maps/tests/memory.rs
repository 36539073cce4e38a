//! Memory: decoding stays within its limit, for files as they should be and for files that lie. A binary of its own,
//! because the allocator counts what all threads of a process take.

use std::io::Cursor;

use halfvector_maps::{DecodeError, Limits, decode};
use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, codecs::png::PngEncoder};
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What a decoder may take beside texels: tables, windows, rows.
const OVERHEAD: usize = 3 << 20;

/// Peak of `work` above what was there before.
fn peak_of<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let result = work();
    (result, ALLOCATOR.peak_usage().saturating_sub(before))
}

fn written(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// One test: the parts must not run side by side.
#[test]
fn decoding_stays_within_its_limit() {
    sound_files();
    claims();
    bombs();
    profiles();
    tiff_claims();
}

/// The limit that lets a file through is no less than what is taken for it.
fn sound_files() {
    let (width, height) = (1200, 900);
    let noise = |i: usize| ((i as u32).wrapping_mul(2_654_435_761) >> 24) as u8;
    let bytes = |channels: usize| (0..width as usize * height as usize * channels).map(noise).collect::<Vec<_>>();
    let words = |channels: usize| bytes(channels).into_iter().map(|b| u16::from(b) * 251).collect::<Vec<_>>();
    let grey = DynamicImage::ImageLuma8(image::ImageBuffer::from_raw(width, height, bytes(1)).unwrap());
    let rgb = DynamicImage::ImageRgb8(image::ImageBuffer::from_raw(width, height, bytes(3)).unwrap());
    let rgba = DynamicImage::ImageRgba8(image::ImageBuffer::from_raw(width, height, bytes(4)).unwrap());
    let deep = DynamicImage::ImageRgba16(image::ImageBuffer::from_raw(width, height, words(4)).unwrap());
    for (image, format) in [
        (&grey, ImageFormat::Png),
        (&grey, ImageFormat::Jpeg),
        (&rgb, ImageFormat::Png),
        (&rgb, ImageFormat::Jpeg),
        (&rgb, ImageFormat::Tiff),
        (&rgb, ImageFormat::Bmp),
        (&rgb, ImageFormat::Tga),
        (&rgb, ImageFormat::Qoi),
        (&rgb, ImageFormat::WebP),
        (&rgba, ImageFormat::Png),
        (&rgba, ImageFormat::WebP),
        (&deep, ImageFormat::Png),
        (&deep, ImageFormat::Tiff),
    ] {
        let file = written(image, format);
        // The least limit, in steps of a quarter byte a texel, that it decodes with.
        let texels = u64::from(width * height);
        let least = (1..80)
            .map(|quarters| texels * quarters / 4)
            .find(|&max_bytes| decode(&file, Limits { max_bytes, ..Limits::default() }).is_ok())
            .expect("some limit is enough");
        let (result, peak) = peak_of(|| decode(&file, Limits { max_bytes: least, ..Limits::default() }));
        assert!(result.is_ok());
        println!("{format:?} {:?}: limit {least}, peak {peak}", image.color());
        assert!(peak as u64 <= least + OVERHEAD as u64, "{format:?} {:?}: {peak} of {least}", image.color());
    }
}

/// Headers that claim 65535 x 65535 texels take next to nothing.
fn claims() {
    let one = DynamicImage::new_rgb8(1, 1);
    let mut png = written(&one, ImageFormat::Png);
    png[16..24].copy_from_slice(&[0, 0, 255, 255, 0, 0, 255, 255]);
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    // So large that the decoder itself will not even count its bytes.
    let mut largest = png.clone();
    largest[16..24].copy_from_slice(&[127, 255, 255, 255, 127, 255, 255, 255]);
    let crc = crc32(&largest[12..29]);
    largest[29..33].copy_from_slice(&crc.to_be_bytes());
    let (result, peak) = peak_of(|| decode(&largest, Limits::default()));
    assert!(matches!(result, Err(DecodeError::Memory { format: "PNG" })) && peak < OVERHEAD, "{peak}: {result:?}");
    let mut tga = written(&one, ImageFormat::Tga);
    tga[12..16].fill(255);
    let mut bmp = written(&one, ImageFormat::Bmp);
    bmp[18..26].copy_from_slice(&[255, 255, 0, 0, 255, 255, 0, 0]);
    let mut jpeg = written(&one, ImageFormat::Jpeg);
    let frame = jpeg.windows(2).position(|w| w[0] == 255 && matches!(w[1], 0xc0..=0xc2)).unwrap();
    jpeg[frame + 5..frame + 9].fill(255);
    let mut qoi = written(&one, ImageFormat::Qoi);
    qoi[4..12].copy_from_slice(&[0, 0, 255, 255, 0, 0, 255, 255]);
    let mut tiff = written(&one, ImageFormat::Tiff);
    let directory = u32::from_le_bytes(tiff[4..8].try_into().unwrap()) as usize;
    for entry in 0..usize::from(tiff[directory]) {
        let at = directory + 2 + 12 * entry;
        if matches!(tiff[at], 0 | 1) && tiff[at + 1] == 1 {
            // ImageWidth and ImageLength as LONG.
            tiff[at + 2..at + 12].copy_from_slice(&[4, 0, 1, 0, 0, 0, 255, 255, 0, 0]);
        }
    }
    for (name, file) in [("PNG", png), ("TGA", tga), ("BMP", bmp), ("JPEG", jpeg), ("QOI", qoi), ("TIFF", tiff)] {
        let (result, peak) = peak_of(|| decode(&file, Limits::default()));
        let error = result.unwrap_err();
        assert!(matches!(error, DecodeError::TooLarge { width: 65_535, height: 65_535, .. }), "{name}: {error:?}");
        assert!(error.to_string().starts_with(name) && peak < OVERHEAD, "{name}: {peak}");
    }
    // A WebP header holds at most 16384 x 16384: a limit of 64 MiB refuses that.
    let mut webp = written(&DynamicImage::new_rgba8(1, 1), ImageFormat::WebP);
    let stream = webp.windows(4).position(|w| w == b"VP8L").unwrap() + 8;
    webp[stream + 1..stream + 5].copy_from_slice(&[255, 255, 255, 15]);
    let (result, peak) = peak_of(|| decode(&webp, Limits { max_bytes: 1 << 26, ..Limits::default() }));
    assert!(result.is_err() && peak < OVERHEAD, "WebP: {peak}, {result:?}");
}

/// Small files that inflate to much: image data past the size, and a profile of 200 MB of zeros.
fn bombs() {
    let limits = Limits { max_bytes: 16 << 20, ..Limits::default() };
    let allowed = (16 << 20) + OVERHEAD;
    let huge = vec![0_u8; 200 << 20];
    let mut with_profile = Vec::new();
    let mut encoder = PngEncoder::new(&mut with_profile);
    encoder.set_icc_profile(huge.clone()).unwrap();
    encoder.write_image(&[1, 2, 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
    drop(huge);
    assert!(with_profile.len() < 1 << 20);
    let (result, peak) = peak_of(|| decode(&with_profile, limits));
    println!(
        "PNG with a huge profile: {} bytes, peak {peak}, {:?}",
        with_profile.len(),
        result.map(|d| d.profile().cloned())
    );
    assert!(peak < allowed, "{peak}");

    // The data of 12000 x 12000 black texels behind a header of 1 x 1.
    let mut file = written(&DynamicImage::new_luma8(12_000, 12_000), ImageFormat::Png);
    file[16..24].copy_from_slice(&[0, 0, 0, 1, 0, 0, 0, 1]);
    let crc = crc32(&file[12..29]);
    file[29..33].copy_from_slice(&crc.to_be_bytes());
    let (result, peak) = peak_of(|| decode(&file, limits));
    println!("PNG with data past its size: {} bytes, peak {peak}, {:?}", file.len(), result.map(|d| d.image().width()));
    assert!(peak < allowed, "{peak}");
}

/// A profile beside a large image counts, and bringing colours to sRGB takes no second image.
fn profiles() {
    let limits = Limits { max_bytes: 64 << 20, ..Limits::default() };
    let image = vec![7_u8; 64 << 20];
    let with = |profile: Option<Vec<u8>>| {
        let mut file = Vec::new();
        let mut encoder = PngEncoder::new(&mut file);
        if let Some(profile) = profile {
            encoder.set_icc_profile(profile).unwrap();
        }
        encoder.write_image(&image, 4096, 4096, ExtendedColorType::Rgba8).unwrap();
        file
    };
    let (result, peak) = peak_of(|| decode(&with(Some(vec![0; 20 << 20])), limits).map(|_| ()));
    assert!(matches!(result, Err(DecodeError::TooLarge { .. })), "{result:?}, {peak}");
    let plain = with(None);
    let gamma = [&[0, 0, 0, 4][..], b"gAMA", &100_000_u32.to_be_bytes()].concat();
    let gamma = [&gamma, &crc32(&gamma[4..]).to_be_bytes()[..]].concat();
    let file = [&plain[..33], &gamma, &plain[33..]].concat();
    drop((plain, image));
    let (noted, peak) = peak_of(|| decode(&file, limits).unwrap().into_color().unwrap());
    assert!(noted.notes[0].contains("converted to sRGB"), "{:?}", noted.notes);
    assert!(peak < (64 << 20) + OVERHEAD, "{peak}");
}

/// A TIFF file of 1 x 1 whose tags say that they have a million values.
fn tiff_claims() {
    let sound = written(&DynamicImage::new_rgb8(1, 1), ImageFormat::Tiff);
    let directory = u32::from_le_bytes(sound[4..8].try_into().unwrap()) as usize;
    for entry in 0..usize::from(sound[directory]) {
        let mut file = sound.clone();
        let at = directory + 2 + 12 * entry;
        file[at + 4..at + 8].copy_from_slice(&1_000_000_u32.to_le_bytes());
        let (result, peak) = peak_of(|| decode(&file, Limits::default()));
        assert!(matches!(result, Err(DecodeError::Truncated { .. })) && peak < OVERHEAD, "{entry}: {peak}, {result:?}");
    }
}

/// PNG's CRC (ISO/IEC 15948, annex D).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}
