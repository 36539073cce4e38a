//! Fresnel reflectance. `f0` is the reflectance at normal incidence, `f90` the one at grazing incidence.

use crate::Real;
use crate::math::pow5;

/// Nearest that f0 / f90 comes to 1, where the index of refraction that it implies is infinite: 1 - 2^-20, an exact f32,
/// so that 1 - f0 / f90 is exact there too.
const F0_CEILING: f64 = 0.99999904632568359375;
/// Smallest f90 divided by: 0 / 0 where a specular weight of 0 has scaled both f0 and f90 to nothing.
const F90_FLOOR: f64 = 1e-30;
/// Largest index of refraction; its square must not overflow.
const ETA_CEILING: f64 = 1e9;
/// Smallest sum of cosines divided by: 0 / 0 at eta = 1, cos = 0. Its square is still a normal f32.
const COSINE_SUM_FLOOR: f64 = 1e-18;
/// (1 - m)^5 at m = 1/7, the cosine of 82 degrees.
const F82_SCHLICK_WEIGHT: f64 = 7776.0 / 16807.0;
/// 1 / (m (1 - m)^6) at m = 1/7.
const F82_SCALE: f64 = 823_543.0 / 46_656.0;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering:
/// F = f0 + (f90 - f0) (1 - l.h)^5.
///
/// Domain: 0 <= f0 <= f90 <= 1, any l_dot_h (1 - l.h is held in [0, 1]). Other f0 and f90 are taken as they are, with no
/// bound on the relative error where f90 < f0 cancels. f0 = f90 gives f0 exactly.
/// Error in f32: <= 8 ulp of max(F, 0.02).
#[inline]
pub fn f_schlick<R: Real>(f0: [R; 3], f90: [R; 3], l_dot_h: R) -> [R; 3] {
    let weight = pow5((R::ONE - l_dot_h).clamp(R::ZERO, R::ONE));
    [0, 1, 2].map(|i| f0[i] + (f90[i] - f0[i]) * weight)
}

/// Fresnel's equations for the dielectric that f0 / f90 implies, per channel, scaled to f90:
/// eta = (1 + s) / (1 - s), s = sqrt(f0 / f90);  F = f90 f_dielectric(eta, l.h), which is f0 at l.h = 1 and f90 at 0.
///
/// Domain: f0, f90 in [0, 1]. f0 / f90 is held in [0, 1 - 2^-20]; f90 = 0 gives 0.
/// Error in f32: <= 64 ulp of max(F, 0.02) for f0 / f90 <= 0.9. Nearer to 1 the ratio's
/// own rounding counts 1 / (1 - f0 / f90) times at grazing angles: 3e-5 at 0.9998.
/// 1 / (1 - s) is taken as (1 + s) / (1 - s^2), which keeps its digits near s = 1.
#[inline]
pub fn f_exact<R: Real>(f0: [R; 3], f90: [R; 3], l_dot_h: R) -> [R; 3] {
    [
        f_exact_channel(f0[0], f90[0], l_dot_h),
        f_exact_channel(f0[1], f90[1], l_dot_h),
        f_exact_channel(f0[2], f90[2], l_dot_h),
    ]
}

/// One channel of [`f_exact`]: a part of its caller, or else no batch is widened.
#[inline(always)]
fn f_exact_channel<R: Real>(f0: R, f90: R, l_dot_h: R) -> R {
    let s2 = (f0 / f90.max(R::of(F90_FLOOR))).clamp(R::ZERO, R::of(F0_CEILING));
    let s = R::ONE + s2.sqrt();
    f90 * f_dielectric(s * s / (R::ONE - s2), l_dot_h)
}

