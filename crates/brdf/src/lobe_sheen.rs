//! Sheen: the fuzz of cloth over all that lies below. Charlie's distribution (Estevez and Kulla 2017, Production Friendly
//! Microfacet Sheen BRDF) with Neubelt and Pettineo's visibility, as in Khronos 2020, KHR_materials_sheen.
//!
//! That pair is no BRDF at grazing angles: its directional albedo E reaches 3.2 at n.v = 0.004, roughness 0.1, and grows
//! without bound as both fall. Here the lobe is divided by max(1, 1.06 E(v), 1.06 E(l)), which is reciprocal and reflects
//! at most what arrives; where both albedos are below 0.94 it is the published form.

use crate::Real;
use crate::frame::{Frame, half_from_light};
use crate::math::finite_or_zero;
use crate::sheen::{d_charlie, v_neubelt};
use crate::vector::{add, scale};

/// Smallest perceptual roughness of the fit of the albedo.
const SHEEN_ROUGHNESS_FLOOR: f64 = 0.05;
/// What the fit of the albedo may be too low by, as a factor, where the albedo is near 1.
const SHEEN_MARGIN: f64 = 1.06;

/// 1 / 1.06: what the lobe reflects where the fit would have it reflect all.
const SHEEN_ALBEDO_CEILING: f64 = 0.943_396_226_415_094_3;

/// Parameters of the sheen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen<R> {
    /// Colour times weight, linear Rec. 709, in [0, 1].
    pub color: [R; 3],
    /// Artist's roughness in [0, 1]; held above 0.05.
    pub perceptual_roughness: R,
}

/// Directional albedo of the white lobe before it is held at 1: our own fit to quadrature in the perceptual roughness r,
/// E = (0.347 + 0.1492 r + 0.1148 r^2) / r exp(-mu (b - mu (c - mu d))), b = 0.7769 + 1.4284 / r, c = 0.9992 + 1.1096 / r,
/// d = 0.2518 + 0.9523 / r + 0.1776 / r^2.
///
/// Domain: n_dot_w in [0, 1] (held), perceptual_roughness in [0.05, 1] (held). Error from roughness 0.1 up: <= 0.05 max(1, E);
/// relative to max(E, 0.02) at most 0.17, and 0.02 rms.
#[inline]
pub fn sheen_albedo<R: Real>(n_dot_w: R, perceptual_roughness: R) -> R {
    let r = perceptual_roughness.clamp(R::of(SHEEN_ROUGHNESS_FLOOR), R::ONE);
    let inv_r = R::ONE / r;
    let mu = n_dot_w.clamp(R::ZERO, R::ONE);
    let at_grazing = (R::of(0.347) + r * (R::of(0.1492) + r * R::of(0.1148))) * inv_r;
    let b = R::of(0.7769) + R::of(1.4284) * inv_r;
    let c = R::of(0.9992) + R::of(1.1096) * inv_r;
    let d = R::of(0.2518) + inv_r * (R::of(0.9523) + R::of(0.1776) * inv_r);
    at_grazing * (-R::of(core::f64::consts::LOG2_E) * mu * (b - mu * (c - mu * d))).exp2()
}

/// BRDF times n.l for the unit direction `l` to a light, color D V n.l / max(1, 1.06 E(v), 1.06 E(l)) in 1/sr; 0 where the
/// light is behind the surface.
///
/// Reciprocal. Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn sheen_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Sheen<R>) -> [R; 3] {
    let h = half_from_light(frame, l);
    let r = p.perceptual_roughness.clamp(R::of(SHEEN_ROUGHNESS_FLOOR), R::ONE);
    let d = d_charlie(h.n_dot_h, h.sin2_theta_h, r * r);
    let v = v_neubelt(frame.n_dot_v, h.n_dot_l, h.l_dot_h, r * r);
    let most = sheen_albedo(frame.n_dot_v, r).max(sheen_albedo(h.n_dot_l, r)) * R::of(SHEEN_MARGIN);
    finite_or_zero(scale(p.color, v * h.n_dot_l * d / most.max(R::ONE)))
}

/// The direction, not unit, about which the sheen's light is gathered: n + 0.4 v, the normal leaning to the viewer, to whom
/// fibres that stand up reflect most of what comes from behind them.
#[inline]
pub fn sheen_direction<R: Real>(frame: Frame<R>) -> [R; 3] {
    add(frame.normal, scale(frame.view_dir, R::of(0.4)))
}

/// Radiance filtered by the sheen's lobe, a ring that narrows to the horizon with the roughness r, from two lookups:
/// `around`, the irradiance over pi about [`sheen_direction`], and `middle`, prefiltered about the normal for a roughness
/// near 0.56, which the ring does not see: max(around + (0.84 - 0.7 r) (around - middle), 0.4 around).
///
/// Our own fit to the integral of light times the lobe, for r from 0.2: a little nearer to it than a map that is filtered by
/// Charlie's distribution with n = v, and it needs none.
#[inline]
pub fn sheen_ring<R: Real>(p: Sheen<R>, around: [R; 3], middle: [R; 3]) -> [R; 3] {
    let part = R::of(0.84) - R::of(0.7) * p.perceptual_roughness;
    [0, 1, 2].map(|i| (around[i] + part * (around[i] - middle[i])).max(R::of(0.4) * around[i]))
}

/// Radiance that the sheen reflects from an environment, seen at n.v: color min(E, 1/1.06) times the radiance filtered by
/// the lobe: [`sheen_ring`]'s, or, one lookup less and a worse fit, the irradiance over pi of the normal.
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn sheen_environment<R: Real>(p: Sheen<R>, n_dot_v: R, prefiltered_radiance: [R; 3]) -> [R; 3] {
    let albedo = sheen_albedo(n_dot_v, p.perceptual_roughness).min(R::of(SHEEN_ALBEDO_CEILING));
    finite_or_zero([0, 1, 2].map(|i| p.color[i] * albedo * prefiltered_radiance[i]))
}

/// What the base keeps of its own light below the sheen: 1 - max(color) min(E(v), 1). Estevez and Kulla 2017, albedo
/// scaling; the same for all channels, so that a coloured sheen tints nothing twice.
///
/// View-only. In [0, 1] for any numbers: a weight can not become negative. Base and sheen together reflect at most 1.03
/// times what arrives (the fit's error).
#[inline]
pub fn sheen_base<R: Real>(p: Sheen<R>, n_dot_v: R) -> R {
    let albedo = sheen_albedo(n_dot_v, p.perceptual_roughness).min(R::ONE);
    let most = p.color[0].max(p.color[1]).max(p.color[2]);
    (R::ONE - most * albedo).clamp(R::ZERO, R::ONE)
}
