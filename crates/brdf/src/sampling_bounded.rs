//! Sampling of GGX reflections with two widths, alpha_t along x and alpha_b along y: all visible normals, or only those
//! that reflect above a bound of the horizon; and the cosine. For tables, bakes and references.
//!
//! Local frame: the normal is +Z. Domain: alphas in [1e-8, 1], view unit with z in [1e-6, 1], `u` two numbers in [0, 1).

use crate::Real;
use crate::math::{INV_PI, PI, normalize_or};
use crate::vector::{add, dot, scale};

/// Smallest squared denominator of D's root and of the projected area.
const AREA_FLOOR: f64 = 1e-36;

/// D of GGX with two widths over pi: s w^2 / pi, s = alpha_t alpha_b, w = s / |(alpha_b h.x, alpha_t h.y, s h.z)|^2.
/// Burley 2012, Physically-Based Shading at Disney, appendix B.
#[inline]
fn d_two_widths<R: Real>(h: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let s = alpha_t * alpha_b;
    let q = [alpha_b * h[0], alpha_t * h[1], s * h[2]];
    let w = s / dot(q, q).max(R::of(AREA_FLOOR));
    s * w * (w * R::of(INV_PI))
}

/// 2 (v.h) h - v, the direction that `view` is reflected to by a microfacet of normal `h`.
#[inline]
pub fn reflected<R: Real>(view: [R; 3], h: [R; 3]) -> [R; 3] {
    add(scale(h, R::of(2.0) * dot(view, h)), scale(view, -R::ONE))
}

/// The normal of a spherical cap's sample, taken back from the hemisphere of alpha 1: Dupuy and Benyoub 2023, Sampling
/// Visible GGX Normals with Spherical Caps, with the cap's lowest height -`bound` times that of the whole cap.
#[inline]
fn cap_normal<R: Real>(view: [R; 3], alpha_t: R, alpha_b: R, bound: R, u: [R; 2]) -> [R; 3] {
    let up = [R::ZERO, R::ZERO, R::ONE];
    let w = normalize_or([view[0] * alpha_t, view[1] * alpha_b, view[2]], up);
    let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
    let s = (u[1] * (R::ONE + bound * w[2])).clamp(R::ZERO, R::of(2.0));
    let sin_theta = (s * (R::of(2.0) - s)).sqrt();
    let h = [sin_theta * cos_phi + w[0], sin_theta * sin_phi + w[1], (R::ONE - s + w[2]).max(R::ZERO)];
    normalize_or([h[0] * alpha_t, h[1] * alpha_b, h[2]], up)
}

/// A half vector drawn from the normals of GGX with two widths that `view` sees, G1(v) max(0, v.h) D(h) / n.v.
/// Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps.
///
/// alpha_t = alpha_b is [`crate::sampling::sample_ggx_vndf`]. The result is a unit vector with z >= 0.
#[inline]
pub fn sample_ggx_vndf_anisotropic<R: Real>(view: [R; 3], alpha_t: R, alpha_b: R, u: [R; 2]) -> [R; 3] {
    cap_normal(view, alpha_t, alpha_b, R::ONE, u)
}

/// Density, per solid angle of half vectors, of [`sample_ggx_vndf_anisotropic`]: G1(v) max(0, v.h) D(h) / n.v, taken as
/// 2 max(0, v.h) D(h) / (n.v + |(alpha_t v.x, alpha_b v.y, v.z)|).
///
/// Integrates to 1 over the hemisphere. Error in f32: <= 16 ulp for exact arguments.
#[inline]
pub fn pdf_half_vector_ggx_vndf_anisotropic<R: Real>(view: [R; 3], h: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let stretched = [alpha_t * view[0], alpha_b * view[1], view[2]];
    let area = view[2] + dot(stretched, stretched).sqrt();
    R::of(2.0) * dot(view, h).max(R::ZERO) * d_two_widths(h, alpha_t, alpha_b) / area.max(R::of(AREA_FLOOR))
}

/// Density, per solid angle of directions, of the reflection of `view` by [`sample_ggx_vndf_anisotropic`].
///
/// Directions below the horizon have a density too: they are the part that is lost when only those above count (up to
/// 42 % at roughness 1 and grazing incidence), and with them the integral is 1. 0 where v + l = 0.
#[inline]
pub fn pdf_solid_angle_ggx_vndf_anisotropic<R: Real>(view: [R; 3], dir: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let h = normalize_or(add(view, dir), [R::ZERO; 3]);
    let stretched = [alpha_t * view[0], alpha_b * view[1], view[2]];
    let area = view[2] + dot(stretched, stretched).sqrt();
    let front = h[2].max(R::ZERO);
    let density = R::of(0.5) * d_two_widths(h, alpha_t, alpha_b) / area.max(R::of(AREA_FLOOR));
    R::choose(R::ZERO.lt(front), density, R::ZERO)
}

