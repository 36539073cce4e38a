//! Other readings of a normal map's texel: hard cases in f32 and f64, and every texel that 8 bits can hold.

use halfvector_maps::Real;
use halfvector_maps::blend::texel_from_normal;
use halfvector_maps::normal::normal_from_texel;
use halfvector_maps::texel::{normal_from_texel_snorm, normal_from_texel_two_channel, texel_from_normal_snorm};
use rayon::prelude::*;

use crate::blend::blends;
use crate::{assert_near, degrees_between, is_unit, r, unit, v, wide};

/// Runs a generic check in both types.
macro_rules! both {
    ($check:ident) => {
        $check::<f32>();
        $check::<f64>();
    };
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Row "normal texel 8-bit flat": centred on 128, (128, 128, 255) is straight up; as unorm it leans by .318 degrees.
#[test]
fn normal_texel_8_bit_flat() {
    fn check<R: Real>() {
        let flat = v([128.0 / 255.0, 128.0 / 255.0, 1.0]);
        assert!(degrees_between(wide(normal_from_texel_snorm::<R>(flat, r(1.0), false)), UP) < 1e-5);
        assert!((degrees_between(wide(normal_from_texel::<R>(flat, r(1.0), false)), UP) - 0.3178).abs() < 1e-3);
    }
    both!(check);
}

/// A neutral texel of a map centred on 128 stays straight up through every blend and back through a colour.
#[test]
fn neutral_snorm_texels_blend_to_straight_up() {
    fn check<R: Real>() {
        let read = |color| normal_from_texel_snorm::<R>(color, r(1.0), false);
        let flat = read(v([128.0 / 255.0, 128.0 / 255.0, 1.0]));
        for (name, blend) in blends::<R>() {
            let up = wide(read(texel_from_normal_snorm(blend(flat, flat))));
            assert!(degrees_between(up, UP) < 1e-4, "{name}: {up:?}");
        }
        let n = unit([0.3, -0.2, 0.9]);
        assert_near(read(texel_from_normal_snorm(v(n))), n, 1e-6);
        // Written as 2 c - 1 and read as centred on 128 it would lean.
        assert!(degrees_between(wide(read(texel_from_normal(flat))), UP) > 0.3);
    }
    both!(check);
}

/// The ends are -1 and 1: code 0 is -1 like code 1, and 255 is 1.
#[test]
fn snorm_ends_are_one() {
    fn check<R: Real>() {
        let x = |code: f64| wide(normal_from_texel_snorm::<R>(v([code / 255.0, 128.0 / 255.0, 1.0]), r(1.0), false));
        assert_near(
            normal_from_texel_snorm::<R>(v([1.0, 128.0 / 255.0, 1.0]), r(1.0), false),
            unit([1.0, 0.0, 1.0]),
            1e-6,
        );
        assert_eq!(x(0.0), x(1.0));
        assert!((x(1.0)[0] + x(255.0)[0]).abs() < 1e-6);
    }
    both!(check);
}

/// Row "normal texel zero": what says nothing is straight up in each reading.
#[test]
fn normal_texel_zero() {
    fn check<R: Real>() {
        assert_eq!(wide(normal_from_texel_snorm::<R>(v([128.0 / 255.0; 3]), r(0.0), false)), UP);
        assert_eq!(wide(normal_from_texel_two_channel::<R>(v([0.5, 0.5, 0.0]), r(1.0), true)), UP);
        assert_eq!(wide(normal_from_texel_two_channel::<R>(v([1.0, 0.5, 0.0]), r(0.0), true)), UP);
    }
    both!(check);
}

/// Row "BC5 z reconstruct": x = .8, y = .7 lies outside of the unit circle; z is 0 and the rest is made unit.
#[test]
fn bc5_z_reconstruct() {
    fn check<R: Real>() {
        let got = normal_from_texel_two_channel::<R>(v([0.9, 0.85, 0.3]), r(1.0), false);
        assert_near(got, unit([0.8, 0.7, 0.0]), 1e-6);
        let got = normal_from_texel_two_channel::<R>(v([0.8, 0.7, 0.0]), r(1.0), true);
        assert_near(got, [0.6, -0.4, (1.0_f64 - 0.52).sqrt()], 1e-6);
    }
    both!(check);
}

/// Strength works on the slope and the flip on y, as in the plain reading.
#[test]
fn strength_and_flip() {
    fn check<R: Real>() {
        let n = [0.3, -0.2, 0.932_737_9];
        let plain = n.map(|x| 0.5 * x + 0.5);
        let (a, b) = (
            normal_from_texel::<R>(v(plain), r(2.0), true),
            normal_from_texel_two_channel::<R>(v(plain), r(2.0), true),
        );
        assert!(degrees_between(wide(a), wide(b)) < 1e-3);
        let centred = n.map(|x| (127.0 * x + 128.0) / 255.0);
        assert!(degrees_between(wide(a), wide(normal_from_texel_snorm::<R>(v(centred), r(2.0), true))) < 1e-3);
    }
    both!(check);
}

/// Values that no texel has give a unit vector too.
#[test]
fn bad_values_are_unit() {
    fn check<R: Real>() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30, -1e30] {
            for k in 0..3 {
                let mut color = [0.3, 0.6, 0.9];
                color[k] = bad;
                for strength in [0.0, 1.0, bad] {
                    assert!(
                        is_unit(normal_from_texel_snorm::<R>(v(color), r(strength), false)),
                        "{color:?} {strength}"
                    );
                    assert!(
                        is_unit(normal_from_texel_two_channel::<R>(v(color), r(strength), false)),
                        "{color:?} {strength}"
                    );
                }
            }
        }
    }
    both!(check);
}

/// All 2^24 texels of an 8-bit map by the centred reading.
#[test]
fn every_8_bit_texel_is_unit() {
    let failed = (0..1_u32 << 24).into_par_iter().with_min_len(1 << 16).find_any(|code| {
        let [r, g, b, _] = code.to_le_bytes().map(|c| f32::from(c) / 255.0);
        !is_unit(normal_from_texel_snorm([r, g, b], 1.0, code & 4 == 0))
    });
    assert_eq!(failed, None);
}

/// All 2^16 texels of an 8-bit two-channel map; of a 16-bit one all x with 256 of y.
#[test]
fn every_two_channel_texel_is_unit() {
    let failed = (0..1_u32 << 24).into_par_iter().with_min_len(1 << 16).find_any(|code| {
        let (x, y) = (code & 0xffff, (code >> 16) * 257);
        let [r, g] = [x, y].map(|c| c as f32 / 65_535.0);
        !is_unit(normal_from_texel_two_channel([r, g, 0.0], 1.0, x & 1 == 0))
            || (x < 256 && !is_unit(normal_from_texel_two_channel([x as f32 / 255.0, g, 0.0], 1.0, false)))
    });
    assert_eq!(failed, None);
}
