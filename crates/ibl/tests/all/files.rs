//! Files: real ones give the light they should, damaged and lying ones an error that names the field.

use crate::data_file;
use halfvector_ibl::save::{CubeLevels, TexelFormat, ktx2};
use halfvector_ibl::{
    BakeOptions, Cube, Equirect, LevelMap, Limits, LoadError, LoadedEnvironment, MAX_RADIANCE, Source, StoredLevels,
    StoredLobe, bake, load, load_within,
};
use proptest::prelude::*;

fn map(environment: LoadedEnvironment) -> Equirect {
    match environment.source {
        Source::Equirect(map) => map,
        Source::Levels(_) => panic!("a map was expected"),
    }
}

fn stored(environment: LoadedEnvironment) -> StoredLevels {
    match environment.source {
        Source::Levels(levels) => levels,
        Source::Equirect(_) => panic!("levels were expected"),
    }
}

/// The same picture as ZIP half EXR, as DWAB EXR and as Radiance file.
#[test]
fn formats_agree() {
    let (Some(exr), Some(hdr), Some(dwab)) =
        (data_file("env/bpy_city.exr"), data_file("env/bpy_city.hdr"), data_file("env/dwab/bpy_city.exr"))
    else {
        return;
    };
    let [exr, hdr, dwab] =
        [(&exr, "bpy_city.exr"), (&hdr, "bpy_city.hdr"), (&dwab, "dwab/bpy_city.exr")].map(|(b, name)| {
            let environment = load(b, name).expect("the file is sound");
            println!("{name}: {}", environment.repairs);
            map(environment)
        });
    for other in [&hdr, &dwab] {
        assert_eq!((exr.width, exr.height), (1024, 512));
        assert_eq!((other.width, other.height), (1024, 512));
    }
    for (a, b) in exr.pixels.iter().zip(&hdr.pixels) {
        let largest = a.iter().copied().fold(0.0, f32::max);
        for c in 0..3 {
            assert!((a[c] - b[c]).abs() <= 0.0045 * largest + 1e-6, "{a:?} and {b:?}");
        }
    }
    let (a, b) = (exr.mean(), dwab.mean());
    for c in 0..3 {
        assert!((a[c] / b[c] - 1.0).abs() < 0.01, "{a:?} and {b:?}");
    }
}

#[test]
fn small_dwab_files() {
    for (name, brightest) in [("env/city.exr", 11.0), ("env/studio.exr", 3730.0), ("mitsuba/venice.exr", 8.6)] {
        let Some(bytes) = data_file(name) else { return };
        let map = map(load(&bytes, name).expect("the file is sound"));
        assert_eq!((map.width, map.height), (512, 256));
        let found = map.pixels.iter().flatten().copied().fold(0.0, f32::max);
        assert!((found / brightest - 1.0).abs() < 0.05, "{name}: {found} for {brightest}");
    }
}

/// Both real HDRE files: the room's bright ceiling is up, levels look alike, and the coefficients match the pixels.
#[test]
fn hdre_files() {
    for (name, size) in [("hdre/lounge_64.hdre", 64), ("hdre/lythwood_lounge.hdre", 128)] {
        let Some(bytes) = data_file(name) else { return };
        let environment = load(&bytes, name).expect("the file is sound");
        let levels = stored(environment.clone());
        assert_eq!(levels.lobe, StoredLobe::Hdre { version: 2.0 });
        let sizes: Vec<usize> = levels.levels.iter().map(|cube| cube.size).collect();
        assert_eq!(sizes, [0, 1, 2, 3, 4, 5].map(|i| (size >> i).max(8)));
        let (up, down) = (levels.levels[3].sample([0.0, 1.0, 0.0])[1], levels.levels[3].sample([0.0, -1.0, 0.0])[1]);
        assert!(up > 1.5 * down, "{name}: {up} above, {down} below");

        let baked = bake(&environment, &BakeOptions { size: 32, ..BakeOptions::default() });
        if let Some(coefficients) = levels.irradiance_sh {
            for (k, (file, ours)) in coefficients.iter().zip(&baked.irradiance_sh).enumerate() {
                let (file, ours) = (file[1], ours[1]);
                println!("{name}: coefficient {k}: {file} in the file, {ours} from its pixels");
                assert!((file - ours).abs() < 0.06 * baked.irradiance_sh[0][1], "{name}, {k}: {file} for {ours}");
            }
        }
        // The report takes the file's levels as they are.
        let report = bake(&environment, &BakeOptions { size, level_map: LevelMap::Report, ..BakeOptions::default() });
        assert_eq!(report.radiance[1], levels.levels[1]);
        assert_eq!(report.radiance[5].size, size >> 5);
    }
}

