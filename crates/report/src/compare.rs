//! Two reports: what became slower, larger or less accurate, beyond noise, and what is not there any more.
//!
//! [`times`], [`counts`] and [`errors`] hold one kind of figure each; here stands what is a row of both.

mod counts;
mod errors;
mod times;

use std::collections::HashSet;
use std::fmt;

use crate::missing::{DEVICE, LeftOut};
use crate::{Report, Row};

/// A row as it was, and as it is.
type Pair<'a> = (&'a Row, &'a Row);

/// A figure of a row, and its name for people.
type Figure = (&'static str, fn(&Row) -> Option<f64>);

/// Something that became worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What: `slower`, `longer`, `larger`, `less accurate`, `less sure`, `less alike`, `more results that are no numbers`, `gone`.
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
    /// Whether another run of the same found it, too; see [`confirm`].
    pub confirmed: bool,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} {}: {} ({})", self.what, self.term, self.method, self.figures, self.domain)
    }
}

impl Change {
    fn of(what: &'static str, row: &Row, figure: &'static str, figures: String) -> Change {
        let [term, method, domain] = [&row.term, &row.method, &row.domain].map(String::clone);
        Change { what, term, method, domain, figure, figures, confirmed: false }
    }

    /// Whether another run of the same may say something else of it.
    pub fn is_doubtful(&self) -> bool {
        self.what == SLOWER
    }

    fn is_of(&self, row: &Row) -> bool {
        [&self.term, &self.method, &self.domain] == [&row.term, &row.method, &row.domain]
    }
}

/// What is worse in `new` than in `old`, among the rows of the parts that both hold.
///
/// Times are compared as ratios. What the machine did while a method was measured is divided out by the yardstick that ran beside
/// it; then the machine's own speed, which is the median of all ratios, and that of the device: so two machines can be compared, and
/// what all methods lose together is not seen. Errors are compared only when both reports drew the same points, which they do when
/// their efforts are the same. What was recorded once is compared with nothing.
pub fn changes(old: &Report, new: &Report) -> Vec<Change> {
    let of = |known: &Row| new.rows.iter().find(|row| is_same(row, known));
    let all = pairs(old, new);
    let pairs = measured(&all);
    let mut changes = times::slower(&pairs);
    changes.extend(counts::grown(&pairs));
    if old.effort == new.effort {
        changes.extend(errors::grown(&pairs));
    }

    let is_measured = |part: &str| new.parts.iter().any(|name| name == part);
    let is_whole = old.parts.iter().all(|part| is_measured(part));
    let is_left_out = |row: &Row| new.left_out.iter().any(|left| left.what.is_none() && left.part == row.part);
    let was_measured =
        |row: &Row| if row.part.is_empty() { is_whole } else { is_measured(&row.part) && !is_left_out(row) };
    let lost = lost_device(old, new);
    let by_device = |row: &Row| lost.is_some() && row.gpu.is_some();
    let gone = old.rows.iter().filter(|row| was_measured(row) && of(row).is_none() && !by_device(row));
    changes.extend(
        gone.map(|row| Change::of("gone", row, "row", format!("it has no row any more{}", left_out(row, new)))),
    );
    let parts = new.left_out.iter().filter(|left| left.what.is_none());
    changes.extend(parts.filter(|left| old.rows.iter().any(|row| row.part == left.part)).map(lost_part));
    let only_recorded = all.iter().filter(|(old, new)| !is_recorded(old) && is_recorded(new));
    changes.extend(
        only_recorded
            .map(|(old, new)| Change::of("gone", old, "row", format!("it is not measured any more{}", why(new)))),
    );
    changes.extend(vanished(&pairs, is_measured("shaders"), lost.is_some()));
    changes.extend(lost);
    changes
}

fn is_same(a: &Row, b: &Row) -> bool {
    [&a.term, &a.method, &a.domain] == [&b.term, &b.method, &b.domain]
}

fn is_recorded(row: &Row) -> bool {
    row.recorded.is_some()
}

/// The rows that both have.
fn pairs<'r>(old: &'r Report, new: &'r Report) -> Vec<Pair<'r>> {
    let of = |known: &Row| new.rows.iter().find(|row| is_same(row, known));
    old.rows.iter().filter_map(|row| Some((row, of(row)?))).collect()
}

/// Those of them that were measured for both.
fn measured<'r>(all: &[Pair<'r>]) -> Vec<Pair<'r>> {
    all.iter().copied().filter(|(old, new)| !is_recorded(old) && !is_recorded(new)).collect()
}

/// Times of which little can be said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hidden {
    /// How many of them.
    pub count: usize,
    /// How many times both reports have.
    pub of: usize,
    /// How many times as long one of them may take without being told.
    pub most: f64,
}

impl fmt::Display for Hidden {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Hidden { count, of, most } = self;
        write!(
            f,
            "could not be judged: {count} of {of} times; their spreads, or a yardstick that something else slowed, hide up to {most:.1} \
             times as long"
        )
    }
}

