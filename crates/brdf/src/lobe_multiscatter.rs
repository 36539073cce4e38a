//! The lobe of light that bounces more than once between the microfacets of a rough surface. Kulla and Conty 2017,
//! Revisiting Physically Based Shading at Imageworks, after Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled
//! Specular-Matte BRDF Model with Importance Sampling:
//!
//! f_ms = color (1 - E(v)) (1 - E(l)) / (pi (1 - E_avg)).
//!
//! It is reciprocal, and added to the single-scattering lobe it reflects all light where F is 1. On smooth surfaces the
//! losses are as small as a table's errors, and their quotient would be noise. There the form is shifted,
//!
//! f_ms = color ((1 - E(v) + s)(1 - E(l) + s) / (1 - E_avg + s) - s) / pi,  s = max(2e-3 - (1 - E_avg), 0),
//!
//! which has the same albedo and is reciprocal; it is held at 0, which adds at most 5e-4.

use crate::Real;
use crate::frame::{Frame, half_from_light};
use crate::math::{INV_PI, finite_or_zero};
use crate::multiscatter::{average_loss_ggx, multiscatter_color};
use crate::vector::{mul, scale};

/// Smallest average loss divided by: reached at perceptual roughness 0.147.
const AVERAGE_LOSS_FLOOR: f64 = 2e-3;

/// Parameters of the lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiscatter<R> {
    /// What leaves of the light that bounces on.
    pub color: [R; 3],
    /// 1 - E(v) of the white lobe.
    pub loss: R,
    /// 1 - E_avg of the white lobe.
    pub average_loss: R,
}

/// The lobe beside a specular lobe of f0 and f90, whose split-sum pair towards the viewer is `dfg` (E(v) is its sum).
///
/// Domain: all arguments in [0, 1] (held). No channel of the colour is negative or above 1.
#[inline]
pub fn multiscatter_from_dfg<R: Real>(
    f0: [R; 3],
    f90: [R; 3],
    dfg: [R; 2],
    perceptual_roughness: R,
) -> Multiscatter<R> {
    let average_loss = average_loss_ggx(perceptual_roughness);
    let loss = (R::ONE - dfg[0] - dfg[1]).clamp(R::ZERO, R::ONE);
    Multiscatter { color: multiscatter_color(f0, f90, R::ONE - average_loss), loss, average_loss }
}

/// BRDF times n.l for the unit direction `l` to a light, in 1/sr, with the split-sum pair `dfg` of n.l and the same
/// roughness; 0 where the light is behind the surface.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn multiscatter_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Multiscatter<R>, dfg: [R; 2]) -> [R; 3] {
    let n_dot_l = half_from_light(frame, l).n_dot_l;
    let loss = (R::ONE - dfg[0] - dfg[1]).clamp(R::ZERO, R::ONE);
    let shift = (R::of(AVERAGE_LOSS_FLOOR) - p.average_loss).max(R::ZERO);
    let product = (p.loss + shift) * (loss + shift) / (p.average_loss + shift) - shift;
    finite_or_zero(scale(p.color, product.max(R::ZERO) * n_dot_l * R::of(INV_PI)))
}

/// Radiance reflected from an environment: the lobe is wide and nearly Lambert's, so it is fed with the irradiance over pi.
/// Exact for a uniform environment.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn multiscatter_environment<R: Real>(p: Multiscatter<R>, irradiance_over_pi: [R; 3]) -> [R; 3] {
    finite_or_zero(mul(scale(p.color, p.loss), irradiance_over_pi))
}
