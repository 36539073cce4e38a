//! Random numbers that depend on nothing but a seed, a pixel and a sample: the same at any number of threads.

/// The numbers of one sample of one pixel, in order: SplitMix64 of Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom
/// Number Generators", started at a hash of seed, pixel and sample.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Random {
    state: u64,
}

/// SplitMix64's step: 2^64 over the golden ratio, odd.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// SplitMix64's finaliser, Stafford's variant 13.
#[inline(always)]
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

impl Random {
    #[inline(always)]
    pub(crate) fn new(seed: u64, pixel: u64, sample: u64) -> Random {
        // Hashed one after the other: counters that differ by one bit start far apart.
        let key = mixed(mixed(mixed(seed ^ STEP).wrapping_add(pixel)).wrapping_add(sample ^ STEP));
        Random { state: key }
    }

    /// Even in [0, 1).
    #[inline(always)]
    pub(crate) fn number(&mut self) -> f64 {
        self.state = self.state.wrapping_add(STEP);
        (mixed(self.state) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Even over the unit square.
    #[inline(always)]
    pub(crate) fn pair(&mut self) -> [f64; 2] {
        [self.number(), self.number()]
    }
}

#[cfg(test)]
mod tests {
    use super::Random;

    #[test]
    fn even_and_not_correlated_between_pixels_and_samples() {
        let n = 20_000_u64;
        for (pixel_step, sample_step) in [(0, 1), (1, 0), (1, 1), (640, 0)] {
            let numbers: Vec<f64> = (0..n).map(|i| Random::new(7, i * pixel_step, i * sample_step).number()).collect();
            let mean = numbers.iter().sum::<f64>() / n as f64;
            let variance = numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n as f64;
            let lag = numbers.windows(2).map(|w| (w[0] - mean) * (w[1] - mean)).sum::<f64>() / n as f64 / variance;
            assert!((mean - 0.5).abs() < 0.01 && (variance * 12.0 - 1.0).abs() < 0.03 && lag.abs() < 0.03);
        }
    }

    #[test]
    fn the_same_for_the_same() {
        let draw = |seed| Random::new(seed, 5, 9).pair();
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
    }
}
