//! Written files: what is read back, and what other readers rely on byte by byte.

use crate::data_file;
use halfvector_ibl::save::{CubeLevels, SaveError, TexelFormat, exr, hdre, hdre_face, ktx2, strip};
use halfvector_ibl::{
    BakeOptions, Cube, Layout, LevelMap, LoadedEnvironment, Source, StoredLevels, StoredLobe, bake, load, load_faces,
    studio,
};

fn stored(environment: LoadedEnvironment) -> StoredLevels {
    match environment.source {
        Source::Levels(levels) => levels,
        Source::Equirect(_) => panic!("levels were expected"),
    }
}

/// Levels of 16, 8, 4 texels whose values tell level, face and place apart.
fn levels() -> Vec<Cube> {
    (0..3)
        .map(|level| {
            let size = 16 >> level;
            let texels = (0..6 * size * size).map(|k| [(level + 1) as f32, k as f32 / 8.0, 0.25]).collect();
            Cube { size, texels }
        })
        .collect()
}

fn number(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize
}

fn long(bytes: &[u8], at: usize) -> usize {
    u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes")) as usize
}

#[test]
fn ktx2_comes_back() {
    let (levels, roughness) = (levels(), [0.0, 0.3, 1.0]);
    for format in [TexelFormat::Rgba16F, TexelFormat::Rgba32F, TexelFormat::Rgb9E5] {
        let bytes = ktx2(CubeLevels::radiance(&levels, &roughness), format).expect("written");
        assert_eq!(bytes, ktx2(CubeLevels::radiance(&levels, &roughness), format).expect("written"));
        let back = stored(load(&bytes, "x.ktx2").expect("sound"));
        assert_eq!(back.lobe, StoredLobe::Ggx(roughness.to_vec()));
        assert_eq!(back.levels.len(), 3);
        for (a, b) in levels.iter().zip(&back.levels) {
            assert_eq!(a.size, b.size);
            for (a, b) in a.texels.iter().zip(&b.texels) {
                let largest = a.iter().copied().fold(0.0, f32::max);
                for c in 0..3 {
                    let allowed = if format == TexelFormat::Rgb9E5 { largest / 511.0 } else { 0.0 };
                    assert!((a[c] - b[c]).abs() <= allowed, "{format:?}: {a:?} came back as {b:?}");
                }
            }
        }
    }
}

/// Slopes are alpha where there is one, told by a key; a slope that is no number is none, one that no bake writes is held.
#[test]
fn ktx2_keeps_slopes() {
    let (levels, roughness) = (levels(), [0.0, 0.5, 1.0]);
    let slope: Vec<Vec<f32>> =
        levels.iter().map(|level| (0..level.texels.len()).map(|k| k as f32 / 128.0 - 1.0).collect()).collect();
    let cube = CubeLevels { slope: &slope, ..CubeLevels::radiance(&levels, &roughness) };
    let back = |format, cube| stored(load(&ktx2(cube, format).expect("written"), "x").expect("sound"));
    assert_eq!(back(TexelFormat::Rgba16F, cube).slope, slope);
    assert_eq!(back(TexelFormat::Rgba32F, cube).slope, slope);
    assert!(back(TexelFormat::Rgb9E5, cube).slope.is_empty());
    assert!(back(TexelFormat::Rgba32F, CubeLevels::radiance(&levels, &roughness)).slope.is_empty());
    let broken = slope.iter().map(|level| vec![f32::NAN; level.len()]).collect::<Vec<_>>();
    assert_eq!(back(TexelFormat::Rgba32F, CubeLevels { slope: &broken, ..cube }).slope[2][0], 0.0);
    let steep = slope.iter().map(|level| vec![-1e9; level.len()]).collect::<Vec<_>>();
    assert_eq!(back(TexelFormat::Rgba16F, CubeLevels { slope: &steep, ..cube }).slope[2][0], -16.0);
    let short = CubeLevels { slope: &slope[1..], ..cube };
    assert!(matches!(ktx2(short, TexelFormat::Rgba16F), Err(SaveError::Levels { .. })));
}

