//! The parts of the report: what is measured, each in a file of its own.

pub mod brdf;
pub mod energy;
pub mod ibl;
pub mod lobes;
pub mod maps;
pub mod mips;
mod split_sum;

use crate::{Effort, Row};

/// A part of the report.
pub struct Part {
    /// Name for `--only`.
    pub name: &'static str,
    /// Measures it.
    pub rows: fn(Effort) -> Vec<Row>,
}

/// All parts, in the order shown.
pub const PARTS: &[Part] = &[
    Part { name: "brdf", rows: brdf::rows },
    Part { name: "energy", rows: energy::rows },
    Part { name: "maps", rows: maps::rows },
    Part { name: "mips", rows: mips::rows },
    Part { name: "ibl", rows: ibl::rows },
    Part { name: "lobes", rows: lobes::rows },
];
