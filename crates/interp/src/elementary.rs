//! Elementary functions for arguments and results of f32, computed in f64 without branches: relative errors are below
//! 1e-9, so that the result rounded to f32 is within one unit in the last place. Polynomials are Taylor series after a
//! reduction of the range; numbers beside the functions say what is left out.
//!
//! They are no replacement for the f64 functions of the standard library.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E, PI};

/// 1.5 * 2^52: added to a number of less than 2^51 it rounds that to an integer, which stands in the low bits.
pub const ROUND: f64 = 6_755_399_441_055_744.0;

/// The sum of `coefficients[i] * x^i`.
#[inline(always)]
pub fn polynomial<const N: usize>(x: f64, coefficients: [f64; N]) -> f64 {
    let mut sum = coefficients[N - 1];
    let mut i = N - 1;
    while i > 0 {
        i -= 1;
        sum = sum * x + coefficients[i];
    }
    sum
}

/// One number or the other, without a branch where loops are widened.
#[inline(always)]
pub fn choose(condition: bool, accept: f64, reject: f64) -> f64 {
    if condition { accept } else { reject }
}

/// 2^x. The fraction is in [-1/2, 1/2]; the next term of the series is (ln 2 / 2)^10 / 10! = 7e-12.
#[inline(always)]
pub(crate) fn exp2(x: f64) -> f64 {
    let bounded = choose(x < -300.0, -300.0, choose(x > 300.0, 300.0, x));
    let shifted = bounded + ROUND;
    let power = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    let t = (bounded - (shifted - ROUND)) * LN_2;
    let series = polynomial(
        t,
        [
            1.0,
            1.0,
            1.0 / 2.0,
            1.0 / 6.0,
            1.0 / 24.0,
            1.0 / 120.0,
            1.0 / 720.0,
            1.0 / 5040.0,
            1.0 / 40320.0,
            1.0 / 362_880.0,
        ],
    );
    power * series
}

#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    exp2(x * LOG2_E)
}

/// log2 of a number that an f32 can hold. The significand is in [sqrt(1/2), sqrt(2)), so that s = (m-1)/(m+1) is below
/// 0.1716, and the next term of the series is s^17 / 17 = 6e-15.
#[inline(always)]
pub(crate) fn log2(x: f64) -> f64 {
    let bits = x.to_bits();
    // The significand as a number of [1, 2), and what the exponent is, both without a conversion of integers.
    let m = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000);
    let exponent = f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - 4_503_599_627_370_496.0 - 1023.0;
    let upper = m > std::f64::consts::SQRT_2;
    let m = choose(upper, m * 0.5, m);
    let exponent = choose(upper, exponent + 1.0, exponent);
    let s = (m - 1.0) / (m + 1.0);
    let series =
        polynomial(s * s, [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0]);
    let finite = exponent + 2.0 * LOG2_E * s * series;
    let at_end = choose(x == 0.0, f64::NEG_INFINITY, choose(x == f64::INFINITY, x, f64::NAN));
    choose((x > 0.0) & (x < f64::INFINITY), finite, at_end)
}

#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    log2(x) * LN_2
}

/// x^y for x >= 0, with x^0 = 1; NaN for a negative x, as 2^(y log2 x) has it.
#[inline(always)]
pub(crate) fn pow(x: f64, y: f64) -> f64 {
    let product = y * log2(x);
    let power = exp2(product);
    // Beyond the bounds of exp2 the result is 0 or infinite in f32 either way; NaN passes through the comparison.
    let power = choose(product.is_nan(), product, power);
    choose((y == 0.0) & (x >= 0.0), 1.0, choose(x == 1.0, choose(y.is_nan(), y, 1.0), power))
}