/// Every number of the header, the descriptor as the Khronos library writes it for the same VkFormat, the smallest level
/// first in the file, each aligned, keys sorted.
#[test]
fn ktx2_bytes_are_as_specified() {
    const SIGNED_FLOATS: [u32; 2] = [0xbf80_0000, 0x3f80_0000];
    let [low, high] = SIGNED_FLOATS;
    let (levels, roughness) = (levels(), [0.0, 0.3, 1.0]);
    let half = [
        0x5c,
        0,
        0x58_0002,
        0x1_0101,
        0,
        8,
        0,
        0xc00f_0000,
        0,
        low,
        high,
        0xc10f_0010,
        0,
        low,
        high,
        0xc20f_0020,
        0,
        low,
        high,
        0xcf0f_0030,
        0,
        low,
        high,
    ];
    let float = [
        0x5c,
        0,
        0x58_0002,
        0x1_0101,
        0,
        16,
        0,
        0xc01f_0000,
        0,
        low,
        high,
        0xc11f_0020,
        0,
        low,
        high,
        0xc21f_0040,
        0,
        low,
        high,
        0xcf1f_0060,
        0,
        low,
        high,
    ];
    let shared = [
        0x7c,
        0,
        0x78_0002,
        0x1_0101,
        0,
        4,
        0,
        0x8_0000,
        0,
        0,
        8448,
        0x2004_001b,
        0,
        15,
        31,
        0x108_0009,
        0,
        0,
        8448,
        0x2104_001b,
        0,
        15,
        31,
        0x208_0012,
        0,
        0,
        8448,
        0x2204_001b,
        0,
        15,
        31,
    ];
    for (format, vk_format, type_size, texel, descriptor) in [
        (TexelFormat::Rgba16F, 97, 2, 8, half.as_slice()),
        (TexelFormat::Rgba32F, 109, 4, 16, float.as_slice()),
        (TexelFormat::Rgb9E5, 123, 4, 4, shared.as_slice()),
    ] {
        let bytes = ktx2(CubeLevels::radiance(&levels, &roughness), format).expect("written");
        let header: Vec<usize> = (0..9).map(|i| number(&bytes, 12 + 4 * i)).collect();
        assert_eq!(header, [vk_format, type_size, 16, 16, 0, 0, 6, 3, 0]);
        let (at, length) = (number(&bytes, 48), number(&bytes, 52));
        assert_eq!((at, length), (80 + 3 * 24, 4 * descriptor.len()));
        let found: Vec<usize> = (0..length / 4).map(|i| number(&bytes, at + 4 * i)).collect();
        assert_eq!(found, descriptor.iter().map(|&x: &u32| x as usize).collect::<Vec<_>>(), "{format:?}");

        let (mut at, end) = (number(&bytes, 56), number(&bytes, 56) + number(&bytes, 60));
        let mut pairs = Vec::new();
        while at < end {
            let length = number(&bytes, at);
            let text = String::from_utf8(bytes[at + 4..at + 4 + length].to_vec()).expect("text");
            pairs.push(text);
            at += 4 + length.next_multiple_of(4);
        }
        assert_eq!(at, end);
        assert!(pairs.is_sorted() && pairs.iter().all(|pair| pair.ends_with('\0')), "{pairs:?}");
        assert!(pairs.contains(&"KTXorientation\0rd\0".to_owned()));
        assert!(pairs.contains(&"halfvector.roughness\x000,0.3,1\0".to_owned()), "{pairs:?}");

        let places: Vec<[usize; 3]> = (0..3).map(|i| [0, 8, 16].map(|k| long(&bytes, 80 + 24 * i + k))).collect();
        for (level, [offset, length, whole]) in places.iter().enumerate() {
            assert_eq!((*length, length), (6 * (16 >> level) * (16 >> level) * texel, whole));
            assert_eq!(offset % texel, 0);
        }
        assert!(places[2][0] >= end && places[2][0] < end + texel);
        assert!(places.is_sorted_by(|a, b| a[0] >= b[0] + b[1]));
        assert_eq!(places[0][0] + places[0][1], bytes.len());
    }
}

