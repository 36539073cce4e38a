//! Times that can be compared: every candidate runs once per round, so that a slow moment of the machine meets all alike,
//! and each gets the median of its rounds.

use std::time::Instant;

/// A candidate: what is run. It returns something of its result, so that the work is not optimised away.
pub type Candidate<'a> = &'a mut dyn FnMut() -> f64;

/// How long a candidate takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The median of the rounds [s].
    pub seconds: f64,
    /// Half the distance of the quartiles, over the median; none of fewer than four rounds.
    pub spread: Option<f64>,
}

/// Times one run of each candidate over `rounds` interleaved rounds, after one round that warms up.
pub fn measured(candidates: &mut [Candidate<'_>], rounds: usize) -> Vec<Time> {
    let mut seconds = vec![Vec::with_capacity(rounds); candidates.len()];
    for round in 0..=rounds {
        for (candidate, seconds) in candidates.iter_mut().zip(&mut seconds) {
            let start = Instant::now();
            std::hint::black_box(candidate());
            if round > 0 {
                seconds.push(start.elapsed().as_secs_f64());
            }
        }
    }
    seconds.into_iter().map(time).collect()
}

/// The medians of [`measured`] [s].
pub fn interleaved(candidates: &mut [Candidate<'_>], rounds: usize) -> Vec<f64> {
    measured(candidates, rounds).iter().map(|time| time.seconds).collect()
}

fn time(mut seconds: Vec<f64>) -> Time {
    seconds.sort_by(f64::total_cmp);
    let quarter = seconds.len() / 4;
    let middle = median(seconds.clone());
    let spread =
        (quarter > 0 && middle > 0.0).then(|| 0.5 * (seconds[seconds.len() - 1 - quarter] - seconds[quarter]) / middle);
    Time { seconds: middle, spread }
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
        let work = |n: u32| move || (0..n).map(|i| f64::from(std::hint::black_box(i)).sqrt()).sum();
        let (mut short, mut long) = (work(1_000), work(200_000));
        let seconds = interleaved(&mut [&mut short, &mut long], 5);
        assert!(seconds[0] < seconds[1], "{seconds:?}");
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn the_spread_is_that_of_the_inner_half() {
        let eight = time(vec![1.0, 100.0, 9.0, 10.0, 10.0, 11.0, 12.0, 8.0]);
        assert_eq!((eight.seconds, eight.spread), (10.0, Some(0.1)));
        assert_eq!(time(vec![1.0, 2.0, 3.0]).spread, None);
    }
}
