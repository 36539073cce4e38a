//! Sampling of GGX's visible normals: for tables, bakes and references. The shader that shades does not sample.
//!
//! Local frame: the normal is +Z. Domain: alpha in [1e-8, 1], n.v in [1e-6, 1].

use crate::Real;
use crate::ggx::d_ggx;
use crate::math::{PI, normalize_or};

/// Smith's masking of one direction for GGX: G1 = 2 n.w / (n.w + sqrt(alpha^2 + (1 - alpha^2)(n.w)^2)).
/// Walter et al. 2007, equation 34.
///
/// Edges: 0 at n.w <= 0; alpha = 0 gives 1. Error in f32: <= 3 ulp.
#[inline]
pub fn g1_smith_ggx<R: Real>(n_dot_w: R, alpha: R) -> R {
    let a2 = alpha * alpha;
    let g1 = R::of(2.0) * n_dot_w / (n_dot_w + (a2 + (R::ONE - a2) * n_dot_w * n_dot_w).sqrt());
    R::choose(R::ZERO.lt(n_dot_w), g1, R::ZERO)
}

/// A half vector drawn from the GGX normals that `view` sees, D_v(h) = G1(v) max(0, v.h) D(h) / n.v.
/// Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps.
///
/// `view` is a unit vector with z >= 0, `u` two numbers in [0, 1). The result is a unit vector with z >= 0.
///
/// The cap's height z = (1 - u1)(1 + w.z) - w.z is taken as 1 - s, s = u1 (1 + w.z): its sine sqrt(s (2 - s)) then has
/// no cancellation near the pole, where all samples of a smooth surface lie.
#[inline]
pub fn sample_ggx_vndf<R: Real>(view: [R; 3], alpha: R, u: [R; 2]) -> [R; 3] {
    let up = [R::ZERO, R::ZERO, R::ONE];
    let w = normalize_or([view[0] * alpha, view[1] * alpha, view[2]], up);
    let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
    let s = (u[1] * (R::ONE + w[2])).clamp(R::ZERO, R::of(2.0));
    let sin_theta = (s * (R::of(2.0) - s)).sqrt();
    let h = [sin_theta * cos_phi + w[0], sin_theta * sin_phi + w[1], (R::ONE - s + w[2]).max(R::ZERO)];
    normalize_or([h[0] * alpha, h[1] * alpha, h[2]], up)
}

/// Probability density, per solid angle, of the direction l = 2 (v.h) h - v for h of [`sample_ggx_vndf`]:
/// G1(v) D(h) / (4 n.v).
///
/// G1 / n.v is taken in one, 2 / (n.v + sqrt(...)), so that n.v = 0 is no 0 / 0. Densities of directions l below the
/// horizon count too: the integral over the whole sphere is 1. Error in f32: <= 10 ulp.
#[inline]
pub fn pdf_solid_angle_ggx_vndf<R: Real>(n_dot_v: R, n_dot_h: R, sin2_theta_h: R, alpha: R) -> R {
    let a2 = alpha * alpha;
    let g1_over_n_dot_v = R::of(2.0) / (n_dot_v + (a2 + (R::ONE - a2) * n_dot_v * n_dot_v).sqrt());
    R::of(0.25) * g1_over_n_dot_v * d_ggx(n_dot_h, sin2_theta_h, alpha)
}
