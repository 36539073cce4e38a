//! What of the difference from a picture is not chance, where that picture's own noise is known: squares of differences with
//! what noise adds taken off, how sure their mean is, and how large an error may be that could all be chance.

use super::difference::RELATIVE_FLOOR;

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

/// How many of its standard errors the mean difference of a channel is off at least where it is no chance.
const CAUTION_OF_MEAN: f64 = 3.0;

/// What of an error noise does not explain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beyond {
    /// The error with what noise is expected to add taken off; 0 where chance may explain all of it.
    pub error: f64,
    /// Two standard errors more: it is hardly larger.
    pub at_most: f64,
    /// The error as it is, with the noise.
    pub with_noise: f64,
}

/// What of RMSE and of the relative error (as in [`super::Difference`]) of two pictures the noise of known standard errors does not
/// explain. `brightness` is what the relative error is relative to. Of a reference that is noisy itself that is not its own pixel:
/// one that happens to be dark would count more, and its difference, which is noise, with it; [`surroundings`] do.
///
/// How sure the means are is found of the model of [`CleanSquares`] and of how the pixels scatter, whichever says less: few samples
/// of rare and bright light scatter more than a Gauss curve. What is beyond four standard errors of its pixel is no such scatter.
///
/// Where the mean difference of a channel is beyond three of its standard errors, the error is at least that mean, less what noise is
/// expected to add to it: a mean shows a bias of all pixels that squares of single pixels hide under their noise.
pub fn beyond_noise(
    test: &[[f64; 3]],
    reference: &[[f64; 3]],
    standard_error: &[[f64; 3]],
    brightness: &[[f64; 3]],
) -> [Beyond; 2] {
    let (mut plain, mut relative) = (Scatter::default(), Scatter::default());
    for (((t, r), s), b) in test.iter().zip(reference).zip(standard_error).zip(brightness) {
        let difference: [f64; 3] = std::array::from_fn(|c| t[c] - r[c]);
        plain.add(difference, *s);
        let scale = b.map(|b| 1.0 / (b * b + RELATIVE_FLOOR).sqrt());
        let scaled = |x: [f64; 3]| std::array::from_fn(|c| x[c] * scale[c]);
        relative.add(scaled(difference), scaled(*s));
    }
    [plain, relative].map(|scatter| scatter.beyond())
}

/// Squared differences without noise, and the variance of their sum.
#[derive(Default)]
struct Scatter {
    squares: CleanSquares,
    variance: f64,
    /// With noise.
    plain: f64,
    /// Sums of each channel's differences, and of the squares of their standard errors.
    sum: [f64; 3],
    sum_variance: [f64; 3],
}

impl Scatter {
    fn add(&mut self, difference: [f64; 3], standard_error: [f64; 3]) {
        let mut pixel = CleanSquares::default();
        pixel.add(difference, [0.0; 3], standard_error);
        let noise: f64 = standard_error.iter().map(|s| s * s).sum();
        let scatter = pixel.square.abs().min(CAUTION_OF_ONE * CAUTION_OF_ONE * noise);
        self.variance += pixel.variance.max(scatter * scatter);
        self.plain += difference.iter().map(|d| d * d).sum::<f64>();
        self.squares.square += pixel.square;
        self.squares.count += pixel.count;
        for c in 0..3 {
            self.sum[c] += difference[c];
            self.sum_variance[c] += standard_error[c] * standard_error[c];
        }
    }

    /// The mean square of the channels' mean differences that are no chance, and two standard errors more.
    fn of_mean(&self) -> [f64; 2] {
        let pixels = (self.squares.count / 3.0).max(1.0);
        let mut mean = [0.0; 2];
        for (sum, variance) in self.sum.into_iter().zip(self.sum_variance) {
            let (difference, error) = (sum.abs() / pixels, variance.sqrt() / pixels);
            if difference > CAUTION_OF_MEAN * error {
                mean[0] += without_noise(difference, error) / 3.0;
                mean[1] += (difference + CAUTION * error).powi(2) / 3.0;
            }
        }
        mean
    }

    fn beyond(&self) -> Beyond {
        let squares = CleanSquares { variance: self.variance, ..self.squares };
        let error = if squares.may_be_chance() { 0.0 } else { squares.rms() };
        let [mean, mean_at_most] = self.of_mean().map(f64::sqrt);
        let at_most = squares.bound().max(mean_at_most);
        Beyond { error: error.max(mean), at_most, with_noise: squares.root(self.plain) }
    }
}

