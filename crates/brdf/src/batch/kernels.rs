//! The common lobes over slices. Local frame: the normal is +Z, `view` and `light` are unit.
//!
//! The specular lobe is GGX with the height-correlated V and Schlick's Fresnel with f90 = 1: the metal-rough model's.
//! The diffuse lobe is EON. The specular one is written for the local frame, with the half vector's length cancelled and one division: dividers are the narrowest
//! part of a CPU with wide vectors. The values agree with those of the scalar functions within their errors.

use super::{Kernel, LengthMismatch, Simd};
use crate::Real;
use crate::diffuse::diffuse_eon;
use crate::frame::N_DOT_V_FLOOR;
use crate::ggx::V_FLOOR;
use crate::math::{FINITE_CEILING, INV_PI, LENGTH2_FLOOR, pow5};
use crate::sampling::sample_ggx_vndf;
use crate::sampling_bounded::{pdf_solid_angle_cosine, sample_cosine};
use crate::vector::dot;

/// sqrt(alpha^2 + (1 - alpha^2) c^2): of GGX's masking.
#[inline(always)]
fn masking_root<R: Real>(cosine: R, a2: R) -> R {
    ((R::ONE - a2) * cosine).mul_add(cosine, a2).sqrt()
}

#[inline(always)]
fn f_schlick_metal<R: Real>(f0: R, weight: R) -> R {
    f0.mul_add(R::ONE - weight, weight)
}

/// Factor of both sides of the one division of [`SpecularEval`], squared: its lower side is a fourth power of cosines, and
/// 2^58 keeps it within f32's range, for directions of length 1 and alpha >= 1e-8.
const RANGE: f64 = (1_u64 << 58) as f64;

/// Of D for the half vector along `sum`, of any length, without normalising it: D = k^2 / pi,
/// k = alpha |s|^2 / (alpha^2 s.z^2 + s.x^2 + s.y^2).
#[inline(always)]
fn d_ggx_denominator<R: Real>(sum: [R; 3], alpha: R) -> R {
    let a = sum[2] * alpha;
    let denominator = a.mul_add(a, sum[1].mul_add(sum[1], sum[0] * sum[0]));
    // The floor makes the 0 / 0 of v + l = 0, and of alpha = 0 at the peak, a number.
    denominator.max(R::of(LENGTH2_FLOOR))
}

/// D V F n.l of directions to the viewer and to the light.
/// Inputs: view x y z, light x y z, alpha, f0 r g b. Outputs: r g b.
pub struct SpecularEval;

impl Kernel<10, 3> for SpecularEval {
    #[inline(always)]
    fn call<R: Real>(&self, [vx, vy, vz, lx, ly, lz, alpha, r, g, b]: [R; 10]) -> [R; 3] {
        let n_dot_v = vz.max(R::of(N_DOT_V_FLOOR));
        let n_dot_l = lz.max(R::ZERO);
        let a2 = alpha * alpha;
        let masking = n_dot_l.mul_add(masking_root(n_dot_v, a2), n_dot_v * masking_root(n_dot_l, a2));
        let sum = [vx + lx, vy + ly, vz + lz];
        let sine2 = sum[1].mul_add(sum[1], sum[0] * sum[0]);
        let length2 = sum[2].mul_add(sum[2], sine2);
        let a = sum[2] * alpha;
        let below = a.mul_add(a, sine2) * R::of(RANGE);
        let above = a2 * (R::of(0.5 * INV_PI * RANGE * RANGE) * n_dot_l) * (length2 * length2);
        // 1 - l.h, an ulp below 0 at most.
        let weight = pow5(length2.sqrt_by_products().mul_add(R::of(-0.5), R::ONE));
        let scale = above / (below * below * masking);
        // scale (f0 + (1 - f0) weight), scaled before it meets the colours. The last step also catches 0 / 0.
        let white = scale * weight;
        let tinted = scale - white;
        [r, g, b].map(|f0| f0.mul_add(tinted, white).clamp(R::ZERO, R::of(FINITE_CEILING)))
    }
}

/// EON times n.l ([`diffuse_eon`]; perceptual roughness 0 is Lambert's) of directions to the viewer and to the light.
/// Inputs: view x y z, light x y z, perceptual roughness, albedo r g b. Outputs: r g b.
pub struct DiffuseEval;