/// How much smaller the sampled cap is: k = (1 - a^2) s^2 / (s^2 + a^2 z^2), a = min(alpha_t, alpha_b, 1),
/// s = 1 + sqrt(v.x^2 + v.y^2). Eto and Tokuyoshi 2023, equation 5.
#[inline]
fn cap_bound<R: Real>(view: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let a = alpha_t.min(alpha_b).min(R::ONE);
    let s = R::ONE + (view[0] * view[0] + view[1] * view[1]).sqrt();
    let (a2, s2) = (a * a, s * s);
    (R::ONE - a2) * s2 / (s2 + a2 * view[2] * view[2])
}

/// A reflected direction drawn from the visible normals without most of those that reflect below the horizon.
/// Eto and Tokuyoshi 2023, Bounded VNDF Sampling for Smith-GGX Reflections.
///
/// The bound is that of the narrower width, so with two widths more is lost than with one. The result is unit; its z may
/// still be below 0.
#[inline]
pub fn sample_ggx_bounded<R: Real>(view: [R; 3], alpha_t: R, alpha_b: R, u: [R; 2]) -> [R; 3] {
    reflected(view, cap_normal(view, alpha_t, alpha_b, cap_bound(view, alpha_t, alpha_b), u))
}

/// Density, per solid angle of directions, of [`sample_ggx_bounded`]: D(h) / (2 (k n.v + |(alpha_t v.x, alpha_b v.y, v.z)|)).
///
/// It holds for every direction that can be drawn, all those above the horizon among them; it is greater there than
/// the unbounded density, and integrates to 1 with the part that is still drawn below the horizon. 0 where v + l = 0.
/// Error in f32: <= 16 ulp for exact arguments.
#[inline]
pub fn pdf_solid_angle_ggx_bounded<R: Real>(view: [R; 3], dir: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let h = normalize_or(add(view, dir), [R::ZERO; 3]);
    let density = R::of(0.5) * d_two_widths(h, alpha_t, alpha_b) / area_ggx_bounded(view, alpha_t, alpha_b);
    R::choose(R::ZERO.lt(h[2]), density, R::ZERO)
}

/// What D(h) / 2 is divided by in [`pdf_solid_angle_ggx_bounded`]: k n.v + |(alpha_t v.x, alpha_b v.y, v.z)|, for who
/// knows D(h) already. Never below 1e-36.
#[inline]
pub fn area_ggx_bounded<R: Real>(view: [R; 3], alpha_t: R, alpha_b: R) -> R {
    let stretched = [alpha_t * view[0], alpha_b * view[1], view[2]];
    let area = cap_bound(view, alpha_t, alpha_b) * view[2] + dot(stretched, stretched).sqrt();
    area.max(R::of(AREA_FLOOR))
}

/// A direction of the upper hemisphere with density n.l / pi. Malley's method: a point of the unit disc, lifted.
/// Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section A.5.3.
///
/// z = sqrt(1 - u1) exactly, without cancellation at the horizon; it is never below 2^-12 in f32.
#[inline]
pub fn sample_cosine<R: Real>(u: [R; 2]) -> [R; 3] {
    let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
    let radius = u[1].clamp(R::ZERO, R::ONE).sqrt();
    [radius * cos_phi, radius * sin_phi, (R::ONE - u[1]).clamp(R::ZERO, R::ONE).sqrt()]
}

/// Density of [`sample_cosine`]: n.l / pi, 0 below the horizon.
#[inline]
pub fn pdf_solid_angle_cosine<R: Real>(n_dot_l: R) -> R {
    n_dot_l.max(R::ZERO) * R::of(INV_PI)
}

/// A direction of the upper hemisphere, all equally likely: z = 1 - u1.
#[inline]
pub fn sample_hemisphere<R: Real>(u: [R; 2]) -> [R; 3] {
    let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
    let z = (R::ONE - u[1]).clamp(R::ZERO, R::ONE);
    let radius = (u[1].clamp(R::ZERO, R::ONE) * (R::ONE + z)).sqrt();
    [radius * cos_phi, radius * sin_phi, z]
}

/// Density of [`sample_hemisphere`]: 1 / (2 pi), 0 below the horizon.
#[inline]
pub fn pdf_solid_angle_hemisphere<R: Real>(n_dot_l: R) -> R {
    R::choose(R::ZERO.le(n_dot_l), R::of(0.5 * INV_PI), R::ZERO)
}