/// The mean of the pixels around each pixel of a picture, two to each side, without itself: how bright it is there, as its own noise does
/// not tell. `width` is the pixels in a row; a pixel alone is its own surroundings.
pub fn surroundings(picture: &[[f64; 3]], width: usize) -> Vec<[f64; 3]> {
    const REACH: usize = 2;
    let width = width.clamp(1, picture.len().max(1));
    let near = |at: usize, end: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(end);
    let mean = |i: usize| {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for y in near(i / width, picture.len().div_ceil(width)) {
            for pixel in
                near(i % width, width).filter_map(|x| picture.get(y * width + x).filter(|_| y * width + x != i))
            {
                sum = std::array::from_fn(|c| sum[c] + pixel[c]);
                count += 1.0;
            }
        }
        if count > 0.0 { sum.map(|x: f64| x / count) } else { picture[i] }
    };
    (0..picture.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures of few paths that find a small light now and then: noise is no error, in dark places neither, and a tenth of
    /// brightness is one.
    #[test]
    fn rare_light_is_noise_in_all_figures() {
        const SIDE: usize = 64;
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut drawn = |samples: usize, factor: f64| {
            let pixel = |_| {
                let seen: Vec<f64> =
                    (0..samples).map(|_| factor * if uniform() < 0.1 { 2.0 } else { 0.02 * uniform() }).collect();
                let mean = seen.iter().sum::<f64>() / samples as f64;
                let square = seen.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (samples - 1) as f64;
                ([mean; 3], [(square / samples as f64).sqrt(); 3])
            };
            (0..SIDE * SIDE).map(pixel).unzip::<[f64; 3], [f64; 3], Vec<_>, Vec<_>>()
        };
        for samples in [2, 4, 16] {
            let (reference, of_reference) = drawn(samples, 1.0);
            for factor in [1.0, 2.0] {
                let (test, of_test) = drawn(samples, factor);
                let both: Vec<[f64; 3]> =
                    of_test.iter().zip(&of_reference).map(|(a, b)| std::array::from_fn(|c| a[c].hypot(b[c]))).collect();
                let beyond = beyond_noise(&test, &reference, &both, &surroundings(&reference, SIDE));
                let plain = super::super::difference(&test, &reference, None);
                println!("{samples} samples, factor {factor}: {beyond:?} of {plain:?}");
                let truth = 0.209 * (factor - 1.0);
                assert!(beyond[0].at_most >= truth && beyond[0].at_most < plain.rmse, "{samples}: {beyond:?}");
                if factor == 1.0 {
                    assert_eq!(beyond.map(|beyond| beyond.error), [0.0; 2], "{samples}: {beyond:?} of {plain:?}");
                    assert!((beyond[0].with_noise / plain.rmse - 1.0).abs() < 1e-12);
                } else if samples == 16 {
                    assert!((beyond[0].error / truth - 1.0).abs() < 0.3 && beyond[1].error > 0.5, "{beyond:?}");
                }
            }
        }
        assert_eq!(surroundings(&[[1.0; 3]], 1), [[1.0; 3]]);
        assert_eq!(surroundings(&[], 0), [[0.0; 3]; 0]);
        assert_eq!(surroundings(&[[1.0; 3], [3.0; 3], [5.0; 3]], 3)[0], [4.0; 3]);
    }

    /// A picture that is a fiftieth too bright everywhere, under noise of a fifth: no pixel shows it, and no sum of their squares, but
    /// the mean does. Without the fiftieth all is noise.
    #[test]
    fn a_bias_that_single_pixels_hide_is_an_error() {
        const COUNT: usize = 96 * 96;
        let drawn = |seed: u64, factor: f64| -> Vec<[f64; 3]> {
            let normal = |pixel: usize| {
                let mut random = crate::random::Random::new(seed, pixel as u64, 0);
                (0..12).map(|_| random.number()).sum::<f64>() - 6.0
            };
            (0..COUNT).map(|pixel| [1.0, 0.5, 0.0].map(|x| factor * x * (1.0 + 0.2 * normal(pixel)))).collect()
        };
        let noise = vec![[1.0, 0.5, 0.0].map(|x| x * 0.2 * 2.0_f64.sqrt()); COUNT];
        let reference = drawn(1, 1.0);
        let beyond = |test: &[[f64; 3]]| beyond_noise(test, &reference, &noise, &surroundings(&reference, 96));
        assert_eq!(beyond(&drawn(2, 1.0)).map(|beyond| beyond.error), [0.0; 2]);
        let [plain, relative] = beyond(&drawn(2, 1.02));
        let truth = 0.02 * (1.25_f64 / 3.0).sqrt();
        assert!((plain.error / truth - 1.0).abs() < 0.5, "{plain:?} {truth}");
        assert!((relative.error / (0.02 * (2.0_f64 / 3.0).sqrt()) - 1.0).abs() < 0.5, "{relative:?}");
        for figure in [plain, relative] {
            assert!(figure.at_most > figure.error && figure.with_noise > figure.at_most, "{figure:?}");
        }
    }

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
