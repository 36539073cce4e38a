//! What to choose: for each budget the method that costs least within its limit of error.

use crate::comparison::{Comparison, Entry, front};
use crate::cost::Cost;
use crate::timing::median;
use crate::unit::Budget;
use crate::{Row, terms};

/// Times on the device that spread by more than this, in the median of the methods, do not tell methods apart; the instructions of the same
/// shaders are weighed then.
const STEADY: f64 = 0.1;

/// Memory decides on a phone between methods whose times differ by less than this.
const NEARLY: f64 = 1.2;

/// The time on the device, or, where the rows' times are not steady, the instructions.
pub(crate) fn steadier(rows: &[&Row]) -> Cost {
    let spreads = rows.iter().map(|row| row.gpu_spread.unwrap_or(f64::INFINITY)).collect();
    if median(spreads) <= STEADY { Cost::Device } else { Cost::Instructions }
}

/// A method, and what it costs.
type Taken<'c, 'a> = (&'c Entry<'a>, f64);

/// Those that no other of them beats.
fn unbeaten<'c, 'a>(taken: &[Taken<'c, 'a>], cost: Cost) -> Vec<Taken<'c, 'a>> {
    let figures: Vec<_> = taken.iter().map(|&(entry, spent)| (entry.rms, spent, cost.spread(entry.row))).collect();
    taken.iter().zip(front(&figures)).filter(|(_, front)| *front).map(|(taken, _)| *taken).collect()
}

/// The cheapest of those within a limit of error.
fn cheapest<'c, 'a>(taken: &[Taken<'c, 'a>], limit: f64) -> Option<&'c Entry<'a>> {
    let within = taken.iter().filter(|(entry, _)| entry.rms <= limit);
    within.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(entry, _)| *entry)
}

