//! GGX stretched along the tangent: D and V for two widths, alpha_t along the tangent and alpha_b along the bitangent.
//!
//! Vectors are unit, in the tangent frame: (tangent, bitangent, normal). Domain: alphas in [1e-8, 4], z in [1e-6, 1].

use crate::Real;
use crate::math::INV_PI;
use crate::vector::dot;

/// Smallest denominator of D's root: reached only for alphas below 1e-9, makes the 0 / 0 of alpha = 0 a 0.
const D_ANISOTROPIC_FLOOR: f64 = 1e-36;
/// Smallest denominator of V: keeps V <= 5e35 at n.l = n.v = 0.
const V_ANISOTROPIC_FLOOR: f64 = 1e-36;

/// Burley 2012, Physically-Based Shading at Disney (appendix B); Heitz 2014, equation 85:
/// D = 1 / (pi alpha_t alpha_b ((t.h / alpha_t)^2 + (b.h / alpha_b)^2 + (n.h)^2)^2), in 1/sr.
///
/// With s = alpha_t alpha_b and w = s / ((alpha_b t.h)^2 + (alpha_t b.h)^2 + (s n.h)^2) it is s w^2 / pi: no alpha is
/// divided by, and no square leaves f32 (w <= 1 / s). alpha_t = alpha_b is `d_ggx`.
/// Edges: an alpha of 0 gives 0. Error in f32: <= 12 ulp for exact arguments.
///
/// ```
/// use halfvector_brdf::anisotropic::d_ggx_anisotropic;
/// // At the peak: 1 / (pi alpha_t alpha_b).
/// let d = d_ggx_anisotropic([0.0, 0.0, 1.0], 0.1_f64, 0.5);
/// assert!((d - 1.0 / (std::f64::consts::PI * 0.05)).abs() < 1e-14);
/// ```
#[inline]
pub fn d_ggx_anisotropic<R: Real>(h_in_tangent: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let s = alpha_t * alpha_b;
    let q = [alpha_b * h_in_tangent[0], alpha_t * h_in_tangent[1], s * h_in_tangent[2]];
    let w = s / dot(q, q).max(R::of(D_ANISOTROPIC_FLOOR));
    s * w * (w * R::of(INV_PI))
}

/// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, equations 86 and 99 over 4 n.l n.v:
/// V = 1/2 / (n.l |(alpha_t t.v, alpha_b b.v, n.v)| + n.v |(alpha_t t.l, alpha_b b.l, n.l)|).
///
/// Edges: n.l = n.v = 0 gives 5e35. Error in f32: <= 6 ulp.
#[inline]
pub fn v_smith_ggx_anisotropic<R: Real>(
    view_in_tangent: [R; 3],
    light_in_tangent: [R; 3],
    alpha_t: R,
    alpha_b: R,
) -> R {
    let stretched = |w: [R; 3]| {
        let stretched = [alpha_t * w[0], alpha_b * w[1], w[2]];
        dot(stretched, stretched).sqrt()
    };
    let view = light_in_tangent[2] * stretched(view_in_tangent);
    let light = view_in_tangent[2] * stretched(light_in_tangent);
    R::of(0.5) / (view + light).max(R::of(V_ANISOTROPIC_FLOOR))
}
