//! Errors gathered over a domain, and the names of inputs.

use std::fmt::Debug;

/// Largest and mean-square error, and where the largest stands. Sums in f64, in the order given: the same every run.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    max: f64,
    squares: f64,
    /// What the squares count together.
    count: f64,
    at: String,
    inputs: u64,
    searched: bool,
}

impl Errors {
    /// Adds one error (its sign does not matter; NaN counts as infinite); `at` describes the input, and is asked for a
    /// new largest only.
    pub fn add(&mut self, error: f64, at: impl FnOnce() -> String) {
        self.inputs += 1;
        self.add_one(error, 1.0, at);
    }

    /// Adds the errors of the three numbers of a colour, which are of one input.
    pub fn add_color(&mut self, errors: [f64; 3], at: impl Fn() -> String) {
        self.add_weighted(errors, 1.0, at);
    }

    /// The same where the input stands for more or less of the domain than others.
    pub fn add_weighted(&mut self, errors: [f64; 3], weight: f64, at: impl Fn() -> String) {
        self.inputs += 1;
        errors.into_iter().for_each(|error| self.add_one(error, weight, &at));
    }

    fn add_one(&mut self, error: f64, weight: f64, at: impl FnOnce() -> String) {
        let error = if error.is_nan() { f64::INFINITY } else { error.abs() };
        if error > self.max || self.count == 0.0 {
            (self.max, self.at) = (error, at());
        }
        self.squares += weight * error * error;
        self.count += weight;
    }

    /// Takes what a search found beyond the errors that were added: the largest may be larger, the mean square stays that of the
    /// added ones.
    pub(crate) fn search(&mut self, found: f64, at: impl FnOnce() -> String) {
        self.searched = true;
        let found = if found.is_nan() { f64::INFINITY } else { found.abs() };
        if found > self.max {
            (self.max, self.at) = (found, at());
        }
    }

    /// The largest.
    pub fn max(&self) -> f64 {
        self.max
    }

    /// Root of the mean square; 0 when nothing was added.
    pub fn rms(&self) -> f64 {
        if self.count > 0.0 { (self.squares / self.count).sqrt() } else { 0.0 }
    }

    /// Puts the figures into a row.
    pub fn fill(&self, row: &mut crate::Row) {
        (row.error_max, row.error_rms, row.at) = (Some(self.max), Some(self.rms()), Some(self.at.clone()));
        (row.points, row.searched) = (Some(self.inputs), self.searched);
    }
}

/// An input with the names of its arguments, each of so many numbers: `n.v = 0.02, f0 = [0.04, 0.04, 0.04]`. The numbers are whole, so that
/// a program can read them back.
pub(crate) fn named<T: Debug>(names: &[(&str, usize)], numbers: &[T]) -> String {
    let mut rest = numbers;
    let said = names.iter().map(|&(name, count)| {
        let (own, others) = rest.split_at(count.min(rest.len()));
        rest = others;
        match own {
            [number] => format!("{name} = {number:?}"),
            all => format!("{name} = {all:?}"),
        }
    });
    said.collect::<Vec<_>>().join(", ")
}

/// The names and numbers of an input that a row says: `tilt = 75 deg, normal = [0, 0, 1]`. Units are left out; none where a value is no number.
#[cfg(test)]
pub(crate) fn inputs(at: &str) -> Vec<(String, Vec<f64>)> {
    let mut depth = 0;
    let outside = |c: char| {
        depth += i32::from(c == '[') - i32::from(c == ']');
        c == ',' && depth == 0
    };
    let value = |text: &str| -> Option<Vec<f64>> {
        let numbers = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
        let number = |text: &str| text.split_whitespace().next()?.parse().ok();
        numbers.map_or_else(|| Some(vec![number(text)?]), |all| all.split(',').map(number).collect())
    };
    let parts = at.split(outside).filter_map(|part| part.split_once(" = "));
    parts.map(|(name, text)| (name.trim().to_owned(), value(text).unwrap_or_default())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_argument_has_its_name() {
        let names = [("view", 3), ("alpha", 1)];
        assert_eq!(named(&names, &[0.0, 0.6, 0.8, 1.5e-6]), "view = [0.0, 0.6, 0.8], alpha = 1.5e-6");
    }
}
