//! The sampler and its density against closed forms and converged tables; D and V against what they must integrate to.

use halfvector_brdf::dfg::dfg_karis;
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::math::PI;
use halfvector_brdf::multiscatter::energy_compensation;
use halfvector_brdf::sampling::{g1_smith_ggx, pdf_solid_angle_ggx_vndf, sample_ggx_vndf};
use halfvector_brdf::vector::dot;

use crate::data::table;

const STRATA: usize = 512;

/// Half vectors of a stratified set of samples.
fn half_vectors(view: [f64; 3], alpha: f64) -> impl Iterator<Item = [f64; 3]> {
    let centre = |i: usize| (i as f64 + 0.5) / STRATA as f64;
    (0..STRATA * STRATA).map(move |i| sample_ggx_vndf(view, alpha, [centre(i % STRATA), centre(i / STRATA)]))
}

fn view_at(n_dot_v: f64) -> [f64; 3] {
    [(1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v]
}

/// Directional albedo of a white lobe by sampling: the mean of F G2 / G1 with F = 1.
fn albedo(n_dot_v: f64, alpha: f64, visibility: fn(f64, f64, f64, f64) -> f64) -> f64 {
    let view = view_at(n_dot_v);
    let sum: f64 = half_vectors(view, alpha)
        .map(|h| {
            let v_dot_h = dot(view, h);
            let n_dot_l = 2.0 * v_dot_h * h[2] - view[2];
            if n_dot_l <= 0.0 {
                return 0.0;
            }
            visibility(n_dot_v, n_dot_l, v_dot_h, alpha) * 4.0 * n_dot_v * n_dot_l / g1_smith_ggx(n_dot_v, alpha)
        })
        .sum();
    sum / (STRATA * STRATA) as f64
}

#[test]
fn albedo_of_alpha_1_is_its_closed_form() {
    for n_dot_v in [0.05_f64, 0.3, 0.7, 1.0] {
        let exact = 1.0 - n_dot_v * (1.0 + 1.0 / n_dot_v).ln();
        let sampled = albedo(n_dot_v, 1.0, v_smith_ggx_correlated);
        assert!((sampled - exact).abs() < 2e-5, "n.v {n_dot_v}: {sampled} instead of {exact}");
    }
}

#[test]
fn albedo_is_the_table_s() {
    let Some(grid) = table("dfg_grid_shared.csv") else { return };
    let (mut worst, mut worst_separable, mut worst_karis, mut rows) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
    for row in grid.rows().step_by(37) {
        let (n_dot_v, roughness) = (row.number("nov"), row.number("roughness"));
        let alpha = alpha_from_perceptual_roughness(roughness);
        let truth = row.number("E_ss_white");
        worst = worst.max((albedo(n_dot_v, alpha, v_smith_ggx_correlated) - truth).abs());
        let separable = row.number("E_ss_white_separable_smith");
        worst_separable = worst_separable.max((albedo(n_dot_v, alpha, v_smith_ggx_separable) - separable).abs());
        let karis = dfg_karis(n_dot_v, roughness);
        worst_karis = worst_karis.max((karis[0] - row.number("dfg_scale")).abs());
        worst_karis = worst_karis.max((karis[1] - row.number("dfg_bias")).abs());
        let [lost, ..] = energy_compensation([1.0; 3], [1.0; 3], [truth, 0.0]).map(|c| c * truth - 1.0);
        assert!(lost.abs() < 1e-15, "a white metal reflects all, not {lost}");
        rows += 1;
    }
    println!(
        "albedo, {rows} points: correlated {worst:.1e}, separable {worst_separable:.1e}, Karis's fit {worst_karis:.3}"
    );
    assert!(rows > 10 && worst < 5e-4 && worst_separable < 5e-4, "{worst:.1e} {worst_separable:.1e}");
    // 0.48 over the whole table, at grazing angles and roughness 1: the fit's known worst.
    assert!(worst_karis < 0.48, "Karis's fit is off by {worst_karis}");
}

#[test]
fn moments_are_the_table_s() {
    let Some(moments) = table("vndf_moments_shared.csv") else { return };
    let mut rows = 0;
    for row in moments.rows().filter(|r| r.text("alpha_x") == r.text("alpha_y")) {
        let view = ["vx", "vy", "vz"].map(|c| row.number(c));
        let count = (STRATA * STRATA) as f64;
        let (mut mean, mut square) = ([0.0; 3], [0.0; 3]);
        for h in half_vectors(view, row.number("alpha_x")) {
            assert!((dot(h, h) - 1.0).abs() < 1e-14 && h[2] >= 0.0);
            for i in 0..3 {
                mean[i] += h[i] / count;
                square[i] += h[i] * h[i] / count;
            }
        }
        for (i, (m, s)) in [("E_hx", "E_hx2"), ("E_hy", "E_hy2"), ("E_hz", "E_hz2")].into_iter().enumerate() {
            let (dm, ds) = ((mean[i] - row.number(m)).abs(), (square[i] - row.number(s)).abs());
            // Midpoints see little of the last stratum's tail, in which h^2 falls off slowly.
            assert!(dm < 2e-4 && ds < 2e-4, "row {}: {m} off by {dm:.1e}, {s} by {ds:.1e}", row.text("id"));
        }
        rows += 1;
    }
    println!("moments of the sampler: {rows} isotropic rows");
    assert!(rows > 0);
}

/// The integral of `f(cos, sin^2)` over the hemisphere, uniform in the logarithm of the tangent: a midpoint sum of a
/// smooth function that dies off at both ends, which is exact to rounding.
fn over_hemisphere(f: impl Fn(f64, f64) -> f64) -> f64 {
    let (steps, low, high) = (4000, (1e-12_f64).ln(), (1e12_f64).ln());
    let step = (high - low) / f64::from(steps);
    (0..steps)
        .map(|i| {
            let tan = (low + (f64::from(i) + 0.5) * step).exp();
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            let sin = tan * cos;
            // d theta = cos sin d ln tan
            f(cos, sin * sin) * 2.0 * PI * sin * cos * sin * step
        })
        .sum()
}

#[test]
fn projected_area_of_the_microfacets_is_1() {
    for roughness in [1e-2, 0.045, 0.2, 0.5, 1.0] {
        let alpha = alpha_from_perceptual_roughness(roughness);
        let area = over_hemisphere(|cos, sin2| d_ggx(cos, sin2, alpha) * cos);
        assert!((area - 1.0).abs() < 1e-10, "roughness {roughness}: {area}");
    }
}

#[test]
fn density_at_normal_incidence_integrates_to_1() {
    // l is at twice the angle of h: d omega_l = 4 cos(theta_h) d omega_h.
    for roughness in [0.045, 0.3, 1.0] {
        let alpha = alpha_from_perceptual_roughness(roughness);
        let total = over_hemisphere(|cos, sin2| pdf_solid_angle_ggx_vndf(1.0, cos, sin2, alpha) * 4.0 * cos);
        assert!((total - 1.0).abs() < 1e-10, "roughness {roughness}: {total}");
    }
}

#[test]
fn sampling_survives_the_edges_of_its_domain() {
    let last = 1.0 - f32::EPSILON / 2.0;
    for alpha in [0.0, 1e-8, 1e-4, 0.5, 1.0_f32] {
        for view in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1e-6], [0.6, 0.0, 0.8_f32]] {
            for u in [[0.0, 0.0], [0.0, last], [last, 0.0], [last, last], [0.5, 1e-9], [0.5, last]] {
                let h = sample_ggx_vndf(view, alpha, u);
                assert!((dot(h, h) - 1.0).abs() < 1e-6 && h[2] >= 0.0, "{alpha} {view:?} {u:?}: {h:?}");
            }
        }
    }
}
