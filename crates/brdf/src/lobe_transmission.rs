//! Transmission through a rough dielectric interface. Walter, Marschner, Li, Torrance 2007, Microfacet Models for
//! Refraction through Rough Surfaces.
//!
//! Two meanings, each of its own functions. *Solid*: the interface bends light; what is inside the body is another medium,
//! and radiance that enters it is compressed by eta^2. *Thin-walled* (KHR_materials_transmission, Khronos 2020; OpenPBR's
//! `geometry_thin_walled`): a sheet, which light leaves in the direction in which it came, blurred as a reflection is. Light
//! is absorbed by neither: `color` is what a ray keeps.

use crate::Real;
use crate::frame::{Frame, frame_from_normal, half_from_light};
use crate::fresnel::{f_dielectric, f_schlick, f0_from_ior};
use crate::ggx::{d_ggx, v_smith_ggx_correlated};
use crate::math::{finite_or_zero, normalize_or};
use crate::vector::{add, cross, dot, scale};

/// Smallest square of the denominator of the change of angles: 0 / 0 where eta = 1 and l = -v, which has no half vector.
const JACOBIAN_FLOOR: f64 = 1e-24;

/// Parameters of transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission<R> {
    /// Share of the light that passes, linear Rec. 709.
    pub color: [R; 3],
    /// Index of refraction behind the surface over the index on the viewer's side: ior from outside, 1 / ior from inside.
    pub eta: R,
    /// Square of the perceptual roughness.
    pub alpha: R,
}

/// The half vector of refraction, -(v + eta l) / |v + eta l|, turned to the viewer's side of the surface where eta < 1 has
/// turned it away; 0 where there is none.
#[inline]
fn refraction_half<R: Real>(frame: Frame<R>, l: [R; 3], eta: R) -> [R; 3] {
    let sum = normalize_or(add(frame.view_dir, scale(l, eta)), [R::ZERO; 3]);
    let side = R::choose(R::ZERO.lt(dot(sum, frame.normal)), R::ONE, -R::ONE);
    scale(sum, side)
}

/// Solid: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it, in 1/sr:
/// color (1 - F) |v.h| |l.h| G D / (n.v (v.h + eta l.h)^2), equation 21 of the paper, over the index on the viewer's side.
///
/// G = G1(v) G1(l). The numerator's eta_o^2 is the viewer's side's, so f(v, l) eta_l^2 = f(l, v) eta_v^2: the form is
/// reciprocal up to the compression of radiance. F is exact; total internal reflection (eta < 1) gives 0.
/// 0 for a light in front. Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn transmission_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Transmission<R>) -> [R; 3] {
    let h = refraction_half(frame, l, p.eta);
    let (v_dot_h, l_dot_h) = (dot(frame.view_dir, h), dot(l, h));
    let sine = cross(frame.normal, h);
    let n_dot_l = -dot(frame.normal, l);
    let root = v_dot_h + p.eta * l_dot_h;
    let d = d_ggx(dot(frame.normal, h), dot(sine, sine), p.alpha);
    // G / (n.v |n.l|) is four times V of Smith's separable form; times |n.l| it is finite at the horizon.
    let a2 = p.alpha * p.alpha;
    let lit = |c: R| c + (a2 + (R::ONE - a2) * c * c).sqrt();
    let front = n_dot_l.max(R::ZERO);
    let g = R::of(4.0) * front / (lit(frame.n_dot_v) * lit(front)).max(R::of(1e-36));
    let f = f_dielectric(p.eta, v_dot_h);
    let part = (R::ONE - f) * d * g * v_dot_h * -l_dot_h / (root * root).max(R::of(JACOBIAN_FLOOR));
    // The two rays stand on both sides of the microfacet, and the light behind the surface.
    let through = R::ZERO.lt(v_dot_h) & l_dot_h.lt(R::ZERO) & R::ZERO.lt(n_dot_l);
    finite_or_zero(scale(p.color, R::choose(through, part, R::ZERO)))
}

