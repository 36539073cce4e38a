//! Times that can be compared: every candidate runs once per round, so that a slow moment of the machine meets all alike.
//! The rounds lie in several sittings, apart in time and each with its own memory ([`crate::placed`]).
//!
//! Beside the candidates runs a yardstick, a loop that knows nothing of them: how fast the machine was while they ran.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// A candidate: what is run, given the number of the sitting. It returns something of its result, so that the work is not
/// optimised away.
pub type Candidate<'a> = &'a mut dyn FnMut(usize) -> f64;

/// How often a candidate is measured, some time apart; in each sitting what it reads may lie elsewhere.
pub const SITTINGS: usize = 5;

/// Long beside the clock's step and what the first run has to fetch.
const ROUND: Duration = Duration::from_micros(50);

/// What takes longer than this is as slow the first time as the second: a single round needs no run before it.
const LONG: Duration = Duration::from_millis(20);

/// From one sitting to the next.
const PAUSE: Duration = Duration::from_millis(25);

/// How long a candidate takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The median of the rounds of the fastest sitting [s]: what else the machine does only adds.
    pub seconds: f64,
    /// How much longer the median sitting took, in parts; of two sittings the slower one; none of a single one.
    pub spread: Option<f64>,
    /// A step of the yardstick in the fastest of its sittings [s].
    pub pace: f64,
}

