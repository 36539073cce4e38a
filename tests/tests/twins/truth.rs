//! The specular lobe on the GPU: against 60-digit truth, and what guards colours against arguments that are no numbers.

use super::domain::Numbers;
use super::gpu::{Gpu, library};
use crate::support::{data, root};

const COLUMNS: [&str; 6] = ["vx", "vy", "vz", "lx", "ly", "lz"];

#[test]
fn specular_lobe_is_the_truth() {
    let path =
        data("brdf/brdf_points_shared.csv").unwrap_or_else(|| root().join("crates/brdf/tests/data/brdf_points.csv"));
    let Some(gpu) = Gpu::open() else { return };
    let text = std::fs::read_to_string(path).expect("the table can be read");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header line");
    let rows: Vec<Vec<&str>> = lines.collect();
    let number = |row: &[&str], name: &str| {
        let column = header.iter().position(|h| *h == name).expect("a column of the table");
        row[column].parse::<f64>().expect("a number")
    };
    let mut arguments = Vec::new();
    for row in &rows {
        let [vx, vy, vz, lx, ly, lz] = COLUMNS.map(|c| number(row, c) as f32);
        let (f0, alpha) = (number(row, "f0") as f32, number(row, "alpha") as f32);
        // normal, view, n.v; light; f0, f90, alpha
        arguments.extend([0.0, 0.0, 1.0, vx, vy, vz, vz, lx, ly, lz, f0, f0, f0, 1.0, 1.0, 1.0, alpha]);
    }
    let results = gpu.call::<f32>(&library(), "specular_eval", &arguments);
    let (mut passed, mut worst) = (0, 0.0_f64);
    for (row, value) in rows.iter().zip(results.values.chunks_exact(results.results)) {
        let scale = ["D_ggx", "V_smith_hc", "nol"].iter().map(|c| number(row, c)).product::<f64>()
            * number(row, "F_schlick").max(0.02);
        // The acceptance of the data's README: rounding, the conditioning of the directions, and their lengths.
        let tolerance = 4e-6 + 4.0 * 6e-8 * number(row, "cond_f32") + 2.0 * number(row, "len_err_f32");
        let error = (value[0] - number(row, "spec_schlick_cos")).abs() / scale;
        if error <= tolerance {
            passed += 1;
        } else {
            assert!(number(row, "roughness") < 0.0021, "row {}: {error:.2e}, allowed {tolerance:.2e}", row[0]);
        }
        if number(row, "roughness") >= 0.045 {
            worst = worst.max(error / tolerance);
        }
    }
    println!("{}: specular_eval {passed} of {}, roughness >= 0.045 worst {worst:.2}", gpu.name, rows.len());
    assert!(rows.len() - passed <= 4 && worst <= 0.5, "{passed} of {} pass, worst {worst:.2}", rows.len());
}

/// What every shader ends in: see codegen's test `every_lit_shader_ends_in_a_finite_colour`.
#[test]
fn colours_of_any_bits_are_made_finite() {
    let Some(gpu) = Gpu::open() else { return };
    let mut numbers = Numbers::new("finite_or_zero");
    let inputs: Vec<f32> = (0..3 << 14).map(|_| numbers.anything()).collect();
    let results = gpu.call::<f32>(&library(), "finite_or_zero", &inputs);
    let bad = results.values.iter().position(|x| !x.is_finite());
    let row = bad.map(|i| &inputs[i / 3 * 3..][..3]);
    assert!(bad.is_none(), "{}: finite_or_zero of {row:?} is not finite", gpu.name);
}
