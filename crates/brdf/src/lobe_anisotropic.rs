//! The specular lobe of a brushed surface: GGX with two widths, along the tangent and across it.

use crate::Real;
use crate::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use crate::frame::{Frame, N_DOT_V_FLOOR, half_from_light};
use crate::fresnel::f_schlick;
use crate::math::{any_tangent, finite_or_zero, normalize_or};
use crate::vector::{add, cross, dot, scale};

/// Lookups of an environment along the stretched highlight.
pub const ANISOTROPIC_STRIPS: u32 = 5;

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

/// The unit direction across `normal` along which a surface is brushed: the mesh's tangent (w is the handedness of its
/// bitangent), made perpendicular to the shading normal and turned by `rotation` [rad] towards the bitangent, as
/// KHR_materials_anisotropy (Khronos 2023) counts it.
///
/// Domain: `normal` unit, any tangent. One of zero or along the normal is replaced by any other direction across it.
#[inline]
pub fn anisotropic_tangent<R: Real>(normal: [R; 3], tangent: [R; 4], rotation: R) -> [R; 3] {
    let [x, y, z, handedness] = tangent;
    let t = [x, y, z];
    let t = normalize_or(add(t, scale(normal, -dot(normal, t))), any_tangent(normal));
    let side = R::choose(handedness.lt(R::ZERO), -R::ONE, R::ONE);
    let (sin, cos) = rotation.sin_cos();
    add(scale(t, cos), scale(cross(normal, t), side * sin))
}

/// D V F times n.l for the unit direction `l` to a light, in 1/sr; 0 where the light is behind the surface.
///
/// The bitangent is n x t. Reciprocal. Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn anisotropic_eval<R: Real>(frame: Frame<R>, l: [R; 3], p: Anisotropic<R>) -> [R; 3] {
    let half = half_from_light(frame, l);
    let bitangent = cross(frame.normal, p.tangent);
    let h_in_tangent = [dot(p.tangent, half.h), dot(bitangent, half.h), half.n_dot_h];
    // Of v only n.v is held, as in the frame.
    let n_dot_v = dot(frame.normal, frame.view_dir).max(R::of(N_DOT_V_FLOOR));
    let view = [dot(p.tangent, frame.view_dir), dot(bitangent, frame.view_dir), n_dot_v];
    let light = [dot(p.tangent, l), dot(bitangent, l), dot(frame.normal, l)];
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

/// One of the lookups of an environment that stand for an anisotropic highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnisotropicStrip<R> {
    /// Unit direction of the lookup in world space.
    pub dir: [R; 3],
    /// The roughness of the lookup.
    pub perceptual_roughness: R,
    /// What it counts, above 0; the weights of all strips do not add up to 1.
    pub weight: R,
}

/// Strip `index` of 0 to [`ANISOTROPIC_STRIPS`] - 1: the stretched lobe as a row of round ones, side by side along the
/// tangent.
///
/// The slopes of GGX along the tangent beyond those of the width across, of width sqrt(alpha_t^2 - alpha_b^2), have the
/// density (1 + s^2)^(-3/2) / 2: the strips stand in the middles of equal parts of it, s = x / sqrt(1 - x^2), and mirror v
/// each about its own half vector. A lobe's width is what is left across there, alpha_b sqrt(1 + s^2), less where v leans
/// along the strips, and 0.2 of the gap to the next one. Constants are our own; the weight is n.l (Karis 2013).
///
/// alpha_t = alpha_b gives the mirror direction and alpha_b for every strip. Domain: alphas in [0, 1], alpha_t >= alpha_b
/// (else as if equal), a unit tangent across the normal. The roughness is in [0, 1].
#[inline]
pub fn anisotropic_strip<R: Real>(
    frame: Frame<R>,
    tangent: [R; 3],
    alpha_t: R,
    alpha_b: R,
    index: R,
) -> AnisotropicStrip<R> {
    let one = R::ONE;
    let spread2 = (alpha_t * alpha_t - alpha_b * alpha_b).max(R::ZERO);
    let apart = spread2 / (alpha_t * alpha_t).max(R::of(1e-18));
    let along = dot(frame.view_dir, tangent);
    let strips = f64::from(ANISOTROPIC_STRIPS);
    let x = R::of(2.0 / strips) * index + R::of(1.0 / strips - 1.0);
    let widening2 = one / (one - x * x);
    let slope = x * (spread2 * widening2).sqrt();
    let cos_h = one / (one + slope * slope).sqrt();
    let h = scale(add(frame.normal, scale(tangent, slope)), cos_h);
    let dir = add(scale(h, R::of(2.0) * dot(frame.view_dir, h)), scale(frame.view_dir, -one));
    let lean = (along - slope * frame.n_dot_v) * cos_h;
    let across = alpha_b * (one + ((one - lean * lean).max(R::of(1e-4)).sqrt() - one) * apart);
    // 1 less the square of what of v lies across the strips.
    let aside = along * along + frame.n_dot_v * frame.n_dot_v;
    let gap = widening2 * cos_h;
    // 0.2 of the gap 2 / ANISOTROPIC_STRIPS in x, squared.
    let gap2 = R::of(0.0064) * gap * gap * widening2 * (spread2 * aside);
    let alpha2 = (across * across * (one + (widening2 - one) * apart) + gap2) * (cos_h * cos_h);
    AnisotropicStrip {
        dir,
        perceptual_roughness: alpha2.min(one).sqrt().sqrt(),
        // Where v.h < 0, n.l is, too.
        weight: dot(frame.normal, dir).max(R::of(1e-3)),
    }
}

/// Karis 2013, the split sum: prefiltered radiance of [`anisotropic_strip`] or of [`anisotropic_reflection`] times the
/// lobe's directional albedo, taken as that of the width sqrt(alpha_t alpha_b).
///
/// Any input gives a finite result: a channel that would be NaN or infinite is 0.
#[inline]
pub fn anisotropic_environment<R: Real>(p: Anisotropic<R>, prefiltered_radiance: [R; 3], dfg: [R; 2]) -> [R; 3] {
    finite_or_zero([0, 1, 2].map(|i| prefiltered_radiance[i] * (p.f0[i] * dfg[0] + p.f90[i] * dfg[1])))
}