/// Of the methods within a limit of error that take about as long as the cheapest, that which reads the least memory: what a phone's
/// battery pays for. Of methods that read as little it is the cheapest that no other beats. None where a method's memory is not known,
/// or none keeps the limit.
fn smallest<'c, 'a>(taken: &[Taken<'c, 'a>], cost: Cost, limit: f64) -> Option<&'c Entry<'a>> {
    if taken.iter().any(|(entry, _)| entry.row.bytes.is_none()) {
        return None;
    }
    let within = || taken.iter().copied().filter(|(entry, _)| entry.rms <= limit);
    let fastest = within().map(|(_, spent)| spent).fold(f64::INFINITY, f64::min);
    let nearly = within().filter(|(_, spent)| *spent <= NEARLY * fastest);
    let least = nearly.filter_map(|(entry, _)| entry.row.bytes).min()?;
    // What reads less still takes longer than that, and is weighed, too: nothing is taken that it beats.
    let small: Vec<Taken<'c, 'a>> =
        within().filter(|(entry, _)| entry.row.bytes.is_some_and(|bytes| bytes <= least)).collect();
    cheapest(&unbeaten(&small, cost), limit)
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
    /// that for film, which is the cheapest of those that are within 5 % of the least error or of rounding. On mobile it is, of
    /// those that take up to 1.2 times as long as the cheapest, that which reads the least memory, where it is known of all.
    /// Costs are those of the plot.
    pub fn choice(&self, budget: Budget) -> &Entry<'a> {
        self.pick(budget, self.cost, |_| true).unwrap_or(&self.entries[0])
    }

    /// What to recommend: the same among the methods that `--method` knows, by the device's time where all of these have
    /// one that is steady, else by instructions, or by the plot's costs. Of methods whose costs are alike it is the more accurate.
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

    /// The cost that is weighed among some of the methods: the device's time where all have one and these are steady, else
    /// the instructions of the same shaders; where a method has no shader, the plot's.
    fn weighed(&self, of: impl Fn(&Entry<'a>) -> bool) -> Cost {
        let rows: Vec<&Row> = self.entries.iter().filter(|entry| of(entry)).map(|entry| entry.row).collect();
        let all = |cost: Cost| rows.iter().all(|row| cost.of(row).is_some());
        match (all(Cost::Device), all(Cost::Instructions)) {
            (true, false) => Cost::Device,
            (true, true) => steadier(&rows),
            _ => self.cost,
        }
    }

    /// Of some of the methods that which a budget takes; none of none.
    fn pick(&self, budget: Budget, cost: Cost, of: impl Fn(&Entry<'a>) -> bool) -> Option<&Entry<'a>> {
        let spent = |entry: &Entry<'a>| if cost == self.cost { Some(entry.cost) } else { cost.of(entry.row) };
        let taken = self.entries.iter().filter(|entry| of(entry));
        let taken: Vec<Taken<'_, 'a>> = taken.filter_map(|entry| Some((entry, spent(entry)?))).collect();
        let front = unbeaten(&taken, cost);
        // Entries stand in the order of their errors.
        let (best, _) = *front.first()?;
        let film = || cheapest(&front, (1.05 * best.rms).max(self.unit.limit(Budget::Film))).unwrap_or(best);
        match budget {
            Budget::Film => Some(film()),
            Budget::Mobile => {
                let limit = self.unit.limit(budget);
                Some(smallest(&taken, cost, limit).or_else(|| cheapest(&front, limit)).unwrap_or_else(film))
            }
            Budget::Desktop => Some(cheapest(&front, self.unit.limit(budget)).unwrap_or_else(film)),
        }
    }

    /// Whether the method keeps the budget's limit, or is only the best that there is.
    pub fn keeps(&self, entry: &Entry<'_>, budget: Budget) -> bool {
        budget == Budget::Film || entry.rms <= self.unit.limit(budget)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comparison::comparisons;

    fn row(method: &str, domain: &str, error: f64, cost: f64) -> Row {
        Row { error_rms: Some(error), cost_ns: Some(cost), ..Row::new("d", method, domain) }
    }

    #[test]
    fn the_worst_of_the_domains_keeps_the_limit() {
        let rows = vec![
            row("a", "one; relative", 0.001, 4.0),
            row("b", "one; relative", 0.2, 1.0),
            row("a", "two; relative", 0.005, 6.0),
            row("b", "two; relative", 0.05, 1.0),
        ];
        let found = comparisons(&rows);
        let both = &found[0];
        assert_eq!(Budget::ALL.map(|budget| both.choice(budget).row.method.as_str()), ["a", "a", "a"]);
        assert!(both.keeps(&both.entries[0], Budget::Desktop) && !both.keeps(&both.entries[1], Budget::Mobile));
    }

    /// A phone takes the smaller of two that are good enough and about as fast, and no smaller one that takes far longer.
    #[test]
    fn memory_decides_on_a_phone() {
        let of = |method: &str, error, cost, bytes| Row {
            bytes: Some(bytes),
            ..row(method, "one; in degrees", error, cost)
        };
        let rows = vec![
            of("wide", 0.001, 1.0, 8),
            of("plain", 0.2, 1.0, 4),
            of("packed", 0.9, 1.1, 1),
            of("tiny and slow", 0.9, 2.0, 0),
            of("bad", 20.0, 0.5, 0),
        ];
        let found = comparisons(&rows);
        let chosen = Budget::ALL.map(|budget| found[0].choice(budget).row.method.as_str());
        assert_eq!(chosen, ["packed", "wide", "wide"]);
    }

    /// Of methods that read the same memory and take as long, within their spread, a phone takes the more accurate one.
    #[test]
    fn of_the_same_memory_a_phone_takes_the_more_accurate() {
        let of = |method: &str, error, gpu_ns, spread| Row {
            term: "level_map".into(),
            gpu_ns: Some(gpu_ns),
            gpu_spread: Some(spread),
            bytes: Some(16_773_120),
            ..row(method, "studio; relative", error, 120.0)
        };
        let rows = vec![
            of("hermite", 0.0062, 189.9, 0.001),
            of("geometric", 0.0488, 175.9, 0.002),
            of("linear", 0.0514, 173.5, 0.008),
            of("report", 0.0514, 169.5, 0.066),
        ];
        let found = comparisons(&rows);
        let mobile = found[0].recommended(Budget::Mobile);
        assert_eq!((mobile.weighed, mobile.entry.row.method.as_str()), (Cost::Device, "geometric"));
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
        let of = |method: &str, error, instructions, gpu_ns: Option<f64>, spread| Row {
            instructions: Some(instructions),
            gpu_ns,
            gpu_spread: gpu_ns.map(|_| spread),
            cost_ns: None,
            term: "anisotropy".into(),
            ..row(method, "one; relative", error, 0.0)
        };
        let found = |strips: Option<f64>, bent: Option<f64>, spread: f64| {
            let rows = vec![of("strips", 0.05, 500, strips, spread), of("bent", 0.08, 600, bent, spread)];
            let found = comparisons(&rows);
            let choice = found[0].recommended(Budget::Mobile);
            (found[0].cost, choice.weighed, choice.entry.row.method.clone())
        };
        assert_eq!(found(Some(617.0), Some(216.0), 0.05), (Cost::Device, Cost::Device, "bent".to_owned()));
        assert_eq!(found(Some(222.0), Some(216.0), 0.05), (Cost::Device, Cost::Device, "strips".to_owned()));
        // Times that say little leave the choice to the instructions, and so does a machine without a device.
        let counted = (Cost::Instructions, Cost::Instructions, "strips".to_owned());
        assert_eq!(found(Some(617.0), Some(216.0), 0.3), counted);
        assert_eq!(found(None, None, 0.0), counted);
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