impl Kernel<10, 3> for DiffuseEval {
    #[inline(always)]
    fn call<R: Real>(&self, [vx, vy, vz, lx, ly, lz, perceptual_roughness, r, g, b]: [R; 10]) -> [R; 3] {
        let n_dot_v = vz.clamp(R::of(N_DOT_V_FLOOR), R::ONE);
        let n_dot_l = lz.clamp(R::ZERO, R::ONE);
        let sum = [vx + lx, vy + ly, vz + lz];
        let l_dot_h = R::of(0.5) * dot(sum, sum).sqrt();
        let brdf = diffuse_eon([r, g, b], n_dot_v, n_dot_l, l_dot_h, perceptual_roughness);
        brdf.map(|c| (c * n_dot_l).clamp(R::ZERO, R::of(FINITE_CEILING)))
    }
}

/// A light direction by the cosine ([`sample_cosine`]), for the diffuse lobe, whose weight is then pi times its BRDF.
/// Inputs: two numbers in [0, 1). Outputs: light x y z, density in 1/sr.
pub struct DiffuseSample;

impl Kernel<2, 4> for DiffuseSample {
    #[inline(always)]
    fn call<R: Real>(&self, u: [R; 2]) -> [R; 4] {
        let [x, y, z] = sample_cosine(u);
        [x, y, z, pdf_solid_angle_cosine(z)]
    }
}

/// Density of light directions drawn by [`SpecularSample`]: G1(v) D(h) / (4 n.v).
/// Inputs: view x y z, light x y z, alpha. Outputs: density in 1/sr.
pub struct SpecularPdf;

impl Kernel<7, 1> for SpecularPdf {
    #[inline(always)]
    fn call<R: Real>(&self, [vx, vy, vz, lx, ly, lz, alpha]: [R; 7]) -> [R; 1] {
        let n_dot_v = vz.max(R::of(N_DOT_V_FLOOR));
        let sum = [vx + lx, vy + ly, vz + lz];
        let k = alpha * dot(sum, sum) / d_ggx_denominator(sum, alpha);
        [k * k * R::of(0.5 * INV_PI) / (n_dot_v + masking_root(n_dot_v, alpha * alpha))]
    }
}

/// A light direction for a view: the mirror image about a visible GGX normal ([`sample_ggx_vndf`]).
/// Inputs: view x y z, alpha, f0 r g b, two numbers in [0, 1).
/// Outputs: light x y z, density in 1/sr, weight r g b = (D V F n.l) / density, 0 below the horizon.
pub struct SpecularSample;

impl Kernel<9, 7> for SpecularSample {
    #[inline(always)]
    fn call<R: Real>(&self, [vx, vy, vz, alpha, r, g, b, u0, u1]: [R; 9]) -> [R; 7] {
        let view = [vx, vy, vz];
        let n_dot_v = vz.max(R::of(N_DOT_V_FLOOR));
        let h = sample_ggx_vndf([vx, vy, n_dot_v], alpha, [u0, u1]);
        let v_dot_h = dot(view, h);
        let twice = v_dot_h + v_dot_h;
        let light = [0, 1, 2].map(|i| twice.mul_add(h[i], -view[i]));
        let n_dot_l = light[2].max(R::ZERO);
        let a2 = alpha * alpha;
        let view_root = masking_root(n_dot_v, a2);
        let k = alpha / d_ggx_denominator(h, alpha);
        let pdf = k * k * R::of(0.5 * INV_PI) / (n_dot_v + view_root);
        // G2 / G1(v) = n.l (n.v + root(v)) / (n.l root(v) + n.v root(l)).
        let masking = n_dot_l.mul_add(view_root, n_dot_v * masking_root(n_dot_l, a2)).max(R::of(V_FLOOR));
        let ratio = n_dot_l * (n_dot_v + view_root) / masking;
        let weight = pow5((R::ONE - v_dot_h).max(R::ZERO));
        let [r, g, b] = [r, g, b].map(|f0| f_schlick_metal(f0, weight) * ratio);
        [light[0], light[1], light[2], pdf, r, g, b]
    }
}

/// Slices of unit directions: x, y and z.
pub type Directions<'a> = [&'a [f32]; 3];

