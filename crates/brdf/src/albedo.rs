//! Directional and average albedo of the GGX lobe, and the directional one of the sheen's, by quadrature in f64: the truth that tables
//! and fits are made from and measured against. Nothing here is for a shader.

use crate::Real;
use crate::ggx::{alpha_from_perceptual_roughness, v_smith_ggx_correlated};
use crate::math::PI;
use crate::sheen::{d_charlie, v_neubelt};

/// The smallest cosine; below it stands the limit towards 0.
const MIN_COSINE: f64 = 1e-6;
/// The smallest alpha: a mirror's albedo to 15 digits.
const MIN_ALPHA: f64 = 1e-8;
/// Panels of a segment: each is four times as long as the one before, so that even alpha = 1e-8 has enough.
const PANELS: usize = 16;
/// The smallest roughness of the sheen.
const MIN_SHEEN_ROUGHNESS: f64 = 0.05;
/// Points in a panel of the sheen's integral.
const SHEEN_POINTS: usize = 8;
/// Points in a panel that integrate to 1e-8.
const FINE_POINTS: usize = 12;

/// Points and weights of Gauss and Legendre's rule of `N` points over [-1, 1], by Newton's method from Chebyshev's points.
/// Press et al. 2007, Numerical Recipes, section 4.6.1.
pub fn gauss_legendre<const N: usize>() -> [[f64; 2]; N] {
    core::array::from_fn(|i| {
        let mut x = Real::sin_cos(PI * (i as f64 + 0.75) / (N as f64 + 0.5)).1;
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut p, mut before) = (1.0, 0.0);
            for k in 1..=N {
                let k = k as f64;
                (p, before) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k, p);
            }
            slope = N as f64 * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    })
}

/// (a, b) of the GGX lobe D V F for F = f0 + (f90 - f0)(1 - l.h)^5: the share of uniform light that it reflects is
/// f0 a + f90 b, and a + b the directional albedo E(v) of a white one. Karis 2013, Real Shading in Unreal Engine 4.
///
/// E = Int D V n.l dl, b = Int D V (1 - l.h)^5 n.l dl over the directions l. With S = |v + l|^2 and M = n.v + n.l,
/// D = alpha^2 S^2 / (pi q^2), q = S - (1 - alpha^2) M^2, and both S and q are p + r sin^2(phi / 2) in the azimuth phi from
/// the mirror direction: q's peak there is sqrt(p / r) wide. The polar angle is taken in panels that grow fourfold from the
/// mirror direction and from the horizon, where the lobe and V change within min(alpha, n.v), the azimuth in
/// panels that grow fourfold from its peak, with Gauss's rule of `POINTS` in each. `visibility` is V of (n.v, n.l, l.h,
/// alpha).
///
/// Domain: every number; n.v is held in [1e-6, 1], alpha in [1e-8, 1]; NaN counts as the lower end of n.v.
/// Error with 12 points: <= 1e-8; with 6: <= 1e-5.
pub fn directional_albedo_ggx_with<const POINTS: usize>(
    n_dot_v: f64,
    perceptual_roughness: f64,
    visibility: fn(f64, f64, f64, f64) -> f64,
    rule: &[[f64; 2]; POINTS],
) -> [f64; 2] {
    let n_dot_v = Real::clamp(n_dot_v, MIN_COSINE, 1.0);
    let alpha = f64::max(alpha_from_perceptual_roughness(perceptual_roughness), MIN_ALPHA);
    let theta_v = Real::acos(n_dot_v);
    let sin_v = Real::sin_cos(theta_v).0;
    let (mut all, mut bias) = (0.0, 0.0);
    let mut polar = |theta_l: f64, weight: f64| {
        let (sin_l, n_dot_l) = Real::sin_cos(theta_l);
        let cos_sum = Real::sin_cos(0.5 * (theta_v + theta_l)).1;
        let (sin_difference, cos_difference) = Real::sin_cos(0.5 * (theta_v - theta_l));
        // S and q in the mirror direction; neither subtracts.
        let s0 = 4.0 * cos_sum * cos_sum;
        let q0 = s0 * (sin_difference * sin_difference + alpha * alpha * cos_difference * cos_difference);
        let rise = 4.0 * sin_v * sin_l;
        graded(PI, 2.0 * Real::sqrt(q0 / (q0 + rise)), rule, |phi, width| {
            let sin = Real::sin_cos(0.5 * phi).0;
            let more = rise * sin * sin;
            let d = alpha * (s0 + more) / (q0 + more);
            let l_dot_h = 0.5 * Real::sqrt(s0 + more);
            let v = visibility(n_dot_v, n_dot_l, l_dot_h, alpha);
            // Both halves of the azimuth.
            let part = 2.0 * weight * width * (d * d / PI) * v * n_dot_l * sin_l;
            all += part;
            bias += part * crate::math::pow5(f64::max(1.0 - l_dot_h, 0.0));
        });
    };
    let horizon = 0.5 * PI;
    let middle = 0.5 * (theta_v + horizon);
    let scale = f64::min(alpha, n_dot_v);
    graded(theta_v, 0.5 * scale, rule, |offset, width| polar(theta_v - offset, width));
    graded(middle - theta_v, 0.5 * scale, rule, |offset, width| polar(theta_v + offset, width));
    graded(horizon - middle, 0.5 * scale, rule, |offset, width| polar(horizon - offset, width));
    // Rounding may leave [0, 1].
    let all = f64::min(all, 1.0);
    let bias = f64::min(bias, all);
    [all - bias, bias]
}

