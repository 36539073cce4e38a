//! Two reports: what became slower or less accurate, beyond noise.

use std::collections::HashSet;
use std::fmt;

use crate::timing::median;
use crate::{Report, Row};

/// A figure of a row, and its name for people.
type Figure = (&'static str, fn(&Row) -> Option<f64>);

/// A kind of time, and how sure it is.
struct Timed {
    name: &'static str,
    cost: fn(&Row) -> Option<f64>,
    spread: fn(&Row) -> Option<f64>,
}

const TIMED: [Timed; 2] = [
    Timed { name: "one call", cost: |row| row.cost_ns, spread: |row| row.cost_spread },
    Timed { name: "an element of a batch", cost: |row| row.cost_batch_ns, spread: |row| row.cost_batch_spread },
];

/// An error may differ by this part, for the elementary functions of another system.
const ERROR_NOISE: f64 = 0.05;
/// Errors below this are rounding of f64.
const ERROR_FLOOR: f64 = 1e-9;
/// A time may differ by this part and by the spreads of both runs.
const TIME_NOISE: f64 = 0.15;
/// A row whose yardstick took longer than the run's fastest by more than this part was measured in a slow moment, which meets one
/// method more than another: so much more noise is allowed, twice what is beyond.
const CALM: f64 = 0.08;
/// A time differs by more than this [ns], or not at all: what a batch of a quarter of a nanosecond an element takes depends on
/// where the compiler's loop happens to lie, too.
const TIME_FLOOR: f64 = 0.05;
/// A counted number of instructions may grow by this part.
const COUNT_NOISE: f64 = 0.02;

/// Something that became worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What: `slower`, `longer`, `less accurate`, `more results that are no numbers`, `gone`.
    pub what: &'static str,
    /// The row, as it was.
    pub term: String,
    /// Its method.
    pub method: String,
    /// Its inputs.
    pub domain: String,
    /// Which of the row's figures.
    pub figure: &'static str,
    /// The figure before and now, with what noise allows, in words.
    pub figures: String,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} {}: {} ({})", self.what, self.term, self.method, self.figures, self.domain)
    }
}

impl Change {
    fn of(what: &'static str, row: &Row, figure: &'static str, figures: String) -> Change {
        let [term, method, domain] = [&row.term, &row.method, &row.domain].map(String::clone);
        Change { what, term, method, domain, figure, figures }
    }

    fn is_of(&self, row: &Row) -> bool {
        [&self.term, &self.method, &self.domain] == [&row.term, &row.method, &row.domain]
    }
}

/// What is worse in `new` than in `old`, among the rows of the parts that both hold.
///
/// Times are compared as ratios. What the machine did while a method was measured is divided out by the yardstick that ran beside
/// it; then the machine's own speed, which is the median of all ratios: so two machines can be compared, and what all methods
/// lose together is not seen. Errors are compared only when both reports drew the same points, which they do when their
/// efforts are the same.
pub fn changes(old: &Report, new: &Report) -> Vec<Change> {
    let key = |row: &Row| (row.term.clone(), row.method.clone(), row.domain.clone());
    let of = |part: &Row| new.rows.iter().find(|row| key(row) == key(part));
    let pairs: Vec<(&Row, &Row)> = old.rows.iter().filter_map(|row| Some((row, of(row)?))).collect();
    let mut changes = slower(&pairs);
    changes.extend(longer(&pairs));
    if old.effort == new.effort {
        changes.extend(pairs.iter().flat_map(|&(old, new)| less_accurate(old, new)));
    }
    let is_measured = |part: &str| new.parts.iter().any(|name| name == part);
    let is_whole = old.parts.iter().all(|part| is_measured(part));
    let was_measured = |row: &Row| if row.part.is_empty() { is_whole } else { is_measured(&row.part) };
    let gone = old.rows.iter().filter(|row| was_measured(row) && of(row).is_none());
    changes.extend(gone.map(|row| Change::of("gone", row, "row", "it has no row any more".to_owned())));
    changes
}

