//! The specular lobe of a rough surface: one call a light and one call an environment.

use crate::Real;
use crate::dfg::specular_albedo;
use crate::frame::{Frame, half_from_light};
use crate::fresnel::f_schlick;
use crate::ggx::{d_ggx, v_smith_ggx_correlated};
use crate::math::finite_or_zero;
use crate::vector::{add, mul, scale};

/// Parameters of the specular lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specular<R> {
    /// Reflectance at normal incidence.
    pub f0: [R; 3],
    /// Reflectance at grazing incidence.
    pub f90: [R; 3],
    /// Square of the perceptual roughness.
    pub alpha: R,
}

/// Cook and Torrance 1982, A Reflectance Model for Computer Graphics: D V F times n.l for the unit direction `l` to a
/// light, V = G / (4 n.l n.v), in 1/sr; 0 where the light is behind the surface.
///
/// V n.l is taken first: it is at most 1/2 / max(alpha, n.v), while V alone is infinite at n.l = n.v = 0.
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn specular_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Specular<R>) -> [R; 3] {
    let h = half_from_light(frame, l);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let f = f_schlick(p.f0, p.f90, h.l_dot_h);
    finite_or_zero(scale(f, v * h.n_dot_l * d))
}

/// The direction, not unit, from which the lobe's light comes in the mean: `mirror_dir` leaning to the normal by the
/// cube of the perceptual roughness, m + roughness^3 (n - m).
///
/// A wide lobe is cut by the surface and shadowed where it grazes: at roughness 1 it sees what a diffuse surface sees.
/// After Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering, listing 22; the weight is our own fit
/// to the integral of light times the lobe, and takes a quarter to a half of the split sum's error.
#[inline]
pub fn specular_direction<R: Real>(frame: Frame<R>, mirror_dir: [R; 3], perceptual_roughness: R) -> [R; 3] {
    let weight = perceptual_roughness * perceptual_roughness * perceptual_roughness;
    add(scale(mirror_dir, R::ONE - weight), scale(frame.normal, weight))
}

/// Karis 2013, Real Shading in Unreal Engine 4, the split sum: prefiltered radiance of [`specular_direction`] times the
/// lobe's directional albedo.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn specular_environment<R: Real>(p: Specular<R>, prefiltered_radiance: [R; 3], dfg: [R; 2]) -> [R; 3] {
    finite_or_zero(mul(prefiltered_radiance, specular_albedo(p.f0, p.f90, dfg)))
}
