//! Directions drawn as often as light comes from there: a texel by an alias table, and within it evenly by solid angle.

use std::f64::consts::PI;

use halfvector_ibl::{Equirect, alias_table, equirect_texel_solid_angle};

use crate::elementary::{choose, sin_cos_of_turns};

/// The table.
pub(super) struct Drawn {
    /// For each texel the share of its slot that is its own, and the texel that has the rest. 8 bytes a texel: the table is
    /// read all over.
    slots: Vec<(f32, u32)>,
    /// (1 - cos) / 2 of the upper edge of each row, and how much it grows to the lower.
    rows: Vec<(f64, f64)>,
    width: f64,
    count: f64,
}

impl Drawn {
    /// The table and each texel's density [1/sr]: that with which it is drawn, the rounding of the shares included.
    pub(super) fn new(map: &Equirect) -> (Drawn, Vec<f64>) {
        let (width, height) = (map.width, map.height);
        let areas: Vec<f64> = (0..height).map(|row| equirect_texel_solid_angle(width, height, row)).collect();
        let power =
            |(k, texel): (usize, &[f32; 3])| texel.iter().map(|x| f64::from(*x)).sum::<f64>() * areas[k / width];
        let weights: Vec<f64> = map.pixels.iter().enumerate().map(power).collect();
        let slots: Vec<(f32, u32)> =
            alias_table(&weights).into_iter().map(|(share, alias)| (share as f32, alias)).collect();
        let mut densities = vec![0.0; slots.len()];
        for (own, (share, alias)) in slots.iter().enumerate() {
            densities[own] += f64::from(*share);
            densities[*alias as usize] += 1.0 - f64::from(*share);
        }
        let count = slots.len() as f64;
        for (k, density) in densities.iter_mut().enumerate() {
            *density /= count * areas[k / width];
        }
        // Half an angle's sine keeps the digits at the poles.
        let edge = |row: usize| (0.5 * PI * row as f64 / height as f64).sin().powi(2);
        let rows = (0..height).map(|row| (edge(row), edge(row + 1) - edge(row))).collect();
        (Drawn { slots, rows, width: width as f64, count }, densities)
    }

    /// The slot for a number of 0..1, and what the number leaves.
    #[inline(always)]
    pub(super) fn slot(&self, u: f64) -> (f64, f64) {
        let scaled = u * self.count;
        let slot = scaled.floor();
        (slot, scaled - slot)
    }

    /// The share of a slot that is its own, and the texel that has the rest.
    #[inline(always)]
    pub(super) fn share(&self, slot: u32) -> (f64, f64) {
        let (share, alias) = self.slots[slot as usize];
        (f64::from(share), f64::from(alias))
    }

    /// Column and row of a texel. Half a texel is far more than the product's rounding.
    #[inline(always)]
    pub(super) fn place(&self, texel: f64) -> (f64, f64) {
        let row = ((texel + 0.5) * (1.0 / self.width)).floor();
        (texel - row * self.width, row)
    }

    /// (1 - cos) / 2 of a row's upper edge, and how much it grows to the lower.
    #[inline(always)]
    pub(super) fn row(&self, row: u32) -> (f64, f64) {
        self.rows[row as usize]
    }

    /// The direction of a place along a row, in texels, and of (1 - cos) / 2, in the map's own frame. Even in the cosine is
    /// even in solid angle.
    #[inline(always)]
    pub(super) fn direction(&self, x: f64, half: f64) -> [f64; 3] {
        let (sin_theta, cos_theta) = (2.0 * (half * (1.0 - half)).sqrt(), 1.0 - 2.0 * half);
        let (sin_phi, cos_phi) = sin_cos_of_turns(x * (1.0 / self.width) - 0.5);
        [sin_theta * cos_phi, cos_theta, sin_theta * sin_phi]
    }
}

/// A slot's own texel or the other one. What the choice has not used of the number places the direction within the texel.
#[inline(always)]
pub(super) fn choice(slot: f64, rest: f64, share: f64, alias: f64) -> (f64, f64) {
    let own = rest < share;
    let (over, under) = (choose(own, rest, rest - share), choose(own, share, 1.0 - share));
    (choose(own, slot, alias), over / under)
}
