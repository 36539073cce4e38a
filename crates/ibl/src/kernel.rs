//! The lobes as zonal kernels: the numbers by which a convolution multiplies the harmonics of each degree.

use crate::harmonics::gauss_legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// k_l for l = 0 ..= band of the prefilter lobe with n = v = r: weight D_GGX(h) max(n.l, 0), normalised to k_0 = 1.
///
/// Half way between l and n, cos^2 theta_h = (1 + n.l) / 2, so with s = 1 - n.l the weight is
/// n.l / (s (1 - alpha^2) / 2 + alpha^2)^2 (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
/// equation 33; Karis 2013, "Real Shading in Unreal Engine 4", for n = v = r). `alpha` > 0; at 1 the lobe is the cosine.
pub(crate) fn ggx_kernel(alpha: f64, band: usize) -> Vec<f64> {
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

/// k_l for l = 0 ..= band of the cosine lobe, normalised to k_0 = 1: radiance to irradiance over pi.
pub(crate) fn cosine_kernel(band: usize) -> Vec<f64> {
    ggx_kernel(1.0, band)
}

/// k_l = integral of w P_l(cos) / integral of w, over the hemisphere, for a weight w(cos, 1 - cos) as wide as `width`.
fn zonal_kernel(band: usize, width: f64, weight: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let rule = gauss_legendre(8);
    // Panels short enough for the fastest polynomial and, near the lobe's middle, for the lobe.
    let longest = 3.0 / (band as f64 + 1.0);
    let mut kernel = vec![0.0; band + 1];
    let mut start = 0.0;
    while start < FRAC_PI_2 {
        let end = (start + (width.max(start) / 2.0).min(longest)).min(FRAC_PI_2);
        for &(x, w) in &rule {
            let theta: f64 = start + (end - start) * (x + 1.0) / 2.0;
            let (sin, cos) = theta.sin_cos();
            let half = (theta / 2.0).sin();
            let w = w * (end - start) / 2.0 * sin * weight(cos, 2.0 * half * half);
            let (mut p, mut before) = (1.0, 0.0);
            for (l, k) in kernel.iter_mut().enumerate() {
                *k += w * p;
                let l = l as f64;
                (p, before) = (((2.0 * l + 1.0) * cos * p - l * before) / (l + 1.0), p);
            }
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
pub(crate) fn ggx_band(alpha: f64, series_end: f64) -> usize {
    let band = series_end / alpha.max(1e-6);
    (band.ceil() as usize).max(MIN_BAND)
}

/// Degrees taken for every lobe, however wide.
const MIN_BAND: usize = 192;

/// Rows of a grid on which cubic interpolation follows the lobe: the lobe is about 4 alpha wide, thus 16 rows or more.
pub(crate) fn ggx_grid_rows(alpha: f64) -> usize {
    ((4.0 * PI / alpha.max(1e-6)).ceil() as usize).next_power_of_two().clamp(128, 2048)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cosine lobe has 1, 2/3, 1/4, 0, -1/24 (Ramamoorthi and Hanrahan 2001).
    #[test]
    fn cosine_lobe_is_the_known_one() {
        let k = cosine_kernel(64);
        for (l, exact) in [(0, 1.0), (1, 2.0 / 3.0), (2, 0.25), (3, 0.0), (4, -1.0 / 24.0), (5, 0.0)] {
            assert!((k[l] - exact).abs() < 1e-12, "{l}: {} for {exact}", k[l]);
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
