//! Light that meets a rough metal more than once: what each compensation reflects of uniform light in all, against walks
//! between the facets.
//!
//! The walk is Smith's model followed to the end: Heitz, Hanika, d'Eon, Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs
//! with the Smith Model". Facets lie at any height, independent of each other and of their neighbours; a path that is shadowed
//! meets the next facet.

use halfvector_brdf::albedo::directional_albedo_ggx;
use halfvector_brdf::fresnel::f_schlick;
use halfvector_brdf::multiscatter::{
    average_loss_ggx, energy_compensation, energy_compensation_fdez_aguera, multiscatter_color,
};

use super::ibl::unit;
use crate::error::Errors;
use crate::{Effort, Row};

const N_DOT_V: [f64; 4] = [0.1, 0.3, 0.6, 1.0];
const ROUGHNESS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Reflectances at normal incidence; each stands for a channel of a metal's colour.
const F0: [f64; 4] = [0.2, 0.5, 0.8, 1.0];

/// Bounces after which a path is given up: of white facets at roughness 1 one path in 10^5 has more.
const MOST_BOUNCES: usize = 64;

const DOMAIN: &str = "metals of f0 0.2..1, n.v 0.1..1, roughness 0.25..1: the directional albedo; relative error against walks \
                      between the facets of Smith's model";

/// What a method reflects of uniform light in all, by f0, the directional albedo's pair and the white lobe's average albedo.
type Reflects = fn(f64, [f64; 2], f64) -> f64;

/// One row for each compensation. What it costs is in the shader's instructions.
pub(super) fn rows(effort: Effort) -> Vec<Row> {
    let methods: [(&str, Reflects); 4] = [
        ("turquin", |f0, ab, _| (f0 * ab[0] + ab[1]) * energy_compensation([f0; 3], [1.0; 3], ab)[0]),
        ("fdez_aguera", |f0, ab, _| (f0 * ab[0] + ab[1]) * energy_compensation_fdez_aguera([f0; 3], [1.0; 3], ab)[0]),
        ("kulla_conty", |f0, [a, b], e| f0 * a + b + multiscatter_color([f0; 3], [1.0; 3], e)[0] * (1.0 - a - b)),
        ("none", |f0, [a, b], _| f0 * a + b),
    ];
    let mut errors: [Errors; 4] = std::array::from_fn(|_| Errors::default());
    for roughness in ROUGHNESS {
        for n_dot_v in N_DOT_V {
            let truth = albedos(n_dot_v, roughness * roughness, effort.pick(1 << 14, 1 << 17));
            let (pair, average) = (directional_albedo_ggx(n_dot_v, roughness), 1.0 - average_loss_ggx(roughness));
            for (f0, truth) in F0.into_iter().zip(truth) {
                for ((_, reflects), errors) in methods.iter().zip(&mut errors) {
                    let at = || format!("n.v = {n_dot_v}, roughness = {roughness}, f0 = {f0}");
                    errors.add((reflects(f0, pair, average) - truth) / truth, at);
                }
            }
        }
    }
    let row = |((name, _), errors): (&(&str, Reflects), Errors)| {
        let mut row = Row::new("compensation", name, DOMAIN);
        errors.fill(&mut row);
        row
    };
    methods.iter().zip(errors).map(row).collect()
}

/// Numbers in 0..1 that come out the same on every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// What a facet surface reflects of uniform light, for each of [`F0`], all bounces counted.
fn albedos(n_dot_v: f64, alpha: f64, walks: usize) -> [f64; 4] {
    let mut random = Random(1);
    let mut sums = [0.0; 4];
    for _ in 0..walks {
        let weights = walk(n_dot_v, alpha, &mut random);
        sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight);
    }
    sums.map(|sum| sum / walks as f64)
}