/// An HDRE file of our own.
fn hdre(
    version: f32,
    size: u16,
    kind: u16,
    bits: u16,
    channels: u16,
    texel: impl Fn(usize, usize) -> Vec<u8>,
) -> Vec<u8> {
    let mut bytes = vec![0; 256];
    bytes[..4].copy_from_slice(b"HDRE");
    bytes[4..8].copy_from_slice(&version.to_le_bytes());
    for (at, value) in [(8, size), (10, size), (16, channels), (18, bits), (20, 256), (22, 1), (28, kind)] {
        bytes[at..at + 2].copy_from_slice(&value.to_le_bytes());
    }
    for level in 0..6 {
        let size = usize::from(size) >> level;
        let size = if version > 2.0 { size.max(1) } else { size.max(8) };
        for k in 0..6 * size * size {
            bytes.extend(texel(level, k / (size * size)));
        }
    }
    bytes
}

/// Face numbers in every coding; below 3.0 up and down change places.
#[test]
fn hdre_codings() {
    let floats = |value: f32, n: usize| std::iter::repeat_n(value.to_le_bytes(), n).flatten().collect::<Vec<u8>>();
    let files = [
        ("float", hdre(2.0, 16, 3, 32, 4, |_, face| floats(face as f32, 4)), [0.0, 1.0, 3.0, 2.0, 4.0, 5.0]),
        ("rgb", hdre(2.75, 16, 3, 32, 3, |_, face| floats(face as f32, 3)), [0.0, 1.0, 3.0, 2.0, 4.0, 5.0]),
        ("half", hdre(3.0, 16, 2, 16, 4, |_, _| [0x00, 0x40].repeat(4)), [2.0; 6]),
        ("u8", hdre(2.5, 16, 1, 8, 4, |_, _| vec![255; 4]), [1.0; 6]),
        ("rgbe", hdre(2.75, 16, 4, 8, 4, |_, _| vec![128, 128, 128, 131]), [4.0; 6]),
    ];
    for (name, bytes, expected) in files {
        let levels = stored(load(&bytes, name).expect(name)).levels;
        for cube in &levels {
            let face = cube.size * cube.size;
            for (k, texel) in cube.texels.iter().enumerate() {
                assert_eq!(texel[0], expected[k / face], "{name}, face {}", k / face);
            }
        }
    }
}

/// From 3.0 on the rows of the filtered levels are turned to match level 0, whichever way they were written.
#[test]
fn hdre_rows_are_found() {
    for flipped in [false, true] {
        let mut bytes = hdre(3.0, 32, 3, 32, 4, |_, _| Vec::new());
        for level in 0..6 {
            let size = 32usize >> level;
            for k in 0..6 * size * size {
                let row = k % (size * size) / size;
                let row = if flipped && level > 0 { size - 1 - row } else { row };
                let value = (row as f32 + 0.5) / size as f32;
                bytes.extend(std::iter::repeat_n(value.to_le_bytes(), 4).flatten());
            }
        }
        let levels = stored(load(&bytes, "rows").expect("sound")).levels;
        for cube in &levels[..5] {
            assert!(cube.texels[0][0] < 0.5, "first row up, size {}", cube.size);
        }
    }
}