/// f0 of a surface of which `weight` is a sheet with two faces: all bounces between them together reflect 2 f / (1 + f),
/// and the rest, (1 - f) / (1 + f), passes.
///
/// Domain: both arguments in [0, 1]. In [0, 1].
#[inline]
pub fn f0_of_sheet<R: Real>(f0: R, weight: R) -> R {
    f0 + weight * (f0 * (R::ONE - f0) / (R::ONE + f0))
}

/// Factor on [`transmission_eval`] that brings back what the microfacets beyond the first block of the light that comes
/// through a solid body's surface: 1 / (1 - loss),
/// loss = alpha (0.317 (1 - 1/eta) + q (0.361 - 0.335/eta + q (1.405/eta - 0.456))) / (1 - 0.067 alpha), q = 1 - n.v.
///
/// Our own fit to quadrature: with the reflection a white surface keeps 0.9 to 1.1 of the light for n.v from 0.3, roughness up to 1,
/// eta from 1.2 to 2. View-only, as `energy_compensation`. eta below 1 is taken as 1. In [1, 6.7].
#[inline]
pub fn transmission_compensation<R: Real>(n_dot_v: R, p: Transmission<R>) -> R {
    let one = R::ONE;
    let inv_eta = (one / p.eta.max(one)).clamp(R::ZERO, one);
    let q = one - n_dot_v.clamp(R::ZERO, one);
    let slope = R::of(0.317) * (one - inv_eta)
        + q * (R::of(0.361) - R::of(0.335) * inv_eta + q * (R::of(1.405) * inv_eta - R::of(0.456)));
    let loss = p.alpha * slope / (one - R::of(0.067) * p.alpha);
    one / (one - loss.clamp(R::ZERO, R::of(0.85)))
}

/// Thin-walled: BTDF times |n.l| for the unit direction `l` from the surface to a light behind it: a reflection whose light
/// is mirrored at the surface, color (1 - F) D V |n.l|, F of both faces of the sheet together.
///
/// F is Schlick's from [`f0_of_sheet`], as that of the reflection is, so that a smooth sheet keeps all light; at grazing
/// incidence a real sheet reflects more, 2 f / (1 + f) of Fresnel's f.
/// Reciprocal. eta below 1 is taken as 1 / eta. 0 for a light in front. Any input gives a finite result.
#[inline]
pub fn transmission_thin_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Transmission<R>) -> [R; 3] {
    let mirrored = add(l, scale(frame.normal, R::of(-2.0) * dot(frame.normal, l)));
    let h = half_from_light(frame, mirrored);
    let d = d_ggx(h.n_dot_h, h.sin2_theta_h, p.alpha);
    let v = v_smith_ggx_correlated(frame.n_dot_v, h.n_dot_l, h.l_dot_h, p.alpha);
    let [f, ..] = f_schlick([f0_of_sheet(f0_from_ior(p.eta), R::ONE); 3], [R::ONE; 3], h.l_dot_h);
    finite_or_zero(scale(p.color, (R::ONE - f) * (v * h.n_dot_l * d)))
}

/// Factor on [`transmission_thin_eval`] that brings back what single scattering loses: with it, and `energy_compensation` on
/// the reflection, a white sheet of reflectance f0 at normal incidence keeps all light,
/// (1 - (f0 a + b) (1 + f0 (1/E - 1))) / ((1 - f0) a), E = a + b of the split-sum pair `dfg`.
///
/// View-only. Domain: f0, a and b in [0, 1]. In [0, 10].
#[inline]
pub fn transmission_thin_compensation<R: Real>(f0: R, dfg: [R; 2]) -> R {
    let gain = R::ONE / (dfg[0] + dfg[1]).clamp(R::of(0.1), R::ONE) - R::ONE;
    let reflected = (f0 * dfg[0] + dfg[1]) * (R::ONE + f0 * gain);
    let factor = (R::ONE - reflected) / ((R::ONE - f0) * dfg[0]).max(R::of(1e-4));
    factor.clamp(R::ZERO, R::of(10.0))
}

