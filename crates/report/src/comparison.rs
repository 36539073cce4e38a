//! Rows that can be compared: the methods of one term on the same inputs, with one kind of cost. Which of them no other
//! beats, and what to choose.

use crate::{Row, terms};

/// What the methods of a comparison cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Time of an element of a batch.
    Batch,
    /// Time of one call.
    Call,
    /// Memory that is read.
    Bytes,
    /// Time of a pixel of a whole shader on the device.
    Device,
    /// Instructions of a whole shader.
    Instructions,
}

impl Cost {
    const ALL: [Cost; 5] = [Cost::Batch, Cost::Call, Cost::Bytes, Cost::Device, Cost::Instructions];

    /// Of a row, where it has this kind.
    pub fn of(self, row: &Row) -> Option<f64> {
        match self {
            Cost::Batch => row.cost_batch_ns,
            Cost::Call => row.cost_ns,
            Cost::Bytes => row.bytes.map(|bytes| bytes as f64),
            Cost::Device => row.gpu_ns,
            Cost::Instructions => row.instructions.map(|count| count as f64),
        }
    }

    /// How sure a row's cost is, in parts; what is counted is exact. None where it is not known.
    pub fn spread(self, row: &Row) -> Option<f64> {
        match self {
            Cost::Batch => row.cost_batch_spread,
            Cost::Call => row.cost_spread,
            Cost::Device => row.gpu_spread,
            Cost::Bytes | Cost::Instructions => Some(0.0),
        }
    }

    /// Title of an axis or a column, with the unit.
    pub fn title(self) -> &'static str {
        match self {
            Cost::Batch => "time of one element of a batch [ns]",
            Cost::Call => "time of one call [ns]",
            Cost::Bytes => "memory read [bytes]",
            Cost::Device => "time of a pixel of a whole fragment stage on the device [ns]",
            Cost::Instructions => "instructions of a whole fragment stage",
        }
    }

    /// Whether it is a time: times are as sure as their spread says, what is counted is exact.
    pub fn is_time(self) -> bool {
        matches!(self, Cost::Batch | Cost::Call | Cost::Device)
    }

    /// How it was measured.
    pub fn measured(self) -> &'static str {
        match self {
            Cost::Batch => {
                "Time: one element of a batch on one core; the median of interleaved runs, of five sittings the fastest."
            }
            Cost::Call => {
                "Time: one call after the other on one core; the median of interleaved runs, of five sittings the fastest."
            }
            Cost::Bytes => "Memory: what the method reads, counted and not timed.",
            Cost::Device => {
                "Time: a pixel of a whole fragment stage with the method, by the device's timestamps; the shortest of turns \
                 that lie apart."
            }
            Cost::Instructions => {
                "Instructions: SPIR-V of a whole fragment stage with the method, counted and not timed."
            }
        }
    }
}

/// What errors are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Parts of the truth.
    Relative,
    /// Angles.
    Degrees,
    /// Distances in units in the last place.
    Ulps,
    /// The quantity's own.
    Plain,
}

impl Unit {
    /// Of the errors on a domain.
    pub fn of(domain: &str) -> Unit {
        // What stands before the last semicolon are the inputs, which have units of their own.
        let said = domain.rsplit(';').next().unwrap_or(domain);
        let has = |words: [&str; 2]| words.iter().any(|word| said.contains(word));
        if has(["degrees", "in deg"]) {
            Unit::Degrees
        } else if has(["ulps", "ulp of"]) {
            Unit::Ulps
        } else if has(["relative", "parts of the"]) {
            Unit::Relative
        } else {
            Unit::Plain
        }
    }

    /// Title of an axis or a column.
    pub fn title(self) -> &'static str {
        match self {
            Unit::Relative => "rms error, relative",
            Unit::Degrees => "rms error [degrees]",
            Unit::Ulps => "rms error [ulp]",
            Unit::Plain => "rms error",
        }
    }

    /// The rms error that each budget allows; film asks for the least there is, and counts less than this as nothing.
    pub fn limit(self, budget: Budget) -> f64 {
        let [mobile, desktop, film] = match self {
            Unit::Relative | Unit::Plain => [0.1, 0.01, 1e-6],
            Unit::Degrees => [5.0, 1.0, 1e-3],
            Unit::Ulps => [1024.0, 32.0, 2.0],
        };
        match budget {
            Budget::Mobile => mobile,
            Budget::Desktop => desktop,
            Budget::Film => film,
        }
    }
}