#[test]
fn lying_headers_name_the_field() {
    let sound = hdre(2.0, 8, 3, 32, 4, |_, _| vec![0; 16]);
    assert!(load(&sound, "x").is_ok());
    let with = |at: usize, bytes: &[u8]| {
        let mut file = sound.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    for (file, part) in [
        (with(4, &1.5f32.to_le_bytes()), "version"),
        (with(4, &f32::NAN.to_le_bytes()), "version"),
        (with(8, &[9, 0]), "height"),
        (with(8, &[0, 0, 0, 0]), "size"),
        (with(8, &[0xff, 0xff, 0xff, 0xff]), "limit"),
        (with(8, &[0, 4, 0, 4]), "its levels"),
        (with(16, &[3, 0]), "numChannels"),
        (with(18, &[16, 0]), "bitsPerChannel"),
        (with(20, &[0xff, 0xff]), "headerSize: 65535 lies outside of the file"),
        (with(20, &[0, 2]), "headerSize: 512 and the levels'"),
        (with(20, &[252, 0]), "headerSize: 252 and the levels'"),
        (with(20, &[144, 0]), "headerSize"),
        (with(20, &[4, 1]), "headerSize"),
        ([&sound[..], &[0]].concat(), "headerSize"),
        (with(20, &[0, 0]), "headerSize"),
        (with(22, &[0, 1]), "endianEncoding"),
        (with(28, &[7, 0]), "type"),
        (with(30, &[1, 0]), "numCoeffs"),
        (with(30, &[2, 0]), "includesSH"),
        (with(0, b"ERDH"), "signature"),
        (sound[..sound.len() - 1].to_vec(), "its levels"),
        (sound[..100].to_vec(), "its header"),
        (Vec::new(), "empty"),
        (b"not a picture".to_vec(), "no Radiance .hdr, OpenEXR, HDRE, KTX2, PNG, JPEG"),
        (b"#?RADIANCE\n\n-Y 99999999 +X 99999999\n".to_vec(), "limit"),
    ] {
        let error = load(&file, "room.hdre").expect_err(part).to_string();
        assert!(error.contains(part) && error.contains("room.hdre"), "{error} should name {part}");
    }
    let error = load_within(&sound, "x", Limits { max_texels: 100, ..Limits::default() }).expect_err("too large");
    assert!(matches!(error, LoadError::TooLarge { .. }), "{error}");
}

/// What light cannot be is counted and replaced.
#[test]
fn values_are_repaired() {
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.5, 70000.0, 2.0];
    let bytes =
        hdre(2.0, 8, 3, 32, 4, |_, face| std::iter::repeat_n(values[face].to_le_bytes(), 4).flatten().collect());
    let environment = load(&bytes, "x").expect("sound");
    let components = 3 * 6 * 64;
    assert_eq!(environment.repairs.not_a_number, components);
    assert_eq!(environment.repairs.infinite, 2 * components);
    assert_eq!(environment.repairs.negative, components);
    assert_eq!(environment.repairs.too_bright, components);
    let told = environment.repairs.to_string();
    for kind in ["not a number", "infinite", "negative", "above 65504"] {
        assert!(told.contains(kind), "{told}");
    }
    let levels = stored(environment).levels;
    assert!(levels.iter().flat_map(|c| c.texels.iter().flatten()).all(|x| (0.0..=MAX_RADIANCE).contains(x)));
}

/// An EXR file of the project's own making, small.
fn small_exr() -> Vec<u8> {
    use exr::prelude::{WritableImage, f16};
    let image = exr::image::Image::from_channels(
        (8, 4),
        exr::image::SpecificChannels::rgb(|p: exr::math::Vec2<usize>| {
            (f16::from_f32(p.0 as f32), f16::from_f32(p.1 as f32), f16::from_f32(0.5))
        }),
    );
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).expect("written to memory");
    bytes.into_inner()
}

#[test]
fn exr_texels_stand_where_they_should() {
    let map = map(load(&small_exr(), "small.exr").expect("sound"));
    assert_eq!((map.width, map.height), (8, 4));
    assert_eq!(map.pixels[2 * 8 + 5], [5.0, 2.0, 0.5]);
}

fn small_hdr() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n".to_vec();
    for _ in 0..4 {
        bytes.extend([2, 2, 0, 8]);
        for value in [100, 120, 140, 130] {
            bytes.extend([128 + 5, value, 3, 1, 2, 3]);
        }
    }
    bytes
}

