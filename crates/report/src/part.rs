//! The parts of the report: what is measured, each in a file of its own.

pub mod brdf;
mod coupling;
mod encode;
pub mod energy;
mod frames;
pub mod ibl;
pub mod lobes;
pub mod maps;
pub mod mips;
mod multiple;
pub mod peers;
pub mod pictures;
pub mod precision;
pub mod shaders;
pub mod specular_aa;
mod split_sum;
mod stations;
mod texels;

use crate::{Effort, Row};

/// A part of the report.
pub struct Part {
    /// Name for `--only`.
    pub name: &'static str,
    /// Measures it.
    pub rows: fn(Effort) -> Vec<Row>,
}

impl Part {
    /// About how long it takes on two cores [s]; parts that are not named here are quick.
    pub fn seconds(&self, effort: Effort) -> f64 {
        let [quick, full] = match self.name {
            "shaders" => [30.0, 60.0],
            "ibl" => [15.0, 60.0],
            "lobes" => [8.0, 50.0],
            "specular_aa" => [1.0, 10.0],
            "pictures" => [45.0, 400.0],
            "peers" => [5.0, 110.0],
            _ => [1.0, 6.0],
        };
        match effort {
            Effort::Quick => quick,
            Effort::Full => full,
        }
    }
}

/// All parts, in the order shown.
pub const PARTS: &[Part] = &[
    Part { name: "shaders", rows: shaders::rows },
    Part { name: "brdf", rows: brdf::rows },
    Part { name: "energy", rows: energy::rows },
    Part { name: "maps", rows: maps::rows },
    Part { name: "mips", rows: mips::rows },
    Part { name: "ibl", rows: ibl::rows },
    Part { name: "lobes", rows: lobes::rows },
    Part { name: "specular_aa", rows: specular_aa::rows },
    Part { name: "precision", rows: precision::rows },
    Part { name: "pictures", rows: pictures::rows },
    Part { name: "peers", rows: peers::rows },
];
