//! Plain differences of numbers, pixel by pixel and channel by channel, and what of them noise explains.

use super::noise::without_noise;

/// How far a picture is from another one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Root of the mean squared difference of all channels.
    pub rmse: f64,
    /// Root of the mean of (test - reference)^2 / (reference^2 + 0.01): relative where the reference is bright. Rousselle,
    /// Knaus, Zwicker 2011, "Adaptive Sampling and Reconstruction using Greedy Error Minimization".
    pub relative: f64,
    /// Sum of differences over the sum of the reference: how much brighter the whole is.
    pub mean_relative: f64,
    /// Largest difference of a channel.
    pub largest: f64,
}

/// The smallest square that a squared difference is divided by, beside the reference's own.
pub(super) const RELATIVE_FLOOR: f64 = 0.01;

/// The difference of two pictures of equally many pixels, linear and finite. Where the standard error of each channel of
/// their difference is known, what noise is expected to add is taken off `rmse` and `relative`: E[d^2] = D^2 + s^2 for
/// independent errors, so D^2 is the mean of d^2 - s^2, held at 0.
///
/// Pixels beyond the shorter picture are not looked at; two empty pictures do not differ.
pub fn difference(test: &[[f64; 3]], reference: &[[f64; 3]], standard_error: Option<&[[f64; 3]]>) -> Difference {
    let (mut square, mut relative, mut signed, mut sum, mut largest) = (0.0, 0.0, 0.0, 0.0, 0.0_f64);
    let mut count = 0_usize;
    for (i, (t, r)) in test.iter().zip(reference).enumerate() {
        for c in 0..3 {
            let (d, noise) = (t[c] - r[c], standard_error.map_or(0.0, |errors| errors[i][c]));
            let clean = without_noise(d, noise);
            square += clean;
            relative += clean / (r[c] * r[c] + RELATIVE_FLOOR);
            signed += d;
            sum += r[c];
            largest = largest.max(d.abs());
            count += 1;
        }
    }
    let mean = |x: f64| if count == 0 { 0.0 } else { (x / count as f64).max(0.0).sqrt() };
    let mean_relative = if sum > 0.0 { signed / sum } else { 0.0 };
    Difference { rmse: mean(square), relative: mean(relative), mean_relative, largest }
}

/// How differences compare with their standard errors: z = difference / standard error. Unbiased pictures with right
/// errors have rms 1, 0.27 % beyond 3 and none beyond 6.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scores {
    /// Root mean square of z.
    pub rms: f64,
    /// Share of |z| > 3.
    pub beyond_3: f64,
    /// Largest |z|.
    pub largest: f64,
    /// Numbers compared.
    pub count: usize,
}

/// The z-scores of the difference of two pictures whose independent standard errors are known. Channels without any error
/// are counted only where they differ by more than a millionth: as infinitely far.
pub fn scores(
    test: &[[f64; 3]],
    test_error: &[[f64; 3]],
    reference: &[[f64; 3]],
    reference_error: &[[f64; 3]],
) -> Scores {
    let (mut square, mut beyond, mut largest, mut count) = (0.0, 0_usize, 0.0_f64, 0_usize);
    let errors = test_error.iter().zip(reference_error);
    let channels =
        test.iter().zip(reference).zip(errors).flat_map(|((t, r), (a, b))| [0, 1, 2].map(|c| [t[c], r[c], a[c], b[c]]));
    for [t, r, a, b] in channels {
        let error = a.hypot(b);
        let d = (t - r).abs();
        if error == 0.0 && d <= 1e-6 * r.abs().max(1.0) {
            continue;
        }
        let z = d / error;
        square += z * z;
        beyond += usize::from(z > 3.0);
        largest = largest.max(z);
        count += 1;
    }
    if count == 0 {
        return Scores::default();
    }
    Scores { rms: (square / count as f64).sqrt(), beyond_3: beyond as f64 / count as f64, largest, count }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_differences() {
        let (a, b) = ([[1.0; 3], [2.0, 0.0, 4.0]], [[1.0; 3], [1.0, 0.0, 2.0]]);
        let d = difference(&a, &b, None);
        assert!((d.rmse - (5.0_f64 / 6.0).sqrt()).abs() < 1e-15);
        assert!((d.relative - ((1.0 / 1.01 + 4.0 / 4.01) / 6.0_f64).sqrt()).abs() < 1e-15);
        assert!((d.mean_relative - 3.0 / 6.0).abs() < 1e-15 && d.largest == 2.0);
        assert_eq!(difference(&a, &a, None), Difference::default());
        assert_eq!(difference(&[], &[], None), Difference::default());
    }

    #[test]
    fn noise_is_taken_off_and_scored() {
        // A bias of 0.1 under noise of 1: a plain rmse would say 1.005.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let n = 200_000;
        let reference = vec![[5.0; 3]; n];
        let test: Vec<[f64; 3]> = (0..n).map(|_| std::array::from_fn(|_| 5.1 + normal())).collect();
        let (one, none) = (vec![[1.0; 3]; n], vec![[0.0; 3]; n]);
        let d = difference(&test, &reference, Some(&one));
        assert!((d.rmse - 0.1).abs() < 0.02, "{d:?}");
        let s = scores(&test, &one, &reference, &none);
        assert!((s.rms - 1.005).abs() < 0.01 && s.beyond_3 < 0.004 && s.largest < 6.0, "{s:?}");
        assert_eq!(scores(&reference, &none, &reference, &none), Scores::default());
        assert_eq!(scores(&test, &none, &reference, &none).rms, f64::INFINITY);
    }
}