/// What is left of a path's light when it leaves the surface; 0 when it does not.
fn walk(n_dot_v: f64, alpha: f64, random: &mut Random) -> [f64; 4] {
    let mut direction = [-(1.0 - n_dot_v * n_dot_v).max(0.0).sqrt(), 0.0, -n_dot_v];
    // How much of the facets lies lower: 1 is above all of them.
    let mut lower = 1.0;
    let mut weights = [1.0; 4];
    for _ in 0..MOST_BOUNCES {
        match next_height(direction[2], alpha, lower, random.next()) {
            None => return weights,
            Some(height) => lower = height,
        }
        let back = direction.map(|x| -x);
        let facet = visible_normal(back, alpha, [random.next(), random.next()]);
        let cosine = (0..3).map(|i| back[i] * facet[i]).sum::<f64>();
        for (weight, f0) in weights.iter_mut().zip(F0) {
            *weight *= f_schlick([f0; 3], [1.0; 3], cosine.clamp(0.0, 1.0))[0];
        }
        direction = unit(std::array::from_fn(|i| 2.0 * cosine * facet[i] - back[i]));
    }
    [0.0; 4]
}

/// Where on its way a path meets the next facet: how much of the facets lies lower there. None when it leaves. The share
/// of paths that climb from one height to another without a hit is the ratio of the heights' shares to the power Lambda.
fn next_height(cosine: f64, alpha: f64, lower: f64, u: f64) -> Option<f64> {
    if cosine > 0.9999 {
        return None;
    }
    if cosine.abs() < 1e-6 {
        return Some(lower);
    }
    let tangent = (1.0 - cosine * cosine).max(0.0).sqrt() / cosine;
    let lambda = 0.5 * (-1.0 + cosine.signum() * (1.0 + alpha * alpha * tangent * tangent).sqrt());
    if cosine > 0.0 && u > 1.0 - lower.powf(lambda) {
        return None;
    }
    Some((lower / (1.0 - u).max(1e-12).powf(1.0 / lambda)).clamp(1e-12, 1.0))
}

/// A facet's normal, as often as it is seen from a direction, which may come from below. Dupuy and Benyoub 2023, "Sampling
/// Visible GGX Normals with Spherical Caps".
fn visible_normal(w: [f64; 3], alpha: f64, u: [f64; 2]) -> [f64; 3] {
    let w = unit([alpha * w[0], alpha * w[1], w[2]]);
    let z = (1.0 - u[1]) * (1.0 + w[2]) - w[2];
    let (sine, phi) = ((1.0 - z * z).max(0.0).sqrt(), std::f64::consts::TAU * u[0]);
    let h = [sine * phi.cos() + w[0], sine * phi.sin() + w[1], z + w[2]];
    unit([alpha * h[0], alpha * h[1], h[2].max(1e-9)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// White facets swallow nothing, and what leaves after one bounce is the single-scattering albedo.
    #[test]
    fn white_facets_reflect_all() {
        for n_dot_v in [0.1, 0.6, 1.0] {
            let all = albedos(n_dot_v, 1.0, 1 << 13);
            assert!((all[3] - 1.0).abs() < 2e-3, "n.v {n_dot_v}: {all:?}");
        }
        let mut random = Random(7);
        let (walks, mut left) = (1 << 15, 0);
        for _ in 0..walks {
            let facet = visible_normal([0.8, 0.0, 0.6], 0.5, [random.next(), random.next()]);
            let cosine = 0.8 * facet[0] + 0.6 * facet[2];
            let up = 2.0 * cosine * facet[2] - 0.6;
            let height = next_height(-0.6, 0.5, 1.0, random.next()).expect("a hit on the way down");
            left += usize::from(next_height(up, 0.5, height, random.next()).is_none());
        }
        let [a, b] = directional_albedo_ggx(0.6, 0.5_f64.sqrt());
        let found = left as f64 / f64::from(walks);
        assert!((found - a - b).abs() < 0.01, "{found}, not {}", a + b);
    }

    #[test]
    fn every_compensation_is_better_than_none() {
        let rows = rows(Effort::Quick);
        let rms = |name: &str| rows.iter().find(|row| row.method == name).and_then(|row| row.error_rms);
        assert!(["turquin", "fdez_aguera", "kulla_conty"].iter().all(|name| rms(name) < rms("none")), "{rows:?}");
    }
}
