//! The lobes as zonal kernels: the numbers by which a convolution multiplies the harmonics of each degree.

use crate::harmonics::gauss_legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// A lobe that is symmetric about the direction it filters for (n = v = r).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lobe {
    /// GGX of this alpha, above 0; at 1 the cosine.
    Ggx(f64),
    /// Charlie of this alpha, above 0: a ring near the horizon.
    Charlie(f64),
    /// max(n.l, 0) to this power, above 0.
    CosinePower(f64),
}

impl Lobe {
    /// k_l for l = 0 ..= band, normalised to k_0 = 1.
    pub(crate) fn kernel(self, band: usize) -> Vec<f64> {
        match self {
            Lobe::Ggx(alpha) => ggx_kernel(alpha, band),
            Lobe::Charlie(alpha) => charlie_kernel(alpha, band),
            Lobe::CosinePower(power) => {
                zonal_kernel(band, power.max(1.0).recip().sqrt(), |cos, _| cos.max(0.0).powf(power))
            }
        }
    }

    /// The degree at which the series may end: there k_l is about exp(-2 series_end) of k_0.
    pub(crate) fn band(self, series_end: f64) -> usize {
        match self {
            Lobe::Ggx(alpha) | Lobe::Charlie(alpha) => ggx_band(alpha, series_end),
            // A Gaussian of variance 1 / power, nearly: k_l = exp(-l^2 / (2 power)).
            Lobe::CosinePower(power) => ((4.0 * series_end * power).sqrt().ceil() as usize).max(MIN_BAND),
        }
    }

    /// Rows of a grid on which cubic interpolation follows the lobe.
    pub(crate) fn grid_rows(self) -> usize {
        match self {
            Lobe::Ggx(alpha) | Lobe::Charlie(alpha) => ggx_grid_rows(alpha),
            Lobe::CosinePower(power) => ggx_grid_rows(power.max(1.0).recip().sqrt()),
        }
    }
}

/// k_l of the sheen lobe with n = v = r: weight D_Charlie(h) max(n.l, 0), D = sin(theta_h)^(1/alpha) (2 + 1/alpha) / (2 pi)
/// (Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", equation 2), with sin^2 theta_h = (1 - n.l) / 2.
fn charlie_kernel(alpha: f64, band: usize) -> Vec<f64> {
    let power = 0.5 / alpha;
    // 1 - n.l is at most 1, and there the weight is normalised.
    zonal_kernel(band, alpha, |cos, one_minus_cos| cos * one_minus_cos.powf(power))
}

/// k_l for l = 0 ..= band of the prefilter lobe with n = v = r: weight D_GGX(h) max(n.l, 0), normalised to k_0 = 1.
///
/// Half way between l and n, cos^2 theta_h = (1 + n.l) / 2, so with s = 1 - n.l the weight is
/// n.l / (s (1 - alpha^2) / 2 + alpha^2)^2 (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
/// equation 33; Karis 2013, "Real Shading in Unreal Engine 4", for n = v = r). `alpha` > 0; at 1 the lobe is the cosine.
fn ggx_kernel(alpha: f64, band: usize) -> Vec<f64> {
    let a2 = alpha * alpha;
    // The scale a2^2 keeps the numbers near 1; the normalisation removes it.
    zonal_kernel(band, alpha, |cos, one_minus_cos| a2 * a2 * ggx_weight(alpha, cos, one_minus_cos))
}

/// The weight n.l / (s (1 - alpha^2) / 2 + alpha^2)^2 of a direction at the cosine n.l = 1 - s > 0: for any alpha it is
/// 4 n.l / s^2 far from the middle, and smaller everywhere when alpha is greater.
pub(crate) fn ggx_weight(alpha: f64, cos: f64, one_minus_cos: f64) -> f64 {
    let a2 = alpha * alpha;
    let d = one_minus_cos * (1.0 - a2) / 2.0 + a2;
    cos / (d * d)
}

