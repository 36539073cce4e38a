//! The diffuse lobe: one call a light and one call an environment.

use crate::Real;
use crate::diffuse::diffuse_lambert;
use crate::frame::{Frame, half_from_light};
use crate::math::finite_or_zero;
use crate::vector::{mul, scale};

/// Parameters of the diffuse lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse<R> {
    /// Albedo, linear Rec. 709.
    pub color: [R; 3],
    /// Artist's roughness in [0, 1].
    pub perceptual_roughness: R,
}

/// BRDF times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn diffuse_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Diffuse<R>) -> [R; 3] {
    let h = half_from_light(frame, l);
    let brdf = diffuse_lambert(p.color, frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.perceptual_roughness);
    finite_or_zero(scale(brdf, h.n_dot_l))
}

/// Radiance reflected from an environment: color times irradiance over pi. Exact for Lambert's BRDF.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn diffuse_environment<R: Real>(p: Diffuse<R>, irradiance_over_pi: [R; 3]) -> [R; 3] {
    finite_or_zero(mul(p.color, irradiance_over_pi))
}
