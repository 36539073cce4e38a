//! The split sum's second factor as a table, by quadrature in f64.

use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::sampling::{g1_smith_ggx, sample_ggx_vndf};
use rayon::prelude::*;

use crate::harmonics::gauss_legendre;

/// Which masking and shadowing the albedo is integrated with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Height-correlated Smith (Heitz 2014).
    #[default]
    Correlated,
    /// The product of both directions' G1 (Walter et al. 2007).
    Separable,
}

/// Scale and bias over n.v and perceptual roughness.
#[derive(Clone, Debug, PartialEq)]
pub struct DfgTable {
    /// Texels along each axis, at least 2.
    pub size: usize,
    /// `size * size` pairs (a, b), row by row: column i is n_dot_v = (i / (size - 1))^2, row j is perceptual roughness
    /// j / (size - 1). Specular albedo = f0 a + f90 b.
    pub texels: Vec<[f32; 2]>,
}

/// Points along each ray of the disc of visible normals, and rays over half of it; the other half is its mirror image.
const POINTS: usize = 12;
const RAYS: usize = 24;

/// Halvings that find where a ray's normals stop reflecting the view above the horizon.
const HALVINGS: usize = 26;

/// The smallest cosine; the table's first column holds the limit towards 0.
const MIN_COSINE: f64 = 1e-6;

/// The table for height-correlated Smith; `size` is held in 2..=1024.
pub fn dfg_table(size: usize) -> DfgTable {
    dfg_table_with(size, Visibility::Correlated)
}

/// The table for a visibility; `size` is held in 2..=1024.
pub fn dfg_table_with(size: usize, visibility: Visibility) -> DfgTable {
    let size = size.clamp(2, 1024);
    let rule = gauss_legendre(POINTS);
    let texels = (0..size * size)
        .into_par_iter()
        .map(|k| {
            let place = |i: usize| i as f64 / (size - 1) as f64;
            integrated(place(k % size).powi(2), place(k / size), visibility, RAYS, &rule).map(|x| x as f32)
        })
        .collect();
    DfgTable { size, texels }
}

/// Scale and bias (a, b) of one n.v and perceptual roughness, both held in 0..=1.
///
/// Karis 2013, "Real Shading in Unreal Engine 4": a + b is the share of uniform light that a lobe with F = 1 reflects, and
/// b the part of it weighted by (1 - l.h)^5. Both are integrated over the visible normals (Heitz 2018, "Sampling the GGX
/// Distribution of Visible Normals"), where the integrand is G2 / G1 <= 1: Gauss's rule along rays of the projected disc,
/// each ending where light would come from below the horizon, and equal steps between rays.
pub fn dfg(n_dot_v: f64, perceptual_roughness: f64, visibility: Visibility) -> [f64; 2] {
    integrated(n_dot_v, perceptual_roughness, visibility, 8 * RAYS, &gauss_legendre(4 * POINTS))
}

fn integrated(
    n_dot_v: f64,
    perceptual_roughness: f64,
    visibility: Visibility,
    rays: usize,
    rule: &[(f64, f64)],
) -> [f64; 2] {
    // Written so that what is not a number counts as the lower bound.
    let n_dot_v = if n_dot_v > MIN_COSINE { n_dot_v.min(1.0) } else { MIN_COSINE };
    let alpha = alpha_from_perceptual_roughness(perceptual_roughness).max(1e-8);
    let view = [(1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v];
    let g1 = g1_smith_ggx(n_dot_v, alpha);
    let (mut all, mut bias) = (0.0, 0.0);
    for ray in 0..rays {
        let angle = (ray as f64 + 0.5) / (2 * rays) as f64;
        // (v.h, n.l) along the ray. u = 1 - (1 - t^2)^2 is like a radius where it is small, and dense near 1, where normals
        // turn away within 1 - u of about alpha^2.
        let along = |t: f64| {
            let rest = 1.0 - t * t;
            let h = sample_ggx_vndf(view, alpha, [angle, 1.0 - rest * rest]);
            let v_dot_h = view[0] * h[0] + view[2] * h[2];
            (v_dot_h, 2.0 * v_dot_h * h[2] - n_dot_v)
        };
        // The very end has no normal: there the two vectors that make it cancel.
        let (mut inside, mut end) = (0.0, 1.0 - 1e-6);
        if along(end).1 < 0.0 {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (inside + end);
                if along(middle).1 > 0.0 { inside = middle } else { end = middle }
            }
        }
        for &(x, w) in rule {
            let t = end * (x + 1.0) / 2.0;
            let (v_dot_h, n_dot_l) = along(t);
            if n_dot_l <= 0.0 || v_dot_h <= 0.0 {
                continue;
            }
            let v = match visibility {
                Visibility::Correlated => v_smith_ggx_correlated(n_dot_v, n_dot_l, v_dot_h, alpha),
                Visibility::Separable => v_smith_ggx_separable(n_dot_v, n_dot_l, v_dot_h, alpha),
            };
            // du / dt, and the share of the ray.
            let weight = w * end / 2.0 * 4.0 * t * (1.0 - t * t) / rays as f64;
            let g2_over_g1 = weight * 4.0 * n_dot_l * n_dot_v * v / g1;
            all += g2_over_g1;
            bias += g2_over_g1 * (1.0 - v_dot_h).max(0.0).powi(5);
        }
    }
    [all - bias, bias]
}
