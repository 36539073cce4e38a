//! Brute-force truth: an environment's light through a lobe by a sum over every texel. Slow, and independent of harmonics.

use crate::equirect::{Equirect, direction_from_equirect};
use crate::sampling::equirect_texel_solid_angle;
use std::f64::consts::PI;

/// Texels that are weighted together.
const LANES: usize = 8;

/// Pieces along an edge of a texel over which the weight is not even.
const PIECES: usize = 12;

/// A map ready to be summed, taken as constant over each texel with its exact solid angle.
#[derive(Clone, Debug)]
pub struct Quadrature {
    width: usize,
    height: usize,
    /// For each eight texels: direction x, y, z, solid angle, and radiance times solid angle. The last are filled with 0.
    blocks: Vec<[[f64; LANES]; 7]>,
    mean: [f64; 3],
}

impl Quadrature {
    /// Makes a map ready: 56 bytes a texel.
    pub fn new(map: &Equirect) -> Quadrature {
        let mut blocks = vec![[[0.0; LANES]; 7]; map.pixels.len().div_ceil(LANES)];
        for (k, pixel) in map.pixels.iter().enumerate() {
            let (row, column) = (k / map.width, k % map.width);
            let [x, y, z] = direction(map.width, map.height, column as f64, row as f64);
            let area = equirect_texel_solid_angle(map.width, map.height, row);
            let [r, g, b] = pixel.map(|radiance| f64::from(radiance) * area);
            for (numbers, number) in blocks[k / LANES].iter_mut().zip([x, y, z, area, r, g, b]) {
                numbers[k % LANES] = number;
            }
        }
        Quadrature { width: map.width, height: map.height, blocks, mean: map.mean() }
    }

    /// Mean radiance over the sphere.
    pub fn mean(&self) -> [f64; 3] {
        self.mean
    }

    /// Radiance prefiltered by D_GGX(h) n.l with n = v = r, for a unit direction and a perceptual roughness above 0; at 1 it
    /// is the irradiance over pi. To about 1e-3 from roughness 0.1 up.
    ///
    /// Texels that are not small against the lobe's width or their distance are cut into 144 pieces.
    pub fn prefiltered(&self, dir: [f64; 3], perceptual_roughness: f64) -> [f64; 3] {
        let a2 = perceptual_roughness.powi(4);
        let texel = PI / self.height as f64;
        let even = (6.0 * texel).powi(2) - 4.0 * a2;
        let mut sums = [[0.0; LANES]; 4];
        for (block, [x, y, z, area, r, g, b]) in self.blocks.iter().enumerate() {
            let mut near = false;
            for i in 0..LANES {
                let squared = (x[i] - dir[0]).powi(2) + (y[i] - dir[1]).powi(2) + (z[i] - dir[2]).powi(2);
                near |= squared < even;
                let weight = weight(squared, a2);
                for (sum, part) in sums.iter_mut().zip([area, r, g, b]) {
                    sum[i] += weight * part[i];
                }
            }
            if near {
                for i in 0..LANES {
                    let more = self.cut_up(dir, a2, block * LANES + i);
                    for (sum, part) in sums.iter_mut().zip([area, r, g, b]) {
                        sum[i] += more * part[i];
                    }
                }
            }
        }
        let [whole, r, g, b] = sums.map(|sum| sum.iter().sum::<f64>());
        [r / whole, g / whole, b / whole]
    }

    /// The mean weight of a texel that is cut into pieces, less that of its middle.
    fn cut_up(&self, dir: [f64; 3], a2: f64, texel: usize) -> f64 {
        let of = |column: f64, row: f64| {
            let l = direction(self.width, self.height, column, row);
            weight((0..3).map(|i| (l[i] - dir[i]).powi(2)).sum(), a2)
        };
        let (column, row) = ((texel % self.width) as f64, (texel / self.width) as f64);
        let sin = |row: f64| (PI * (row + 0.5) / self.height as f64).sin();
        let (mut mean, mut whole) = (0.0, 0.0);
        for k in 0..PIECES * PIECES {
            let offset = |k: usize| (k as f64 + 0.5) / PIECES as f64 - 0.5;
            let (x, y) = (column + offset(k % PIECES), row + offset(k / PIECES));
            mean += of(x, y) * sin(y);
            whole += sin(y);
        }
        mean / whole - of(column, row)
    }
}

/// n.l / ((1 - n.l) (1 - alpha^2) / 2 + alpha^2)^2 of a direction at the squared chord |n - l|^2 = 2 (1 - n.l).
#[inline(always)]
fn weight(squared: f64, a2: f64) -> f64 {
    let d = 0.25 * squared * (1.0 - a2) + a2;
    (1.0 - 0.5 * squared).max(0.0) / (d * d)
}

/// The direction of a point of a map given in texels; whole numbers are texel centres.
fn direction(width: usize, height: usize, column: f64, row: f64) -> [f64; 3] {
    direction_from_equirect((column + 0.5) / width as f64, (row + 0.5) / height as f64)
}