/// Fresnel's equations, unpolarised light, real index `eta` = inside over outside, cosine on the outside:
/// g = sqrt(eta^2 - 1 + c^2),  r_s = (c - g)/(c + g),  r_p = (eta^2 c - g)/(eta^2 c + g),  F = (r_s^2 + r_p^2)/2.
/// Born and Wolf 1999, Principles of Optics, section 1.5.
///
/// Both differences are written with e = (eta - 1)(eta + 1) as a factor, which has no cancellation at eta near 1:
/// g - c = e/(g + c),  eta^2 c - g = e (c (g + c) - 1)/(g + c).
/// Domain: eta in [1e-3, 1e9], cos_theta in [0, 1] (held there). Total internal reflection (g^2 < 0) is 1; eta = 1 is 0.
/// Error in f32: <= 16 ulp of max(F, 1e-4) for eta in [1, 3].
#[inline(always)]
pub fn f_dielectric<R: Real>(eta: R, cos_theta: R) -> R {
    let c = cos_theta.clamp(R::ZERO, R::ONE);
    let n = eta.min(R::of(ETA_CEILING));
    let e = (n - R::ONE) * (n + R::ONE);
    let g2 = e + c * c;
    let floor = R::of(COSINE_SUM_FLOOR);
    let g = g2.max(R::ZERO).sqrt();
    let sum = (g + c).max(floor);
    let r_s = e / (sum * sum);
    let r_p = r_s * sum * (c * sum - R::ONE) / (n * n * c + g).max(floor);
    R::choose(g2.lt(R::ZERO), R::ONE, R::of(0.5) * (r_s * r_s + r_p * r_p))
}

/// Reflectance at normal incidence of a dielectric in air: ((ior - 1)/(ior + 1))^2.
///
/// Domain: every number. KHR_materials_ior writes 0 for an infinite index: 0, and all that is no index (below 0, NaN),
/// gives 1. Error in f32: <= 2 ulp for ior in [1, 3].
#[inline]
pub fn f0_from_ior<R: Real>(ior: R) -> R {
    let n = ior.clamp(R::ZERO, R::of(ETA_CEILING));
    let s = (n - R::ONE) / (n + R::ONE);
    s * s
}

/// Index of refraction, relative to the outside, of the dielectric that reflects `f0` at normal incidence:
/// (1 + s) / (1 - s), s = sqrt(f0).
///
/// Domain: f0 is held in [0, 1 - 2^-20], where the index is 4.2e6; f0 = 1 would be an infinite one.
/// 1 / (1 - s) is taken as (1 + s) / (1 - f0), which keeps its digits near 1. Error in f32: <= 6 ulp.
#[inline]
pub fn ior_from_f0<R: Real>(f0: R) -> R {
    let s2 = f0.clamp(R::ZERO, R::of(F0_CEILING));
    let s = R::ONE + s2.sqrt();
    s * s / (R::ONE - s2)
}

/// Schlick's F of 1 - l.h, for who has that number without cancellation: (1 - l.h) = |v - l|^2 / (4 (1 + l.h)).
/// F = f0 + (f90 - f0) x^5, x = 1 - l.h. Near l = v a difference of 1 and l.h has lost the digits of x.
///
/// Domain: x in [0, 1], not held there. Error in f32: <= 4 ulp.
#[inline]
pub fn f_schlick_of_complement<R: Real>(f0: R, f90: R, one_minus_l_dot_h: R) -> R {
    f0 + (f90 - f0) * pow5(one_minus_l_dot_h)
}

/// Kutz, Hasan, Edmondson 2021, Novel Aspects of the Adobe Standard Material, as in OpenPBR 1.1: Schlick's F with a metal's
/// edge tint, the reflectance at l.h = 1/7 relative to Schlick's there:
/// F = F_S(l.h) - l.h (1 - l.h)^6 / (m (1 - m)^6) F_S(m) (1 - f82_tint), m = 1/7 (82 degrees), F_S of f90 = 1.
///
/// Domain: f0 and f82_tint in [0, 1], any l_dot_h (1 - l.h is held in [0, 1]). The equation is as low as -0.13 for a dark
/// f0 with a dark tint, which no metal has: F is held at 0 and above, and at 1 and below. f82_tint = 1 is Schlick's F.
/// Error in f32: 7e-7, absolute.
///
/// ```
/// use halfvector_brdf::fresnel::{f_f82_tint, f_schlick};
/// let (f0, white) = ([0.9, 0.6, 0.3], [1.0; 3]);
/// let tinted = f_f82_tint(f0, [0.5; 3], 1.0 / 7.0_f64);
/// let plain = f_schlick(f0, white, 1.0 / 7.0);
/// assert!((0..3).all(|i| (tinted[i] - 0.5 * plain[i]).abs() < 1e-15));
/// ```
#[inline]
pub fn f_f82_tint<R: Real>(f0: [R; 3], f82_tint: [R; 3], l_dot_h: R) -> [R; 3] {
    let x = (R::ONE - l_dot_h).clamp(R::ZERO, R::ONE);
    [0, 1, 2].map(|i| f_f82_tint_of_complement(f0[i], f82_tint[i], x).clamp(R::ZERO, R::ONE))
}

