//! Mip chains: sizes, means, alpha, normals, against sums in f64.

use halfvector_maps::color::linear_from_srgb;
use halfvector_maps::{Channels, ColorSpace, Image, MapKind, Texels, mip_chain};

use crate::{degrees_between, unit, wide};

/// Texels of no pattern.
fn noise(count: usize) -> Vec<[u8; 4]> {
    let mut state = 0x9e37_79b9_u32;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 24) as u8
    };
    (0..count).map(|_| [next(), next(), next(), next()]).collect()
}

fn image(width: u32, height: u32, channels: Channels, texels: Texels) -> Image {
    Image::new(width, height, channels, texels).unwrap()
}

#[test]
fn levels_go_down_to_one_texel_for_any_size() {
    for (width, height) in [(1, 1), (2, 1), (1, 7), (3, 3), (5, 4), (16, 16), (17, 9), (64, 3), (100, 33), (1023, 2)] {
        let texels = noise((width * height) as usize);
        let levels =
            mip_chain(&image(width, height, Channels::Rgb, Texels::U8(texels)), ColorSpace::Srgb, MapKind::Color);
        let longest: u32 = width.max(height);
        assert_eq!(levels.len() as u32, longest.ilog2() + 1);
        for (i, level) in levels.iter().enumerate() {
            assert_eq!((level.width(), level.height()), ((width >> i).max(1), (height >> i).max(1)));
        }
    }
}

/// The mean of every level is the mean of the first, in linear light, for sizes that are no powers of two.
#[test]
fn every_level_has_the_mean_of_the_first() {
    for (width, height) in [(37, 23), (64, 64), (3, 5), (1, 31), (99, 2)] {
        let texels: Vec<[f32; 4]> =
            noise((width * height) as usize).iter().map(|t| t.map(|c| f32::from(c) / 16.0)).collect();
        let image = image(width, height, Channels::Rgb, Texels::F32(texels));
        let mean = |image: &Image| {
            let Texels::F32(texels) = image.texels() else { panic!("the format changed") };
            [0, 1, 2, 3].map(|k| texels.iter().map(|t| f64::from(t[k])).sum::<f64>() / texels.len() as f64)
        };
        let want = mean(&image);
        for level in mip_chain(&image, ColorSpace::Linear, MapKind::Data) {
            for (got, want) in mean(&level).into_iter().zip(want) {
                assert!((got - want).abs() < 1e-5 * want, "{width} x {height}: {got} is not {want}");
            }
        }
    }
}

/// Black and white average to linear one half, which is sRGB code 188, not 128; as data to 128.
#[test]
fn colours_average_in_linear_light() {
    let texels = vec![[0, 0, 0, 255], [255, 255, 255, 255]];
    let checker = image(2, 1, Channels::Rgb, Texels::U8(texels));
    let last = |space, kind| mip_chain(&checker, space, kind).pop().unwrap().texel(0, 0).map(|c| (c * 255.0) as u8);
    assert_eq!(last(ColorSpace::Srgb, MapKind::Color), [188, 188, 188, 255]);
    assert_eq!(last(ColorSpace::Linear, MapKind::Data), [128, 128, 128, 255]);
}

/// An odd width: 3 -> 1 weighs all three alike (dropping the last column would give 0), and 5 -> 2 by covered area.
#[test]
fn odd_sizes_are_weighted_by_area() {
    let row = |values: &[f32]| {
        let texels = values.iter().map(|&x| [x, 0.0, 0.0, 1.0]).collect();
        image(values.len() as u32, 1, Channels::Rgb, Texels::F32(texels))
    };
    let level = mip_chain(&row(&[0.0, 0.0, 3.0]), ColorSpace::Linear, MapKind::Data);
    assert!((level[1].texel(0, 0)[0] - 1.0).abs() < 1e-6);
    let level = mip_chain(&row(&[1.0, 2.0, 4.0, 8.0, 16.0]), ColorSpace::Linear, MapKind::Data);
    // Each of the two covers 2.5: (1 + 2 + 4/2) / 2.5 and (4/2 + 8 + 16) / 2.5.
    assert!((level[1].texel(0, 0)[0] - 2.0).abs() < 1e-6);
    assert!((level[1].texel(1, 0)[0] - 10.4).abs() < 1e-5);
}

/// What cannot be seen does not bleed: opaque red beside transparent green stays red. Data keep their plain mean.
#[test]
fn transparent_texels_do_not_bleed() {
    let texels = vec![[255, 0, 0, 255], [0, 255, 0, 0], [0, 255, 0, 0], [0, 255, 0, 0]];
    let leaf = image(2, 2, Channels::Rgba, Texels::U8(texels));
    let last = |kind| mip_chain(&leaf, ColorSpace::Srgb, kind).pop().unwrap();
    assert_eq!(last(MapKind::Color).texels(), &Texels::U8(vec![[255, 0, 0, 64]]));
    assert_eq!(last(MapKind::Data).texels(), &Texels::U8(vec![[137, 225, 0, 64]]));
}

