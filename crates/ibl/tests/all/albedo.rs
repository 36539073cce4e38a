//! The split sum's table against converged quadrature: at the truth's points, read as a shader reads it.

use halfvector_brdf::albedo::{directional_albedo_ggx_with, gauss_legendre};
use halfvector_brdf::coupling::{coupling_compensated, coupling_single};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::ggx::v_smith_ggx_correlated;
use halfvector_brdf::lobe_multiscatter::{multiscatter_eval, multiscatter_from_dfg};
use halfvector_brdf::math::PI;
use halfvector_brdf::multiscatter::{energy_compensation, energy_compensation_fdez_aguera};
use halfvector_ibl::environment::dfg_from_table;
use halfvector_ibl::{DFG_SIZE, DfgTable, Visibility, dfg, dfg_table, dfg_table_with};

use crate::data_table;

/// Rows of a truth table: roughness, n.v, a + b, b, and a + b for separable masking where it has that column.
fn rows(name: &str, n_dot_v: usize, sum: usize, bias: usize) -> Option<Vec<[f64; 4]>> {
    let table = data_table(name)?;
    let number = |row: &[String], i: usize| row[i].parse::<f64>().expect("a number");
    Some(table.iter().map(|r| [0, n_dot_v, sum, bias].map(|i| number(r, i))).collect())
}

fn truth() -> Option<Vec<[f64; 4]>> {
    let mut all = rows("brdf/dfg_grid_shared.csv", 2, 3, 5)?;
    all.extend(rows("brdf/dfg_scatter_shared.csv", 2, 3, 5)?);
    Some(all)
}

#[test]
fn single_scattering_is_the_truth() {
    let Some(truth) = truth() else { return };
    let (mut sum, mut bias) = (0.0f64, 0.0f64);
    for &[roughness, n_dot_v, expected_sum, expected_bias] in truth.iter().step_by(7) {
        let [a, b] = dfg(n_dot_v, roughness, Visibility::Correlated);
        sum = sum.max((a + b - expected_sum).abs());
        bias = bias.max((b - expected_bias).abs());
    }
    println!("quadrature against the truth: a + b {sum:.1e}, b {bias:.1e}");
    assert!(sum < 1e-5 && bias < 1e-5, "{sum:.1e} {bias:.1e}");
}

#[test]
fn default_table_is_within_its_errors() {
    let Some(truth) = truth() else { return };
    let table = stored();
    let (mut inner, mut anywhere) = ([0.0f64; 3], [0.0f64; 3]);
    for &[roughness, n_dot_v, sum, bias] in &truth {
        let [a, b] = dfg_from_table(&table, n_dot_v, roughness).map(f64::from);
        let error = [(a + b - sum).abs(), (b - bias).abs(), (a + b - sum).abs() / sum];
        for i in 0..3 {
            anywhere[i] = anywhere[i].max(error[i]);
            if n_dot_v >= 0.05 && roughness >= 0.089 {
                inner[i] = inner[i].max(error[i]);
            }
        }
    }
    println!("table, {} points: a + b, b, relative a + b: {inner:.4?} inside, {anywhere:.4?} anywhere", truth.len());
    assert!(inner[0] < 1.2e-3 && inner[1] < 2e-3 && inner[2] < 2.2e-3, "{inner:?}");
    assert!(anywhere[0] < 4e-3 && anywhere[1] < 4e-3, "{anywhere:?}");
}

#[test]
fn separable_table_is_another_one() {
    let (correlated, separable) = (dfg_table(4), dfg_table_with(4, Visibility::Separable));
    assert!(correlated.texels.iter().zip(&separable.texels).all(|(c, s)| c[0] + c[1] >= s[0] + s[1] - 1e-4));
    assert_ne!(correlated, separable);
}

/// The table as shaders read it.
fn stored() -> DfgTable {
    let mut table = dfg_table(DFG_SIZE);
    for texel in &mut table.texels {
        *texel = texel.map(|x| half::f16::from_f32(x).to_f32());
    }
    table
}

/// What a white metal and a white base under a dielectric reflect of uniform light: punctual directions are integrated
/// exactly, all that scales them comes from the table. The view-only factors leave the integral over directions alone.
#[test]
fn furnace_through_the_table() {
    let table = stored();
    let read = |n_dot_v: f64, roughness: f64| dfg_from_table(&table, n_dot_v, roughness).map(f64::from);
    let white = [1.0; 3];
    let nodes = gauss_legendre::<32>().map(|[x, w]| ((x + 1.0) / 2.0, w / 2.0));
    let (mut metal, mut metal_anywhere, mut low, mut high) = (0.0f64, 0.0f64, f64::INFINITY, 0.0f64);
    for i in 0..20 {
        let roughness = 0.02 + 0.98 * (f64::from(i) / 19.0).powi(2);
        for j in 0..24 {
            let n_dot_v = 0.001 + 0.999 * (f64::from(j) / 23.0).powi(3);
            let [a, b] = directional_albedo_ggx_with::<6>(
                n_dot_v,
                roughness,
                v_smith_ggx_correlated::<f64>,
                &gauss_legendre::<6>(),
            );
            let dfg = read(n_dot_v, roughness);
            let lobe = multiscatter_from_dfg(white, white, dfg, roughness);
            let frame = frame_from_normal([0.0, 0.0, 1.0], [(1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v]);
            let kulla_conty: f64 = nodes
                .iter()
                .map(|&(t, w)| {
                    let mu = t * t;
                    let l = [0.0, (1.0 - mu * mu).sqrt(), mu];
                    multiscatter_eval(frame, l, lobe, read(mu, roughness))[0] * 2.0 * PI * w * 2.0 * t
                })
                .sum();
            for total in [
                (a + b) * energy_compensation(white, white, dfg)[0],
                (a + b) * energy_compensation_fdez_aguera(white, white, dfg)[0],
                a + b + kulla_conty,
            ] {
                if n_dot_v >= 0.05 && roughness >= 0.089 {
                    metal = metal.max((total - 1.0).abs());
                } else {
                    metal_anywhere = metal_anywhere.max((total - 1.0).abs());
                }
            }
            for f0 in [0.02, 0.04, 0.08] {
                for total in [
                    f0 * a + b + coupling_single(f0, 1.0, dfg),
                    (f0 * a + b) * energy_compensation([f0; 3], white, dfg)[0] + coupling_compensated(f0, 1.0, dfg),
                ] {
                    (low, high) = (low.min(total), high.max(total));
                }
            }
        }
    }
    println!(
        "white metal through the table: within {metal:.1e}, elsewhere {metal_anywhere:.1e}; base {low:.5}..{high:.5}"
    );
    assert!(metal < 3e-3 && metal_anywhere < 3e-2);
    assert!(low > 0.97 && high < 1.001, "{low} {high}");
    // A mirror, where the lobe is a delta and its albedo is Schlick's: nothing is compensated, nothing is lost.
    for n_dot_v in [0.001, 0.05, 0.3, 1.0] {
        let dfg = read(n_dot_v, 0.0);
        let fresnel = (1.0 - n_dot_v).powi(5);
        assert!((energy_compensation(white, white, dfg)[0] - 1.0).abs() < 3e-3);
        assert!((0.04 + 0.96 * fresnel + coupling_single(0.04, 1.0, dfg) - 1.0).abs() < 6e-3);
    }
}
