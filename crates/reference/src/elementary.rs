//! Elementary functions in f64 without a branch or a call, so that loops over many numbers are widened to vectors. Made of
//! sums, products, quotients and choices that every machine rounds alike; errors are below 1e-15.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

pub(crate) use halfvector_interp::elementary::choose;
use halfvector_interp::elementary::{ROUND, polynomial};

/// A whole number of 0..2^32 as an integer, without the conversion's care for all others.
#[inline(always)]
pub(crate) fn whole(x: f64) -> u32 {
    (x + ROUND).to_bits() as u32
}

/// The angle of (x, y) in -pi..pi; 0 for the origin.
///
/// Of the quotient q of the shorter leg by the longer, or (q - 1) / (q + 1) above tan(pi/8), so that its square z is below
/// 0.1716; there atan(sqrt(z)) / sqrt(z) is interpolated at 13 Chebyshev nodes, within 3e-18.
#[inline(always)]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    let (ay, ax) = (y.abs(), x.abs());
    let steep = ay > ax;
    let (small, large) = (choose(steep, ax, ay), choose(steep, ay, ax));
    let upper = small > 0.414_213_562_373_095_03 * large;
    let (over, under) = (choose(upper, small - large, small), choose(upper, small + large, large));
    let t = over / choose(under == 0.0, 1.0, under);
    let series = polynomial(
        t * t,
        [
            1.0,
            -0.333_333_333_333_333_26,
            0.199_999_999_999_970_15,
            -0.142_857_142_853_297_1,
            0.111_111_110_853_221_09,
            -0.090_909_080_590_311_9,
            0.076_922_810_999_377_44,
            -0.066_662_052_599_765_26,
            0.058_768_340_046_141_61,
            -0.052_173_125_740_615_91,
            0.044_995_007_289_840_32,
            -0.033_387_824_501_211_93,
            0.015_113_765_096_600_925,
        ],
    );
    let angle = choose(upper, FRAC_PI_4, 0.0) + t * series;
    let angle = choose(steep, FRAC_PI_2 - angle, angle);
    let angle = choose(x.is_sign_negative(), PI - angle, angle);
    angle.copysign(y)
}

/// Sine and cosine of an angle in full turns, |turns| < 1e6. Taylor's series on a quarter turn; the next terms are
/// (pi/4)^17 / 17! = 5e-17 and (pi/4)^18 / 18! = 2e-18.
#[inline(always)]
pub(crate) fn sin_cos_of_turns(turns: f64) -> (f64, f64) {
    let shifted = turns * 4.0 + ROUND;
    let r = (turns - (shifted - ROUND) * 0.25) * TAU;
    let r2 = r * r;
    let sin = r * polynomial(
        r2,
        [
            1.0,
            -1.0 / 6.0,
            1.0 / 120.0,
            -1.0 / 5040.0,
            1.0 / 362_880.0,
            -1.0 / 39_916_800.0,
            1.0 / 6_227_020_800.0,
            -1.0 / 1_307_674_368_000.0,
        ],
    );
    let cos = polynomial(
        r2,
        [
            1.0,
            -1.0 / 2.0,
            1.0 / 24.0,
            -1.0 / 720.0,
            1.0 / 40320.0,
            -1.0 / 3_628_800.0,
            1.0 / 479_001_600.0,
            -1.0 / 87_178_291_200.0,
            1.0 / 20_922_789_888_000.0,
        ],
    );
    let quarter = shifted.to_bits();
    let odd = quarter & 1 != 0;
    let turned = |x: f64, half: u64| f64::from_bits(x.to_bits() ^ ((half & 2) << 62));
    (turned(choose(odd, cos, sin), quarter), turned(choose(odd, sin, cos), quarter.wrapping_add(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn as_the_standard_library() {
        let mut random = Random::new(5, 0, 0);
        for _ in 0..20_000 {
            let [a, b] = random.pair();
            let size = (60.0 * (random.number() - 0.5)).exp2();
            let (y, x) = (2.0 * a - 1.0, (2.0 * b - 1.0) * size);
            assert!((atan2(y, x) - y.atan2(x)).abs() <= 1e-15, "{y} {x}");
            let turns = 3.0 * x.clamp(-1.0, 1.0);
            // What the standard library loses by an angle that is no exact multiple of a turn.
            let lost = 2e-16 * (TAU * turns).abs();
            let ((sin, cos), (sin_there, cos_there)) = (sin_cos_of_turns(turns), (TAU * turns).sin_cos());
            assert!((sin - sin_there).abs().max((cos - cos_there).abs()) <= 1e-15 + lost, "{turns}");
        }
        for (y, x) in [(0.0, 0.0), (0.0, -1.0), (-0.0, -1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (2.0, -2.0)] {
            assert_eq!(atan2(y, x), f64::atan2(y, x), "{y} {x}");
        }
        assert_eq!([0.0, 0.25, 0.5, -0.25].map(sin_cos_of_turns), [(0.0, 1.0), (1.0, 0.0), (-0.0, -1.0), (-1.0, 0.0)]);
        assert_eq!([0.0, 7.0, 4_294_967_295.0].map(whole), [0, 7, u32::MAX]);
    }
}
