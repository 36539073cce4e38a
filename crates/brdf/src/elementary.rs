//! Elementary functions without a branch or a call, for [`Lane`]. Coefficients: least maximum error by Lawson's
//! reweighted least squares, rounded to f32.

use crate::Real;
use crate::lanes::Lane;

/// 1.5 * 2^23: added to a number below 2^22 it leaves the nearest integer in the lowest bits, without a conversion,
/// whose behaviour outside of the integers' range would cost three more instructions.
const ROUND: f32 = 12_582_912.0;
const ROUND_F64: f64 = 6_755_399_441_055_744.0;

#[inline(always)]
fn polynomial<const FUSED: bool, const WIDE: bool, const N: usize>(
    x: Lane<FUSED, WIDE>,
    coefficients: [f32; N],
) -> Lane<FUSED, WIDE> {
    let mut sum = Lane(coefficients[N - 1]);
    for i in (0..N - 1).rev() {
        sum = sum.mul_add(x, Lane(coefficients[i]));
    }
    sum
}

#[inline(always)]
fn polynomial_f64<const N: usize>(x: f64, coefficients: [f64; N]) -> f64 {
    let mut sum = coefficients[N - 1];
    for i in (0..N - 1).rev() {
        sum = sum * x + coefficients[i];
    }
    sum
}

/// x y (1 + r)^(-1/2), y = 1 / sqrt(x) within 3.6 %, by halving the exponent of x, r = x y^2 - 1.
#[inline(always)]
pub(crate) fn sqrt_by_products<const FUSED: bool, const WIDE: bool>(x: Lane<FUSED, WIDE>) -> Lane<FUSED, WIDE> {
    /// 3/2 of the exponent's bias, less what centres the error.
    const HALF: u32 = 0x5f37_0000;
    const C: [f32; 4] = [-0.499_998_42, 0.374_985_2, -0.313_887_8, 0.278_575_3];
    let inverse = Lane(f32::from_bits(HALF.wrapping_sub(x.0.to_bits() >> 1)));
    let root = x * inverse;
    let r = root.mul_add(inverse, Lane(-1.0));
    (root * r).mul_add(polynomial(r, C), root)
}

/// x 2^n in two steps, so that neither factor leaves the range while the product is within it. |n| <= 252.
#[inline(always)]
fn scale_by_power_of_2(x: f32, n: i32) -> f32 {
    let half = n >> 1;
    let power = |n: i32| f32::from_bits(((n + 127) << 23) as u32);
    x * power(half) * power(n - half)
}

/// 2^(n + f), f in [-1/2, 1/2].
#[inline(always)]
fn exp2_of_parts<const FUSED: bool, const WIDE: bool>(n: i32, f: Lane<FUSED, WIDE>) -> f32 {
    const C: [f32; 7] =
        [1.0, core::f32::consts::LN_2, 0.240_226_5, 0.055_503_324, 0.009_618_438, 0.001_339_887_5, 0.000_153_533_6];
    scale_by_power_of_2(polynomial(f, C).0, n)
}

/// 2^x by its nearest integer and a polynomial of degree 6.
#[inline(always)]
pub(crate) fn exp2<const FUSED: bool, const WIDE: bool>(x: Lane<FUSED, WIDE>) -> Lane<FUSED, WIDE> {
    let held = x.clamp(Lane(-160.0), Lane(130.0)).0;
    let rounded = held + ROUND;
    let n = rounded.to_bits() as i32 - ROUND.to_bits() as i32;
    let result = exp2_of_parts::<FUSED, WIDE>(n, Lane(held - (rounded - ROUND)));
    Lane(if x.0.is_nan() { x.0 } else { result })
}

/// The exponent n and the mantissa m in [sqrt(1/2), sqrt(2)) of a positive number; denormal ones included.
#[inline(always)]
fn parts(x: f32) -> (i32, f32) {
    const SQRT_HALF: u32 = 0x3f35_04f3;
    let denormal = x < f32::MIN_POSITIVE;
    let normal = if denormal { x * 8_388_608.0 } else { x };
    let bits = normal.to_bits().wrapping_sub(SQRT_HALF);
    let n = (bits as i32 >> 23) - if denormal { 23 } else { 0 };
    (n, f32::from_bits((bits & 0x007f_ffff).wrapping_add(SQRT_HALF)))
}

/// The logarithm's values where it has no parts.
#[inline(always)]
fn log2_edges(x: f32, inside: f32) -> f32 {
    let finite = if x == 0.0 { f32::NEG_INFINITY } else { inside };
    let real = if x < 0.0 { f32::NAN } else { finite };
    if x < f32::INFINITY { real } else { x }
}

