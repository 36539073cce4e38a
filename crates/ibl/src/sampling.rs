//! Importance sampling of an environment: directions drawn where the light is, each with its density.
//!
//! The map is taken as constant within each texel, as the prefilter takes it. It draws no random numbers: the caller does.

use crate::equirect::{Equirect, direction_from_equirect, equirect_from_direction};
use std::f64::consts::PI;

/// A direction that was drawn, and what comes from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentSample {
    /// Unit direction, in the environment's frame.
    pub dir: [f64; 3],
    /// Radiance of the texel.
    pub radiance: [f32; 3],
    /// Density over solid angle at `dir`, 1/sr, above 0.
    pub pdf_solid_angle: f64,
}

/// Draws directions with a density in proportion to a map's radiance (the sum of its colours).
///
/// Walker 1977, "An Efficient Method for Generating Discrete Random Variables with General Distributions", with the table
/// of Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given Distribution": a texel is drawn in constant
/// time, with the probability of its radiance times its exact solid angle, and a direction evenly within it. A black map is
/// drawn evenly over the sphere.
#[derive(Clone, Debug)]
pub struct EnvironmentSampler {
    map: Equirect,
    /// For each texel the share of its slot that is its own, and the texel that has the rest.
    slots: Vec<(f64, u32)>,
    /// What the radiance is divided by to get the density; 0 for a black map.
    total: f64,
}

impl EnvironmentSampler {
    /// Makes the table: 16 bytes a texel beside the map. At most 2^32 texels.
    pub fn new(map: Equirect) -> EnvironmentSampler {
        let areas: Vec<f64> =
            (0..map.height).map(|row| equirect_texel_solid_angle(map.width, map.height, row)).collect();
        let power = |k: usize| grey(map.pixels[k]) * areas[k / map.width];
        let mut weights: Vec<f64> = (0..map.pixels.len()).map(power).collect();
        let total: f64 = weights.iter().sum();
        if total <= 0.0 {
            weights = (0..map.pixels.len()).map(|k| areas[k / map.width]).collect();
        }
        EnvironmentSampler { slots: alias_table(&weights), map, total: total.max(0.0) }
    }

    /// The direction for two numbers of 0..1, even over the unit square.
    pub fn sample(&self, u: [f64; 2]) -> EnvironmentSample {
        let count = self.slots.len() as f64;
        let [u, v] = u.map(|x| if x > 0.0 { x.min(1.0 - f64::EPSILON) } else { 0.0 });
        let slot = ((u * count) as usize).min(self.slots.len() - 1);
        let rest = (u * count - slot as f64).clamp(0.0, 1.0);
        let (share, alias) = self.slots[slot];
        // What the choice has not used of the first number places the direction within the texel.
        let (texel, rest) =
            if rest < share { (slot, rest / share) } else { (alias as usize, (rest - share) / (1.0 - share)) };
        let (row, column) = (texel / self.map.width, texel % self.map.width);
        let (top, bottom) = (self.edge(row), self.edge(row + 1));
        // Even in the cosine is even in solid angle; half an angle's sine keeps the digits at the poles.
        let half = |theta: f64| (0.5 * theta).sin().powi(2);
        let theta = 2.0 * (half(top) + (half(bottom) - half(top)) * v).clamp(0.0, 1.0).sqrt().asin();
        let dir = direction_from_equirect((column as f64 + rest) / self.map.width as f64, theta / PI);
        let radiance = self.map.pixels[texel];
        EnvironmentSample { dir, radiance, pdf_solid_angle: self.density(radiance) }
    }

    /// The density over solid angle, 1/sr, at which [`Self::sample`] draws a direction: 0 where the map is black.
    pub fn pdf_solid_angle(&self, dir: [f64; 3]) -> f64 {
        self.density(self.radiance(dir))
    }

    /// The radiance of the texel that a direction meets.
    pub fn radiance(&self, dir: [f64; 3]) -> [f32; 3] {
        let (u, v) = equirect_from_direction(dir);
        let place = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
        self.map.pixels[place(v, self.map.height) * self.map.width + place(u, self.map.width)]
    }

    fn density(&self, radiance: [f32; 3]) -> f64 {
        if self.total > 0.0 { grey(radiance) / self.total } else { 1.0 / (4.0 * PI) }
    }

    /// The polar angle of a row's upper edge.
    fn edge(&self, row: usize) -> f64 {
        PI * row as f64 / self.map.height as f64
    }
}

/// The exact solid angle, in sr, of a texel of a row of an equirectangular map: the difference of the cosines of its edges
/// times its width, without cancellation at the poles.
pub fn equirect_texel_solid_angle(width: usize, height: usize, row: usize) -> f64 {
    let step = PI / height as f64;
    // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2).
    // The lower half mirrors the upper: the sine close to pi would lose digits.
    let row = row.min((height - 1).saturating_sub(row));
    2.0 * PI / width as f64 * 2.0 * (step * (row as f64 + 0.5)).sin() * (0.5 * step).sin()
}

fn grey([r, g, b]: [f32; 3]) -> f64 {
    f64::from(r) + f64::from(g) + f64::from(b)
}

/// Slots of equal size for drawing by weight: each with the share that is its own, and whose the rest is. Walker 1977, "An
/// Efficient Method for Generating Discrete Random Variables with General Distributions".
///
/// `weights` are finite and not below 0, and not all 0. What has no weight has no share.
pub fn alias_table(weights: &[f64]) -> Vec<(f64, u32)> {
    let scale = weights.len() as f64 / weights.iter().sum::<f64>();
    let mut left: Vec<f64> = weights.iter().map(|weight| weight * scale).collect();
    let mut slots: Vec<(f64, u32)> = (0..weights.len()).map(|k| (1.0, k as u32)).collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..weights.len()).partition(|&k| left[k] < 1.0);
    while let (Some(&low), Some(&high)) = (small.last(), large.last()) {
        small.pop();
        slots[low] = (left[low], high as u32);
        left[high] -= 1.0 - left[low];
        if left[high] < 1.0 {
            large.pop();
            small.push(high);
        }
    }
    // Rounding leaves slots whose share is all but 1; a texel without light must not get one.
    for k in small {
        if weights[k] <= 0.0 {
            let lit = (0..weights.len()).max_by(|&a, &b| weights[a].total_cmp(&weights[b])).unwrap_or(k);
            slots[k] = (0.0, lit as u32);
        }
    }
    slots
}
