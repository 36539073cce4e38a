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
    [0, 1, 2].map(|i| {
        let s2 = (f0[i] / f90[i].max(R::of(F90_FLOOR))).clamp(R::ZERO, R::of(F0_CEILING));
        let s = R::ONE + s2.sqrt();
        f90[i] * f_dielectric(s * s / (R::ONE - s2), l_dot_h)
    })
}

/// Fresnel's equations, unpolarised light, real index `eta` = inside over outside, cosine on the outside:
/// g = sqrt(eta^2 - 1 + c^2),  r_s = (c - g)/(c + g),  r_p = (eta^2 c - g)/(eta^2 c + g),  F = (r_s^2 + r_p^2)/2.
/// Born and Wolf 1999, Principles of Optics, section 1.5.
///
/// Both differences are written with e = (eta - 1)(eta + 1) as a factor, which has no cancellation at eta near 1:
/// g - c = e/(g + c),  eta^2 c - g = e (c (g + c) - 1)/(g + c).
/// Domain: eta in [1e-3, 1e9], cos_theta in [0, 1] (held there). Total internal reflection (g^2 < 0) is 1; eta = 1 is 0.
/// Error in f32: <= 16 ulp of max(F, 1e-4) for eta in [1, 3].
#[inline]
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