impl Simd {
    /// [`SpecularEval`] over slices: BRDF times n.l in 1/sr, r g b, into `out`; 0 where the light is behind the surface.
    ///
    /// Domain: alpha in [1e-8, 1], f0 in [0, 1]. Any input gives a result in [0, 3e38]: a channel that would be NaN or
    /// negative is 0. n.v is held above 1e-7. Where the light is opposite to the viewer, the lobe is 0.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have one length.
    pub fn specular_eval(
        self,
        view: Directions,
        light: Directions,
        alpha: &[f32],
        f0: [&[f32]; 3],
        out: [&mut [f32]; 3],
    ) -> Result<(), LengthMismatch> {
        let [vx, vy, vz] = view;
        let [lx, ly, lz] = light;
        let [r, g, b] = f0;
        self.run(&SpecularEval, [vx, vy, vz, lx, ly, lz, alpha, r, g, b], out)
    }

    /// [`DiffuseEval`] over slices: BRDF times n.l in 1/sr, r g b, into `out`; 0 where the light is behind the surface.
    ///
    /// Domain: perceptual roughness and albedo in [0, 1]. Any input gives a result in [0, 3e38]: a channel that would be NaN
    /// or negative is 0. n.v is held above 1e-7.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have one length.
    pub fn diffuse_eval(
        self,
        view: Directions,
        light: Directions,
        perceptual_roughness: &[f32],
        albedo: [&[f32]; 3],
        out: [&mut [f32]; 3],
    ) -> Result<(), LengthMismatch> {
        let [vx, vy, vz] = view;
        let [lx, ly, lz] = light;
        let [r, g, b] = albedo;
        self.run(&DiffuseEval, [vx, vy, vz, lx, ly, lz, perceptual_roughness, r, g, b], out)
    }

    /// [`DiffuseSample`] over slices: unit directions to light, and their density in 1/sr.
    ///
    /// Domain: `u` in [0, 1).
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have one length; outputs are counted light x y z, density.
    pub fn diffuse_sample(
        self,
        u: [&[f32]; 2],
        light: [&mut [f32]; 3],
        pdf_solid_angle: &mut [f32],
    ) -> Result<(), LengthMismatch> {
        let [lx, ly, lz] = light;
        self.run(&DiffuseSample, u, [lx, ly, lz, pdf_solid_angle])
    }

    /// [`SpecularPdf`] over slices: the density in 1/sr with which [`Simd::specular_sample`] draws `light`.
    ///
    /// Domain: alpha in [1e-8, 1]. NaN in gives NaN out. n.v is held above 1e-7.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have one length.
    pub fn specular_pdf(
        self,
        view: Directions,
        light: Directions,
        alpha: &[f32],
        pdf_solid_angle: &mut [f32],
    ) -> Result<(), LengthMismatch> {
        let [vx, vy, vz] = view;
        let [lx, ly, lz] = light;
        self.run(&SpecularPdf, [vx, vy, vz, lx, ly, lz, alpha], [pdf_solid_angle])
    }

    /// [`SpecularSample`] over slices: directions to light, their density in 1/sr, and the weight BRDF n.l / density.
    ///
    /// Domain: alpha in [1e-8, 1], f0 in [0, 1], `u` in [0, 1). n.v is held above 1e-7. A direction below the horizon has
    /// weight 0 and a density. NaN in gives NaN in the same element.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have one length; outputs are counted light x y z, density, weight r g b.
    pub fn specular_sample(
        self,
        view: Directions,
        alpha: &[f32],
        f0: [&[f32]; 3],
        u: [&[f32]; 2],
        out: SampleSlices,
    ) -> Result<(), LengthMismatch> {
        let [vx, vy, vz] = view;
        let [r, g, b] = f0;
        let [lx, ly, lz] = out.light;
        let [wr, wg, wb] = out.weight;
        let inputs = [vx, vy, vz, alpha, r, g, b, u[0], u[1]];
        self.run(&SpecularSample, inputs, [lx, ly, lz, out.pdf_solid_angle, wr, wg, wb])
    }
}

/// Where [`Simd::specular_sample`] writes.
pub struct SampleSlices<'a> {
    /// Unit directions to the light: x, y, z.
    pub light: [&'a mut [f32]; 3],
    /// Their density in 1/sr.
    pub pdf_solid_angle: &'a mut [f32],
    /// BRDF times n.l over the density: r, g, b.
    pub weight: [&'a mut [f32]; 3],
}
