//! Speed against error: one [`Row`] per method and domain, measured on the machine that runs it.
//!
//! * [`PARTS`] lists what is measured; a part is one file of `part/`, a function from [`Effort`] to rows.
//! * Errors are against f64 truth and come out the same on every run. Times are medians of interleaved runs
//!   ([`timing`]), to be read as ratios within one report.
//! * [`write`] turns rows into JSON and CSV text.
//!
//! The crate writes no file and knows no command line.

pub mod error;
pub mod part;
mod row;
pub mod timing;
pub mod write;

pub use part::{PARTS, Part};
pub use row::{Row, mark_pareto};

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Fewer points and runs: the whole report within two minutes on two cores.
    Quick,
    /// Enough for a steady third digit.
    Full,
}

impl Effort {
    /// One of two numbers of points or runs.
    pub fn pick(self, quick: usize, full: usize) -> usize {
        match self {
            Effort::Quick => quick,
            Effort::Full => full,
        }
    }
}
