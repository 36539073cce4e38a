//! Diffuse BRDFs, without n.l, in 1/sr. One signature, so that one can stand for another; each takes the albedo, in which
//! multiple scattering is not linear.

use crate::Real;
use crate::math::{INV_PI, pow5};
use crate::vector::scale;

/// Lambert 1760, Photometria: albedo / pi.
#[inline]
pub fn diffuse_lambert<R: Real>(
    albedo: [R; 3],
    _n_dot_v: R,
    _n_dot_l: R,
    _l_dot_h: R,
    _perceptual_roughness: R,
) -> [R; 3] {
    scale(albedo, R::of(INV_PI))
}

/// Burley 2012, Physically-Based Shading at Disney:
/// albedo (1 + (F90 - 1)(1 - n.l)^5)(1 + (F90 - 1)(1 - n.v)^5) / pi,  F90 = 1/2 + 2 perceptual_roughness (l.h)^2.
///
/// Domain: cosines and roughness in [0, 1]. It is reciprocal but does not keep energy: at high roughness and grazing
/// angles it reflects more than it receives. A white surface reflects 0.535 (n.v = 0.02, roughness 0) to 1.519 (n.v = 0.02,
/// roughness 1) of the light. Error in f32: <= 8 ulp.
#[inline]
pub fn diffuse_burley<R: Real>(albedo: [R; 3], n_dot_v: R, n_dot_l: R, l_dot_h: R, perceptual_roughness: R) -> [R; 3] {
    let f90_minus_1 = R::of(2.0) * perceptual_roughness * l_dot_h * l_dot_h - R::of(0.5);
    let light = R::ONE + f90_minus_1 * pow5((R::ONE - n_dot_l).clamp(R::ZERO, R::ONE));
    let view = R::ONE + f90_minus_1 * pow5((R::ONE - n_dot_v).clamp(R::ZERO, R::ONE));
    scale(albedo, light * view * R::of(INV_PI))
}

/// Smallest cosine divided by: below the library's domain, which begins at 1e-6, and far from overflow.
const DIFFUSE_COSINE_FLOOR: f64 = 1e-18;

/// |v_t||l_t| cos(phi) / max(n.v, n.l) where it is positive, itself where it is negative: Fujii's s / t. The dot product
/// of the tangential parts is v.l - n.v n.l, and v.l = 2 (l.h)^2 - 1.
#[inline]
fn fujii_ratio<R: Real>(n_dot_v: R, n_dot_l: R, l_dot_h: R) -> R {
    let s = R::of(2.0) * l_dot_h * l_dot_h - R::ONE - n_dot_v * n_dot_l;
    let t = n_dot_v.max(n_dot_l).max(R::of(DIFFUSE_COSINE_FLOOR));
    R::choose(s.lt(R::ZERO), s, s / t)
}

/// Oren and Nayar 1994, Generalization of Lambert's Reflectance Model, the qualitative form:
/// albedo / pi (A + B max(0, cos(phi)) sin(a) tan(b)), a and b the greater and the smaller of the two angles,
/// A = 1 - s2 / (2 (s2 + 0.33)), B = 0.45 s2 / (s2 + 0.09), s2 = sigma^2.
///
/// sigma, the standard deviation of the slope's angle in radians, is taken to be perceptual_roughness.
/// sin(a) tan(b) cos(phi) = (v.l - n.v n.l) / max(n.v, n.l). It is reciprocal and neither keeps energy (a white
/// surface reflects 0.624 to 1.011 of the light) nor is smooth where cos(phi) changes its sign.
/// Domain: cosines in [1e-6, 1], roughness and albedo in [0, 1]. Error in f32: <= 12 ulp but for the rounding of v.l, which
/// counts 1 / max(n.v, n.l) times.
#[inline]
pub fn diffuse_oren_nayar<R: Real>(
    albedo: [R; 3],
    n_dot_v: R,
    n_dot_l: R,
    l_dot_h: R,
    perceptual_roughness: R,
) -> [R; 3] {
    let sigma2 = perceptual_roughness * perceptual_roughness;
    let a = R::ONE - R::of(0.5) * sigma2 / (sigma2 + R::of(0.33));
    let b = R::of(0.45) * sigma2 / (sigma2 + R::of(0.09));
    let ratio = fujii_ratio(n_dot_v, n_dot_l, l_dot_h).max(R::ZERO);
    scale(albedo, (a + b * ratio) * R::of(INV_PI))
}

