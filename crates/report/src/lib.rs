//! Speed against error: one [`Row`] per method and domain, measured on the machine that runs it.
//!
//! * [`PARTS`] lists what is measured; a part is one file of `part/`, a function from a [`Run`] to rows.
//! * Errors are against f64 truth and come out the same on every run. Times are medians of interleaved runs
//!   ([`timing`]), to be read as ratios within one report.
//! * [`Report`] is a run: rows, machine, day. [`comparison`] weighs methods against each other, [`choice`] takes one for each
//!   budget, [`compare`] holds two runs against each other.
//! * [`page`] makes the HTML page, [`plot`] its plots, [`write`] the CSV.
//!
//! The crate writes no file and knows no command line.

pub mod choice;
pub mod compare;
pub mod comparison;
pub mod cost;
pub mod error;
mod faults;
pub mod missing;
pub mod page;
pub mod part;
pub mod placed;
pub mod plot;
pub mod publish;
mod report;
mod row;
mod search;
mod terms;
pub mod timing;
pub mod unit;
pub mod words;
pub mod write;

pub use comparison::mark_pareto;
pub use part::{PARTS, Part, Run, SoFar};
pub use report::{Report, ReportError};
pub use row::Row;

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Effort {
    /// Fewer points and runs: the whole report within two minutes on two cores.
    Quick,
    /// Enough for a steady third digit.
    Full,
}

impl Effort {
    /// What it means for who reads the figures.
    pub fn words(self) -> &'static str {
        match self {
            Effort::Quick => "quick: few points and runs",
            Effort::Full => "full",
        }
    }

    /// One of two numbers of points or runs.
    pub fn pick(self, quick: usize, full: usize) -> usize {
        match self {
            Effort::Quick => quick,
            Effort::Full => full,
        }
    }
}