/// How many rows both reports have.
pub fn common(old: &Report, new: &Report) -> usize {
    let keys: HashSet<_> = new.rows.iter().map(|row| (&row.term, &row.method, &row.domain)).collect();
    old.rows.iter().filter(|row| keys.contains(&(&row.term, &row.method, &row.domain))).count()
}

/// What is said of times; of all else a second run would say the same.
const SLOWER: &str = "slower";

/// The parts of `new` to measure again, for something in them seems to be slower.
pub fn doubtful<'r>(changes: &[Change], new: &'r Report) -> HashSet<&'r str> {
    let is_doubted = |row: &&Row| changes.iter().any(|change| change.what == SLOWER && change.is_of(row));
    new.rows.iter().filter(is_doubted).map(|row| row.part.as_str()).collect()
}

/// Takes out what was slower once and is not in `again`, another run of the same.
pub fn confirm(changes: &mut Vec<Change>, again: &[Change]) {
    let key = |change: &Change| (change.term.clone(), change.method.clone(), change.domain.clone(), change.figure);
    let is_same = |a: &Change, b: &Change| b.what == SLOWER && key(a) == key(b);
    changes.retain(|change| change.what != SLOWER || again.iter().any(|other| is_same(change, other)));
}

/// How often as long a time is as before, beside the yardsticks of both runs; of runs before there was one, by itself.
fn ratio(timed: &Timed, old: &Row, new: &Row) -> Option<f64> {
    let pace = match (old.yardstick_ns, new.yardstick_ns) {
        (Some(before), Some(now)) => now / before,
        _ => 1.0,
    };
    Some((timed.cost)(new)? / (timed.cost)(old)? / pace).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
}

/// How much longer a row's yardstick took than the fastest of its run, beyond what is usual.
fn strain(row: &Row, fastest: f64) -> f64 {
    row.yardstick_ns.map_or(0.0, |yardstick| (yardstick / fastest - 1.0 - CALM).max(0.0))
}

fn slower(pairs: &[(&Row, &Row)]) -> Vec<Change> {
    let all = pairs.iter().flat_map(|&(old, new)| TIMED.iter().filter_map(move |timed| ratio(timed, old, new)));
    let machine = median(all.collect());
    let fastest = [pairs.iter().map(|pair| pair.0).collect::<Vec<_>>(), pairs.iter().map(|pair| pair.1).collect()]
        .map(|rows| rows.iter().filter_map(|row| row.yardstick_ns).fold(f64::INFINITY, f64::min));
    let mut changes = Vec::new();
    // The same time stands in the rows of all domains of a method.
    let mut told = HashSet::new();
    for &(old, new) in pairs {
        for timed in &TIMED {
            let (Some(before), Some(now)) = ((timed.cost)(old), (timed.cost)(new)) else { continue };
            let Some(ratio) = ratio(timed, old, new).map(|ratio| ratio / machine) else { continue };
            // A time of too few runs does not know its noise: it proves nothing.
            let (Some(first), Some(second)) = ((timed.spread)(old), (timed.spread)(new)) else { continue };
            let strain = strain(old, fastest[0]) + strain(new, fastest[1]);
            let allowed = 1.0 + TIME_NOISE + first + second + 2.0 * strain;
            let seen = ratio > allowed && (ratio - 1.0) * before > TIME_FLOOR;
            if seen && told.insert((&old.term, &old.method, before.to_bits())) {
                let figures = format!(
                    "{} takes {now:.3} ns, was {before:.3} ns; {ratio:.2} times as long beside what else ran, noise allows {allowed:.2}",
                    timed.name
                );
                changes.push(Change::of(SLOWER, old, timed.name, figures));
            }
        }
    }
    changes
}

/// Shaders with more instructions; once for each method, whose rows all have the same number.
fn longer(pairs: &[(&Row, &Row)]) -> Vec<Change> {
    let mut told = HashSet::new();
    let mut changes = Vec::new();
    for &(old, new) in pairs {
        let (Some(before), Some(now)) = (old.instructions, new.instructions) else { continue };
        let grown = now as f64 > before as f64 * (1.0 + COUNT_NOISE);
        if grown && told.insert((&old.term, &old.method, before)) {
            changes.push(Change::of("longer", old, "instructions", format!("{now} instructions, were {before}")));
        }
    }
    changes
}