/// Fujii's improved Oren-Nayar (FON), as Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving Rough Diffuse BRDF:
/// albedo / pi A (1 + r s/t), A = 1 / (1 + (1/2 - 2/(3 pi)) r), s = v.l - n.v n.l, t = max(n.v, n.l) where s > 0, else 1.
///
/// r is perceptual_roughness. Single scattering only: a white surface of r = 1 loses up to 22 % (16.7 % on average).
/// Domain: cosines in [1e-6, 1], roughness and albedo in [0, 1]; below, t is held at 1e-18. Error in f32: <= 12 ulp but for
/// the rounding of v.l, which counts r / max(n.v, n.l) times.
#[inline]
pub fn diffuse_fon<R: Real>(albedo: [R; 3], n_dot_v: R, n_dot_l: R, l_dot_h: R, perceptual_roughness: R) -> [R; 3] {
    scale(albedo, fon(n_dot_v, n_dot_l, l_dot_h, perceptual_roughness) * R::of(INV_PI))
}

/// pi times the FON BRDF of albedo 1. 1 + r s/t is not below 0: -1 where light and viewer are opposite in the horizon.
#[inline]
fn fon<R: Real>(n_dot_v: R, n_dot_l: R, l_dot_h: R, r: R) -> R {
    fon_scale(r) * (R::ONE + r * fujii_ratio(n_dot_v, n_dot_l, l_dot_h)).max(R::ZERO)
}

/// FON's A.
#[inline]
fn fon_scale<R: Real>(r: R) -> R {
    R::ONE / (R::ONE + R::of(FON_A) * r)
}

/// 1/2 - 2/(3 pi): both FON's A and G(0) / pi, the most that the directional albedo's G / pi is.
const FON_A: f64 = 0.5 - 2.0 / 3.0 * INV_PI;
/// 2/3 - 28/(15 pi): the hemisphere's average of G / pi.
const FON_AVERAGE: f64 = 2.0 / 3.0 - 28.0 / 15.0 * INV_PI;

/// Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving Rough Diffuse BRDF, with the paper's polynomial for the
/// directional albedo: FON plus
/// m / pi (1 - E(v)) (1 - E(l)) / (1 - E_avg),  m = albedo^2 E_avg / (1 - albedo (1 - E_avg)).
///
/// 1 - E = A r (c - G/pi), c = 1/2 - 2/(3 pi), and 1 - E_avg = A r (c - c_avg): the quotient is A r (..)(..) / (c - c_avg),
/// which is 0 at r = 0, where the paper's is 0 / 0. Albedos are held in [0, 1]: at 5.98 m has a pole.
/// A white surface reflects 1 to 8e-4. Domain and error as [`diffuse_fon`].
///
/// ```
/// use halfvector_brdf::diffuse::{diffuse_eon, diffuse_lambert};
/// // n.v, n.l, l.h, roughness: smooth is Lambert's.
/// let albedo = [0.8, 0.5, 0.2_f64];
/// let (smooth, lambert) = (diffuse_eon(albedo, 0.7, 0.4, 0.9, 0.0), diffuse_lambert(albedo, 0.7, 0.4, 0.9, 0.0));
/// assert!((0..3).all(|i| (smooth[i] - lambert[i]).abs() < 1e-15));
/// ```
#[inline]
pub fn diffuse_eon<R: Real>(albedo: [R; 3], n_dot_v: R, n_dot_l: R, l_dot_h: R, perceptual_roughness: R) -> [R; 3] {
    let r = perceptual_roughness;
    let lost = (R::of(FON_A) - fon_g_over_pi_fit(n_dot_v)) * (R::of(FON_A) - fon_g_over_pi_fit(n_dot_l));
    eon(albedo, fon(n_dot_v, n_dot_l, l_dot_h, r), lost, r)
}

/// [`diffuse_eon`] with the exact directional albedo: white surfaces reflect all. The truth of the fit; the arc cosine that
/// it needs has 4096 ulp on a GPU.
#[inline]
pub fn diffuse_eon_exact<R: Real>(
    albedo: [R; 3],
    n_dot_v: R,
    n_dot_l: R,
    l_dot_h: R,
    perceptual_roughness: R,
) -> [R; 3] {
    let r = perceptual_roughness;
    eon(albedo, fon(n_dot_v, n_dot_l, l_dot_h, r), fon_lost_exact(n_dot_v) * fon_lost_exact(n_dot_l), r)
}

/// EON of pi times FON, and of (c - G(v)/pi)(c - G(l)/pi), which the polynomial makes as low as -1.4e-4 at grazing angles.
#[inline]
fn eon<R: Real>(albedo: [R; 3], fon: R, lost: R, r: R) -> [R; 3] {
    let a = fon_scale(r);
    let average = a * (R::ONE + R::of(FON_AVERAGE) * r);
    let multiple = average * (a * r * lost * R::of(1.0 / (FON_A - FON_AVERAGE)));
    albedo.map(|c| {
        let rho = c.clamp(R::ZERO, R::ONE);
        let bounced = rho * multiple / (R::ONE - rho * (R::ONE - average));
        rho * (fon + bounced).max(R::ZERO) * R::of(INV_PI)
    })
}