#[test]
fn what_a_format_cannot_hold_is_refused() {
    let levels = levels();
    assert!(matches!(ktx2(CubeLevels::radiance(&levels, &[0.0]), TexelFormat::Rgba16F), Err(SaveError::Levels { .. })));
    let twice = [levels[1].clone(), levels[1].clone()];
    let uneven = CubeLevels { levels: &twice, ..CubeLevels::irradiance_over_pi(&twice[0]) };
    assert!(matches!(ktx2(CubeLevels::radiance(&[], &[]), TexelFormat::Rgba16F), Err(SaveError::Size { .. })));
    assert!(matches!(ktx2(uneven, TexelFormat::Rgba16F), Err(SaveError::Size { .. })));
    assert!(matches!(hdre(&levels, None), Err(SaveError::Levels { .. })));
    assert!(matches!(exr(CubeLevels::radiance(&[], &[])), Err(SaveError::Size { .. })));
    let bytes = ktx2(CubeLevels::irradiance_over_pi(&levels[0]), TexelFormat::Rgba16F).expect("written");
    let environment = load(&bytes, "x").expect("sound");
    assert!(environment.notes[0].contains("irradiance"), "{:?}", environment.notes);
}

/// Levels that are already what is asked for are taken as they are.
#[test]
fn baked_levels_are_used_as_they_are() {
    let options = BakeOptions {
        size: 32,
        level_map: LevelMap::Linear,
        levels: Some(4),
        irradiance_size: 1,
        ..BakeOptions::default()
    };
    let baked = bake(&studio(), &options);
    let bytes = ktx2(CubeLevels::radiance(&baked.radiance, &baked.roughness), TexelFormat::Rgba32F).expect("written");
    let environment = load(&bytes, "x.ktx2").expect("sound");
    assert_eq!(bake(&environment, &options).radiance, baked.radiance);
    // For another roughness they are filtered anew.
    let other = bake(&environment, &BakeOptions { levels: Some(3), ..options });
    assert_ne!(other.radiance[1].texels, baked.radiance[1].texels);
}

/// Compressed levels, made of a plain file by the means of the crates that undo it.
#[test]
fn supercompression_is_undone() {
    let levels = levels();
    let plain = ktx2(CubeLevels::radiance(&levels, &[0.0, 0.5, 1.0]), TexelFormat::Rgba32F).expect("written");
    let compressed = |scheme: u32, code: &dyn Fn(&[u8]) -> Vec<u8>| {
        let start = long(&plain, 80 + 2 * 24);
        let mut bytes = plain[..start].to_vec();
        bytes[44..48].copy_from_slice(&scheme.to_le_bytes());
        for level in (0..3).rev() {
            let [offset, length] = [0, 8].map(|k| long(&plain, 80 + 24 * level + k));
            let coded = code(&plain[offset..offset + length]);
            let at = 80 + 24 * level;
            let offset = bytes.len() as u64;
            bytes[at..at + 8].copy_from_slice(&offset.to_le_bytes());
            bytes[at + 8..at + 16].copy_from_slice(&(coded.len() as u64).to_le_bytes());
            bytes.extend(coded);
        }
        bytes
    };
    let zlib = |data: &[u8]| miniz_oxide::deflate::compress_to_vec_zlib(data, 6);
    let zstandard = |data: &[u8]| ruzstd::encoding::compress_to_vec(data, ruzstd::encoding::CompressionLevel::Fastest);
    for bytes in [compressed(3, &zlib), compressed(2, &zstandard)] {
        assert_eq!(stored(load(&bytes, "x").expect("sound")).levels, levels);
        // A level that becomes longer or shorter than it should is found out.
        let mut lying = bytes.clone();
        let (first, second) = (80, 80 + 24);
        let entry: [u8; 16] = lying[second..second + 16].try_into().expect("sixteen bytes");
        lying[first..first + 16].copy_from_slice(&entry);
        let error = load(&lying, "x").expect_err("level 0 is level 1").to_string();
        assert!(error.contains("level 0"), "{error}");
    }
}

/// The real files, bit by bit.
#[test]
fn hdre_files_come_back() {
    for name in ["hdre/lounge_64.hdre", "hdre/lythwood_lounge.hdre"] {
        let Some(bytes) = data_file(name) else { return };
        let environment = load(&bytes, name).expect("sound");
        assert!(environment.repairs.is_none(), "{}", environment.repairs);
        let levels = stored(environment);
        let written = hdre(&levels.levels, levels.irradiance_sh.as_ref()).expect("written");
        assert!(written == bytes, "{name} is not the same again");
    }
}