/// log2 x = n + log2(1 + f), f = m - 1, by f times a polynomial of degree 9.
#[inline(always)]
pub(crate) fn log2<const FUSED: bool, const WIDE: bool>(x: Lane<FUSED, WIDE>) -> Lane<FUSED, WIDE> {
    const C: [f32; 10] = [
        core::f32::consts::LOG2_E,
        -0.721_347_33,
        0.480_898_23,
        -0.360_696_64,
        0.288_567_4,
        -0.239_617_39,
        0.204_600_77,
        -0.191_062_97,
        0.186_174_14,
        -0.109_948_054,
    ];
    let (n, m) = parts(x.0);
    let f = Lane::<FUSED, WIDE>(m - 1.0);
    Lane(log2_edges(x.0, f.mul_add(polynomial(f, C), Lane(n as f32)).0))
}

/// x^y = 2^(y log2 x), the exponent in f64: in f32 its rounding alone would cost up to 60 ulp.
/// log2 m = 2 / ln 2 atanh(s), s = (m - 1) / (m + 1).
#[inline(always)]
pub(crate) fn powf<const FUSED: bool, const WIDE: bool>(
    x: Lane<FUSED, WIDE>,
    y: Lane<FUSED, WIDE>,
) -> Lane<FUSED, WIDE> {
    const C: [f64; 5] = [
        2.885_390_081_790_143,
        0.961_796_673_283_251,
        0.577_083_594_573_237,
        0.411_672_213_578_386,
        0.340_738_414_948_224,
    ];
    let (n, m) = parts(x.0);
    let m = f64::from(m);
    let s = (m - 1.0) / (m + 1.0);
    let log = f64::from(n) + s * polynomial_f64(s * s, C);
    let exponent = Real::clamp(log * f64::from(y.0), -160.0, 130.0);
    let rounded = exponent + ROUND_F64;
    let fraction = exponent - (rounded - ROUND_F64);
    let inside = exp2_of_parts::<FUSED, WIDE>(rounded.to_bits() as i32, Lane(fraction as f32));
    // 0 and infinity have no logarithm: their powers are 0, 1 or infinity by the signs alone.
    let grows = (x.0 > 1.0) == (y.0 > 0.0);
    let at_end = if grows { f32::INFINITY } else { 0.0 };
    let real = if x.0 == 0.0 || x.0 == f32::INFINITY { at_end } else { inside };
    let defined = if x.0 >= 0.0 && !y.0.is_nan() { real } else { f32::NAN };
    Lane(if y.0 == 0.0 { 1.0 } else { defined })
}

/// Cody and Waite 1980, Software Manual for the Elementary Functions: the angle less the nearest multiple n of pi/2, which
/// is taken away in three parts of few digits, so that n times each is exact. Then a polynomial for each function.
#[inline(always)]
pub(crate) fn sin_cos<const FUSED: bool, const WIDE: bool>(
    x: Lane<FUSED, WIDE>,
) -> (Lane<FUSED, WIDE>, Lane<FUSED, WIDE>) {
    const PI_2: [f32; 3] = [1.570_312_5, 0.000_483_751_297, 7.549_790_126e-8];
    let rounded = x.0 * core::f32::consts::FRAC_2_PI + ROUND;
    let quadrant = rounded.to_bits();
    let n = Lane::<FUSED, WIDE>(rounded - ROUND);
    let r = PI_2.iter().fold(x, |r, &part| n.mul_add(Lane(-part), r));
    let t = r * r;
    let sine = (r * t).mul_add(polynomial(t, [-0.166_666_55, 0.008_332_178, -0.000_195_172_98]), r);
    let cosine = (t * t).mul_add(
        polynomial(t, [0.041_666_646, -0.001_388_736_8, 2.443_845e-5]),
        t.mul_add(Lane::<FUSED, WIDE>(-0.5), Lane::<FUSED, WIDE>(1.0)),
    );
    let odd = quadrant & 1 == 1;
    let (s, c) = if odd { (cosine.0, sine.0) } else { (sine.0, cosine.0) };
    let sign = |q: u32| (q & 2) << 30;
    (
        Lane(f32::from_bits(s.to_bits() ^ sign(quadrant))),
        Lane(f32::from_bits(c.to_bits() ^ sign(quadrant.wrapping_add(1)))),
    )
}

/// acos |x| = pi/2 - asin |x| below 1/2 and 2 asin sqrt((1 - |x|) / 2) above, where the former would cancel;
/// pi less it for negative x.
#[inline(always)]
pub(crate) fn acos<const FUSED: bool, const WIDE: bool>(x: Lane<FUSED, WIDE>) -> Lane<FUSED, WIDE> {
    const C: [f32; 6] = [0.166_666_6, 0.075_005_11, 0.044_515_72, 0.031_817_608, 0.014_402_616, 0.037_565_187];
    let size = x.abs();
    let high = 0.5 < size.0;
    let t: Lane<FUSED, WIDE> =
        if high { (Lane::<FUSED, WIDE>(1.0) - size) * Lane::<FUSED, WIDE>(0.5) } else { size * size };
    let s = if high { t.sqrt() } else { size };
    let asin = (s * t).mul_add(polynomial(t, C), s);
    let positive = if high { asin + asin } else { Lane::<FUSED, WIDE>(core::f32::consts::FRAC_PI_2) - asin };
    Lane(if x.0 < 0.0 { core::f32::consts::PI - positive.0 } else { positive.0 })
}