/// The paper's polynomial for G / pi; off by 4.7e-4 at most.
#[inline]
fn fon_g_over_pi_fit<R: Real>(n_dot_w: R) -> R {
    let m = R::ONE - n_dot_w;
    m * (R::of(0.0571085289) + m * (R::of(0.491881867) + m * (R::of(-0.332181442) + m * R::of(0.0714429953))))
}

/// 1/2 - 2/(3 pi) - G/pi, G = s (acos(c) - s c) + 2/3 ((s/c)(1 - s^3) - s), c = n.w, s its sine.
///
/// Both are equal at c = 0. With acos(c) = pi/2 - asin(c), 1 - s = c^2/(1 + s) and (1 - s^3)/c = c (1 + s + s^2)/(1 + s) the
/// difference is, without cancellation,
/// ((pi/2 - 2/3) c^2/(1 + s) + s (asin(c) + s c - (2/3) c (1 + s + s^2)/(1 + s))) / pi.
#[inline]
fn fon_lost_exact<R: Real>(n_dot_w: R) -> R {
    let c = n_dot_w.clamp(R::ZERO, R::ONE);
    let s = ((R::ONE - c) * (R::ONE + c)).sqrt();
    // asin to full relative precision: one step of Newton's method from pi/2 - acos, whose error is absolute. At c = 1 the
    // cosine is 0 and the start exact.
    let start = R::of(core::f64::consts::FRAC_PI_2) - c.acos();
    let (sin, cos) = start.sin_cos();
    let asin = start - R::choose(c.lt(R::of(0.5)), (sin - c) / cos.max(R::of(0.5)), R::ZERO);
    let inner = asin + s * c - R::of(2.0 / 3.0) * c * ((R::ONE + s + s * s) / (R::ONE + s));
    let outer = R::of(core::f64::consts::FRAC_PI_2 - 2.0 / 3.0) * (c * c / (R::ONE + s));
    (outer + s * inner) * R::of(INV_PI)
}

/// Directional albedo of FON of albedo 1, exactly: E = A (1 + r G/pi).
///
/// Domain: n.v in [0, 1], roughness in [0, 1]. 1 at n.v = 0 and at r = 0. Error in f32: <= 4 ulp.
#[inline]
pub fn directional_albedo_fon_exact<R: Real>(n_dot_v: R, perceptual_roughness: R) -> R {
    R::ONE - fon_scale(perceptual_roughness) * perceptual_roughness * fon_lost_exact(n_dot_v)
}

/// Directional albedo of FON of albedo 1 by the EON paper's polynomial; relative error of the fit <= 6e-4.
///
/// Domain: n.v in [0, 1], roughness in [0, 1]. Up to 1.0004 at n.v = 0. Error in f32: <= 6 ulp.
#[inline]
pub fn directional_albedo_fon<R: Real>(n_dot_v: R, perceptual_roughness: R) -> R {
    fon_scale(perceptual_roughness) * (R::ONE + perceptual_roughness * fon_g_over_pi_fit(n_dot_v))
}

/// Average albedo of FON of albedo 1: 2 times the integral of E(mu) mu = A (1 + (2/3 - 28/(15 pi)) r).
///
/// Domain: roughness in [0, 1]. Error in f32: <= 3 ulp.
#[inline]
pub fn average_albedo_fon<R: Real>(perceptual_roughness: R) -> R {
    fon_scale(perceptual_roughness) * (R::ONE + R::of(FON_AVERAGE) * perceptual_roughness)
}

/// Directional albedo of EON: albedo E + m (1 - E), with m as in [`diffuse_eon`] and the polynomial for E.
///
/// Domain: n.v, roughness and albedo in [0, 1] (the albedo held there). A white surface has 1. Error in f32: <= 12 ulp.
#[inline]
pub fn directional_albedo_eon<R: Real>(albedo: [R; 3], n_dot_v: R, perceptual_roughness: R) -> [R; 3] {
    let single = directional_albedo_fon(n_dot_v, perceptual_roughness);
    let average = average_albedo_fon(perceptual_roughness);
    albedo.map(|c| {
        let rho = c.clamp(R::ZERO, R::ONE);
        let bounced = rho * average / (R::ONE - rho * (R::ONE - average));
        rho * (single + bounced * (R::ONE - single))
    })
}