/// Times each candidate over `rounds` interleaved rounds in all; in a round it runs as often as fills [`ROUND`]. Rounds that
/// warm up are not counted: one of each sitting, or the very first where a sitting is one round, unless that took long: then it is
/// the first sitting's.
pub fn measured(candidates: &mut [Candidate<'_>], rounds: usize) -> Vec<Time> {
    measured_and_told(candidates, rounds, |_| ())
}

/// The same; after each round of a candidate, and outside of its time, its number is told.
pub fn measured_and_told(candidates: &mut [Candidate<'_>], rounds: usize, mut told: impl FnMut(usize)) -> Vec<Time> {
    let count = candidates.len();
    let sittings = rounds.clamp(1, SITTINGS);
    let each = rounds.div_ceil(sittings);
    let mut yardstick = yardstick;
    let mut all: Vec<Candidate<'_>> = candidates.iter_mut().map(|candidate| &mut **candidate as _).collect();
    all.push(&mut yardstick);
    let mut runs = vec![1; all.len()];
    let mut medians = vec![Vec::with_capacity(sittings); all.len()];
    let mut only: Vec<Option<f64>> = vec![None; all.len()];
    for sitting in 0..sittings {
        if sitting == 0 {
            for (number, ((candidate, runs), only)) in all.iter_mut().zip(&mut runs).zip(&mut only).enumerate() {
                let often = |seconds: f64| (ROUND.as_secs_f64() / seconds.max(1e-9)).clamp(1.0, 1000.0) as u32;
                // The first run fetches what the others need, and says little of them.
                let first = seconds_of(*candidate, sitting, 1);
                *only = (each == 1 && first > LONG.as_secs_f64()).then_some(first);
                if number < count {
                    told(number);
                }
                *runs = often(first);
                if *runs > 1 {
                    *runs = often(seconds_of(*candidate, sitting, *runs));
                }
            }
        }
        let warm_up = usize::from(each > 1);
        let mut seconds = vec![Vec::with_capacity(each); all.len()];
        for round in 0..warm_up + each {
            let places = all.iter_mut().zip(&runs).zip(&mut seconds).zip(&mut only).enumerate();
            for (number, (((candidate, &runs), seconds), only)) in places {
                let time = only.take().unwrap_or_else(|| {
                    let time = seconds_of(*candidate, sitting, runs);
                    if number < count {
                        told(number);
                    }
                    time
                });
                if round >= warm_up {
                    seconds.push(time);
                }
            }
        }
        for (medians, seconds) in medians.iter_mut().zip(seconds) {
            medians.push(median(seconds));
        }
        if sitting + 1 < sittings {
            std::thread::sleep(PAUSE);
        }
    }
    let pace = medians.pop().map_or(0.0, |medians| time(medians).seconds / f64::from(STEPS));
    medians.into_iter().map(|medians| Time { pace, ..time(medians) }).collect()
}

/// The mean time of some runs of a candidate [s], with a stack that begins elsewhere within its cache line in each sitting: a function
/// that keeps vectors there may take three times as long for where they lie.
fn seconds_of(candidate: Candidate<'_>, sitting: usize, runs: u32) -> f64 {
    match sitting % 4 {
        0 => padded::<16>(candidate, sitting, runs),
        1 => padded::<32>(candidate, sitting, runs),
        2 => padded::<48>(candidate, sitting, runs),
        _ => padded::<64>(candidate, sitting, runs),
    }
}

#[inline(never)]
fn padded<const BYTES: usize>(candidate: Candidate<'_>, sitting: usize, runs: u32) -> f64 {
    let pad = black_box([0_u8; BYTES]);
    let start = Instant::now();
    for _ in 0..runs {
        black_box(candidate(sitting));
    }
    let seconds = start.elapsed().as_secs_f64() / f64::from(runs);
    black_box(&pad);
    seconds
}

const STEPS: u32 = 1000;

/// Chains of multiplications and additions, as many as keep the processor's units busy: what shares them (another thread of the
/// core) slows it as it slows what is measured.
fn yardstick(_: usize) -> f64 {
    let mut x: [f64; 16] = std::array::from_fn(|i| 0.1 + 0.05 * i as f64);
    for _ in 0..STEPS {
        x = x.map(|x| 3.7 * x * (1.0 - x));
    }
    black_box(x).iter().sum()
}

fn time(mut sittings: Vec<f64>) -> Time {
    sittings.sort_by(f64::total_cmp);
    let seconds = sittings[0];
    let spread = (sittings.len() > 1 && seconds > 0.0).then(|| sittings[sittings.len() / 2] / seconds - 1.0);
    Time { seconds, spread, pace: 0.0 }
}

/// The middle number, or the mean of the two middle ones; 0 for none.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    match numbers.len() {
        0 => 0.0,
        n if n % 2 == 1 => numbers[n / 2],
        n => 0.5 * (numbers[n / 2 - 1] + numbers[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longer_of_two_works_takes_longer() {
        let work = |n: u32| move |_| (0..n).map(|i| f64::from(std::hint::black_box(i)).sqrt()).sum();
        let (mut short, mut long) = (work(1_000), work(200_000));
        let times = measured(&mut [&mut short, &mut long], 5);
        assert!(times[0].seconds < times[1].seconds && times[0].pace > 0.0, "{times:?}");
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn what_takes_long_runs_once_when_one_round_is_asked_for() {
        let mut runs = 0;
        let mut long = |_| {
            runs += 1;
            std::thread::sleep(2 * LONG);
            0.0
        };
        let times = measured(&mut [&mut long], 1);
        assert!(times[0].seconds > LONG.as_secs_f64() && times[0].spread.is_none());
        assert_eq!(runs, 1);
    }

    /// Two rounds are enough for a spread; the first run of what takes long is one of them, and each is told.
    #[test]
    fn what_takes_long_has_a_spread_after_two_runs() {
        let mut long = |_| {
            std::thread::sleep(2 * LONG);
            0.0
        };
        let mut short = |_| 1.0;
        let mut told = Vec::new();
        let times = measured_and_told(&mut [&mut long, &mut short], 2, |number| told.push(number));
        assert!(times[0].spread.is_some() && times[1].spread.is_some());
        assert_eq!(told.iter().filter(|number| **number == 0).count(), 2, "{told:?}");
        assert_eq!(told[0], 0);
    }

    #[test]
    fn the_fastest_sitting_counts_and_the_median_says_how_sure_it_is() {
        let five = time(vec![2.0, 1.0, 9.0, 1.25, 1.5]);
        assert_eq!((five.seconds, five.spread), (1.0, Some(0.5)));
        assert_eq!(time(vec![2.0, 1.0]).spread, Some(1.0));
        assert_eq!(time(vec![1.0]).spread, None);
    }
}
