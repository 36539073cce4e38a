//! Lobes too narrow for the harmonic series: a wider lobe from the series, and what is left by quadrature around each
//! direction.

use crate::cube::{Cube, unit};
use crate::environment::environment_sample;
use crate::harmonics::Grid;
use crate::kernel::ggx_weight;
use std::f64::consts::{FRAC_PI_2, PI};

/// Rings about the lobe's middle, and lookups on each.
const RINGS: usize = 32;
const SECTORS: usize = 12;

/// Prefilters a cube with a GGX lobe (n = v = r) of 0 < `alpha` < `wide_alpha`; `wide` is the same light prefiltered for
/// `wide_alpha`.
///
/// The tails of all GGX lobes are one, so the narrow lobe is the wide one plus a remainder without a tail. The remainder is
/// looked up at its own quantiles, each in a level of the source whose texels are as large as the solid angle that the
/// lookup stands for (Křivánek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling"); the quantiles are
/// those of a fixed polar grid, turned from ring to ring, so nothing is random. Between its lookups light is smoothed over:
/// close beside a lamp a hundred times brighter than the rest by 2 to 7 % rms, elsewhere by much less.
pub(crate) fn narrow_lobe(source: &Cube, wide: &Grid, alpha: f64, wide_alpha: f64, size: usize) -> Cube {
    let lobe = NarrowLobe::new(source, alpha, wide_alpha);
    Cube::from_fn(size, |dir| lobe.at(wide, dir))
}

struct NarrowLobe {
    /// The source and its halvings.
    pyramid: Vec<Cube>,
    share_of_wide: f64,
    samples: Vec<Sample>,
}

impl NarrowLobe {
    fn new(source: &Cube, alpha: f64, wide_alpha: f64) -> NarrowLobe {
        let mut pyramid = vec![source.clone()];
        while let Some(last) = pyramid.last().filter(|last| last.size > 1) {
            let next = last.halved();
            pyramid.push(next);
        }
        let texel = 4.0 * PI / (6 * source.size * source.size) as f64;
        let (share_of_wide, rings) = remainder(alpha, wide_alpha);
        let samples = rings
            .iter()
            .enumerate()
            .flat_map(|(ring, &(theta, solid_angle))| {
                // One level finer than the solid angle says: the lookup itself mixes neighbours.
                let lod = 0.5 * (solid_angle / SECTORS as f64 / texel).log2() - 1.0;
                (0..SECTORS).map(move |sector| {
                    let phi = 2.0 * PI * (sector as f64 + 0.618_034 * ring as f64) / SECTORS as f64;
                    Sample { local: [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()], lod }
                })
            })
            .collect();
        NarrowLobe { pyramid, share_of_wide, samples }
    }

    fn at(&self, wide: &Grid, dir: [f64; 3]) -> [f32; 3] {
        let [t, b] = basis(dir);
        let mut sum = [0.0f64; 3];
        for sample in &self.samples {
            let [x, y, z] = sample.local;
            let l = std::array::from_fn(|i| t[i] * x + b[i] * y + dir[i] * z);
            let texel = environment_sample(&self.pyramid, l, sample.lod);
            for c in 0..3 {
                sum[c] += f64::from(texel[c]);
            }
        }
        let wide = wide.sample(dir);
        let scale = (1.0 - self.share_of_wide) / self.samples.len() as f64;
        std::array::from_fn(|c| (self.share_of_wide * f64::from(wide[c]) + scale * sum[c]) as f32)
    }
}

struct Sample {
    local: [f64; 3],
    lod: f64,
}

/// The wide lobe's share of the narrow lobe, and the rings that stand for equal parts of the remainder: for each its angle
/// from the middle and its solid angle.
fn remainder(alpha: f64, wide_alpha: f64) -> (f64, Vec<(f64, f64)>) {
    // Steps that are even near the middle, on the narrow lobe's scale, and grow with the angle further out.
    const STEPS: usize = 4096;
    let last = (FRAC_PI_2 / alpha).asinh();
    let angle = |i: usize| alpha * (last * i as f64 / STEPS as f64).sinh();
    let (mut wide, mut sums) = (0.0, vec![0.0]);
    for i in 0..STEPS {
        let (start, end) = (angle(i), angle(i + 1));
        let theta = 0.5 * (start + end);
        let (cos, half) = (theta.cos(), (theta / 2.0).sin());
        let area = 2.0 * PI * theta.sin() * (end - start);
        let weight = |alpha: f64| area * ggx_weight(alpha, cos, 2.0 * half * half);
        wide += weight(wide_alpha);
        sums.push(sums[i] + weight(alpha) - weight(wide_alpha));
    }
    let whole = sums[STEPS];
    let angle_at = |share: f64| angle(sums.partition_point(|&sum| sum < share * whole).min(STEPS));
    let rings = (0..RINGS)
        .map(|ring| {
            let part = |offset: f64| angle_at((ring as f64 + offset) / RINGS as f64);
            (part(0.5), 2.0 * PI * (part(0.0).cos() - part(1.0).cos()).max(0.0))
        })
        .collect();
    (wide / (wide + whole), rings)
}

