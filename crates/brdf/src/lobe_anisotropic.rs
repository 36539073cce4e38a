//! The specular lobe of a brushed surface: GGX with two widths, along the tangent and across it.

use crate::Real;
use crate::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use crate::frame::{Frame, half_from_light};
use crate::fresnel::f_schlick;
use crate::math::{finite_or_zero, normalize_or};
use crate::vector::{add, cross, dot, scale};

/// Parameters of the anisotropic specular lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropic<R> {
    /// Reflectance at normal incidence.
    pub f0: [R; 3],
    /// Reflectance at grazing incidence.
    pub f90: [R; 3],
    /// Unit tangent across the normal, along which alpha_t counts, in world space.
    pub tangent: [R; 3],
    /// Width along the tangent.
    pub alpha_t: R,
    /// Width along the bitangent.
    pub alpha_b: R,
}

/// (alpha_t, alpha_b) of KHR_materials_anisotropy (Khronos 2023): alpha_t = mix(alpha, 1, anisotropy^2), alpha_b = alpha.
///
/// Domain: both arguments in [0, 1] (held); the alphas are in [0, 1], and the highlight is stretched along the tangent.
#[inline]
pub fn anisotropic_alphas_gltf<R: Real>(perceptual_roughness: R, anisotropy: R) -> [R; 2] {
    let r = perceptual_roughness.clamp(R::ZERO, R::ONE);
    let strength = anisotropy.clamp(R::ZERO, R::ONE);
    let alpha = r * r;
    [alpha + (R::ONE - alpha) * strength * strength, alpha]
}

/// (alpha_t, alpha_b) of OpenPBR 1.1 (Academy Software Foundation 2024), section 3.3: alpha_t = alpha sqrt(2 / (1 + q^2)),
/// alpha_b = q alpha_t, q = 1 - anisotropy: the mean of the squares stays alpha^2.
///
/// Domain: both arguments in [0, 1] (held). alpha_t is in [0, sqrt 2].
#[inline]
pub fn anisotropic_alphas_openpbr<R: Real>(perceptual_roughness: R, anisotropy: R) -> [R; 2] {
    let r = perceptual_roughness.clamp(R::ZERO, R::ONE);
    let q = R::ONE - anisotropy.clamp(R::ZERO, R::ONE);
    let alpha_t = r * r * (R::of(2.0) / (R::ONE + q * q)).sqrt();
    [alpha_t, q * alpha_t]
}

/// D V F times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
///
/// The bitangent is n x t. Reciprocal. Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn anisotropic_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Anisotropic<R>) -> [R; 3] {
    let half = half_from_light(frame, l);
    let bitangent = cross(frame.normal, p.tangent);
    let h = normalize_or(add(frame.view_dir, l), [R::ZERO; 3]);
    let h_in_tangent = [dot(p.tangent, h), dot(bitangent, h), half.n_dot_h];
    let view = [dot(p.tangent, frame.view_dir), dot(bitangent, frame.view_dir), frame.n_dot_v];
    let light = [dot(p.tangent, l), dot(bitangent, l), half.n_dot_l];
    let d = d_ggx_anisotropic(h_in_tangent, p.alpha_t, p.alpha_b);
    let v = v_smith_ggx_anisotropic(view, light, p.alpha_t, p.alpha_b);
    let f = f_schlick(p.f0, p.f90, half.l_dot_h);
    finite_or_zero(scale(f, v * half.n_dot_l * d))
}

/// The direction in which an environment is looked up for an anisotropic highlight: the mirror direction about a normal
/// that is bent from n towards the plane of the bitangent and v, the more the narrower the lobe is across.
/// Khronos 2023, KHR_materials_anisotropy, implementation notes: after McAuley 2015, Rendering the World of Far Cry 4.
///
/// Exact for anisotropy = 0 (the mirror direction); else a guess at the stretched lobe's middle, by one lookup. Unit.
/// Domain: anisotropy and perceptual_roughness in [0, 1] (held).
#[inline]
pub fn anisotropic_reflection<R: Real>(
    frame: Frame<R>,
    tangent: [R; 3],
    anisotropy: R,
    perceptual_roughness: R,
) -> [R; 3] {
    let bitangent = cross(frame.normal, tangent);
    let across = normalize_or(cross(bitangent, frame.view_dir), tangent);
    let bent = cross(across, bitangent);
    let rest = R::ONE - anisotropy.clamp(R::ZERO, R::ONE) * (R::ONE - perceptual_roughness.clamp(R::ZERO, R::ONE));
    let keep = rest * rest * (rest * rest);
    let mixed = add(scale(bent, R::ONE - keep), scale(frame.normal, keep));
    let normal = normalize_or(mixed, frame.normal);
    let twice = R::of(2.0) * dot(frame.view_dir, normal);
    add(scale(normal, twice), scale(frame.view_dir, -R::ONE))
}

/// Karis 2013, the split sum: prefiltered radiance of [`anisotropic_reflection`] times the lobe's directional albedo, taken
/// as that of the width sqrt(alpha_t alpha_b).
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn anisotropic_environment<R: Real>(p: Anisotropic<R>, prefiltered_radiance: [R; 3], dfg: [R; 2]) -> [R; 3] {
    finite_or_zero([0, 1, 2].map(|i| prefiltered_radiance[i] * (p.f0[i] * dfg[0] + p.f90[i] * dfg[1])))
}
