//! Errors gathered over a domain.

/// Largest and mean-square error, and where the largest stands. Sums in f64, in the order given: the same every run.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    max: f64,
    squares: f64,
    count: u64,
    at: String,
}

impl Errors {
    /// Adds one error (its sign does not matter; NaN counts as infinite); `at` describes the input, and is asked for a
    /// new largest only.
    pub fn add(&mut self, error: f64, at: impl FnOnce() -> String) {
        let error = if error.is_nan() { f64::INFINITY } else { error.abs() };
        if error > self.max || self.count == 0 {
            (self.max, self.at) = (error, at());
        }
        self.squares += error * error;
        self.count += 1;
    }

    /// The largest.
    pub fn max(&self) -> f64 {
        self.max
    }

    /// Root of the mean square; 0 when nothing was added.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// Puts the figures into a row.
    pub fn fill(&self, row: &mut crate::Row) {
        (row.error_max, row.error_rms, row.at) = (Some(self.max), Some(self.rms()), Some(self.at.clone()));
    }
}
