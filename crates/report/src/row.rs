//! One line of the report.

use serde::{Deserialize, Serialize};

/// What one method costs, and how wrong it is, on one domain. A number that does not apply is `None`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Term of shading, as `halfvector methods` names it where it is one of them.
    pub term: String,
    /// Name of the method.
    pub method: String,
    /// The inputs that were drawn, what the error is relative to, and what the truth is.
    pub domain: String,
    /// Largest error.
    pub error_max: Option<f64>,
    /// Root of the mean square of the errors.
    pub error_rms: Option<f64>,
    /// The input of the largest error.
    pub at: Option<String>,
    /// Time of one call on one core, scalar f32 [ns].
    pub cost_ns: Option<f64>,
    /// Time of one element of a batch on one core [ns].
    pub cost_batch_ns: Option<f64>,
    /// SPIR-V instructions of the method in a shader.
    pub instructions: Option<u64>,
    /// Time of one call on the device [ns].
    pub gpu_ns: Option<f64>,
    /// The device's name; a software rasteriser has its own name, too.
    pub gpu: Option<String>,
    /// Memory that it reads from tables or textures [bytes].
    pub bytes: Option<u64>,
    /// No other method of its term and domain is both cheaper and more accurate; set by [`mark_pareto`].
    pub pareto: bool,
}

impl Row {
    /// A row without figures.
    pub fn new(term: &str, method: &str, domain: &str) -> Row {
        Row { term: term.into(), method: method.into(), domain: domain.into(), ..Row::default() }
    }

    /// What a choice weighs: the cheapest measured time, batch before scalar.
    fn cost(&self) -> Option<f64> {
        self.cost_batch_ns.or(self.cost_ns)
    }
}

/// Marks each row that no other row of the same term and domain beats in error and cost. Rows without an rms error or
/// a time are left unmarked.
pub fn mark_pareto(rows: &mut [Row]) {
    let figures: Vec<_> = rows.iter().map(|r| r.error_rms.zip(r.cost())).collect();
    for i in 0..rows.len() {
        let Some((error, cost)) = figures[i] else { continue };
        let beaten = (0..rows.len()).any(|j| {
            let same = rows[j].term == rows[i].term && rows[j].domain == rows[i].domain;
            same && figures[j].is_some_and(|(e, c)| e <= error && c <= cost && (e < error || c < cost))
        });
        rows[i].pareto = !beaten;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_unbeaten_rows_are_marked() {
        let row = |method: &str, error, cost| Row {
            error_rms: Some(error),
            cost_ns: Some(cost),
            ..Row::new("d", method, "all")
        };
        let mut rows =
            vec![row("good", 1.0, 1.0), row("worse", 2.0, 1.0), row("fast", 3.0, 0.5), Row::new("d", "none", "all")];
        mark_pareto(&mut rows);
        assert_eq!(rows.iter().map(|r| r.pareto).collect::<Vec<_>>(), [true, false, true, false]);
    }
}