/// The direction in which an environment is looked up for solid transmission: v refracted by the smooth surface, Snell's
/// law; where it is totally reflected, the grazing ray.
///
/// t = -v / eta + (n.v / eta - sqrt(1 - (1 - (n.v)^2) / eta^2)) n. Unit for unit arguments. For a thin wall it is -v.
#[inline]
pub fn transmission_direction<R: Real>(frame: Frame<R>, eta: R) -> [R; 3] {
    let inv_eta = R::ONE / eta.max(R::of(1e-6));
    let along = inv_eta * frame.n_dot_v - refracted_cosine(frame.n_dot_v, inv_eta);
    let t = add(scale(frame.view_dir, -inv_eta), scale(frame.normal, along));
    normalize_or(t, scale(frame.normal, -R::ONE))
}

/// The cosine of v refracted by the smooth surface, Snell's law; 0 where it is totally reflected.
#[inline]
fn refracted_cosine<R: Real>(n_dot_v: R, inv_eta: R) -> R {
    (R::ONE - inv_eta * inv_eta * (R::ONE - n_dot_v * n_dot_v)).max(R::ZERO).sqrt()
}

/// One lookup of an environment through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransmissionLookup<R> {
    /// Unit direction of the lookup in world space.
    pub dir: [R; 3],
    /// The roughness of the lookup.
    pub perceptual_roughness: R,
}

/// Where and how wide an environment is looked up for solid transmission. The microfacets that the viewer sees lean to
/// them: v is refracted about n + alpha (v - n.v n). A facet turned by an angle turns the refracted ray by
/// X = cos_t - n.v / eta of it out of its plane and by X / cos_t within, a reflected one by twice the angle: the lobe is as
/// wide as a reflection's of alpha X / (2 sqrt(cos_t)). 0.45 in the place of 1/2 and the lean are fitted to the integral.
///
/// alpha = 0 is [`transmission_direction`] and roughness 0. Domain: alpha in [0, 1], eta in [0.1, 10].
#[inline]
pub fn transmission_lookup<R: Real>(frame: Frame<R>, eta: R, alpha: R) -> TransmissionLookup<R> {
    let aside = add(frame.view_dir, scale(frame.normal, -frame.n_dot_v));
    let leaning = normalize_or(add(frame.normal, scale(aside, alpha)), frame.normal);
    let facet = frame_from_normal(leaning, frame.view_dir);
    let dir = transmission_direction(facet, eta);
    let inv_eta = R::ONE / eta.max(R::of(1e-6));
    let cos_t = refracted_cosine(facet.n_dot_v, inv_eta).max(R::of(0.01));
    let turn = (cos_t - facet.n_dot_v * inv_eta).abs();
    let width = (R::of(0.45) * alpha * turn / cos_t.sqrt()).clamp(R::ZERO, R::ONE);
    TransmissionLookup { dir, perceptual_roughness: width.sqrt() }
}

/// Radiance that arrives through the surface from an environment: color (1 - f0 a - b) times the radiance of
/// [`transmission_lookup`], or of -v at the roughness itself for a thin wall, with the split-sum pair `dfg` and the interface's f0.
///
/// The compression by eta^2 is left out: a ray that enters a body leaves it again. Any input gives a finite result.
#[inline]
pub fn transmission_environment<R: Real>(
    p: Transmission<R>,
    f0: R,
    transmitted_radiance: [R; 3],
    dfg: [R; 2],
) -> [R; 3] {
    let through = (R::ONE - f0 * dfg[0] - dfg[1]).clamp(R::ZERO, R::ONE);
    finite_or_zero([0, 1, 2].map(|i| p.color[i] * through * transmitted_radiance[i]))
}