/// What the noise of the two reports hides of the times; none where a slowdown by half is seen in all.
pub fn hidden(old: &Report, new: &Report) -> Option<Hidden> {
    times::hidden(&measured(&pairs(old, new)))
}

/// A part that was measured and is left out now, once for all its rows.
fn lost_part(left: &LeftOut) -> Change {
    let figures = format!("nothing of it is measured any more: {}", left.why);
    Change::of("gone", &Row::new("part", &left.part, "every row of the part"), "part", figures)
}

/// Why a picture's example has no rows, or a drawer none of it, where the report says it.
fn left_out(row: &Row, new: &Report) -> String {
    let example = row.domain.split(':').next();
    let is_of = |left: &&LeftOut| {
        let what = left.what.as_deref();
        let is_method = what.and_then(|what| what.rsplit_once(", ")) == example.map(|name| (name, row.method.as_str()));
        left.part == row.part && what.is_some() && (what == example || is_method)
    };
    new.left_out.iter().find(is_of).map_or_else(String::new, |left| format!(": {}", left.why))
}

/// Where the new report found no device and the old one has times of one, of the same parts: that, once for all its rows.
fn lost_device(old: &Report, new: &Report) -> Option<Change> {
    let is_known = |part: &str| old.parts.iter().any(|name| name == part);
    let is_lost = new.left_out.iter().any(|left| left.what.as_deref() == Some(DEVICE) && is_known(&left.part));
    let name = old.rows.iter().find_map(|row| row.gpu.clone()).filter(|_| is_lost)?;
    let figures = "nothing is measured on a device any more: none was found".to_owned();
    Some(Change::of("gone", &Row::new("device", &name, "every row of a device"), "device", figures))
}

/// Devices of two reports, where both have one and they are not the same: their times are not compared.
pub fn other_device<'r>(old: &'r Report, new: &'r Report) -> Option<[&'r str; 2]> {
    let device = |report: &'r Report| report.rows.iter().find_map(|row| row.gpu.as_deref());
    let devices = [device(old)?, device(new)?];
    (devices[0] != devices[1]).then_some(devices)
}

/// Figures that rows had and have no more. What a method's shader costs stands in all rows of the method and is measured by one part:
/// where that was not measured it is not missed, and it is told once.
fn vanished(pairs: &[Pair<'_>], shaders: bool, without_device: bool) -> Vec<Change> {
    const FIGURES: [Figure; 6] = [
        ("time of one call", |row| row.cost_ns),
        ("time of an element of a batch", |row| row.cost_batch_ns),
        ("instructions", |row| row.instructions.map(|count| count as f64)),
        ("time of a pixel on the device", |row| row.gpu_ns),
        ("memory", |row| row.bytes.map(|bytes| bytes as f64)),
        ("FLIP", |row| row.flip),
    ];
    let mut told = HashSet::new();
    let mut changes = Vec::new();
    for &(old, new) in pairs {
        for (name, figure) in FIGURES {
            let is_shared = ["instructions", "time of a pixel on the device"].contains(&name);
            let is_own = ["pictures", "peers"].contains(&new.part.as_str());
            let is_expected =
                (!is_shared || shaders || is_own) && !(without_device && name == "time of a pixel on the device");
            if figure(old).is_some() && figure(new).is_none() && is_expected {
                let place = if is_shared && !is_own { "" } else { old.domain.as_str() };
                if told.insert((&old.term, &old.method, place, name)) {
                    changes.push(Change::of(
                        "gone",
                        old,
                        name,
                        format!("its {name} is not there any more{}", why(new)),
                    ));
                }
            }
        }
    }
    changes
}

/// A row's note as a reason.
fn why(row: &Row) -> String {
    row.note.as_ref().map_or_else(String::new, |note| format!(": {note}"))
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
    let is_doubted = |row: &&Row| changes.iter().any(|change| change.is_doubtful() && change.is_of(row));
    new.rows.iter().filter(is_doubted).map(|row| row.part.as_str()).collect()
}

/// Takes out what was slower once and is not in `again`, the changes of `run`, another run of the same. What that run measured in a slow
/// moment, in which it would see less, it does not speak against.
pub fn confirm(changes: &mut Vec<Change>, again: &[Change], run: &Report) {
    let key = |change: &Change| (change.term.clone(), change.method.clone(), change.domain.clone(), change.figure);
    let is_same = |a: &Change, b: &Change| b.what == SLOWER && key(a) == key(b);
    let abstains = |change: &Change| {
        let mut own = run.rows.iter().filter(|row| change.is_of(row));
        own.any(|row| times::is_strained(change.figure, row, &run.rows))
    };
    for change in changes.iter_mut().filter(|change| change.is_doubtful()) {
        let is_found = again.iter().any(|other| is_same(change, other));
        change.confirmed |= is_found;
    }
    changes
        .retain(|change| !change.is_doubtful() || again.iter().any(|other| is_same(change, other)) || abstains(change));
}

/// Takes out what was slower once and no other run confirmed.
pub fn settle(changes: &mut Vec<Change>) {
    changes.retain(|change| !change.is_doubtful() || change.confirmed);
}

#[cfg(test)]
mod tests;