fn small_ktx2(format: TexelFormat) -> Vec<u8> {
    let levels = [8, 4, 2].map(|size| Cube { size, texels: vec![[0.5, 1.0, 2.0]; 6 * size * size] });
    ktx2(CubeLevels::radiance(&levels, &[0.0, 0.5, 1.0]), format).expect("written")
}

/// Each field of a KTX2 file in turn.
#[test]
fn lying_ktx2_headers_name_the_field() {
    let sound = small_ktx2(TexelFormat::Rgba16F);
    assert!(load(&sound, "x").is_ok());
    let with = |at: usize, bytes: &[u8]| {
        let mut file = sound.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    let place = |at: usize| u32::from_le_bytes(std::array::from_fn(|i| sound[at + i]));
    let (kvd, level_0) = (place(56), place(80));
    let roughness = sound.windows(7).position(|text| text == b"0,0.5,1").expect("the list");
    for (file, part) in [
        (with(5, b"11"), "KTX 1"),
        (with(8, b"\n\n"), "identifier"),
        (sound[..70].to_vec(), "its header"),
        (sound[..100].to_vec(), "its level index"),
        (with(12, &[0]), "vkFormat: 0 (Basis"),
        (with(12, &[131]), "BC block"),
        (with(12, &[109]), "vkFormat: 109 has texels of 16 bytes, and bytesPlane0"),
        (with(12, &[90]), "vkFormat: 90 has texels of 6 bytes, and bytesPlane0"),
        (with(12, &[122]), "vkFormat: 122 has texels of 4 bytes"),
        (with(16, &[4]), "typeSize: 4 where vkFormat 97 has 2"),
        (with(20, &[0, 0, 0, 0, 0]), "size"),
        (with(20, &[0xff; 8]), "limit"),
        (with(20, &[16]), "pixelHeight"),
        (with(28, &[1]), "pixelDepth"),
        (with(32, &[9]), "layerCount"),
        (with(36, &[5]), "faceCount"),
        (with(36, &[1]), "faceCount: 1 where level 0 has the bytes of 6"),
        (with(40, &[9]), "levelCount"),
        (with(40, &[0]), "levelCount"),
        (with(40, &[2]), "levelCount: 2 where the level index, up to dfdByteOffset, has room for 3"),
        (with(40, &[4]), "levelCount"),
        (with(48, &[0xff; 4]), "dfdByteOffset"),
        (with(48, &[153]), "dfdByteOffset"),
        (with(52, &[0; 4]), "dfdByteLength"),
        (with(52, &[0xff; 4]), "dfdByteLength"),
        (with(152, &[1]), "dfdTotalSize"),
        (with(156, &[1]), "descriptorType"),
        (with(162, &[0xff]), "descriptorBlockSize"),
        (with(166, &[2]), "transferFunction"),
        (with(172, &[16]), "bytesPlane0"),
        (with(60, &[0xff; 4]), "kvdByteLength"),
        (with(60, &(place(60) + 2).to_le_bytes()), "kvdByteLength: "),
        (with(60, &(place(60) - 1).to_le_bytes()), "kvdByteLength: "),
        (with(44, &[1]), "supercompressionScheme"),
        (with(44, &[77]), "supercompressionScheme"),
        (with(44, &[2]), "level 0"),
        (with(44, &[3]), "level 0"),
        (with(56, &[0xff; 4]), "kvdByteOffset"),
        (with(80, &[0xff; 8]), "byteOffset of level 0"),
        (with(80 + 24, &[0xff; 4]), "byteOffset of level 1"),
        (with(56, &(kvd + 4).to_le_bytes()), "kvdByteOffset"),
        (with(56, &[0; 4]), "kvdByteOffset"),
        (with(56, &[16, 0, 0, 0]), "kvdByteOffset"),
        (with(72, &[8]), "sgdByteLength"),
        (with(80, &[0; 8]), "byteOffset of level 0: 0 lies before"),
        (with(80, &[16, 0, 0]), "byteOffset of level 0: 16 lies before"),
        (with(80, &kvd.to_le_bytes()), "byteOffset of level 0"),
        (with(80, &(level_0 + 8).to_le_bytes()), "byteOffset of level 0: from"),
        (with(80, &(level_0 - 8).to_le_bytes()), "byteOffset of level 0"),
        (with(80 + 24, &(level_0 - 8 * 96 + 4).to_le_bytes()), "byteOffset of level 1"),
        (with(80 + 24, &level_0.to_le_bytes()), "lies within level"),
        (with(80 + 48, &(level_0 - 8 * 96).to_le_bytes()), "lies within level"),
        (with(88, &[1]), "byteLength of level 0"),
        (with(96, &[0xff; 8]), "uncompressedByteLength of level 0"),
        (with(roughness, b"1"), "halfvector.roughness"),
        (with(roughness, b"x"), "halfvector.roughness"),
        (sound[..sound.len() - 1].to_vec(), "level 0"),
    ] {
        let error = load(&file, "room.ktx2").expect_err(part).to_string();
        assert!(error.contains(part) && error.contains("room.ktx2"), "{error} should name {part}");
    }
}

/// The header's zero levels, which asks for levels to be made, is no lie where nothing contradicts it; foreign primaries
/// are told.
#[test]
fn ktx2_headers_of_others() {
    let one = Cube { size: 4, texels: vec![[0.5, 1.0, 2.0]; 96] };
    let mut file = ktx2(CubeLevels::irradiance_over_pi(&one), TexelFormat::Rgba16F).expect("written");
    file[40] = 0;
    assert_eq!(stored(load(&file, "x").expect("sound")).levels[0], one);
    let descriptor = 80 + 24;
    file[descriptor + 13] = 9;
    let notes = load(&file, "x").expect("sound").notes;
    assert!(notes.iter().any(|note| note.contains("colorPrimaries (9)")), "{notes:?}");
}

/// A file of others, of one level and one key/value; `bits` of each of some channels.
fn foreign_ktx2(vk_format: u32, channels: usize, bits: u8, pair: &[u8], texels: &[u8]) -> Vec<u8> {
    let texel = channels * usize::from(bits) / 8;
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let (descriptor_at, descriptor) = (80 + 24, 28 + 16 * channels);
    let pairs = if pair.is_empty() { 0 } else { 4 + pair.len().next_multiple_of(4) };
    let pairs_at = descriptor_at + descriptor;
    // Levels stand at multiples of 4 and of a texel: here of both at once.
    let level_at = (pairs_at + pairs).next_multiple_of(4 * texel);
    for number in [vk_format, u32::from(bits / 8), 2, 2, 0, 0, 6, 1, 0] {
        file.extend(number.to_le_bytes());
    }
    for number in [descriptor_at, descriptor, if pairs > 0 { pairs_at } else { 0 }, pairs, 0, 0, 0, 0] {
        file.extend((number as u32).to_le_bytes());
    }
    for number in [level_at, texels.len(), texels.len()] {
        file.extend((number as u64).to_le_bytes());
    }
    file.extend((descriptor as u32).to_le_bytes());
    file.extend([0; 4]);
    file.extend([2, 0, (descriptor - 4) as u8, 0, 1, 1, 1, 0, 0, 0, 0, 0, texel as u8, 0, 0, 0, 0, 0, 0, 0]);
    file.resize(pairs_at, 0);
    if pairs > 0 {
        file.extend((pair.len() as u32).to_le_bytes());
        file.extend(pair);
    }
    file.resize(level_at, 0);
    file.extend(texels);
    file
}

/// Three channels, whose texels are no multiple of four bytes: levels stand at multiples of both. And colours that are
/// stored in another order are put in theirs, or refused by the key's name.
#[test]
fn ktx2_channels_of_others() {
    let bytes: Vec<u8> = [51u8, 102, 255].repeat(24);
    let halves: Vec<u8> =
        [0.25f32, 0.5, 2.0].repeat(24).into_iter().flat_map(|x| half::f16::from_f32(x).to_le_bytes()).collect();
    let floats: Vec<u8> = [0.25f32, 0.5, 2.0].repeat(24).into_iter().flat_map(f32::to_le_bytes).collect();
    let texel = |file: &[u8]| stored(load(file, "x").expect("sound")).levels[0].texels[7];
    assert_eq!(texel(&foreign_ktx2(23, 3, 8, b"", &bytes)), [51.0 / 255.0, 102.0 / 255.0, 1.0]);
    assert_eq!(texel(&foreign_ktx2(90, 3, 16, b"", &halves)), [0.25, 0.5, 2.0]);
    assert_eq!(texel(&foreign_ktx2(106, 3, 32, b"", &floats)), [0.25, 0.5, 2.0]);
    let with = |letters: &[u8]| {
        let pair = [b"KTXswizzle\0", letters, b"\0"].concat();
        foreign_ktx2(106, 3, 32, &pair, &floats)
    };
    assert_eq!(texel(&with(b"rgba")), [0.25, 0.5, 2.0]);
    assert_eq!(texel(&with(b"bgr1")), [2.0, 0.5, 0.25]);
    assert_eq!(texel(&with(b"rrr1")), [0.25; 3]);
    assert_eq!(texel(&with(b"g01a")), [0.5, 0.0, 1.0]);
    for letters in [&b"aaa1"[..], b"rgb", b"xyzw", b"rgbx", b"\xff\xff\xff\xff", b""] {
        let error = load(&with(letters), "x").map(|_| ()).expect_err("refused").to_string();
        assert!(error.contains("KTXswizzle: "), "{error}");
    }
}

/// The level index says where levels stand: with level 0 first and room between them it is as good a file.
#[test]
fn ktx2_levels_stand_in_any_order() {
    let sound = small_ktx2(TexelFormat::Rgba16F);
    let place = |level: usize| u32::from_le_bytes(std::array::from_fn(|i| sound[80 + 24 * level + i])) as usize;
    let lengths = [8 * 384, 8 * 96, 8 * 24];
    let mut turned = sound[..place(2)].to_vec();
    for level in 0..3 {
        turned.resize(turned.len().next_multiple_of(8) + 16, 7);
        let at = turned.len() as u32;
        turned.extend(&sound[place(level)..place(level) + lengths[level]]);
        turned[80 + 24 * level..][..4].copy_from_slice(&at.to_le_bytes());
    }
    assert_eq!(load(&turned, "x").expect("sound").source, load(&sound, "x").expect("sound").source);
}

/// Cut anywhere, an EXR file says that it ends, and within what.
#[test]
fn cut_exr_files_say_where() {
    let sound = small_exr();
    let mut parts = std::collections::BTreeSet::new();
    for length in 4..sound.len() {
        match load(&sound[..length], "cut.exr") {
            Err(LoadError::Truncated { field, .. }) => drop(parts.insert(field)),
            other => panic!("cut at {length} of {}: {other:?}", sound.len()),
        }
    }
    assert_eq!(parts.into_iter().collect::<Vec<_>>(), ["its header", "its offset tables", "its pixels"]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(
        std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(400)
    ))]

    /// No bytes whatever make a reader panic or give values out of range: sound files, cut short and with bytes changed.
    #[test]
    fn damaged_files(
        which in 0usize..6,
        cut in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        keep_whole in any::<bool>(),
    ) {
        let mut bytes = match which {
            0 => small_hdr(),
            1 => hdre(2.0, 8, 3, 32, 4, |_, _| vec![7; 16]),
            2 => hdre(3.0, 16, 2, 16, 3, |level, face| vec![level as u8, face as u8, 1, 2, 3, 60]),
            3 => small_ktx2(TexelFormat::Rgba16F),
            4 => small_ktx2(TexelFormat::Rgb9E5),
            _ => small_exr(),
        };
        for (index, value) in changes {
            // Most fields stand at the start.
            let at = index.index(bytes.len().min(400));
            bytes[at] = value;
        }
        if !keep_whole {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(environment) = load_within(&bytes, "x", Limits { max_texels: 1 << 16, ..Limits::default() }) {
            let sound = |texels: &[[f32; 3]]| texels.iter().flatten().all(|x| (0.0..=MAX_RADIANCE).contains(x));
            match &environment.source {
                Source::Equirect(map) => prop_assert!(map.pixels.len() == map.width * map.height && sound(&map.pixels)),
                Source::Levels(stored) => prop_assert!(stored.levels.iter().all(|level| sound(&level.texels))),
            }
        }
    }
}
