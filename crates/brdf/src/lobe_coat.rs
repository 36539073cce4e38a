//! The coat: a clear dielectric layer over all that lies below, smooth or rough. OpenPBR 1.1 (Academy Software Foundation
//! 2024), section 3.4; Khronos 2020, KHR_materials_clearcoat, is the colour white, ior 1.5.
//!
//! The base below is scaled by [`coat_base`] twice over: by what the coat does not reflect, and by what it absorbs. Bounces
//! between base and coat are not followed (OpenPBR's `coat_darkening` = 0).

use crate::Real;
use crate::frame::{Frame, half_from_light};
use crate::fresnel::f_schlick;
use crate::ggx::{d_ggx, v_smith_ggx_correlated};
use crate::math::finite_or_zero;
use crate::vector::scale;

/// Smallest channel of the coat's colour: its logarithm is taken.
const COLOR_FLOOR: f64 = 1e-6;

/// Parameters of the coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat<R> {
    /// Presence of the coat in [0, 1].
    pub weight: R,
    /// Transmittance through the coat and back, at normal incidence, in [0, 1].
    pub color: [R; 3],
    /// Reflectance at normal incidence, ((ior - 1)/(ior + 1))^2.
    pub f0: R,
    /// Square of the coat's perceptual roughness.
    pub alpha: R,
}

/// The coat's reflection times n.l for the unit direction `l` to a light, weight D V F n.l in 1/sr, with Schlick's F from
/// f0 to 1; 0 where the light is behind the surface.
///
/// Reciprocal. Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn coat_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Coat<R>) -> [R; 3] {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick([p.f0; 3], [R::ONE; 3], h.l_dot_h);
    finite_or_zero(scale(f, p.weight * (v * h.n_dot_l * d)))
}

/// Radiance that the coat reflects from an environment: `prefiltered_radiance` of
/// [`specular_direction`](crate::lobe_specular::specular_direction) at the coat's
/// roughness, times weight (f0 a + b) for the split-sum pair `dfg` at the coat's roughness.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn coat_environment<R: Real>(p: Coat<R>, prefiltered_radiance: [R; 3], dfg: [R; 2]) -> [R; 3] {
    finite_or_zero(scale(prefiltered_radiance, p.weight * (p.f0 * dfg[0] + dfg[1])))
}

/// What the base keeps of its own light below the coat, seen at n.v: 1 + weight (T (1 - f0 a - b) - 1), with the split-sum
/// pair `dfg` at the coat's roughness and the transmittance T = color^(1 / cos theta_t), cos theta_t the refracted cosine.
///
/// Beer and Lambert's law over the path of the refracted view ray, taken for both ways: color is T at normal incidence.
/// View-only: exchanging v and l changes it. Each channel is in [0, 1] for any numbers: a weight can not become negative.
/// Error in f32: <= 64 ulp for channels of the colour >= 0.01.
#[inline]
pub fn coat_base<R: Real>(p: Coat<R>, n_dot_v: R, dfg: [R; 2]) -> [R; 3] {
    let s = p.f0.clamp(R::ZERO, R::of(0.9)).sqrt();
    let inv_eta = (R::ONE - s) / (R::ONE + s);
    let mu = n_dot_v.clamp(R::ZERO, R::ONE);
    let cos2 = R::ONE - inv_eta * inv_eta * (R::ONE - mu * mu);
    // cos theta_t is 0 only for an index of 1 at the horizon.
    let path = R::ONE / cos2.max(R::of(1e-4)).sqrt();
    let through = (R::ONE - p.f0 * dfg[0] - dfg[1]).clamp(R::ZERO, R::ONE);
    let weight = p.weight.clamp(R::ZERO, R::ONE);
    p.color.map(|c| {
        let transmittance = (c.clamp(R::of(COLOR_FLOOR), R::ONE).log2() * path).exp2();
        R::ONE + weight * (transmittance * through - R::ONE)
    })
}