/// How much time there is for a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// The cheapest that nobody sees at a glance.
    Mobile,
    /// The cheapest that nobody sees beside the truth.
    Desktop,
    /// The most accurate.
    Film,
}

impl Budget {
    /// All, from the smallest.
    pub const ALL: [Budget; 3] = [Budget::Mobile, Budget::Desktop, Budget::Film];
}

/// A method in a comparison.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    /// The row of the domain where its rms error is largest.
    pub row: &'a Row,
    /// That error.
    pub rms: f64,
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
        if row.error_rms.is_none() {
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
            // The kind of cost that most of them have; the earlier of equals.
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

/// Which of these (error, cost, spread of the cost) no other beats. Costs within their spread are alike; errors are exact.
fn front(figures: &[(f64, f64, Option<f64>)]) -> Vec<bool> {
    let beats = |a: (f64, f64, Option<f64>), b: (f64, f64, Option<f64>)| {
        let alike = 1.0 + a.2.unwrap_or(0.0).max(b.2.unwrap_or(0.0)).clamp(ALIKE, 0.2);
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
        entries.push(Entry {
            row,
            rms: rms(row),
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

/// What to take within a budget.
#[derive(Clone, Copy, Debug)]
pub struct Choice<'c, 'a> {
    /// The method.
    pub entry: &'c Entry<'a>,
    /// What was weighed against its error.
    pub weighed: Cost,
    /// Whether it keeps the budget's limit, or is only the best that there is.
    pub keeps: bool,
    /// Whether `--method` has no name for it, nor for any other method of the comparison: it is chosen in the library.
    pub library_only: bool,
    /// What would be taken if the library's other methods could be named, too, where that is another one.
    pub of_library: Option<&'c Entry<'a>>,
}

impl<'a> Comparison<'a> {
    /// The method to take within a budget: the cheapest whose rms error is within the budget's limit, or, where none is,
    /// that for film, which is the cheapest of those that are within 5 % of the least error or of rounding. Costs are those of
    /// the plot.
    pub fn choice(&self, budget: Budget) -> &Entry<'a> {
        self.pick(budget, self.cost, |_| true).unwrap_or(&self.entries[0])
    }

    /// What to recommend: the same among the methods that `--method` knows, by the device's time where all of these have
    /// one, else by the plot's costs. Of methods whose costs are alike it is the more accurate.
    pub fn recommended(&self, budget: Budget) -> Choice<'_, 'a> {
        let known = |entry: &Entry<'_>| terms::is_known(self.term, &entry.row.method);
        let best = self.pick(budget, self.weighed(|_| true), |_| true).unwrap_or(&self.entries[0]);
        let (named, weighed) = (self.pick(budget, self.weighed(known), known), self.weighed(known));
        let entry = named.unwrap_or(best);
        Choice {
            entry,
            weighed: if named.is_some() { weighed } else { self.weighed(|_| true) },
            keeps: self.keeps(entry, budget),
            library_only: named.is_none(),
            of_library: (named.is_some() && !known(best)).then_some(best),
        }
    }

    /// The cost that is weighed among some of the methods.
    fn weighed(&self, of: impl Fn(&Entry<'a>) -> bool) -> Cost {
        let timed = self.entries.iter().filter(|entry| of(entry)).all(|entry| entry.row.gpu_ns.is_some());
        if timed { Cost::Device } else { self.cost }
    }

    /// Of some of the methods that which a budget takes; none of none.
    fn pick(&self, budget: Budget, cost: Cost, of: impl Fn(&Entry<'a>) -> bool) -> Option<&Entry<'a>> {
        let spent = |entry: &Entry<'a>| if cost == self.cost { Some(entry.cost) } else { cost.of(entry.row) };
        let taken = self.entries.iter().filter(|entry| of(entry));
        let taken: Vec<(&Entry<'a>, f64)> = taken.filter_map(|entry| Some((entry, spent(entry)?))).collect();
        let figures: Vec<_> = taken.iter().map(|&(entry, spent)| (entry.rms, spent, cost.spread(entry.row))).collect();
        let front: Vec<(&Entry<'a>, f64)> =
            taken.into_iter().zip(front(&figures)).filter(|(_, front)| *front).map(|(entry, _)| entry).collect();
        // Entries stand in the order of their errors.
        let (best, _) = *front.first()?;
        let cheapest = |limit: f64| {
            let within = front.iter().filter(|(entry, _)| entry.rms <= limit);
            within.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(entry, _)| *entry)
        };
        let film = || cheapest((1.05 * best.rms).max(self.unit.limit(Budget::Film))).unwrap_or(best);
        match budget {
            Budget::Film => Some(film()),
            _ => Some(cheapest(self.unit.limit(budget)).unwrap_or_else(film)),
        }
    }

    /// Whether the method keeps the budget's limit, or is only the best that there is.
    pub fn keeps(&self, entry: &Entry<'_>, budget: Budget) -> bool {
        budget == Budget::Film || entry.rms <= self.unit.limit(budget)
    }

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

    fn is_of_bakes(&self) -> bool {
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
        let chosen = |budget| both.choice(budget).row.method.as_str();
        assert_eq!(Budget::ALL.map(chosen), ["a", "a", "a"]);
        assert!(both.keeps(&both.entries[0], Budget::Desktop) && !both.keeps(&both.entries[1], Budget::Mobile));
    }

    /// What is named is recommended, what the library has beside it is told apart.
    #[test]
    fn only_methods_that_can_be_named_are_recommended() {
        let of =
            |method: &str, error, cost| Row { term: "diffuse".into(), ..row(method, "one; relative", error, cost) };
        let rows = vec![of("lambert", 0.5, 1.0), of("eon", 0.005, 3.0), of("eon_exact", 0.0, 9.0)];
        let found = comparisons(&rows);
        let film = found[0].recommended(Budget::Film);
        assert_eq!((film.entry.row.method.as_str(), film.library_only), ("eon", false));
        assert_eq!(film.of_library.map(|entry| entry.row.method.as_str()), Some("eon_exact"));
        let mobile = found[0].recommended(Budget::Mobile);
        assert!(mobile.entry.row.method == "eon" && mobile.of_library.is_none() && mobile.keeps);
        let rows: Vec<Row> = rows.into_iter().map(|row| Row { term: "normal_blend".into(), ..row }).collect();
        assert!(comparisons(&rows)[0].recommended(Budget::Film).library_only);
    }

    /// Where all have a time on the device it decides, and of what takes as long the more accurate one is taken.
    #[test]
    fn the_time_of_the_device_is_weighed_where_there_is_one() {
        let of = |method: &str, error, instructions, gpu_ns| Row {
            instructions: Some(instructions),
            gpu_ns,
            gpu_spread: gpu_ns.map(|_| 0.05),
            cost_ns: None,
            term: "anisotropy".into(),
            ..row(method, "one; relative", error, 0.0)
        };
        let found = |strips: Option<f64>, bent: Option<f64>| {
            let rows = vec![of("strips", 0.05, 500, strips), of("bent", 0.08, 600, bent)];
            let found = comparisons(&rows);
            let choice = found[0].recommended(Budget::Mobile);
            (found[0].cost, choice.weighed, choice.entry.row.method.clone())
        };
        assert_eq!(found(Some(617.0), Some(216.0)), (Cost::Device, Cost::Device, "bent".to_owned()));
        assert_eq!(found(Some(222.0), Some(216.0)), (Cost::Device, Cost::Device, "strips".to_owned()));
        assert_eq!(found(None, None), (Cost::Instructions, Cost::Instructions, "strips".to_owned()));
    }

    /// Of what is nearly as fast as the fastest the sentence names the one that errs least.
    #[test]
    fn a_finding_names_a_method_worth_taking() {
        let rows = vec![
            row("good", "one; relative", 0.001, 3.0),
            row("fair", "one; relative", 0.1, 1.04),
            row("poor", "one; relative", 0.8, 1.0),
        ];
        let found = comparisons(&rows);
        assert_eq!(
            crate::words::finding(&found[0]),
            "`good` errs least, 0.10 %; `fair` is 2.9 times as fast but errs 10 %"
        );
    }

    /// Where no method is good enough, no budget pays for the last hundredth of an error.
    #[test]
    fn beyond_every_limit_all_budgets_choose_alike() {
        let rows = vec![row("dear", "one; relative", 0.31, 9.0), row("a", "one; relative", 0.32, 1.0)];
        let found = comparisons(&rows);
        assert_eq!(Budget::ALL.map(|budget| found[0].choice(budget).row.method.as_str()), ["a", "a", "a"]);
        assert_eq!(
            crate::words::finding(&found[0]),
            "`a` errs 32 %, next to the least there is, and nothing is cheaper"
        );
    }
}