/// The equation of [`f_f82_tint`] as it is written, of x = 1 - l.h (see [`f_schlick_of_complement`]): negative for a dark f0
/// with a dark tint.
///
/// Domain: all arguments in [0, 1]. Error in f32: 7e-7, absolute.
#[inline]
pub fn f_f82_tint_of_complement<R: Real>(f0: R, f82_tint: R, one_minus_l_dot_h: R) -> R {
    let x = one_minus_l_dot_h;
    let at_82 = f0 + (R::ONE - f0) * R::of(F82_SCHLICK_WEIGHT);
    let lost = at_82 * (R::ONE - f82_tint) * R::of(F82_SCALE);
    let x5 = pow5(x);
    f0 + (R::ONE - f0) * x5 - (R::ONE - x) * (x5 * x) * lost
}

/// Fresnel's equations of a conductor, unpolarised light, index `eta` + i `k` relative to the outside, cosine on the
/// outside. Born and Wolf 1999, Principles of Optics, section 14.2.
///
/// With c the cosine, s2 = 1 - c^2 and (a + i b)^2 = (eta + i k)^2 - s2:
/// R_s = ((a - c)^2 + b^2) / ((a + c)^2 + b^2),  R_p = R_s ((a c - s2)^2 + b^2 c^2) / ((a c + s2)^2 + b^2 c^2),
/// F = (R_s + R_p) / 2. All are sums of squares. Of a and b the greater is a square root of a sum and the smaller eta k over
/// it, because the root of the difference |.| - eta^2 + k^2 + s2 has no digit left where k is far above or below eta.
/// a - c is (eta^2 - 1 - k^2 + b^2) / (a + c) where a is the greater, so that an index near 1 keeps its digits.
/// Domain: eta in [1e-3, 1e9], k in [0, 1e9] (held below), cos_theta in [0, 1] (held there). k = 0 is [`f_dielectric`], 1 under total
/// internal reflection. Error in f32: <= 16 ulp of max(F, 0.01) for eta and k in [1e-3, 20].
///
/// ```
/// use halfvector_brdf::fresnel::f_conductor;
/// // Silver in the green, seen from in front: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
/// assert!((f_conductor(0.05_f64, 4.0, 1.0) - 0.988_305_8).abs() < 1e-7);
/// assert_eq!(f_conductor(0.05_f64, 4.0, 0.0), 1.0);
/// ```
#[inline]
pub fn f_conductor<R: Real>(eta: R, k: R, cos_theta: R) -> R {
    let c = cos_theta.clamp(R::ZERO, R::ONE);
    let n = eta.clamp(R::ZERO, R::of(ETA_CEILING));
    let k = k.clamp(R::ZERO, R::of(ETA_CEILING));
    let floor = R::of(COSINE_SUM_FLOOR);
    let (c2, s2) = (c * c, (R::ONE - c) * (R::ONE + c));
    let nk = n * k;
    // eta^2 - k^2 - s2, as a sum of products that are exact at eta = 1.
    let e = (n - R::ONE) * (n + R::ONE) - k * k;
    let t = e + c2;
    let modulus = (t * t + R::of(4.0) * nk * nk).sqrt();
    let greater = (R::of(0.5) * (modulus + t.abs())).sqrt();
    let smaller = nk / greater.max(floor);
    let is_metal = t.lt(R::ZERO);
    let a = R::choose(is_metal, smaller, greater);
    let b = R::choose(is_metal, greater, smaller);
    let sum = (a + c).max(floor);
    let difference = R::choose(is_metal, a - c, (e + b * b) / sum);
    let b2 = b * b;
    let r_s = (difference * difference + b2) / (sum * sum + b2);
    let (minus, plus) = (a * c - s2, a * c + s2);
    let p_over_s = (minus * minus + b2 * c2) / (plus * plus + b2 * c2).max(floor * floor);
    (R::of(0.5) * r_s * (R::ONE + p_over_s)).min(R::ONE)
}
