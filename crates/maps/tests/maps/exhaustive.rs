//! Every texel that a map can hold.

use halfvector_maps::color::{linear_from_srgb, srgb_from_linear};
use halfvector_maps::normal::{normal_from_texel, normal_rotation_fixed, normal_rotation_report, normal_tbn};
use halfvector_maps::{Channels, ColorSpace, Image, MapKind, Texels, mip_chain};
use rayon::prelude::*;

use crate::is_unit;

/// A normal and tangent with nothing special about them, and the axes that the rotations are worst on.
const NORMALS: [[f32; 3]; 4] =
    [[0.267_261_24, -0.534_522_5, 0.801_783_7], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]];

fn every_method_is_unit(color: [f32; 3], normal: [f32; 3], flip_y: bool) -> bool {
    let t = normal_from_texel(color, 1.0, flip_y);
    is_unit(t)
        && is_unit(normal_tbn(t, normal, [0.6, 0.0, -0.8, 1.0]))
        && is_unit(normal_rotation_report(t, normal))
        && is_unit(normal_rotation_fixed(t, normal))
}

/// All 2^24 texels of an 8-bit map, all methods; the normals take turns, so that each meets a quarter of the texels.
#[test]
fn every_8_bit_texel_is_unit() {
    let failed = (0..1_u32 << 24).into_par_iter().with_min_len(1 << 16).find_any(|&code| {
        let [r, g, b, _] = code.to_le_bytes().map(|c| f32::from(c) / 255.0);
        !every_method_is_unit([r, g, b], NORMALS[((code ^ code >> 9) % 4) as usize], code & 4 == 0)
    });
    assert_eq!(failed, None);
}

/// All 2^16 values of each channel of a 16-bit map, the others at the ends and on both sides of the middle.
#[test]
fn every_16_bit_value_is_unit() {
    const OTHERS: [u16; 4] = [0, 32_767, 32_768, 65_535];
    let failed = (0..=u16::MAX).into_par_iter().with_min_len(1 << 10).find_any(|&value| {
        OTHERS.iter().any(|&a| {
            OTHERS.iter().any(|&b| {
                [[value, a, b], [a, value, b], [a, b, value]].iter().any(|codes| {
                    let color = codes.map(|c| f32::from(c) / 65535.0);
                    !every_method_is_unit(color, NORMALS[usize::from(value % 4)], false)
                })
            })
        })
    });
    assert_eq!(failed, None);
}

/// Every 8- and 16-bit sRGB code survives decoding and encoding in f32, and codes keep their order.
#[test]
fn every_srgb_code_survives() {
    let mut last = -1.0;
    for code in 0..=u16::MAX {
        let linear = linear_from_srgb([f32::from(code) / 65535.0; 3])[0];
        assert!(linear > last);
        last = linear;
        assert_eq!((srgb_from_linear([linear; 3])[0] * 65535.0).round(), f32::from(code));
    }
}

/// A map of one texel value has that value in all its levels: every 8-bit code, sRGB and linear, every odd-sized box.
#[test]
fn every_8_bit_code_is_its_own_mean() {
    for code in 0..=u8::MAX {
        let texels = Texels::U8(vec![[code, 255 - code, code, code]; 7 * 5]);
        let image = Image::new(7, 5, Channels::Rgba, texels).unwrap();
        for (space, kind) in [
            (ColorSpace::Srgb, MapKind::Color),
            (ColorSpace::Srgb, MapKind::Data),
            (ColorSpace::Linear, MapKind::Color),
            (ColorSpace::Linear, MapKind::Data),
        ] {
            let levels = mip_chain(&image, space, kind);
            assert_eq!(levels.len(), 3);
            for level in levels {
                assert_eq!(level.texels(), &Texels::U8(vec![[code, 255 - code, code, code]; level.texels().len()]));
            }
        }
    }
}
