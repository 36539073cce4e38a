//! The GGX (Trowbridge-Reitz) microfacet distribution, isotropic: D, and V = G / (4 n.l n.v).
//!
//! All V have one signature, so that one can stand for another; Smith's forms do not look at l.h.
//! Domain: perceptual roughness in [1e-4, 1], that is alpha in [1e-8, 1]; cosines in [1e-6, 1].

use crate::Real;
use crate::math::INV_PI;

/// Perceptual roughness below which a highlight of a punctual light is narrower than f32 directions can resolve between
/// neighbouring pixels; who shades with punctual lights holds the roughness above it. Environments have no floor.
pub const PUNCTUAL_ROUGHNESS_FLOOR: f64 = 0.045;
/// Smallest denominator of D's root. It is reached only for alpha < 1e-9 (perceptual roughness 3e-5), keeps D <= 3.2e35
/// for any cosines, and makes the 0 / 0 of alpha = 0 a 0.
pub(crate) const D_FLOOR: f64 = 1e-18;
/// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0, where V is infinite and V n.l is 0.
pub(crate) const V_FLOOR: f64 = 1e-36;

/// alpha = perceptual_roughness^2. Burley 2012, Physically-Based Shading at Disney.
///
/// Held in [0, 1]; NaN gives 1.
#[inline]
pub fn alpha_from_perceptual_roughness<R: Real>(perceptual_roughness: R) -> R {
    let r = perceptual_roughness.min(R::ONE).max(R::ZERO);
    r * r
}

/// Walter, Marschner, Li, Torrance 2007, Microfacet Models for Refraction through Rough Surfaces:
/// D = alpha^2 / (pi ((n.h)^2 alpha^2 + |n x h|^2)^2), in 1/sr.
///
/// With k = alpha / ((n.h)^2 alpha^2 + |n x h|^2) it is k^2 / pi: k is at most 1 / alpha where the square of the
/// denominator would be alpha^4. 1 - (n.h)^2 in the place of |n x h|^2 loses every digit at the peak.
/// Edges: alpha = 0 is a mirror, whose D is a delta: 0 here. Never above 3.2e35 for cosines up to 1.
/// Error in f32: <= 8 ulp for exact arguments.
#[inline]
pub fn d_ggx<R: Real>(n_dot_h: R, sin2_theta_h: R, alpha: R) -> R {
    let a = n_dot_h * alpha;
    let k = alpha / (a * a + sin2_theta_h).max(R::of(D_FLOOR));
    k * (k * R::of(INV_PI))
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equation 99 over 4 n.l n.v:
/// V = 1/2 / (n.l sqrt(alpha^2 + (1 - alpha^2)(n.v)^2) + n.v sqrt(alpha^2 + (1 - alpha^2)(n.l)^2)).
///
/// Edges: n.l = n.v = 0 gives 5e35 (the true value is infinite, and V n.l is 0).
/// Error in f32: <= 4 ulp.
#[inline]
pub fn v_smith_ggx_correlated<R: Real>(n_dot_v: R, n_dot_l: R, _l_dot_h: R, alpha: R) -> R {
    let a2 = alpha * alpha;
    let view = n_dot_l * (a2 + (R::ONE - a2) * n_dot_v * n_dot_v).sqrt();
    let light = n_dot_v * (a2 + (R::ONE - a2) * n_dot_l * n_dot_l).sqrt();
    R::of(0.5) / (view + light).max(R::of(V_FLOOR))
}

/// Walter et al. 2007: G = G1(v) G1(l), G1(w) = 2 n.w / (n.w + sqrt(alpha^2 + (1 - alpha^2)(n.w)^2)), over 4 n.l n.v:
/// V = 1 / ((n.v + sqrt(alpha^2 + (1 - alpha^2)(n.v)^2)) (n.l + sqrt(alpha^2 + (1 - alpha^2)(n.l)^2))).
///
/// Edges: n.l = n.v = alpha = 0 gives 1e36. Error in f32: <= 5 ulp.
/// Against the height-correlated form it is up to 64 % too dark at roughness 0.3, 85 % at 0.5 (both cosines 0.01).
#[inline]
pub fn v_smith_ggx_separable<R: Real>(n_dot_v: R, n_dot_l: R, _l_dot_h: R, alpha: R) -> R {
    let a2 = alpha * alpha;
    let view = n_dot_v + (a2 + (R::ONE - a2) * n_dot_v * n_dot_v).sqrt();
    let light = n_dot_l + (a2 + (R::ONE - a2) * n_dot_l * n_dot_l).sqrt();
    R::ONE / (view * light).max(R::of(V_FLOOR))
}
