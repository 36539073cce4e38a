//! Which way green runs, told by a height map: made surfaces, flipped copies, unrelated maps, and the data folder's.

use halfvector_maps::{Agreement, Channels, GreenSign, Image, Limits, Texels, agreement, decode};

/// Bumps of some size; `seed` moves them.
fn height_at(x: f64, y: f64, seed: f64) -> f64 {
    (x * 0.21 + seed).sin() * (y * 0.17 + 2.0 * seed).cos() + 0.5 * (x * 0.05 + y * 0.09 + seed * 3.0).sin()
}

fn height_map(width: u32, height: u32, seed: f64) -> Image {
    let texel = |i: u32| {
        let h = height_at(f64::from(i % width), f64::from(i / width), seed);
        let c = ((0.5 + 0.25 * h) * 65_535.0).clamp(0.0, 65_535.0) as u16;
        [c, c, c, 65_535]
    };
    Image::new(width, height, Channels::Grey, Texels::U16((0..width * height).map(texel).collect())).unwrap()
}

/// The surface's normals, green up the picture (+1) or down (-1), in 8 bits.
fn normal_map(width: u32, height: u32, seed: f64, green: f64) -> Image {
    let texel = |i: u32| {
        let (x, y) = (f64::from(i % width), f64::from(i / width));
        let dx = (height_at(x + 0.5, y, seed) - height_at(x - 0.5, y, seed)) * 2.0;
        let dy = (height_at(x, y + 0.5, seed) - height_at(x, y - 0.5, seed)) * 2.0;
        let length = (dx * dx + dy * dy + 1.0).sqrt();
        let [r, g, b] =
            [-dx / length, green * dy / length, 1.0 / length].map(|n| ((0.5 * n + 0.5) * 255.0).round() as u8);
        [r, g, b, 255]
    };
    Image::new(width, height, Channels::Rgb, Texels::U8((0..width * height).map(texel).collect())).unwrap()
}

fn flipped(normal: &Image) -> Image {
    let Texels::U8(texels) = normal.texels() else { panic!("8 bits expected") };
    let texels = texels.iter().map(|&[r, g, b, a]| [r, 255 - g, b, a]).collect();
    Image::new(normal.width(), normal.height(), normal.channels(), Texels::U8(texels)).unwrap()
}

#[test]
fn both_signs_are_told() {
    let height = height_map(128, 96, 1.0);
    for (green, want) in [(1.0, GreenSign::PlusY), (-1.0, GreenSign::MinusY)] {
        let found = agreement(&normal_map(128, 96, 1.0, green), &height).unwrap();
        assert_eq!(found.green_sign, want);
        assert!(found.maps_agree() && found.red > 0.99 && found.green.abs() > 0.99, "{found:?}");
        // Codes are 1/4 of the height over 65535, and slopes twice the height's: 8 texels from black to white.
        assert!((found.height_in_texels - 8.0).abs() < 0.2 && found.mean_degrees < 1.0, "{found:?}");
    }
}

/// A height map of another size is averaged to fit, a normal map too.
#[test]
fn sizes_may_differ_by_levels() {
    for (normal, height) in [((256, 128), (128, 64)), ((128, 64), (256, 128))] {
        let map = |size: (u32, u32), scale: f64| {
            let texel = |i: u32| {
                let (x, y) = (f64::from(i % size.0) * scale, f64::from(i / size.0) * scale);
                let h = height_at(x, y, 1.0);
                let c = ((0.5 + 0.25 * h) * 65_535.0) as u16;
                [c, c, c, 65_535]
            };
            Image::new(size.0, size.1, Channels::Grey, Texels::U16((0..size.0 * size.1).map(texel).collect())).unwrap()
        };
        let found = agreement(
            &normal_map(normal.0, normal.1, 1.0, 1.0),
            &map(height, f64::from(normal.0) / f64::from(height.0)),
        );
        assert_eq!(found.map(|found| found.green_sign), Some(GreenSign::PlusY), "{found:?}");
    }
    assert_eq!(agreement(&normal_map(64, 64, 1.0, 1.0), &height_map(64, 32, 1.0)), None);
    assert_eq!(agreement(&normal_map(4, 4, 1.0, 1.0), &height_map(4, 4, 1.0)), None);
}

/// Unrelated, flat and random maps say nothing.
#[test]
fn what_is_unrelated_is_unknown() {
    let height = height_map(256, 256, 1.0);
    let flat = Image::new(256, 256, Channels::Rgb, Texels::U8(vec![[128, 128, 255, 255]; 65_536])).unwrap();
    let random = (0..65_536_u32).map(|i| {
        let hash = i.wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b);
        let [r, g, ..] = hash.to_le_bytes();
        [r, g, 255, 255]
    });
    let random = Image::new(256, 256, Channels::Rgb, Texels::U8(random.collect())).unwrap();
    for normal in [flat, random] {
        let found = agreement(&normal, &height).unwrap();
        assert_eq!(found.green_sign, GreenSign::Unknown, "{found:?}");
        assert!(!found.maps_agree());
    }
    // Noise of another seed, at frequencies that do not beat with the first.
    let other = normal_map(256, 256, 1.0, 1.0);
    let turned = {
        let Texels::U8(texels) = other.texels() else { panic!("8 bits expected") };
        let texels = (0..65_536).map(|i| texels[(i % 256) * 256 + (97 * (i / 256)) % 256]).collect();
        Image::new(256, 256, Channels::Rgb, Texels::U8(texels)).unwrap()
    };
    assert_eq!(agreement(&turned, &height).unwrap().green_sign, GreenSign::Unknown);
}

/// Metal_Mesh_008: +Y, and its height map agrees; a flipped copy is -Y; another map's heights say nothing.
#[test]
fn metal_mesh_is_plus_y() {
    let folder = crate::data();
    let read = |path: &str| {
        let bytes = std::fs::read(folder.join(path)).ok()?;
        Some(decode(&bytes, Limits::default()).unwrap().into_data().image)
    };
    let (Some(normal), Some(height)) =
        (read("textures/Metal_Mesh_008/normalmap.jpg"), read("textures/Metal_Mesh_008/heightmap.png"))
    else {
        println!("skipped: no textures in {}", folder.display());
        return;
    };
    let found = agreement(&normal, &height).unwrap();
    println!("{found:?}");
    assert!(found.green_sign == GreenSign::PlusY && found.maps_agree(), "{found:?}");
    // The data's README has 0.958 and 0.712, of the normals' components instead of their slopes.
    assert!(found.green > 0.9 && found.red > 0.65, "{found:?}");
    let found = agreement(&flipped(&normal), &height).unwrap();
    assert!(found.green_sign == GreenSign::MinusY && found.maps_agree(), "{found:?}");
    let Some(bricks) = read("mtlx/resources/Images/brick_normal.jpg") else {
        println!("skipped: no brick_normal.jpg in {}", folder.display());
        return;
    };
    let found: Agreement = agreement(&bricks, &height).unwrap();
    println!("bricks: {found:?}");
    assert_eq!(found.green_sign, GreenSign::Unknown);
}
