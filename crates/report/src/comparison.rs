//! Rows that can be compared: the methods of one term on the same inputs, with one kind of cost. Which of them no other
//! beats.

use crate::Row;
use crate::cost::Cost;
use crate::part::levels::NOT_TIMED;
use crate::unit::Unit;

/// A method in a comparison.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    /// The row of the domain where its rms error is largest.
    pub row: &'a Row,
    /// That error.
    pub rms: f64,
    /// The row of the domain where its largest error is largest: another one, where a peak is narrow.
    pub largest: &'a Row,
    /// Its rms error where it is smallest.
    pub least_rms: f64,
    /// What it costs; on average over the domains.
    pub cost: f64,
    /// No other is cheaper and at least as accurate, or more accurate and as cheap.
    pub front: bool,
}

/// Methods of one term that can be weighed against each other.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    /// The term.
    pub term: &'a str,
    /// The inputs; each method's error is its worst over them.
    pub domains: Vec<&'a str>,
    /// What is meant by cost.
    pub cost: Cost,
    /// What errors are counted in.
    pub unit: Unit,
    /// The methods, the most accurate first; at least two.
    pub entries: Vec<Entry<'a>>,
}

/// Terms of which nothing is chosen: drawers of whole pictures, and what the split sum loses beside a sum over all light.
const NO_CHOICE: [&str; 2] = ["picture", "split_sum"];

/// Times that differ by less are alike, where the rows do not say how far they spread.
const ALIKE: f64 = 0.02;

/// Splits rows by term and domain, those that are timed from those with another cost, in the order of appearance.
fn groups(rows: &[Row]) -> Vec<(Cost, Vec<usize>)> {
    let mut domains: Vec<Vec<usize>> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        // What is judged and not timed yet has no cost to be weighed by.
        if row.error_rms.is_none() || row.note.as_deref() == Some(NOT_TIMED) {
            continue;
        }
        let known = domains.iter_mut().find(|group| {
            let first = &rows[group[0]];
            first.term == row.term && first.domain == row.domain
        });
        match known {
            Some(group) => group.push(i),
            None => domains.push(vec![i]),
        }
    }
    let mut groups = Vec::new();
    for group in domains {
        let (timed, other): (Vec<_>, Vec<_>) =
            group.into_iter().partition(|&i| rows[i].cost_ns.or(rows[i].cost_batch_ns).is_some());
        for mut part in [timed, other] {
            // The kind of cost that most of them have; the earlier of equals: the same in every run of a machine.
            let count = |cost: Cost| part.iter().filter(|&&i| cost.of(&rows[i]).is_some()).count();
            let Some(cost) = Cost::ALL.into_iter().rev().max_by_key(|&cost| count(cost)) else { continue };
            part.retain(|&i| cost.of(&rows[i]).is_some());
            if !part.is_empty() {
                groups.push((cost, part));
            }
        }
    }
    groups
}

/// Up to which ratio two costs of these spreads are alike.
pub(crate) fn alike(a: Option<f64>, b: Option<f64>) -> f64 {
    1.0 + a.unwrap_or(0.0).max(b.unwrap_or(0.0)).clamp(ALIKE, 0.2)
}

/// Which of these (error, cost, spread of the cost) no other beats. Costs within their spread are alike; errors are exact.
pub(crate) fn front(figures: &[(f64, f64, Option<f64>)]) -> Vec<bool> {
    let beats = |a: (f64, f64, Option<f64>), b: (f64, f64, Option<f64>)| {
        let alike = alike(a.2, b.2);
        a.0 <= b.0 && a.1 <= b.1 * alike && (a.0 < b.0 || a.1 * alike < b.1)
    };
    figures.iter().map(|&b| !figures.iter().any(|&a| beats(a, b))).collect()
}

/// Marks each row that no other row of the same term, domain and kind of cost beats. Rows without an error or a cost stay
/// unmarked.
pub fn mark_pareto(rows: &mut [Row]) {
    for (cost, group) in groups(rows) {
        let figures: Vec<_> = group.iter().filter_map(|&i| figure(cost, &rows[i])).collect();
        for (i, front) in group.into_iter().zip(front(&figures)) {
            rows[i].pareto = front;
        }
    }
}

