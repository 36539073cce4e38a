//! The error of a picture whose truth is noisy: what of the difference is not chance, and how much there may be where it could
//! all be chance.

/// How many standard errors an error is taken away from a measured one.
const CAUTION: f64 = 2.0;

/// How many of its standard errors a single channel's difference is less: of ten thousand channels less than one is
/// farther off by chance.
const CAUTION_OF_ONE: f64 = 4.0;

/// The error of a picture, in the unit of its radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Error {
    /// Root of the mean square over all channels, with what noise is expected to add taken off; none where chance may explain all
    /// of it.
    pub(crate) rms: Option<f64>,
    /// What the rms error is at most where it is not known.
    pub(crate) bound: Option<f64>,
    /// The largest difference of a channel that chance does not explain: the largest error is at least this, and at least
    /// the rms error. None where chance may explain every one.
    pub(crate) largest: Option<f64>,
    /// The pixel of it.
    pub(crate) at: Option<usize>,
}

/// The error of `test` against `truth`; `noise` is the standard error of each channel of the truth, none where it is exact.
///
/// With D the error, d the difference and s the standard error, E[d^2] = D^2 + s^2, and d^2 - s^2 has the variance
/// 4 D^2 s^2 + 2 s^4 where what errs is normal; the channels of a pixel are taken to err together. Pixels beyond the shortest
/// of the three are not looked at.
pub(crate) fn error(test: &[[f64; 3]], truth: &[[f64; 3]], noise: Option<&[[f64; 3]]>) -> Error {
    let (mut square, mut variance, mut count) = (0.0, 0.0, 0.0_f64);
    let (mut largest, mut at) = (0.0_f64, None);
    for (pixel, (t, r)) in test.iter().zip(truth).enumerate() {
        let noise = noise.map_or(Some([0.0; 3]), |noise| noise.get(pixel).copied());
        let Some(noise) = noise else { break };
        let mut deviation = 0.0;
        for channel in 0..3 {
            let (d, s) = ((t[channel] - r[channel]).abs(), noise[channel]);
            let clean = d * d - s * s;
            square += clean;
            deviation += (4.0 * clean.max(0.0) * s * s + 2.0 * s.powi(4)).sqrt();
            count += 1.0;
            let sure = d - CAUTION_OF_ONE * s;
            if sure > largest {
                (largest, at) = (sure, Some(pixel));
            }
        }
        variance += deviation * deviation;
    }
    if count == 0.0 {
        return Error::default();
    }
    let root = |square: f64| (square / count).max(0.0).sqrt();
    let away = CAUTION * variance.sqrt();
    if noise.is_some() && square <= away {
        return Error {
            bound: Some(root(square.max(0.0) + away)),
            largest: at.map(|_| largest),
            at,
            ..Error::default()
        };
    }
    Error { rms: Some(root(square)), bound: None, largest: Some(largest.max(root(square))), at }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_noise_errors_are_plain() {
        let (a, b) = ([[1.0; 3], [2.0, 0.0, 4.0]], [[1.0; 3], [1.0, 0.0, 2.0]]);
        let found = error(&a, &b, None);
        assert_eq!((found.largest, found.at, found.bound), (Some(2.0), Some(1), None));
        assert!(found.rms.is_some_and(|rms| (rms - (5.0_f64 / 6.0).sqrt()).abs() < 1e-15));
        let same = error(&a, &a, None);
        assert_eq!((same.rms, same.largest, same.at), (Some(0.0), Some(0.0), None));
        assert_eq!(error(&[], &[], None), Error::default());
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
        let none = error(&vec![[1.0; 3]; COUNT], &truth, Some(&noise));
        assert_eq!((none.rms, none.largest), (None, None), "{none:?}");
        assert!(none.bound.is_some_and(|bound| bound > 0.01 && bound < 0.15), "{none:?}");
        let mut test = vec![[1.2; 3]; COUNT];
        let biased = error(&test, &truth, Some(&noise));
        assert!(biased.rms.is_some_and(|rms| (rms - 0.2).abs() < 0.03) && biased.bound.is_none(), "{biased:?}");
        // One pixel that is far off is found at its place, less what chance may have added.
        test[77] = [9.0; 3];
        let off = error(&test, &truth, Some(&noise));
        assert_eq!(off.at, Some(77));
        assert!(off.largest.is_some_and(|largest| largest > 4.5 && largest < 8.0), "{off:?}");
    }
}