/// The remainder of x by pi/2 in [-pi/4, pi/4], and the quotient's two low bits; right for |x| up to 1e9.
#[inline(always)]
fn quarter_turns(x: f64) -> (f64, u64) {
    // pi/2 in three parts of 33, 33 and 53 bits: the products with a quotient of up to 2^20 are exact, and those with
    // one of up to 2^30 are in error by 1e-9 of f32's own spacing there.
    const HIGH: f64 = 1.570_796_326_734_125_6;
    const MIDDLE: f64 = 6.077_100_506_303_966e-11;
    const LOW: f64 = 2.022_266_248_795_950_6e-21;
    let shifted = x * (1.0 / FRAC_PI_2) + ROUND;
    let k = shifted - ROUND;
    (((x - k * HIGH) - k * MIDDLE) - k * LOW, shifted.to_bits())
}

/// Series of sine and cosine on [-pi/4, pi/4]; the next terms are 0.785^13 / 13! = 7e-12 and 0.785^14 / 14! = 4e-13.
#[inline(always)]
fn sin_cos_near_0(r: f64) -> (f64, f64) {
    let r2 = r * r;
    let sin = r * polynomial(r2, [1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0, -1.0 / 39_916_800.0]);
    let cos = polynomial(
        r2,
        [1.0, -1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0],
    );
    (sin, cos)
}

#[inline(always)]
fn turned(x: f64, quarter: u64) -> f64 {
    let (r, k) = quarter_turns(x);
    let k = k.wrapping_add(quarter);
    let (sin, cos) = sin_cos_near_0(r);
    let value = choose(k & 1 == 0, sin, cos);
    f64::from_bits(value.to_bits() ^ ((k & 2) << 62))
}

#[inline(always)]
pub(crate) fn sin(x: f64) -> f64 {
    turned(x, 0)
}

#[inline(always)]
pub(crate) fn cos(x: f64) -> f64 {
    turned(x, 1)
}

#[inline(always)]
pub(crate) fn tan(x: f64) -> f64 {
    let (r, k) = quarter_turns(x);
    let (sin, cos) = sin_cos_near_0(r);
    let odd = k & 1 != 0;
    choose(odd, -cos, sin) / choose(odd, sin, cos)
}

/// Arc tangent of x in [0, 1]. With t = (x-1)/(x+1) above tan(pi/8), |t| <= 0.4143, and the next term of the series is
/// t^25 / 25 = 1e-11.
#[inline(always)]
fn atan_0_to_1(x: f64) -> f64 {
    let upper = x > 0.414_213_562_373_095_03;
    let t = choose(upper, (x - 1.0) / (x + 1.0), x);
    let series = polynomial(
        t * t,
        [
            1.0,
            -1.0 / 3.0,
            1.0 / 5.0,
            -1.0 / 7.0,
            1.0 / 9.0,
            -1.0 / 11.0,
            1.0 / 13.0,
            -1.0 / 15.0,
            1.0 / 17.0,
            -1.0 / 19.0,
            1.0 / 21.0,
            -1.0 / 23.0,
        ],
    );
    choose(upper, FRAC_PI_4, 0.0) + t * series
}

#[inline(always)]
pub(crate) fn atan(x: f64) -> f64 {
    let size = x.abs();
    let steep = size > 1.0;
    let angle = atan_0_to_1(choose(steep, 1.0 / size, size));
    choose(steep, FRAC_PI_2 - angle, angle).copysign(x)
}

#[inline(always)]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    let (ay, ax) = (y.abs(), x.abs());
    let steep = ay > ax;
    let (small, large) = (choose(steep, ax, ay), choose(steep, ay, ax));
    // 0/0 is the angle 0, inf/inf that of the diagonal.
    let ratio = choose(large == 0.0, 0.0, choose(small == f64::INFINITY, 1.0, small / large));
    let angle = atan_0_to_1(ratio);
    let angle = choose(steep, FRAC_PI_2 - angle, angle);
    let angle = choose(x.is_sign_negative(), PI - angle, angle);
    choose(x.is_nan() | y.is_nan(), f64::NAN, angle.copysign(y))
}

#[inline(always)]
pub(crate) fn asin(x: f64) -> f64 {
    atan2(x, ((1.0 - x) * (1.0 + x)).sqrt())
}

#[inline(always)]
pub(crate) fn acos(x: f64) -> f64 {
    atan2(((1.0 - x) * (1.0 + x)).sqrt(), x)
}