fn figure(cost: Cost, row: &Row) -> Option<(f64, f64, Option<f64>)> {
    Some((row.error_rms?, cost.of(row)?, cost.spread(row)))
}

/// All comparisons among rows: methods against the same truth. Domains on which the same methods were measured are taken
/// together. What the arithmetic adds to each method is no comparison of methods.
pub fn comparisons(rows: &[Row]) -> Vec<Comparison<'_>> {
    let mut merged: Vec<(Cost, Vec<Vec<usize>>)> = Vec::new();
    for (cost, group) in groups(rows) {
        if rows[group[0]].is_rounding() || NO_CHOICE.contains(&rows[group[0]].term.as_str()) || group.len() < 2 {
            continue;
        }
        let alike = |other: &[usize]| {
            let names = |group: &[usize]| group.iter().map(|&i| rows[i].method.clone()).collect::<Vec<_>>();
            let (a, b) = (&rows[group[0]], &rows[other[0]]);
            a.term == b.term && Unit::of(&a.domain) == Unit::of(&b.domain) && names(&group) == names(other)
        };
        match merged.iter_mut().find(|(kind, groups)| *kind == cost && alike(&groups[0])) {
            Some((_, groups)) => groups.push(group),
            None => merged.push((cost, vec![group])),
        }
    }
    merged.into_iter().map(|(cost, groups)| comparison(rows, cost, &groups)).collect()
}

fn comparison<'a>(rows: &'a [Row], cost: Cost, groups: &[Vec<usize>]) -> Comparison<'a> {
    let mut entries: Vec<Entry<'a>> = Vec::new();
    for k in 0..groups[0].len() {
        let all: Vec<&Row> = groups.iter().map(|group| &rows[group[k]]).collect();
        let rms = |row: &Row| row.error_rms.unwrap_or(f64::INFINITY);
        let Some(row) = all.iter().copied().max_by(|a, b| rms(a).total_cmp(&rms(b))) else { continue };
        // The earlier of equals; what has no largest error counts as none.
        let most = |row: &Row| row.error_max.unwrap_or(-1.0);
        let largest = all.iter().copied().rev().max_by(|a, b| most(a).total_cmp(&most(b))).unwrap_or(row);
        entries.push(Entry {
            row,
            rms: rms(row),
            largest,
            least_rms: all.iter().map(|row| rms(row)).fold(f64::INFINITY, f64::min),
            cost: all.iter().filter_map(|row| cost.of(row)).sum::<f64>() / all.len() as f64,
            front: false,
        });
    }
    let figures: Vec<_> = entries.iter().map(|entry| (entry.rms, entry.cost, cost.spread(entry.row))).collect();
    for (entry, front) in entries.iter_mut().zip(front(&figures)) {
        entry.front = front;
    }
    entries.sort_by(|a, b| a.rms.total_cmp(&b.rms).then(a.cost.total_cmp(&b.cost)));
    let first = &rows[groups[0][0]];
    Comparison {
        term: &first.term,
        domains: groups.iter().map(|group| rows[group[0]].domain.as_str()).collect(),
        cost,
        unit: Unit::of(&first.domain),
        entries,
    }
}

