//! Cloth: the Charlie distribution, whose microfacets stand up like fibres, and the visibility that goes with it.
//!
//! Domain: alpha in [1e-8, 1], cosines in [1e-6, 1]. Together they reflect more than they receive (up to 3.2 times at
//! grazing angles): the lobe made of them has to be scaled by its directional albedo.

use crate::Real;
use crate::math::INV_PI;

/// Smallest alpha: the library's domain begins here, and the exponent 1 / alpha ends at 1e8.
const CHARLIE_ALPHA_FLOOR: f64 = 1e-8;
/// Smallest sin^2 whose logarithm is taken.
const SIN2_FLOOR: f64 = 1e-37;
/// Smallest denominator of V: keeps it finite at n.l = n.v = 0.
const NEUBELT_FLOOR: f64 = 1e-36;

/// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF:
/// D = (2 + 1/alpha) sin(theta_h)^(1/alpha) / (2 pi), in 1/sr. KHR_materials_sheen: alpha = perceptual_roughness^2.
///
/// The power is 2^(log2(sin^2) / (2 alpha)). Its relative error is |ln of the power| times that of the exponent, in any
/// arithmetic. Where sin^2 is near 1 (the light opposite to the viewer) its distance from 1 decides, and a rounded sin^2
/// has lost it: there log2(1 - x), x = (n.h)^2, is x log2(1 - x) / ((1 - x) - 1), in which the rounding of 1 - x cancels
/// (Kahan's, in Goldberg 1991, What Every Computer Scientist Should Know About Floating-Point Arithmetic, theorem 4).
/// Edges: sin = 0 gives 0; alpha below 1e-8 is taken as 1e-8; never above 1.6e7.
/// Error in f32: <= 8 ulp for powers near 1, (8 + 2 |ln of the power|) ulp in general.
///
/// ```
/// use halfvector_brdf::sheen::d_charlie;
/// // Fibres stand up: nothing at h = n, most at the horizon.
/// assert_eq!(d_charlie(1.0, 0.0, 0.25_f64), 0.0);
/// assert!((d_charlie(0.0, 1.0, 0.25_f64) - 3.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[inline]
pub fn d_charlie<R: Real>(n_dot_h: R, sin2_theta_h: R, alpha: R) -> R {
    let exponent = R::ONE / alpha.max(R::of(CHARLIE_ALPHA_FLOOR));
    let x = n_dot_h * n_dot_h;
    let rest = (R::ONE - x).max(R::of(0.25));
    // -1 where rest rounds to 1: log2 is 0 there, and the sum -x / ln 2 is what counts.
    let is_1 = R::ONE.le(rest);
    let slope = rest.log2() / R::choose(is_1, -R::ONE, rest - R::ONE);
    let near_1 = -x * R::choose(is_1, R::of(core::f64::consts::LOG2_E), slope);
    let log2_sin2 = R::choose(x.lt(R::of(0.5)), near_1, sin2_theta_h.max(R::of(SIN2_FLOOR)).log2());
    let power = (R::of(0.5) * exponent * log2_sin2).exp2();
    let d = (R::of(2.0) + exponent) * power * R::of(0.5 * INV_PI);
    R::choose(R::ZERO.lt(sin2_theta_h), d, R::ZERO)
}

/// Neubelt and Pettineo 2013, Crafting a Next-Gen Material Pipeline for The Order: 1886: V = 1 / (4 (n.l + n.v - n.l n.v)).
///
/// It has the signature of the other V; it looks neither at l.h nor at alpha. Edges: n.l = n.v = 0 gives 2.5e35.
/// Error in f32: <= 4 ulp.
#[inline]
pub fn v_neubelt<R: Real>(n_dot_v: R, n_dot_l: R, _l_dot_h: R, _alpha: R) -> R {
    R::of(0.25) / (n_dot_l + n_dot_v - n_dot_l * n_dot_v).max(R::of(NEUBELT_FLOOR))
}
