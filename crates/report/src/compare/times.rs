//! What takes longer than before: times of the processor beside their yardstick, and times of the device.

use std::collections::HashSet;

use super::{Change, Hidden, Pair, SLOWER};
use crate::Row;
use crate::timing::median;

/// A kind of time, and how sure it is.
struct Timed {
    name: &'static str,
    cost: fn(&Row) -> Option<f64>,
    spread: fn(&Row) -> Option<f64>,
    /// Whether a device took it, which no yardstick runs beside.
    of_device: bool,
}

const TIMED: [Timed; 3] = [
    Timed { name: "one call", cost: |row| row.cost_ns, spread: |row| row.cost_spread, of_device: false },
    Timed {
        name: "an element of a batch",
        cost: |row| row.cost_batch_ns,
        spread: |row| row.cost_batch_spread,
        of_device: false,
    },
    Timed { name: "a pixel on the device", cost: |row| row.gpu_ns, spread: |row| row.gpu_spread, of_device: true },
];

/// A time may differ by this part and by the spreads of both runs.
const TIME_NOISE: f64 = 0.15;
/// A time that was measured too seldom to know its spread may differ by this part.
const UNSURE: f64 = 0.5;
/// A row whose yardstick took longer than the run's fastest by more than this part was measured in a slow moment, which meets one
/// method more than another: so much more noise is allowed, twice what is beyond.
const CALM: f64 = 0.08;
/// A time differs by more than this [ns], or not at all: what a batch of a quarter of a nanosecond an element takes depends on
/// where the compiler's loop happens to lie, too.
const TIME_FLOOR: f64 = 0.05;

/// How often as long a time is as before, beside the yardsticks of both runs; of runs before there was one, by itself. None of
/// times of different devices.
fn ratio(timed: &Timed, (old, new): Pair<'_>) -> Option<f64> {
    let pace = match (old.yardstick_ns, new.yardstick_ns) {
        (Some(before), Some(now)) if !timed.of_device => now / before,
        _ => 1.0,
    };
    let is_comparable = !timed.of_device || old.gpu == new.gpu;
    Some((timed.cost)(new)? / (timed.cost)(old)? / pace)
        .filter(|ratio| is_comparable && ratio.is_finite() && *ratio > 0.0)
}

/// What a yardstick takes when the machine does nothing else: the least of a run.
fn fastest<'r>(rows: impl Iterator<Item = &'r Row>) -> f64 {
    rows.filter_map(|row| row.yardstick_ns).fold(f64::INFINITY, f64::min)
}

/// Whether a time was measured in a slow moment of its run, so that more noise is allowed.
pub(super) fn is_strained(figure: &str, row: &Row, run: &[Row]) -> bool {
    let has_yardstick = TIMED.iter().any(|timed| timed.name == figure && !timed.of_device);
    has_yardstick && strain(row, fastest(run.iter())) > 0.0
}

/// How much longer a row's yardstick took than the fastest of its run, beyond what is usual.
fn strain(row: &Row, fastest: f64) -> f64 {
    row.yardstick_ns.map_or(0.0, |yardstick| (yardstick / fastest - 1.0 - CALM).max(0.0))
}

/// A time of both reports, and what is said of it.
struct Judged<'a> {
    pair: Pair<'a>,
    name: &'static str,
    before: f64,
    now: f64,
    /// How many times as long it takes, beside what else ran.
    ratio: f64,
    /// Up to how many times noise allows.
    allowed: f64,
}

fn judged<'a>(pairs: &[Pair<'a>]) -> Vec<Judged<'a>> {
    // How fast the processor is beside the old one, and the device.
    let machine = [false, true].map(|of_device| {
        let kinds = || TIMED.iter().filter(|timed| timed.of_device == of_device);
        let all: Vec<f64> =
            pairs.iter().flat_map(|&pair| kinds().filter_map(move |timed| ratio(timed, pair))).collect();
        if all.is_empty() { 1.0 } else { median(all) }
    });
    let fastest = [fastest(pairs.iter().map(|pair| pair.0)), fastest(pairs.iter().map(|pair| pair.1))];
    let of = |pair: Pair<'a>, timed: &Timed| {
        let (old, new) = pair;
        let (before, now) = ((timed.cost)(old)?, (timed.cost)(new)?);
        let ratio = ratio(timed, pair)? / machine[usize::from(timed.of_device)];
        let noise = match ((timed.spread)(old), (timed.spread)(new)) {
            (Some(first), Some(second)) => TIME_NOISE + first + second,
            _ => UNSURE,
        };
        let strain = if timed.of_device { 0.0 } else { strain(old, fastest[0]) + strain(new, fastest[1]) };
        Some(Judged { pair, name: timed.name, before, now, ratio, allowed: 1.0 + noise + 2.0 * strain })
    };
    pairs.iter().flat_map(|&pair| TIMED.iter().filter_map(|timed| of(pair, timed)).collect::<Vec<_>>()).collect()
}

/// The times of which a slowdown by half may be hidden by spreads or by what else the machine did: how many of how many, and how much the
/// most of them may have become slower.
pub(super) fn hidden(pairs: &[Pair<'_>]) -> Option<Hidden> {
    let mut known = HashSet::new();
    let mut judged = judged(pairs);
    // The same time stands in the rows of all domains of a method.
    judged.retain(|one| known.insert((&one.pair.0.term, &one.pair.0.method, one.name, one.before.to_bits())));
    let unsure = || judged.iter().map(|one| one.allowed).filter(|&allowed| allowed > 1.0 + UNSURE);
    let most = unsure().max_by(f64::total_cmp)?;
    Some(Hidden { count: unsure().count(), of: judged.len(), most })
}

pub(super) fn slower(pairs: &[Pair<'_>]) -> Vec<Change> {
    let mut changes = Vec::new();
    // The same time stands in the rows of all domains of a method.
    let mut told = HashSet::new();
    for Judged { pair: (old, _), name, before, now, ratio, allowed } in judged(pairs) {
        let seen = ratio > allowed && (ratio - 1.0) * before > TIME_FLOOR;
        if seen && told.insert((&old.term, &old.method, name, before.to_bits())) {
            let figures = format!(
                "{name} takes {now:.3} ns, was {before:.3} ns; {ratio:.2} times as long beside what else ran, noise allows {allowed:.2}"
            );
            changes.push(Change::of(SLOWER, old, name, figures));
        }
    }
    changes
}