/// Calls `add` with the points and weights of a rule over [0, length], in panels of which the first ends at `first` and
/// each next one is four times as far.
fn graded<const POINTS: usize>(length: f64, first: f64, rule: &[[f64; 2]; POINTS], mut add: impl FnMut(f64, f64)) {
    let (mut start, mut end) = (0.0, f64::min(first, length));
    for _ in 0..PANELS {
        if end <= start {
            break;
        }
        for &[x, w] in rule {
            add(start + (end - start) * (x + 1.0) / 2.0, w / 2.0 * (end - start));
        }
        (start, end) = (end, f64::min(4.0 * end, length));
    }
}

/// (a, b) of the GGX lobe with height-correlated V, to 1e-8: [`directional_albedo_ggx_with`] 12 points.
pub fn directional_albedo_ggx(n_dot_v: f64, perceptual_roughness: f64) -> [f64; 2] {
    let rule = gauss_legendre::<FINE_POINTS>();
    directional_albedo_ggx_with::<FINE_POINTS>(n_dot_v, perceptual_roughness, v_smith_ggx_correlated::<f64>, &rule)
}

/// Cosine-weighted averages 2 Int a(mu) mu dmu and 2 Int b(mu) mu dmu of the GGX lobe; their sum is E_avg, which is
/// (4 - 4 ln 2) / 3 at roughness 1.
///
/// Domain: as [`directional_albedo_ggx`]. Error: <= 1e-6. mu = t^2, so that grazing angles have most of the 24 points.
pub fn average_albedo_ggx(perceptual_roughness: f64) -> [f64; 2] {
    let mut average = [0.0; 2];
    for [x, w] in gauss_legendre::<24>() {
        let t = (x + 1.0) / 2.0;
        let pair = directional_albedo_ggx(t * t, perceptual_roughness);
        // 2 mu dmu = 4 t^3 dt
        for i in 0..2 {
            average[i] += w / 2.0 * 4.0 * t * t * t * pair[i];
        }
    }
    average
}

/// Directional albedo of the white sheen lobe as published, Int D V n.l dl with [`d_charlie`] and [`v_neubelt`].
///
/// The polar angle is taken in panels that grow fourfold from the mirror direction, where D has a hole, and from the horizon, where V changes
/// within n.v; the azimuth in panels that grow fourfold from the hole.
///
/// Domain: every number; n.v is held in [1e-6, 1], the roughness in [0.05, 1]; NaN counts as the lower end. Error: <= 1e-5 max(1, E).
pub fn directional_albedo_charlie(n_dot_v: f64, perceptual_roughness: f64) -> f64 {
    let held = |x: f64, low: f64| f64::min(f64::max(x, low), 1.0);
    let (n_dot_v, roughness) = (held(n_dot_v, MIN_COSINE), held(perceptual_roughness, MIN_SHEEN_ROUGHNESS));
    let alpha = roughness * roughness;
    let theta_v = Real::acos(n_dot_v);
    let sin_v = Real::sin_cos(theta_v).0;
    let rule = gauss_legendre::<SHEEN_POINTS>();
    let mut all = 0.0;
    let mut polar = |theta_l: f64, weight: f64| {
        let (sin_l, n_dot_l) = Real::sin_cos(theta_l);
        let v = v_neubelt(n_dot_v, n_dot_l, 0.0, alpha);
        let up = n_dot_v + n_dot_l;
        graded(PI, 0.2, &rule, |phi, width| {
            // phi is 0 in the mirror direction: there v + l has no part along the surface but for what the angles differ.
            let half = Real::sin_cos(0.5 * phi).0;
            let along2 = (sin_v - sin_l) * (sin_v - sin_l) + 4.0 * sin_v * sin_l * half * half;
            let squared = f64::max(up * up + along2, f64::MIN_POSITIVE);
            let d = d_charlie(up / Real::sqrt(squared), along2 / squared, alpha);
            // Both halves of the azimuth.
            all += 2.0 * weight * width * d * v * n_dot_l * sin_l;
        });
    };
    let horizon = 0.5 * PI;
    let middle = 0.5 * (theta_v + horizon);
    graded(theta_v, 0.1, &rule, |offset, width| polar(theta_v - offset, width));
    graded(middle - theta_v, 0.1, &rule, |offset, width| polar(theta_v + offset, width));
    graded(horizon - middle, 0.25 * n_dot_v, &rule, |offset, width| polar(horizon - offset, width));
    all
}
