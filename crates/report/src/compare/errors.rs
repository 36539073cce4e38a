//! What errs more than before, and what looks less alike.

use super::{Change, Figure, Pair};
use crate::Row;

/// An error may differ by this part, for the elementary functions of another system.
const ERROR_NOISE: f64 = 0.05;
/// Errors below this are rounding of f64.
const ERROR_FLOOR: f64 = 1e-9;
/// A mean FLIP below this is seen by nobody.
const FLIP_FLOOR: f64 = 1e-4;

pub(super) fn grown(pairs: &[Pair<'_>]) -> Vec<Change> {
    // What another device computes has its own rounding; what a shader costs there stands in rows of the CPU's errors, too.
    let is_elsewhere =
        |(old, new): &Pair<'_>| old.gpu != new.gpu && ["pictures", "precision"].contains(&new.part.as_str());
    pairs.iter().filter(|pair| !is_elsewhere(pair)).flat_map(|&(old, new)| of_row(old, new)).collect()
}

/// Whether the errors of two rows are of the same inputs, as far as they are counted, and found in the same way.
fn is_alike(old: &Row, new: &Row) -> bool {
    (old.points, old.searched) == (new.points, new.searched)
}

fn of_row(old: &Row, new: &Row) -> Vec<Change> {
    let mut changes = Vec::new();
    if !is_alike(old, new) {
        return changes;
    }
    let kinds: [Figure; 2] = [("rms error", |row| row.error_rms), ("largest error", |row| row.error_max)];
    for (name, error) in kinds {
        // An infinite error is null in the file: a row that had a finite one has lost it. But where noise hides the error it is not
        // known to have grown, and what was hidden has grown beyond what it was at most.
        let now = error(new).unwrap_or(if new.error_bound.is_some() { 0.0 } else { f64::INFINITY });
        let known = error(old).or(if name == "rms error" { old.error_bound } else { None });
        if let Some(before) = known
            && now > before * (1.0 + ERROR_NOISE) + ERROR_FLOOR
        {
            changes.push(Change::of("less accurate", old, name, format!("{name} {now:.3e}, was {before:.3e}")));
            break;
        }
    }
    if let (None, Some(bound)) = (new.error_rms, new.error_bound)
        && let Some((known, was)) = match (old.error_rms, old.error_bound) {
            // What was known is hidden now: it may have grown up to there.
            (Some(rms), _) => Some((2.0 * rms, format!("was {rms:.3e}"))),
            (None, Some(before)) => Some((before * (1.0 + ERROR_NOISE), format!("was at most {before:.3e}"))),
            (None, None) => None,
        }
        && bound > known + ERROR_FLOOR
    {
        let figures = format!("the noise hides an rms error of at most {bound:.3e}, {was}");
        changes.push(Change::of("less sure", old, "bound of the error", figures));
    }
    if let (Some(before), Some(now)) = (old.flip, new.flip)
        && now > before * (1.0 + ERROR_NOISE) + FLIP_FLOOR
    {
        changes.push(Change::of("less alike", old, "FLIP", format!("FLIP {now:.4}, was {before:.4}")));
    }
    let count = |row: &Row| row.not_finite.unwrap_or(0);
    if count(new) > count(old) {
        let figures = format!("{}, were {}", count(new), count(old));
        changes.push(Change::of("more results that are no numbers", old, "results", figures));
    }
    changes
}
