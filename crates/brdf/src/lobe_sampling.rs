//! Sampling of the lobes, with the densities of what is drawn: for references and bakes. The shader does not sample.
//!
//! Local frame: the normal is +Z, +X the tangent. `view` is unit with z in [1e-6, 1], `u` are numbers in [0, 1). Directions
//! that come out below the horizon (of a reflection) or above it (of a transmission) carry no light: that part of the
//! density is lost. Densities are per solid angle, in 1/sr.

use crate::Real;
use crate::lobe_transmission::Transmission;
use crate::math::normalize_or;
use crate::sampling::sample_ggx_vndf;
use crate::sampling_bounded::{
    pdf_half_vector_ggx_vndf_anisotropic, pdf_solid_angle_cosine, pdf_solid_angle_ggx_bounded,
    pdf_solid_angle_hemisphere, sample_cosine, sample_ggx_bounded, sample_hemisphere,
};
use crate::vector::{add, dot, scale};

/// A direction for the diffuse lobe: by the cosine.
#[inline]
pub fn diffuse_sample<R: Real>(_view: [R; 3], u: [R; 2]) -> [R; 3] {
    sample_cosine(u)
}

/// Density of [`diffuse_sample`]. Integrates to 1.
#[inline]
pub fn diffuse_pdf<R: Real>(_view: [R; 3], l: [R; 3]) -> R {
    pdf_solid_angle_cosine(l[2])
}

/// A direction for the specular lobe, and for the coat: visible normals, bounded.
#[inline]
pub fn specular_sample<R: Real>(view: [R; 3], alpha: R, u: [R; 2]) -> [R; 3] {
    sample_ggx_bounded(view, alpha, alpha, u)
}

/// Density of [`specular_sample`].
#[inline]
pub fn specular_pdf<R: Real>(view: [R; 3], l: [R; 3], alpha: R) -> R {
    pdf_solid_angle_ggx_bounded(view, l, alpha, alpha)
}

/// A direction for the anisotropic lobe: visible normals, bounded by the narrower width.
#[inline]
pub fn anisotropic_sample<R: Real>(view: [R; 3], alphas: [R; 2], u: [R; 2]) -> [R; 3] {
    sample_ggx_bounded(view, alphas[0], alphas[1], u)
}

/// Density of [`anisotropic_sample`].
#[inline]
pub fn anisotropic_pdf<R: Real>(view: [R; 3], l: [R; 3], alphas: [R; 2]) -> R {
    pdf_solid_angle_ggx_bounded(view, l, alphas[0], alphas[1])
}

/// A direction for the sheen: uniform over the hemisphere, for the lobe is wide and has no visible normals.
#[inline]
pub fn sheen_sample<R: Real>(_view: [R; 3], u: [R; 2]) -> [R; 3] {
    sample_hemisphere(u)
}

/// Density of [`sheen_sample`]. Integrates to 1.
#[inline]
pub fn sheen_pdf<R: Real>(_view: [R; 3], l: [R; 3]) -> R {
    pdf_solid_angle_hemisphere(l[2])
}

/// A direction for solid transmission: v refracted by a visible normal. Total internal reflection gives the zero vector:
/// with eta < 1 that part is lost.
#[inline]
pub fn transmission_sample<R: Real>(view: [R; 3], p: Transmission<R>, u: [R; 2]) -> [R; 3] {
    let h = sample_ggx_vndf(view, p.alpha, u);
    let v_dot_h = dot(view, h);
    let inv_eta = R::ONE / p.eta;
    let cos2 = R::ONE - inv_eta * inv_eta * (R::ONE - v_dot_h * v_dot_h).max(R::ZERO);
    let along = inv_eta * v_dot_h - cos2.max(R::ZERO).sqrt();
    let t = normalize_or(add(scale(view, -inv_eta), scale(h, along)), [R::ZERO; 3]);
    let passes = R::ZERO.lt(cos2) & R::ZERO.lt(v_dot_h);
    t.map(|x| R::choose(passes, x, R::ZERO))
}

/// Density of [`transmission_sample`]: D_v(h) eta^2 |l.h| / (v.h + eta l.h)^2. Walter et al. 2007, equation 17.
///
/// Integrates to the part that is not totally reflected. 0 for directions that no normal refracts to.
#[inline]
pub fn transmission_pdf<R: Real>(view: [R; 3], l: [R; 3], p: Transmission<R>) -> R {
    let sum = normalize_or(add(view, scale(l, p.eta)), [R::ZERO; 3]);
    let h = scale(sum, R::choose(R::ZERO.lt(sum[2]), R::ONE, -R::ONE));
    let (v_dot_h, l_dot_h) = (dot(view, h), dot(l, h));
    let root = v_dot_h + p.eta * l_dot_h;
    let jacobian = p.eta * p.eta * -l_dot_h / (root * root).max(R::of(1e-24));
    let density = pdf_half_vector_ggx_vndf_anisotropic(view, h, p.alpha, p.alpha) * jacobian;
    R::choose(R::ZERO.lt(v_dot_h) & l_dot_h.lt(R::ZERO), density, R::ZERO)
}

/// A direction for thin-walled transmission: a reflection by a visible normal, mirrored at the surface.
#[inline]
pub fn transmission_thin_sample<R: Real>(view: [R; 3], alpha: R, u: [R; 2]) -> [R; 3] {
    let [x, y, z] = specular_sample(view, alpha, u);
    [x, y, -z]
}

/// Density of [`transmission_thin_sample`].
#[inline]
pub fn transmission_thin_pdf<R: Real>(view: [R; 3], l: [R; 3], alpha: R) -> R {
    specular_pdf(view, [l[0], l[1], -l[2]], alpha)
}