/// k_l = integral of w P_l(cos) / integral of w, over the hemisphere, for a weight w(cos, 1 - cos) as wide as `width`.
fn zonal_kernel(band: usize, width: f64, weight: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    // The points of a panel go together through the recursion P_(l+1) = ((2l + 1) cos P_l - l P_(l-1)) / (l + 1).
    const POINTS: usize = 8;
    let rule = gauss_legendre(POINTS);
    let factors: Vec<(f64, f64)> =
        (0..=band).map(|l| l as f64).map(|l| ((2.0 * l + 1.0) / (l + 1.0), l / (l + 1.0))).collect();
    // Panels short enough for the fastest polynomial and, near the lobe's middle, for the lobe.
    let longest = 3.0 / (band as f64 + 1.0);
    let mut kernel = vec![0.0; band + 1];
    let mut start = 0.0;
    while start < FRAC_PI_2 {
        let end = (start + (width.max(start) / 2.0).min(longest)).min(FRAC_PI_2);
        let (mut cosines, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
        for (i, &(x, w)) in rule.iter().enumerate() {
            let theta: f64 = start + (end - start) * (x + 1.0) / 2.0;
            let (sin, cos) = theta.sin_cos();
            let half = (theta / 2.0).sin();
            cosines[i] = cos;
            weights[i] = w * (end - start) / 2.0 * sin * weight(cos, 2.0 * half * half);
        }
        // w P_l, which obeys the same recursion.
        let (mut p, mut before) = (weights, [0.0; POINTS]);
        for (k, &(a, b)) in kernel.iter_mut().zip(&factors) {
            let mut next = [0.0; POINTS];
            let mut sums = p;
            for i in 0..POINTS {
                next[i] = a * cosines[i] * p[i] - b * before[i];
            }
            for half in [4, 2, 1] {
                for i in 0..half {
                    sums[i] += sums[i + half];
                }
            }
            *k += sums[0];
            (p, before) = (next, p);
        }
        start = end;
    }
    let whole = kernel[0];
    kernel.iter_mut().for_each(|k| *k /= whole);
    kernel
}

/// The degree at which the series of the GGX lobe may end: there k_l is about exp(-2 series_end) of k_0.
///
/// Near its middle the lobe is (theta^2 + (2 alpha)^2)^-2, whose transform is x K_1(x), x = 2 alpha l. The lower bound
/// is for the kink of wide lobes at the horizon, whose harmonics fall only like a power of l.
fn ggx_band(alpha: f64, series_end: f64) -> usize {
    let band = series_end / alpha.max(1e-6);
    (band.ceil() as usize).max(MIN_BAND)
}

/// Degrees taken for every lobe, however wide.
const MIN_BAND: usize = 192;

/// Rows of a grid on which cubic interpolation follows the lobe: the lobe is about 4 alpha wide, thus 8 rows or more.
fn ggx_grid_rows(alpha: f64) -> usize {
    ((2.0 * PI / alpha.max(1e-6)).ceil() as usize).next_power_of_two().clamp(128, 2048)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cosine lobe has 1, 2/3, 1/4, 0, -1/24 (Ramamoorthi and Hanrahan 2001).
    #[test]
    fn cosine_lobe_is_the_known_one() {
        let k = Lobe::Ggx(1.0).kernel(64);
        for (l, exact) in [(0, 1.0), (1, 2.0 / 3.0), (2, 0.25), (3, 0.0), (4, -1.0 / 24.0), (5, 0.0)] {
            assert!((k[l] - exact).abs() < 1e-12, "{l}: {} for {exact}", k[l]);
        }
    }

    /// The cosine to the first power is the cosine lobe too, and a power of 2 has 1, 3/4, 2/5.
    #[test]
    fn powers_of_the_cosine() {
        for (power, exact) in [(1.0, [1.0, 2.0 / 3.0, 0.25]), (2.0, [1.0, 0.75, 0.4])] {
            let k = Lobe::CosinePower(power).kernel(2);
            assert!(k.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-9), "{power}: {k:?}");
        }
    }

    /// At alpha 1/2 the sheen's weight is n.l (1 - n.l): its moments are known.
    #[test]
    fn charlie_is_a_polynomial_at_one_half() {
        let k = Lobe::Charlie(0.5).kernel(2);
        // Integrals of x (1 - x) times 1, x and (3 x^2 - 1) / 2, divided by the first.
        for (value, exact) in k.iter().zip([1.0, 0.5, 6.0 * (1.5 * (0.25 - 0.2) - 0.5 / 6.0)]) {
            assert!((value - exact).abs() < 1e-9, "{k:?}");
        }
    }

    /// Where the series ends, next to nothing is left of a narrow lobe.
    #[test]
    fn narrow_lobes_end() {
        for alpha in [0.01, 0.03] {
            let band = ggx_band(alpha, 7.0);
            let k = ggx_kernel(alpha, band);
            assert!(k[band].abs() < 2e-5, "{alpha}: {}", k[band]);
            assert!(k[band / 8] > 0.1);
        }
    }
}
