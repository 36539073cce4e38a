//! Constants and small functions that the whole library leans on.

use crate::Real;
use crate::vector::{cross, dot, scale};

/// pi.
pub const PI: f64 = core::f64::consts::PI;
/// 1 / pi.
pub const INV_PI: f64 = core::f64::consts::FRAC_1_PI;

/// Shortest squared length that is still divided by: below it lie the denormal numbers of f32, which a GPU may flush.
pub(crate) const LENGTH2_FLOOR: f64 = 1e-37;
/// Longest squared length that is still divided by: above it the sum of squares overflows f32.
const LENGTH2_CEILING: f64 = 1e37;
/// Every number of the library's domain is smaller; f32 ends at 3.4e38.
pub(crate) const FINITE_CEILING: f64 = 3e38;

/// x^5 by three products.
///
/// Domain: |x| < 2e7 (its fifth power is still an f32). Error in f32: <= 3 ulp.
#[inline]
pub fn pow5<R: Real>(x: R) -> R {
    let x2 = x * x;
    x2 * x2 * x
}

/// v / |v|, or `fallback` where v has no direction: zero, NaN, infinite, or of a length outside 3e-19 .. 3e18.
///
/// `fallback` is returned as it is. Error in f32: <= 3 ulp a component.
#[inline]
pub fn normalize_or<R: Real>(v: [R; 3], fallback: [R; 3]) -> [R; 3] {
    let length2 = dot(v, v);
    let has_direction = R::of(LENGTH2_FLOOR).lt(length2) & length2.lt(R::of(LENGTH2_CEILING));
    let unit = scale(v, R::ONE / length2.sqrt());
    [0, 1, 2].map(|i| R::choose(has_direction, unit[i], fallback[i]))
}

/// A unit direction across a unit normal, any.
#[inline]
pub(crate) fn any_tangent<R: Real>(normal: [R; 3]) -> [R; 3] {
    let is_x = R::of(0.7).lt(normal[0].abs());
    let aside = [R::choose(is_x, R::ZERO, R::ONE), R::choose(is_x, R::ONE, R::ZERO), R::ZERO];
    let across = cross(normal, aside);
    scale(across, R::ONE / dot(across, across).sqrt())
}

/// The colour with each channel that is NaN, infinite or beyond +-3e38 set to 0. Exact for all others.
#[inline]
pub fn finite_or_zero<R: Real>(c: [R; 3]) -> [R; 3] {
    c.map(|x| R::choose(x.abs().lt(R::of(FINITE_CEILING)), x, R::ZERO))
}
