//! What of the difference from a picture is not chance, where that picture's own noise is known: squares of differences with
//! what noise adds taken off, how sure their mean is, and how large an error may be that could all be chance.

/// How many standard errors a mean is taken away from a measured one.
const CAUTION: f64 = 2.0;

/// How many of its standard errors a single channel's difference is less: of ten thousand channels less than one is
/// farther off by chance.
const CAUTION_OF_ONE: f64 = 4.0;

/// The square of a difference `d` without what noise of the standard error `s` is expected to add: E[d^2] = D^2 + s^2, with D the
/// error and the noise independent of it. It may be negative, so that sums of it are unbiased.
pub(super) fn without_noise(d: f64, s: f64) -> f64 {
    d * d - s * s
}

/// Squared differences from a picture, with what its noise adds taken off, summed over pixels.
///
/// d^2 - s^2 has the variance 4 D^2 s^2 + 2 s^4 where what errs is normal; the channels of a pixel are taken to err together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CleanSquares {
    square: f64,
    variance: f64,
    count: f64,
}

impl CleanSquares {
    /// Adds a pixel; `standard_error` is that of each channel of the truth, 0 where it is exact.
    pub fn add(&mut self, test: [f64; 3], truth: [f64; 3], standard_error: [f64; 3]) {
        let mut deviation = 0.0;
        for ((t, r), s) in test.into_iter().zip(truth).zip(standard_error) {
            let clean = without_noise(t - r, s);
            self.square += clean;
            deviation += (4.0 * clean.max(0.0) * s * s + 2.0 * s.powi(4)).sqrt();
            self.count += 1.0;
        }
        self.variance += deviation * deviation;
    }

    /// Root of the mean square over all channels; 0 of no pixel, and where noise is all there is.
    pub fn rms(&self) -> f64 {
        self.root(self.square)
    }

    /// The same two standard errors less, at least 0, and two more: where there is no noise, the same twice.
    pub fn rms_between(&self) -> [f64; 2] {
        let away = CAUTION * self.variance.sqrt();
        [self.root(self.square - away), self.root(self.square + away)]
    }

    /// Whether chance may explain all of the difference; never where there is no noise.
    pub fn may_be_chance(&self) -> bool {
        self.variance > 0.0 && self.square <= CAUTION * self.variance.sqrt()
    }

    /// What the rms error is at most where chance may explain all of it.
    fn bound(&self) -> f64 {
        self.root(self.square.max(0.0) + CAUTION * self.variance.sqrt())
    }

    fn root(&self, square: f64) -> f64 {
        (square / self.count.max(1.0)).max(0.0).sqrt()
    }
}

/// The error of a picture beside a noisy one, in the unit of its radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NoisyError {
    /// Root of the mean square over all channels, with what noise is expected to add taken off; none where chance may explain all
    /// of it.
    pub rms: Option<f64>,
    /// What the rms error is at most where it is not known.
    pub bound: Option<f64>,
    /// The largest difference of a channel that chance does not explain: the largest error is at least this, and at least
    /// the rms error. None where chance may explain every one.
    pub largest: Option<f64>,
    /// The pixel of it.
    pub at: Option<usize>,
}

/// The error of `test` against `truth`; `standard_error` is that of each channel of the truth, none where it is exact. Pixels beyond
/// the shortest of the three are not looked at.
pub fn noisy_error(test: &[[f64; 3]], truth: &[[f64; 3]], standard_error: Option<&[[f64; 3]]>) -> NoisyError {
    let mut squares = CleanSquares::default();
    let (mut largest, mut at) = (0.0_f64, None);
    for (pixel, (&t, &r)) in test.iter().zip(truth).enumerate() {
        let errors = standard_error.map_or(Some([0.0; 3]), |errors| errors.get(pixel).copied());
        let Some(errors) = errors else { break };
        squares.add(t, r, errors);
        for channel in 0..3 {
            let sure = (t[channel] - r[channel]).abs() - CAUTION_OF_ONE * errors[channel];
            if sure > largest {
                (largest, at) = (sure, Some(pixel));
            }
        }
    }
    if squares == CleanSquares::default() {
        return NoisyError::default();
    }
    if squares.may_be_chance() {
        return NoisyError { rms: None, bound: Some(squares.bound()), largest: at.map(|_| largest), at };
    }
    let rms = squares.rms();
    NoisyError { rms: Some(rms), bound: None, largest: Some(largest.max(rms)), at }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_noise_errors_are_plain() {
        let (a, b) = ([[1.0; 3], [2.0, 0.0, 4.0]], [[1.0; 3], [1.0, 0.0, 2.0]]);
        let found = noisy_error(&a, &b, None);
        assert_eq!((found.largest, found.at, found.bound), (Some(2.0), Some(1), None));
        assert!(found.rms.is_some_and(|rms| (rms - (5.0_f64 / 6.0).sqrt()).abs() < 1e-15));
        let same = noisy_error(&a, &a, None);
        assert_eq!((same.rms, same.largest, same.at), (Some(0.0), Some(0.0), None));
        assert_eq!(noisy_error(&[], &[], None), NoisyError::default());
    }

    /// Noise of 0.4 on a truth of 1: a bias of a half of it is found, none is not, and is not said to be 0 either.
    #[test]
    fn what_chance_may_explain_is_bounded_and_not_nothing() {
        const COUNT: usize = 4096;
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let noise = vec![[0.4; 3]; COUNT];
        let truth: Vec<[f64; 3]> = (0..COUNT).map(|_| [1.0 + 0.4 * normal(); 3]).collect();
        let none = noisy_error(&vec![[1.0; 3]; COUNT], &truth, Some(&noise));
        assert_eq!((none.rms, none.largest), (None, None), "{none:?}");
        assert!(none.bound.is_some_and(|bound| bound > 0.01 && bound < 0.15), "{none:?}");
        let mut test = vec![[1.2; 3]; COUNT];
        let biased = noisy_error(&test, &truth, Some(&noise));
        assert!(biased.rms.is_some_and(|rms| (rms - 0.2).abs() < 0.03) && biased.bound.is_none(), "{biased:?}");
        // One pixel that is far off is found at its place, less what chance may have added.
        test[77] = [9.0; 3];
        let off = noisy_error(&test, &truth, Some(&noise));
        assert_eq!(off.at, Some(77));
        assert!(off.largest.is_some_and(|largest| largest > 4.5 && largest < 8.0), "{off:?}");
    }
}
