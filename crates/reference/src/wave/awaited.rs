//! Light that is on its way from the environment: directions are gathered and looked up together.

use crate::directions::Directions;
use crate::render::Reference;

/// The density of a direction that was not drawn by chance among others: all of its light counts.
pub(super) const CERTAIN: f64 = f64::MAX;

/// Directions to look up.
#[derive(Default)]
pub(super) struct Awaited {
    dirs: Directions,
    /// For each the sample that awaits it, what its light is multiplied by, and the density at which it was drawn by others
    /// than the environment.
    entries: Vec<(u32, [f64; 3], f64)>,
    lights: Vec<[f64; 4]>,
}

impl Awaited {
    /// A sample sees the environment there. Of a direction with a density counts the share by the balance heuristic, for the
    /// environment could have drawn it, too.
    pub(super) fn push(&mut self, sample: u32, dir: [f64; 3], weight: [f64; 3], density: f64) {
        self.dirs.push(dir);
        self.entries.push((sample, weight, density));
    }

    /// Adds what arrives to what the samples see.
    pub(super) fn arrive(&mut self, reference: &Reference<'_>, seen: &mut [[f64; 4]]) {
        let Some(environment) = &reference.environment else { return };
        environment.look_up(&self.dirs, &mut self.lights);
        for ((sample, weight, density), light) in self.entries.drain(..).zip(&self.lights) {
            let share = density / (density + light[3]);
            let seen = &mut seen[sample as usize];
            for i in 0..3 {
                seen[i] += weight[i] * (light[i] * share);
            }
        }
        self.dirs.clear();
    }
}