/// Two unit vectors at right angles to a unit vector and to each other.
fn basis(n: [f64; 3]) -> [[f64; 3]; 2] {
    let axis = if n[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let t = unit(cross(axis, n));
    [t, cross(n, t)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equirect::{Equirect, direction_from_equirect};
    use crate::harmonics::{MAX_BAND, MAX_ROWS, Spectrum};
    use crate::kernel::Lobe;
    use crate::resample::cube_from_equirect;

    const MIN_ALPHA: f64 = 7.0 / MAX_BAND as f64;

    /// Against fine polar quadrature over the same cube: a smooth picture with lamps a hundred times brighter in it, looked
    /// at everywhere and close beside the lamps.
    #[test]
    fn agrees_with_fine_quadrature() {
        let mut map = Equirect::from_fn(512, 256, |d| d.map(|x| (1.2 + x + 0.5 * (9.0 * x).sin()) as f32));
        let lamps = [(60, 100), (128, 300), (200, 411)];
        for (row, column) in lamps {
            for k in 0..9 {
                map.pixels[(row + k / 3) * 512 + column + k % 3] = [100.0, 150.0, 80.0];
            }
        }
        let source = cube_from_equirect(&map, 256);
        let spectrum = Spectrum::from_equirect(&map, MAX_BAND, MAX_ROWS, 2);
        let wide = spectrum.synthesized(&Lobe::Ggx(MIN_ALPHA).kernel(MAX_BAND), Lobe::Ggx(MIN_ALPHA).grid_rows());
        for alpha in [0.0012, 0.0025, 0.006] {
            let lobe = NarrowLobe::new(&source, alpha, MIN_ALPHA);
            let mut errors = Vec::new();
            for k in 0..24 {
                // From 0 to 24 texels beside a lamp.
                let (row, column) = lamps[k % 3];
                let (u, v) = ((column as f64 + 1.5 + k as f64) / 512.0, (row as f64 + 1.5) / 256.0);
                let dir = direction_from_equirect(u, v);
                let (value, truth) = (f64::from(lobe.at(&wide, dir)[0]), quadrature(&source, alpha, dir));
                errors.push(value / truth - 1.0);
            }
            let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
            let worst = errors.iter().fold(0.0f64, |a, e| a.max(e.abs()));
            println!("alpha {alpha}: rms {:.2} %, worst {:.2} %", 100.0 * rms, 100.0 * worst);
            assert!(rms < 0.08, "alpha {alpha}: rms {rms}");
        }
    }

    fn quadrature(source: &Cube, alpha: f64, dir: [f64; 3]) -> f64 {
        let [t, b] = basis(dir);
        let (rings, sectors) = (600, 400);
        let last = (FRAC_PI_2 / alpha).asinh();
        let angle = |i: f64| alpha * (last * i / f64::from(rings)).sinh();
        let (mut sum, mut whole) = (0.0, 0.0);
        for ring in 0..rings {
            let theta = angle(f64::from(ring) + 0.5);
            let half = (theta / 2.0).sin();
            let weight = theta.sin()
                * (angle(f64::from(ring + 1)) - angle(f64::from(ring)))
                * ggx_weight(alpha, theta.cos(), 2.0 * half * half);
            for sector in 0..sectors {
                let (sin, cos) = (2.0 * PI * f64::from(sector) / f64::from(sectors)).sin_cos();
                let local = [theta.sin() * cos, theta.sin() * sin, theta.cos()];
                let l = std::array::from_fn(|i| t[i] * local[0] + b[i] * local[1] + dir[i] * local[2]);
                sum += weight * f64::from(source.sample(l)[0]);
                whole += weight;
            }
        }
        sum / whole
    }
}
