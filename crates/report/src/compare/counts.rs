//! What is counted and became more: instructions and memory.

use std::collections::HashSet;

use super::{Change, Pair};
use crate::Row;
use crate::cost::Cost;
use crate::words;

/// A count may grow by this part.
const COUNT_NOISE: f64 = 0.02;

/// Shaders with more instructions, once for each method, whose rows all have the same number; and what reads from more memory.
pub(super) fn grown(pairs: &[Pair<'_>]) -> Vec<Change> {
    type Kind = (&'static str, &'static str, Cost, fn(&Row) -> Option<u64>);
    const KINDS: [Kind; 2] = [
        ("longer", "instructions", Cost::Instructions, |row| row.instructions),
        ("larger", "memory", Cost::Bytes, |row| row.bytes),
    ];
    let mut told = HashSet::new();
    let mut changes = Vec::new();
    for &(old, new) in pairs {
        for (what, figure, cost, count) in KINDS {
            let (Some(before), Some(now)) = (count(old), count(new)) else { continue };
            let grown = now as f64 > before as f64 * (1.0 + COUNT_NOISE);
            if grown && told.insert((&old.term, &old.method, what, before)) {
                let [now, before] = [now, before].map(|count| words::cost(count as f64, cost));
                changes.push(Change::of(what, old, figure, format!("{figure}: {now}, was {before}")));
            }
        }
    }
    changes
}