/// Six levels of our own, with the smallest size that the format has.
#[test]
fn hdre_is_written() {
    let levels: Vec<Cube> = (0..6)
        .map(|level| {
            let size = hdre_face(16, level);
            Cube { size, texels: (0..6 * size * size).map(|k| [k as f32, level as f32, -0.0]).collect() }
        })
        .collect();
    let sh: [[f32; 3]; 9] = std::array::from_fn(|k| [k as f32, 1.0, -2.0]);
    let back = stored(load(&hdre(&levels, Some(&sh)).expect("written"), "x").expect("sound"));
    assert_eq!((back.levels, back.irradiance_sh), (levels, Some(sh)));
}

/// The strip of levels is a picture, and the file knows that it is more.
#[test]
fn exr_strips_come_back() {
    let (levels, roughness) = (levels(), [0.0, 0.5, 1.0]);
    let (width, height, texels) = strip(&levels);
    assert_eq!((width, height, texels.len()), (96, 28, 96 * 28));
    assert_eq!(texels[17 * 96 + 8], levels[1].texels[64 + 8], "face 1 of level 1, row 1");
    let bytes = exr(CubeLevels::radiance(&levels, &roughness)).expect("written");
    let back = stored(load(&bytes, "x.exr").expect("sound"));
    assert_eq!((back.levels, back.lobe), (levels.clone(), StoredLobe::Ggx(roughness.to_vec())));
    // Of irradiance it is a plain strip of faces.
    let irradiance = CubeLevels::irradiance_over_pi(&levels[0]);
    let environment = load(&exr(irradiance).expect("written"), "x.exr").expect("sound");
    assert_eq!(environment.layout, Layout::HorizontalStrip);
    assert_eq!(stored(environment).levels, levels[..1]);
}

/// A Radiance file of flat texels whose red counts up from `first`.
fn hdr(width: usize, height: usize, first: u8) -> Vec<u8> {
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    bytes.extend((0..width * height).flat_map(|k| [first + k as u8, 0, 3, 136]));
    bytes
}

#[test]
fn six_files_are_a_cube() {
    let files: Vec<Vec<u8>> = (0..6).map(|face| hdr(2, 2, 10 * face)).collect();
    let names = ["px.hdr", "nx.hdr", "py.hdr", "ny.hdr", "pz.hdr", "nz.hdr"];
    let with = |changed: usize, file: &[u8]| {
        load_faces(std::array::from_fn(|i| (if i == changed { file } else { files[i].as_slice() }, names[i])))
    };
    let cube = &stored(with(6, &[]).expect("sound")).levels[0];
    assert_eq!((cube.size, cube.texels[4 * 4 + 3]), (2, [43.0, 0.0, 3.0]));
    for (changed, file, part) in [
        (2, hdr(2, 1, 0), "square"),
        (3, hdr(4, 4, 0), "the face +X is 2 x 2"),
        (
            5,
            ktx2(CubeLevels::radiance(&levels(), &[0.0, 0.5, 1.0]), TexelFormat::Rgba16F).expect("written"),
            "a whole cube",
        ),
        (1, b"text".to_vec(), "not an environment"),
    ] {
        let error = with(changed, &file).expect_err(part).to_string();
        assert!(error.contains(part) && error.contains(names[changed]), "{error} should say {part}");
    }
}

/// Pictures of the shape of a cross or strip are cubes; a file's own words tell.
#[test]
fn shapes_tell_the_layout() {
    let layout = |width, height| load(&hdr(width, height, 0), "x").expect("sound").layout;
    assert_eq!(layout(12, 2), Layout::HorizontalStrip);
    assert_eq!(layout(2, 12), Layout::VerticalStrip);
    assert_eq!(layout(8, 4), Layout::Equirect);
    // The cells beside the faces count up too, so it is no cross.
    assert_eq!(layout(8, 6), Layout::Equirect);
    assert!(load(&hdr(8, 4, 0), "x").expect("sound").notes.is_empty());
    assert!(load(&hdr(8, 6, 0), "x").expect("sound").notes[0].contains("equirectangular"));
}