fn less_accurate(old: &Row, new: &Row) -> Vec<Change> {
    let mut changes = Vec::new();
    let kinds: [Figure; 2] = [("rms error", |row| row.error_rms), ("largest error", |row| row.error_max)];
    for (name, error) in kinds {
        // An infinite error is null in the file: a row that had a finite one has lost it. But where noise hides the error it is not
        // known to have grown, and what was hidden has grown beyond what it was at most.
        let now = error(new).unwrap_or(if new.error_bound.is_some() { 0.0 } else { f64::INFINITY });
        let known = error(old).or(if name == "rms error" { old.error_bound } else { None });
        if let Some(before) = known
            && now > before * (1.0 + ERROR_NOISE) + ERROR_FLOOR
        {
            changes.push(Change::of("less accurate", old, name, format!("{name} {now:.3e}, was {before:.3e}")));
            break;
        }
    }
    let count = |row: &Row| row.not_finite.unwrap_or(0);
    if count(new) > count(old) {
        let figures = format!("{}, were {}", count(new), count(old));
        changes.push(Change::of("more results that are no numbers", old, "results", figures));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Effort;

    fn report(times: [f64; 3], errors: [f64; 3]) -> Report {
        let mut report = Report::begun(Effort::Quick);
        report.rows = (0..3)
            .map(|i| Row {
                cost_ns: Some(times[i]),
                cost_spread: Some(0.01),
                error_rms: Some(errors[i]),
                ..Row::new("d", ["a", "b", "c"][i], "all")
            })
            .collect();
        report
    }

    #[test]
    fn only_what_is_worse_beyond_noise_is_told() {
        let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
        assert_eq!(changes(&old, &old), []);
        // Another machine: three times as slow throughout, a little noise.
        assert_eq!(changes(&old, &report([3.0, 6.3, 12.0], [0.1, 0.2, 1e-12])), []);
        let worse = changes(&old, &report([1.0, 2.0, 6.0], [0.1, 0.3, 0.0]));
        assert_eq!(
            worse.iter().map(|c| (c.what, c.method.as_str())).collect::<Vec<_>>(),
            [("slower", "c"), ("less accurate", "b")]
        );
        assert!(worse[0].to_string().starts_with("slower: d c: one call takes 6.000 ns, was 4.000 ns; 1.50 times"));
    }

    /// What a quiet machine sees, 1.3 times, and what both runs were unsure of, they do not tell apart.
    #[test]
    fn a_slowdown_is_told_beyond_the_spreads_of_both_runs() {
        let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
        let mut new = report([1.0, 2.0, 1.3 * 4.0], [0.1, 0.2, 0.0]);
        assert_eq!(changes(&old, &new).len(), 1);
        new.rows[2].cost_spread = Some(0.2);
        assert_eq!(changes(&old, &new), []);
    }

    /// A slow moment of the machine meets the yardstick, too.
    #[test]
    fn a_slow_moment_is_not_a_slow_method() {
        let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
        old.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(4.0));
        let mut new = report([1.0, 2.0, 8.0], [0.1, 0.2, 0.0]);
        new.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(4.0));
        assert_eq!(changes(&old, &new).len(), 1);
        new.rows[2].yardstick_ns = Some(8.0);
        assert_eq!(changes(&old, &new), []);
        // It slows one method more than the yardstick.
        (new.rows[2].cost_ns, new.rows[2].yardstick_ns) = (Some(1.6 * 4.0), Some(1.3 * 4.0));
        new.rows[2].cost_spread = Some(0.0);
        assert_eq!(changes(&old, &new), []);
    }

    #[test]
    fn a_batch_has_its_own_spread_and_needs_a_difference_that_is_seen() {
        let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
        (old.rows[0].cost_batch_ns, old.rows[0].cost_batch_spread) = (Some(0.1), Some(0.01));
        let mut new = old.clone();
        new.rows[0].cost_batch_ns = Some(0.14);
        assert_eq!(changes(&old, &new), []);
        new.rows[0].cost_batch_ns = Some(0.2);
        assert_eq!(changes(&old, &new)[0].figure, "an element of a batch");
        new.rows[0].cost_batch_spread = None;
        assert_eq!(changes(&old, &new), []);
    }

    #[test]
    fn longer_shaders_are_told_and_times_of_unknown_noise_are_not() {
        let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        old.rows[0].instructions = Some(400);
        let mut new = old.clone();
        new.rows[0].instructions = Some(430);
        (new.rows[1].cost_ns, new.rows[1].cost_spread) = (Some(9.0), None);
        let found: Vec<_> = changes(&old, &new).iter().map(|c| c.what).collect();
        assert_eq!(found, ["longer"]);
    }

    /// An error that noise hides has not grown, and one that it hid has grown when it is more than it can have been.
    #[test]
    fn errors_below_noise_are_weighed_by_their_bounds() {
        let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        let mut new = old.clone();
        (new.rows[1].error_rms, new.rows[1].error_bound) = (None, Some(0.4));
        assert_eq!(changes(&old, &new), []);
        assert_eq!(changes(&new, &old), []);
        new.rows[1].error_bound = Some(0.15);
        assert_eq!(changes(&new, &old).iter().map(|c| c.what).collect::<Vec<_>>(), ["less accurate"]);
    }

    #[test]
    fn a_lost_row_and_lost_numbers_are_told_and_other_points_are_not_compared() {
        let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        let mut new = old.clone();
        new.rows[0].not_finite = Some(2);
        new.rows[1].error_rms = None;
        new.rows.pop();
        (new.parts, new.rows[0].part) = (vec!["brdf".into()], "brdf".into());
        let found: Vec<_> = changes(&old, &new).iter().map(|c| c.what).collect();
        assert_eq!(found, ["more results that are no numbers", "less accurate", "gone"]);
        new.effort = Effort::Full;
        assert_eq!(changes(&old, &new).iter().map(|c| c.what).collect::<Vec<_>>(), ["gone"]);
    }

    /// A part that was not measured again has lost nothing.
    #[test]
    fn rows_of_other_parts_are_not_missed() {
        let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        old.parts = vec!["brdf".into(), "shaders".into()];
        for (row, part) in old.rows.iter_mut().zip(["brdf", "brdf", "shaders"]) {
            row.part = part.into();
        }
        let mut new = Report { parts: vec!["brdf".into()], ..old.clone() };
        new.rows.truncate(2);
        assert_eq!(changes(&old, &new), []);
        new.rows.truncate(1);
        assert_eq!(
            changes(&old, &new).iter().map(|c| (c.what, c.method.as_str())).collect::<Vec<_>>(),
            [("gone", "b")]
        );
    }

    #[test]
    fn what_is_slower_once_is_measured_again_and_told_when_it_stays_so() {
        let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        old.rows[2].part = "brdf".into();
        let mut new = old.clone();
        (new.rows[2].cost_ns, new.rows[0].error_rms) = (Some(8.0), Some(0.2));
        let mut found = changes(&old, &new);
        assert_eq!(found.iter().map(|c| c.what).collect::<Vec<_>>(), ["slower", "less accurate"]);
        assert_eq!(doubtful(&found, &new), HashSet::from(["brdf"]));
        let mut again = found.clone();
        confirm(&mut found, &again);
        assert_eq!(found.len(), 2);
        // Another figure of the row says nothing of this one.
        again[0].figure = "an element of a batch";
        let mut of_another = found.clone();
        confirm(&mut of_another, &again);
        assert_eq!(of_another.len(), 1);
        confirm(&mut found, &[]);
        assert_eq!(found.iter().map(|c| c.what).collect::<Vec<_>>(), ["less accurate"]);
    }
}