impl Comparison<'_> {
    /// Title of the axis or column of the costs, with the unit.
    pub fn cost_title(&self) -> &'static str {
        if self.is_of_bakes() {
            "time of a bake on all cores for each texel of its levels [ns]"
        } else {
            self.cost.title()
        }
    }

    /// How the costs were measured.
    pub fn how(&self) -> String {
        if self.is_of_bakes() {
            return "Time: a whole bake on all cores, irradiance and harmonics included, shared out among the texels of its levels."
                .to_owned();
        }
        let device = self.entries.iter().find_map(|entry| entry.row.gpu.as_deref());
        match (self.cost, device) {
            (Cost::Device, Some(name)) => format!("{} The device: {name}.", self.cost.measured()),
            _ => self.cost.measured().to_owned(),
        }
    }

    /// Whether the costs are those of bakes.
    pub(crate) fn is_of_bakes(&self) -> bool {
        self.term == "prefilter" && self.cost == Cost::Batch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(method: &str, domain: &str, error: f64, cost: f64) -> Row {
        Row { error_rms: Some(error), cost_ns: Some(cost), ..Row::new("d", method, domain) }
    }

    #[test]
    fn only_unbeaten_rows_are_marked() {
        let mut rows = vec![
            row("good", "all", 1.0, 1.0),
            row("worse", "all", 2.0, 1.0),
            row("fast", "all", 3.0, 0.5),
            row("as fast but for noise", "all", 4.0, 0.499),
            Row::new("d", "none", "all"),
            Row {
                error_rms: Some(9.0),
                bytes: Some(4),
                ..Row::new("d", "a table is not weighed against times", "all")
            },
        ];
        mark_pareto(&mut rows);
        assert_eq!(rows.iter().map(|r| r.pareto).collect::<Vec<_>>(), [true, false, true, false, false, true]);
    }

    /// A run that is interrupted before its bakes are timed weighs none of them, by memory either.
    #[test]
    fn what_is_not_timed_yet_is_not_weighed() {
        let of = |method: &str, place: &str, time: Option<f64>| Row {
            error_rms: Some(if method == "ggx" { 1e-4 } else { 0.05 }),
            cost_batch_ns: time,
            bytes: Some(8_000_000),
            note: time.is_none().then(|| NOT_TIMED.to_owned()),
            ..Row::new("prefilter", method, &format!("{place}: levels; relative error"))
        };
        let mut rows = vec![
            of("ggx", "studio", Some(900.0)),
            of("hdre", "studio", Some(500.0)),
            of("ggx", "sky", None),
            of("hdre", "sky", None),
        ];
        mark_pareto(&mut rows);
        assert_eq!(rows.iter().map(|row| row.pareto).collect::<Vec<_>>(), [true, true, false, false]);
        let found = comparisons(&rows);
        assert_eq!((found.len(), found[0].cost, found[0].domains.len()), (1, Cost::Batch, 1));
    }

    #[test]
    fn a_wide_spread_makes_times_alike() {
        let mut rows = vec![row("a", "all", 1.0, 1.1), row("b", "all", 2.0, 1.0)];
        mark_pareto(&mut rows);
        assert!(rows[1].pareto);
        rows[0].cost_spread = Some(0.15);
        mark_pareto(&mut rows);
        assert!(rows[0].pareto && !rows[1].pareto);
    }

    #[test]
    fn domains_of_the_same_methods_are_taken_together_and_the_worst_counts() {
        let rows = vec![
            row("a", "one; relative", 0.001, 4.0),
            row("b", "one; relative", 0.2, 1.0),
            row("a", "two; relative", 0.005, 6.0),
            row("b", "two; relative", 0.05, 1.0),
            row("a", "one; relative to max(truth, 0) against the same form in f64", 0.0, 4.0),
            row("b", "one; relative to max(truth, 0) against the same form in f64", 0.0, 1.0),
        ];
        let found = comparisons(&rows);
        assert_eq!(found.len(), 1);
        let both = &found[0];
        assert_eq!((both.domains.len(), both.unit, both.cost), (2, Unit::Relative, Cost::Call));
        assert_eq!((both.entries[0].rms, both.entries[0].least_rms, both.entries[0].cost), (0.005, 0.001, 5.0));
    }

    /// A peak may stand where the rms error is small.
    #[test]
    fn the_largest_error_is_the_largest_of_all_domains() {
        let of = |method: &str, domain: &str, rms, most, at: &str| Row {
            error_max: Some(most),
            at: Some(at.to_owned()),
            ..row(method, domain, rms, 1.0)
        };
        let rows = vec![
            of("a", "one; relative", 0.01, 130.0, "peak"),
            of("b", "one; relative", 0.02, 0.1, "here"),
            of("a", "two; relative", 0.05, 58.0, "elsewhere"),
            of("b", "two; relative", 0.01, 0.05, "there"),
        ];
        let found = comparisons(&rows);
        let largest = |k: usize| (found[0].entries[k].largest.error_max, found[0].entries[k].largest.at.as_deref());
        assert_eq!([largest(0), largest(1)], [(Some(0.1), Some("here")), (Some(130.0), Some("peak"))]);
        let report = crate::Report { rows: rows.clone(), ..crate::Report::begun(crate::Effort::Quick) };
        let page = crate::page::html(&report);
        assert!(page.contains(">13\u{202f}000 %") && page.contains("<td class=\"small\">peak</td>"), "{page}");
    }
}
