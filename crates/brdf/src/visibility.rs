//! Forms of V = G / (4 n.l n.v) that are cheaper or older than Smith's own, with the signature of Smith's: one can stand
//! for another. None of them follows from D, so none conserves energy with it.
//!
//! Domain: alpha in [1e-8, 1], cosines in [1e-6, 1]. An argument that a form does not look at may be anything.

use crate::Real;

/// Smallest denominator: keeps V finite at n.l = n.v = 0, where it is infinite and V n.l is 0.
const V_DENOMINATOR_FLOOR: f64 = 1e-36;

/// Hammon 2017, PBR Diffuse Lighting for GGX+Smith Microfacets, an approximation of the height-correlated Smith form:
/// V = 1/2 / (2 n.l n.v (1 - alpha) + (n.l + n.v) alpha).
///
/// Exact at alpha 0 and 1, no square root. Against `v_smith_ggx_correlated`, cosines from 0.01 and alpha from 0.002, both
/// logarithmic: off by up to 29 %, rms 13 %.
/// Edges: n.l = n.v = 0 gives 5e35. Error in f32: <= 6 ulp.
///
/// ```
/// use halfvector_brdf::{ggx::v_smith_ggx_correlated, visibility::v_hammon};
/// assert!((v_hammon(0.6, 0.3, 0.8, 1.0) - v_smith_ggx_correlated(0.6, 0.3, 0.8, 1.0_f64)).abs() < 1e-15);
/// ```
#[inline]
pub fn v_hammon<R: Real>(n_dot_v: R, n_dot_l: R, _l_dot_h: R, alpha: R) -> R {
    let smooth = R::of(2.0) * n_dot_l * n_dot_v * (R::ONE - alpha);
    let rough = (n_dot_l + n_dot_v) * alpha;
    R::of(0.5) / (smooth + rough).max(R::of(V_DENOMINATOR_FLOOR))
}

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering, G1(w) = n.w / (n.w (1 - k) + k), with the k of
/// Karis 2013, Real Shading in Unreal Engine 4, for punctual lights: k = (perceptual_roughness + 1)^2 / 8.
///
/// perceptual_roughness = sqrt(alpha). k is at least 1/8, so that V <= 16: smooth surfaces come out far too dark at grazing
/// angles, which is what the form was remapped for. Against `v_smith_ggx_correlated`, on the points of [`v_hammon`]: V up to
/// 99.5 % too small, rms 76 %. Edges: none. Error in f32: <= 10 ulp.
#[inline]
pub fn v_schlick_smith<R: Real>(n_dot_v: R, n_dot_l: R, _l_dot_h: R, alpha: R) -> R {
    let r = alpha.sqrt() + R::ONE;
    let k = r * r * R::of(0.125);
    let view = n_dot_v * (R::ONE - k) + k;
    let light = n_dot_l * (R::ONE - k) + k;
    R::of(0.25) / (view * light)
}

/// Torrance and Sparrow 1967, Theory for Off-Specular Reflection From Roughened Surfaces; Cook and Torrance 1982, A
/// Reflectance Model for Computer Graphics: G = min(1, 2 n.h n.v / v.h, 2 n.h n.l / v.h), of long V-shaped grooves.
///
/// With n.h = (n.v + n.l) / (2 v.h), which holds for every half vector, all of it over 4 n.l n.v is
/// V = 1/4 / max(n.v n.l, (l.h)^2 max(n.v, n.l) / (n.v + n.l)). It does not look at alpha.
/// Edges: n.l = n.v = 0 gives 2.5e35. Error in f32: <= 6 ulp.
#[inline]
pub fn v_cook_torrance<R: Real>(n_dot_v: R, n_dot_l: R, l_dot_h: R, _alpha: R) -> R {
    let floor = R::of(V_DENOMINATOR_FLOOR);
    let blocked = l_dot_h * l_dot_h * (n_dot_v.max(n_dot_l) / (n_dot_v + n_dot_l).max(floor));
    R::of(0.25) / (n_dot_v * n_dot_l).max(blocked).max(floor)
}

/// Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling:
/// V = 1 / (4 (l.h)^2), an approximation of Cook and Torrance's.
///
/// It grows without bound where l is opposite to v (both at the horizon). Edges: l.h = 0 gives 2.5e35.
/// Error in f32: <= 3 ulp.
#[inline]
pub fn v_kelemen<R: Real>(_n_dot_v: R, _n_dot_l: R, l_dot_h: R, _alpha: R) -> R {
    R::of(0.25) / (l_dot_h * l_dot_h).max(R::of(V_DENOMINATOR_FLOOR))
}
