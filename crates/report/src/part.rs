//! The parts of the report: what is measured, each in a file of its own.

pub mod brdf;
mod coupling;
mod encode;
pub mod energy;
mod frames;
pub mod ibl;
pub(crate) mod levels;
pub mod lobes;
pub mod maps;
pub mod mips;
mod multiple;
mod nearly;
pub mod peers;
pub mod pictures;
pub mod precision;
pub mod shaders;
pub mod specular_aa;
pub(crate) mod split_sum;
mod stations;
mod texels;

pub(crate) use self::texels::DECODED;
use std::sync::{Mutex, PoisonError};

use crate::missing::LeftOut;
use crate::{Effort, Row};

/// What there is of a part while it is measured.
#[derive(Clone, Copy, Debug)]
pub struct SoFar<'a> {
    /// All rows of the part that are finished, none where they are the same as before.
    pub rows: &'a [Row],
    /// What was not measured until now, and why.
    pub left_out: &'a [LeftOut],
    /// How much of the part is done, 0 to 1.
    pub done: f64,
}

/// A part while it is measured: how long to measure, and who is told what is finished.
pub struct Run<'a> {
    effort: Effort,
    told: &'a (dyn Fn(SoFar<'_>) + Sync),
    left_out: Mutex<Vec<LeftOut>>,
}

impl<'a> Run<'a> {
    /// `told` gets what is finished whenever there is more of it. It may be called from any thread.
    pub fn new(effort: Effort, told: &'a (dyn Fn(SoFar<'_>) + Sync)) -> Run<'a> {
        Run { effort, told, left_out: Mutex::default() }
    }

    /// With nobody listening.
    pub fn alone(effort: Effort) -> Run<'static> {
        Run::new(effort, &|_| ())
    }

    /// What was not measured so far, and why.
    pub fn left_out(&self) -> Vec<LeftOut> {
        self.left_out.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// This of a part, or all of it, is not measured.
    pub(crate) fn leave_out(&self, part: &str, what: Option<&str>, why: String) {
        let left = LeftOut { part: part.to_owned(), what: what.map(str::to_owned), why };
        self.left_out.lock().unwrap_or_else(PoisonError::into_inner).push(left);
    }

    /// How long to measure.
    pub(crate) fn effort(&self) -> Effort {
        self.effort
    }

    /// These rows are finished, and so much of the part is done.
    pub(crate) fn keep(&self, rows: &[Row], done: f64) {
        (self.told)(SoFar { rows, left_out: &self.left_out(), done });
    }

    /// So much of the part is done.
    pub(crate) fn at(&self, done: f64) {
        self.keep(&[], done);
    }

    /// The rows of pieces of a part, measured one after the other and kept as they are finished.
    pub(crate) fn pieces<T>(&self, pieces: &[T], rows_of: impl Fn(&T) -> Vec<Row>) -> Vec<Row> {
        let mut rows = Vec::new();
        for (done, piece) in pieces.iter().enumerate() {
            rows.extend(rows_of(piece));
            self.keep(&rows, (done + 1) as f64 / pieces.len() as f64);
        }
        rows
    }
}

/// A part of the report.
pub struct Part {
    /// Name for `--only`.
    pub name: &'static str,
    /// Measures it: all its rows, the finished ones on the way.
    pub rows: fn(&Run<'_>) -> Vec<Row>,
}

impl Part {
    /// Its rows, with nobody listening.
    pub fn measured(&self, effort: Effort) -> Vec<Row> {
        (self.rows)(&Run::alone(effort))
    }

    /// About how long it takes on two cores [s]; parts that are not named here are quick.
    pub fn seconds(&self, effort: Effort) -> f64 {
        let [quick, full] = match self.name {
            "shaders" => [22.0, 60.0],
            "ibl" => [48.0, 140.0],
            "lobes" => [8.0, 75.0],
            "specular_aa" => [1.0, 10.0],
            "pictures" => [30.0, 350.0],
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
    Part { name: shaders::PART, rows: shaders::rows },
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
