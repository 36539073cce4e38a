//! What to choose: for each budget the method that costs least within its limit of error.

use crate::comparison::{Comparison, Entry};
use crate::cost::Cost;
use crate::terms;
use crate::unit::Budget;

/// Times that differ by less, or by less than their spreads, are alike. Those of one machine differ by up to a quarter from run to run, and
/// what is chosen must not.
const ALIKE: f64 = 0.5;

/// Errors of which the larger is not this many times the smaller are the same for film.
const SAME: f64 = 1.05;

/// Shaders whose instructions differ by less are as long.
const AS_LONG: f64 = 0.05;

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
    /// A method that only the library has and that errs less: for the same cost, or for any where the chosen one is over the
    /// limit and this one is not, or the budget is film.
    pub of_library: Option<&'c Entry<'a>>,
}

impl<'a> Comparison<'a> {
    /// The method to take within a budget, by the costs of the plot; see [`Comparison::recommended`].
    pub fn choice(&self, budget: Budget) -> &Entry<'a> {
        self.pick(budget, &[self.cost], |_| true).unwrap_or(&self.entries[0])
    }

    /// What to recommend: a method that `--method` knows, whose rms error is within the budget's limit, or, where none is, within 5 % of
    /// the least error or of rounding, as for film. Of these those whose cost is about the least: first by the device's time where all have one,
    /// then by instructions; or else by the plot's costs. On mobile, where it is known of all, memory comes between the first cost
    /// and the next. Of what is left it is the most accurate, and of equals that which the list of methods has first.
    pub fn recommended(&self, budget: Budget) -> Choice<'_, 'a> {
        let known = |entry: &Entry<'_>| terms::is_known(self.term, &entry.row.method);
        let all = self.weighed(|_| true);
        let best = self.pick(budget, &all, |_| true).unwrap_or(&self.entries[0]);
        let own = self.weighed(known);
        let named = self.pick(budget, &own, known);
        let entry = named.unwrap_or(best);
        Choice {
            entry,
            weighed: if named.is_some() { own[0] } else { all[0] },
            keeps: self.keeps(entry, budget),
            library_only: named.is_none(),
            of_library: self.better_of_library(entry, budget),
        }
    }

    /// What [`Choice::of_library`] says, for the method that was chosen. Costs are those of the plot, which all methods have.
    fn better_of_library(&self, chosen: &Entry<'a>, budget: Budget) -> Option<&Entry<'a>> {
        let floor = self.unit.limit(Budget::Film);
        let errs_less = |entry: &Entry<'a>| SAME * entry.rms.max(floor) < chosen.rms;
        let costs_no_more = |entry: &Entry<'a>| entry.cost <= chosen.cost;
        let is_worth_it = |entry: &Entry<'a>| {
            let keeps_alone = self.keeps(entry, budget) && !self.keeps(chosen, budget);
            budget == Budget::Film || keeps_alone || costs_no_more(entry)
        };
        let is_alone = |entry: &Entry<'a>| !terms::is_known(self.term, &entry.row.method);
        let is_better = |entry: &Entry<'a>| is_alone(entry) && errs_less(entry) && is_worth_it(entry);
        self.pick(budget, &[self.cost], is_better)
    }

    /// The costs that are weighed among some of the methods, one after the other: the device's time and the instructions of the same
    /// shaders, where all have them; where a method has no shader, the plot's.
    fn weighed(&self, of: impl Fn(&Entry<'a>) -> bool) -> Vec<Cost> {
        let has = |cost: &Cost| self.entries.iter().filter(|entry| of(entry)).all(|entry| cost.of(entry.row).is_some());
        let shaders: Vec<Cost> = [Cost::Device, Cost::Instructions].into_iter().filter(has).collect();
        if shaders.is_empty() { vec![self.cost] } else { shaders }
    }

    /// What a method costs; of the plot's kind it is the mean over the domains.
    fn spent(&self, entry: &Entry<'a>, cost: Cost) -> Option<f64> {
        if cost == self.cost { Some(entry.cost) } else { cost.of(entry.row) }
    }

    /// Leaves those whose cost is about the least, by this part or by the spreads.
    fn retain_cheapest(&self, taken: &mut Vec<&Entry<'a>>, cost: Cost, alike: f64) {
        let spent = |entry: &Entry<'a>| self.spent(entry, cost).unwrap_or(f64::INFINITY);
        let Some(least) = taken.iter().copied().min_by(|a, b| spent(a).total_cmp(&spent(b))) else { return };
        let spread = |entry: &Entry<'a>| cost.spread(entry.row).unwrap_or(0.0);
        taken.retain(|entry| spent(entry) <= spent(least) * (1.0 + alike.max(spread(entry) + spread(least))));
    }

    /// Of some of the methods that which a budget takes; none of none.
    fn pick(&self, budget: Budget, costs: &[Cost], of: impl Fn(&Entry<'a>) -> bool) -> Option<&Entry<'a>> {
        let has = |entry: &&Entry<'a>| of(entry) && costs.iter().all(|&cost| self.spent(entry, cost).is_some());
        let all: Vec<&Entry<'a>> = self.entries.iter().filter(has).collect();
        let within = |limit: f64| all.iter().copied().filter(|entry| entry.rms <= limit).collect::<Vec<_>>();
        let mut taken = within(self.unit.limit(budget));
        if taken.is_empty() || budget == Budget::Film {
            let least = all.iter().map(|entry| entry.rms).fold(f64::INFINITY, f64::min);
            taken = within((SAME * least).max(self.unit.limit(Budget::Film)));
        } else if budget == Budget::Mobile && all.iter().all(|entry| entry.row.bytes.is_some()) {
            self.retain_cheapest(&mut taken, *costs.first()?, ALIKE);
            let least = taken.iter().filter_map(|entry| entry.row.bytes).min();
            taken.retain(|entry| entry.row.bytes == least);
        }
        for &cost in costs {
            let alike = if cost.is_time() { ALIKE } else { AS_LONG };
            self.retain_cheapest(&mut taken, cost, if cost == Cost::Bytes { 0.0 } else { alike });
        }
        let order = |entry: &Entry<'a>| (terms::place(self.term, &entry.row.method), entry.row.method.as_str());
        taken.into_iter().min_by(|a, b| a.rms.total_cmp(&b.rms).then_with(|| order(a).cmp(&order(b))))
    }

    /// Whether the method keeps the budget's limit, or is only the best that there is.
    pub fn keeps(&self, entry: &Entry<'_>, budget: Budget) -> bool {
        budget == Budget::Film || entry.rms <= self.unit.limit(budget)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Row;
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
        let of = |method: &str, error, gpu_ns, spread, instructions| Row {
            term: "level_map".into(),
            gpu_ns: Some(gpu_ns),
            gpu_spread: Some(spread),
            instructions: Some(instructions),
            bytes: Some(16_773_120),
            ..row(method, "studio; relative", error, 120.0)
        };
        let rows = vec![
            of("hermite", 0.0062, 189.9, 0.001, 371),
            of("geometric", 0.0488, 175.9, 0.002, 336),
            of("linear", 0.0514, 173.5, 0.008, 328),
            of("report", 0.0514, 169.5, 0.066, 329),
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
        let said = crate::words::of_library(&found[0], &film).expect("a remark");
        assert_eq!(said, "library: eon_exact errs 0 % instead of 0.50 %, one call takes 9.0 ns instead of 3.0 ns");
        // What is dearer and no better, and what is cheaper and worse, is no better choice.
        for other in [of("eon_exact", 0.0049, 9.0), of("eon_exact", 0.006, 1.0)] {
            let rows = [rows[0].clone(), rows[1].clone(), other];
            let found = comparisons(&rows);
            assert!(Budget::ALL.iter().all(|&budget| found[0].recommended(budget).of_library.is_none()));
        }
        // Of two that keep the limit, where no known one does, it is the cheaper one.
        let metals = [of("schlick", 0.03, 0.2), of("f82_tint", 0.007, 0.3), of("conductor", 0.0, 1.7)];
        let metals: Vec<Row> = metals.into_iter().map(|row| Row { term: "fresnel".into(), ..row }).collect();
        let found = comparisons(&metals);
        let desktop = found[0].recommended(Budget::Desktop).of_library;
        assert_eq!(desktop.map(|entry| entry.row.method.as_str()), Some("f82_tint"));
        let film = found[0].recommended(Budget::Film).of_library;
        assert_eq!(film.map(|entry| entry.row.method.as_str()), Some("conductor"));
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
            let rows = vec![of("strips", 0.05, 520, strips, spread), of("bent", 0.08, 470, bent, spread)];
            let found = comparisons(&rows);
            let choice = found[0].recommended(Budget::Mobile);
            (found[0].cost, choice.weighed, choice.entry.row.method.clone())
        };
        assert_eq!(found(Some(617.0), Some(216.0), 0.05), (Cost::Device, Cost::Device, "bent".to_owned()));
        // Times that are alike, or as wide as their difference, leave the choice to the instructions, and so does a machine without a device.
        assert_eq!(found(Some(216.0), Some(222.0), 0.05), (Cost::Device, Cost::Device, "bent".to_owned()));
        assert_eq!(found(Some(200.0), Some(300.0), 0.3).2, "bent");
        assert_eq!(found(None, None, 0.0), (Cost::Instructions, Cost::Instructions, "bent".to_owned()));
    }

    /// Figures of the committed quick run and of a full one: what noise of times there is changes no choice, and neither does twice as much.
    #[test]
    fn two_runs_of_one_machine_choose_alike() {
        type Method = (&'static str, f64, u64, [f64; 2], Option<u64>);
        const TERMS: [(&str, &str, &[Method]); 6] = [
            (
                "fresnel",
                "absolute",
                &[("schlick", 0.03, 371, [190.0, 190.0], None), ("exact", 5e-8, 462, [194.0, 195.0], None)],
            ),
            (
                "compensation",
                "relative",
                &[
                    ("kulla_conty", 0.031, 480, [199.0, 201.0], None),
                    ("turquin", 0.0315, 371, [190.0, 190.0], None),
                    ("fdez_aguera", 0.037, 378, [181.0, 187.0], None),
                    ("none", 0.23, 349, [186.0, 194.0], None),
                ],
            ),
            (
                "level_map",
                "relative",
                &[
                    ("hermite", 0.0062, 371, [189.9, 190.0], Some(17_000_000)),
                    ("geometric", 0.0488, 336, [175.9, 190.0], Some(17_000_000)),
                    ("linear", 0.0514, 328, [173.5, 179.0], Some(17_000_000)),
                    ("report", 0.0514, 329, [169.5, 153.0], Some(17_000_000)),
                ],
            ),
            (
                "irradiance",
                "relative",
                &[
                    ("cube", 5.7e-6, 371, [190.0, 190.0], Some(9_600_000)),
                    ("last_level", 0.0018, 418, [240.0, 249.0], Some(12_000)),
                    ("sh2", 0.053, 426, [205.0, 216.0], Some(144)),
                ],
            ),
            (
                "normal_frame",
                "degrees",
                &[
                    ("tbn_derivative", 1.02, 550, [208.0, 210.0], None),
                    ("tbn", 1.9, 466, [212.0, 215.0], None),
                    ("rotation_fixed", 80.0, 512, [207.0, 207.0], None),
                ],
            ),
            (
                "anisotropy",
                "relative",
                &[("strips", 0.26, 522, [605.0, 625.0], None), ("bent", 0.27, 472, [209.0, 210.0], None)],
            ),
        ];
        // Numbers in -1..1.
        let mut state = 7_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 23) - 1.0
        };
        for (term, unit, methods) in TERMS {
            let mut chosen: Vec<[String; 3]> = Vec::new();
            for number in 0..200 {
                let of = |&(method, error, instructions, times, bytes): &Method, noise: f64| Row {
                    term: term.into(),
                    instructions: Some(instructions),
                    // The runs as they were, and then 5 % of noise on either.
                    gpu_ns: Some(times[number % 2] * if number < 2 { 1.0 } else { 1.0 + 0.05 * noise }),
                    gpu_spread: Some(if number % 2 == 0 { 0.02 } else { 0.12 }),
                    bytes,
                    ..row(method, &format!("one; {unit}"), error, 100.0)
                };
                let rows: Vec<Row> = methods.iter().map(|method| of(method, noise())).collect();
                let found = comparisons(&rows);
                chosen.push(Budget::ALL.map(|budget| found[0].recommended(budget).entry.row.method.clone()));
            }
            assert!(chosen.iter().all(|other| *other == chosen[0]), "{term}: {chosen:?}");
        }
    }

    /// What is as accurate and as cheap as another is told apart by the list of methods.
    #[test]
    fn of_equals_the_list_says_which() {
        let of = |method: &str| Row { term: "level_map".into(), ..row(method, "studio; relative", 0.05, 100.0) };
        for rows in [[of("report"), of("linear")], [of("linear"), of("report")]] {
            assert_eq!(comparisons(&rows)[0].recommended(Budget::Mobile).entry.row.method, "linear");
        }
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