/// Where nothing can be seen the colour is the plain mean, and not 0/0.
#[test]
fn all_transparent_keeps_its_colour() {
    let leaf = image(2, 1, Channels::Rgba, Texels::U8(vec![[200, 10, 30, 0]; 2]));
    let last = mip_chain(&leaf, ColorSpace::Srgb, MapKind::Color).pop().unwrap();
    assert_eq!(last.texels(), &Texels::U8(vec![[200, 10, 30, 0]]));
}

/// Through a whole chain, alpha-weighted colour is the alpha-weighted mean of the first level.
#[test]
fn alpha_weights_hold_over_the_chain() {
    let texels = noise(64 * 64);
    let (mut sum, mut weight) = ([0.0; 3], 0.0);
    for texel in &texels {
        let [r, g, b, a] = texel.map(|c| f64::from(c) / 255.0);
        let linear = linear_from_srgb([r, g, b]);
        for k in 0..3 {
            sum[k] += a * linear[k];
        }
        weight += a;
    }
    let want = halfvector_maps::color::srgb_from_linear(sum.map(|x| x / weight)).map(|s| (s * 255.0).round() as u8);
    let last = mip_chain(&image(64, 64, Channels::Rgba, Texels::U8(texels)), ColorSpace::Srgb, MapKind::Color).pop();
    let Some(Texels::U8(texels)) = last.map(Image::into_texels) else { panic!("the format changed") };
    assert_eq!([texels[0][0], texels[0][1], texels[0][2]], want);
    assert_eq!(texels[0][3], (weight / 4096.0 * 255.0).round() as u8);
}

/// Normals average as vectors and stay unit to the format's step; opposite ones give straight up, not NaN.
#[test]
fn normals_average_as_vectors() {
    let code = |n: [f64; 3]| {
        let [x, y, z] = n.map(|x| ((0.5 * x + 0.5) * 65535.0).round() as u16);
        [x, y, z, 65535]
    };
    let (a, b) = (unit([0.6, 0.0, 0.8]), unit([0.0, -0.8, 0.2]));
    let map = image(2, 1, Channels::Rgb, Texels::U16(vec![code(a), code(b)]));
    for space in [ColorSpace::Linear, ColorSpace::Srgb] {
        let last = mip_chain(&map, space, MapKind::Normal).pop().unwrap().texel(0, 0);
        let n = wide([last[0], last[1], last[2]]).map(|c| 2.0 * c - 1.0);
        assert!(degrees_between(n, [a[0] + b[0], a[1] + b[1], a[2] + b[2]]) < 0.01, "{n:?}");
        assert!((crate::length(n) - 1.0).abs() < 1e-4);
    }
    let opposed = image(2, 1, Channels::Rgb, Texels::F32(vec![[1.0, 0.5, 0.5, 1.0], [0.0, 0.5, 0.5, 1.0]]));
    let last = mip_chain(&opposed, ColorSpace::Linear, MapKind::Normal).pop().unwrap();
    assert_eq!(last.texel(0, 0), [0.5, 0.5, 1.0, 1.0]);
}

/// Rows "HDR mean in f16" and "HDR inf*0": large values do not overflow and a NaN does not spread.
#[test]
fn large_values_and_nan_stay_finite() {
    let texels = vec![[f32::MAX, 60000.0, f32::NAN, 1.0]; 4];
    let last = mip_chain(&image(2, 2, Channels::Rgba, Texels::F32(texels)), ColorSpace::Linear, MapKind::Color).pop();
    let texel = last.unwrap().texel(0, 0);
    assert_eq!(texel, [f32::MAX, 60000.0, 0.0, 1.0]);
}

/// The levels of a 16-bit and of a float image agree with each other, in sRGB too.
#[test]
fn formats_agree() {
    let codes = noise(21 * 13);
    let as_u16 = codes.iter().map(|t| t.map(|c| u16::from(c) * 257)).collect();
    let as_f32 = codes.iter().map(|t| t.map(|c| f32::from(c) / 255.0)).collect();
    let chains = [Texels::U8(codes), Texels::U16(as_u16), Texels::F32(as_f32)]
        .map(|texels| mip_chain(&image(21, 13, Channels::Rgba, texels), ColorSpace::Srgb, MapKind::Color));
    let [u8s, u16s, f32s] = &chains;
    assert_eq!((u8s.len(), u16s.len(), f32s.len()), (5, 5, 5));
    for ((a, b), c) in u8s.iter().zip(u16s).zip(f32s) {
        for y in 0..a.height() {
            for x in 0..a.width() {
                let [a, b, c] = [a, b, c].map(|level| level.texel(x, y));
                for k in 0..4 {
                    assert!((a[k] - c[k]).abs() <= 0.5 / 255.0 + 1e-5 && (b[k] - c[k]).abs() <= 0.5 / 65535.0 + 1e-5);
                }
            }
        }
    }
}
