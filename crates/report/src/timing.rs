//! Times that can be compared: every candidate runs once per round, so that a slow moment of the machine meets all alike,
//! and each gets the median of its rounds.

use std::time::Instant;

/// A candidate: what is run. It returns something of its result, so that the work is not optimised away.
pub type Candidate<'a> = &'a mut dyn FnMut() -> f64;

/// Median seconds of one run of each candidate over `rounds` interleaved rounds, after one round that warms up.
pub fn interleaved(candidates: &mut [Candidate<'_>], rounds: usize) -> Vec<f64> {
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
    seconds.into_iter().map(median).collect()
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
}
