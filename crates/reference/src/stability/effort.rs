//! How hard instability is looked for beyond the points of the domain: harder in short materials, where it costs little.

use crate::stability::trace::Trace;

/// Steps of the interpreter that may be spent, each at one point.
const STEPS: usize = 45_000_000;

/// Fewest and most runs that they make, each of the whole material at one point: a setting of the domain is at most ten times 1024.
const RUNS: [usize; 2] = [16_384, 104_448];

/// Runs for each search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// For following numbers to where they are critical.
    pub(super) critical: usize,
    /// For points close to each other.
    pub(super) dense: usize,
    /// For judging what was found.
    pub(super) judged: usize,
}

impl Effort {
    /// Of a material.
    pub(super) fn of(trace: &Trace<'_>) -> Effort {
        let runs = (STEPS / trace.steps().max(1)).clamp(RUNS[0], RUNS[1]);
        Effort { critical: runs / 2, dense: runs / 4, judged: runs / 4 }
    }
}

/// At most so many of some places, evenly taken.
pub(super) fn at_most<T>(places: Vec<T>, most: usize) -> Vec<T> {
    let step = places.len().div_ceil(most.max(1)).max(1);
    places.into_iter().step_by(step).collect()
}
