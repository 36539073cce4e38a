//! What no run can have measured: a report that was cut short, written by hand or spoiled is refused before anything is compared with it.

use std::collections::HashSet;

use crate::{Report, Row};

/// The longest time that is believed [ns]: a day.
const LONGEST: f64 = 86_400e9;

/// The largest spread that is believed: the sitting in the middle took a thousand times as long again.
const WIDEST: f64 = 1000.0;

/// A figure, its name in the file, and what it may be.
type Figure = (&'static str, fn(&Row) -> Option<f64>, Allowed);

/// What a number may be.
#[derive(Clone, Copy)]
enum Allowed {
    /// 0 or more.
    Error,
    /// 0 to 1.
    Share,
    /// More than 0, at most [`LONGEST`].
    Time,
    /// 0 to [`WIDEST`].
    Spread,
    /// 1 or more.
    Count,
}

impl Allowed {
    fn holds(self, x: f64) -> bool {
        match self {
            Allowed::Error => x >= 0.0 && x.is_finite(),
            Allowed::Share => (0.0..=1.0).contains(&x),
            Allowed::Time => x > 0.0 && x <= LONGEST,
            Allowed::Spread => (0.0..=WIDEST).contains(&x),
            Allowed::Count => x >= 1.0,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Allowed::Error => "an error is 0 or more",
            Allowed::Share => "it is 0 to 1",
            Allowed::Time => "a time is more than 0 and at most a day",
            Allowed::Spread => "a spread is 0 to 1000",
            Allowed::Count => "a count is 1 or more",
        }
    }
}

const FIGURES: [Figure; 13] = [
    ("error_max", |row| row.error_max, Allowed::Error),
    ("error_rms", |row| row.error_rms, Allowed::Error),
    ("error_bound", |row| row.error_bound, Allowed::Error),
    ("flip", |row| row.flip, Allowed::Share),
    ("cost_ns", |row| row.cost_ns, Allowed::Time),
    ("cost_batch_ns", |row| row.cost_batch_ns, Allowed::Time),
    ("gpu_ns", |row| row.gpu_ns, Allowed::Time),
    ("yardstick_ns", |row| row.yardstick_ns, Allowed::Time),
    ("cost_spread", |row| row.cost_spread, Allowed::Spread),
    ("cost_batch_spread", |row| row.cost_batch_spread, Allowed::Spread),
    ("gpu_spread", |row| row.gpu_spread, Allowed::Spread),
    ("instructions", |row| row.instructions.map(|count| count as f64), Allowed::Count),
    ("points", |row| row.points.map(|count| count as f64), Allowed::Count),
];

/// What is impossible in a report, the first thing; none in one that a run wrote.
pub(crate) fn first(report: &Report) -> Option<String> {
    let mut known = HashSet::new();
    for (number, row) in report.rows.iter().enumerate() {
        let place = || format!("row {} ({} {})", number + 1, row.term, row.method);
        for (name, text) in [("term", &row.term), ("method", &row.method), ("domain", &row.domain)] {
            if text.is_empty() {
                return Some(format!("{} has no {name}", place()));
            }
        }
        for (name, figure, allowed) in FIGURES {
            if let Some(x) = figure(row).filter(|x| !allowed.holds(*x)) {
                return Some(format!("{}: {name} is {x}, and {}", place(), allowed.words()));
            }
        }
        // Of pictures the largest error is a bound from below.
        if let (Some(rms), Some(most)) = (row.error_rms, row.error_max)
            && rms > most * (1.0 + 1e-6)
            && row.flip.is_none()
        {
            return Some(format!("{}: error_rms {rms} is more than error_max {most}", place()));
        }
        if !known.insert((&row.term, &row.method, &row.domain)) {
            return Some(format!("{} is there twice, for the same inputs: {}", place(), row.domain));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Effort, ReportError};

    fn report() -> Report {
        let row = |method: &str| Row {
            part: "brdf".into(),
            error_rms: Some(0.1),
            error_max: Some(0.2),
            cost_ns: Some(3.0),
            cost_spread: Some(0.01),
            gpu_ns: Some(200.0),
            instructions: Some(300),
            flip: None,
            ..Row::new("v", method, "all; relative")
        };
        Report { rows: vec![row("hammon"), row("kelemen")], parts: vec!["brdf".into()], ..Report::begun(Effort::Quick) }
    }

    #[test]
    fn what_no_run_measures_is_refused() {
        let whole = report();
        assert_eq!(first(&whole), None);
        type Spoil = fn(&mut Row);
        let spoiled: [(Spoil, &str); 12] = [
            (|row| row.cost_ns = Some(-3.0), "row 2 (v kelemen): cost_ns is -3, and a time is more than 0"),
            (|row| row.cost_ns = Some(0.0), "cost_ns is 0"),
            (|row| row.gpu_ns = Some(1e300), "at most a day"),
            (|row| row.cost_spread = Some(-0.5), "cost_spread is -0.5"),
            (|row| row.cost_spread = Some(1e9), "a spread is 0 to 1000"),
            (|row| row.error_rms = Some(f64::NAN), "error_rms is NaN, and an error is 0 or more"),
            (|row| row.error_max = Some(-0.0001), "error_max is -0.0001"),
            (|row| row.error_rms = Some(0.3), "error_rms 0.3 is more than error_max 0.2"),
            (|row| row.flip = Some(1.5), "flip is 1.5, and it is 0 to 1"),
            (|row| row.instructions = Some(0), "instructions is 0"),
            (|row| row.term.clear(), "has no term"),
            (|row| row.method = "hammon".into(), "row 2 (v hammon) is there twice, for the same inputs: all; relative"),
        ];
        for (spoil, words) in spoiled {
            let mut report = whole.clone();
            spoil(&mut report.rows[1]);
            let fault = first(&report).unwrap_or_else(|| panic!("nothing is wrong, but {words}"));
            assert!(fault.contains(words), "{fault}, not {words}");
        }
        let text = whole.to_json().replacen("\"cost_ns\":3.0", "\"cost_ns\":-3.0", 1);
        assert!(matches!(Report::from_json(&text), Err(ReportError::Impossible(_))), "{text}");
        // What JSON has no number for.
        for number in ["NaN", "1e999", "\"3\""] {
            let text = whole.to_json().replacen("\"cost_ns\":3.0", &format!("\"cost_ns\":{number}"), 1);
            assert!(matches!(Report::from_json(&text), Err(ReportError::Layout(_))), "{text}");
        }
    }
}
