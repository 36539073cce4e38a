//! What the example `evaluate` computes, against 60-digit truth: every value column, from the vectors, in f32 and in f64.
//!
//! The tolerance of a column is relative to its value, or to `floor` where that is more. To it comes what the rounding of
//! the inputs' own arithmetic must do: in FON, EON and Oren-Nayar that of v.l, r / max(n.v, n.l) times; in Charlie's D that
//! of the exponent, |ln of the power| times. The columns of the lobe (`spec_*`) have the data's own tolerance as well.

#[path = "../../examples/evaluate/columns.rs"]
mod evaluate;

use evaluate::{INPUTS, OUTPUTS, Point, values};

use crate::data::{Row, Table, points};

/// Tolerance in f32 of one column, in units of 2^-24, and the value below which the error is that of this value.
fn tolerance(column: &str) -> (f64, f64) {
    match column {
        // 1 - l.h has the rounding of a sum of products; five or six of it are multiplied.
        "F_schlick" => (40.0, 0.02),
        "F_f82" => (160.0, 0.02),
        "spec_schlick" | "spec_schlick_cos" | "spec_aniso_schlick" => (48.0, 0.0),
        "fon" | "eon_exact" | "eon_approx" | "oren_nayar_qual" | "D_charlie" => (16.0, 0.0),
        "lambert" | "V_neubelt" => (6.0, 0.0),
        "V_smith_hc" | "V_aniso" | "G2_smith_hc" | "G2_smith_sep" | "G1_v" | "G1_l" => (10.0, 0.0),
        "F_cond_n0p2_k3p9" | "F_cond_n1p5_k7" | "F_cond_n2p9_k3p1" => (8.0, 0.0),
        _ => (24.0, 0.0),
    }
}

/// What a relative error of `epsilon` in the inputs' arithmetic does to a value beside its own rounding, absolute.
fn conditioned(column: &str, row: Row, epsilon: f64) -> f64 {
    match column {
        "fon" | "eon_exact" | "eon_approx" | "oren_nayar_qual" => {
            let amplified = row.number("roughness") / row.number("nov").max(row.number("nol"));
            8.0 * epsilon * amplified * row.number("lambert")
        }
        "D_charlie" => {
            let ln_power = 0.5 / row.number("alpha") * row.number("sin2_theta_h").max(1e-300).ln();
            8.0 * epsilon * ln_power.abs() * row.number("D_charlie")
        }
        _ => 0.0,
    }
}

fn point(row: Row) -> Point {
    INPUTS.map(|name| row.number(name))
}

/// Compares all columns of all rows; `epsilon` is the type's rounding, `least` the smallest normal number.
fn compare(points: &Table, type_name: &str, epsilon: f64, least: f64, ours: fn(&Point) -> [f64; OUTPUTS.len()]) {
    let mut worst = OUTPUTS.map(|_| (0.0_f64, String::new()));
    let mut rows = 0;
    for row in points.rows() {
        for ((name, value), worst) in OUTPUTS.iter().zip(ours(&point(row))).zip(&mut worst) {
            let truth = row.number(name);
            let (units, floor) = tolerance(name);
            let allowed = units * epsilon * truth.abs().max(floor) + conditioned(name, row, epsilon) + least;
            let error = (value - truth).abs() / allowed;
            if error.is_nan() || error > worst.0 {
                *worst = (error, row.text("id").into());
            }
        }
        rows += 1;
    }
    assert!(rows >= 72, "the table of points has only {rows} rows");
    for (name, (error, at)) in OUTPUTS.iter().zip(&worst) {
        println!("{type_name} {name}: worst {error:.2} of the tolerance, row {at}; {rows} rows");
    }
    let bad: Vec<_> = OUTPUTS.iter().zip(&worst).filter(|(_, (error, _))| error.is_nan() || *error > 1.0).collect();
    assert!(bad.is_empty(), "{type_name}: over the tolerance: {bad:?}");
}

#[test]
fn every_column_in_f32() {
    let ours = |point: &Point| values::<f32>(point).map(f64::from);
    points().iter().for_each(|p| compare(p, "f32", 2f64.powi(-24), 1.2e-38, ours));
}

/// The same tolerances, 2^29 times as small: 1e-15 to 2e-14. The issue asks for 1e-9.
#[test]
fn every_column_in_f64() {
    points().iter().for_each(|p| compare(p, "f64", 2f64.powi(-53), 1e-300, values::<f64>));
}

/// The acceptance of the data's README for code that takes the f32 vectors: rounding, the conditioning of the directions,
/// and their lengths. It allows four misses below roughness 0.0021; there is none.
#[test]
fn the_lobe_in_f32_by_the_data_s_tolerance() {
    let at = |name: &str| OUTPUTS.iter().position(|o| *o == name).expect("a column");
    for table in points() {
        let (mut rows, mut worst) = (0, 0.0_f64);
        for row in table.rows() {
            let scale = row.number("D_ggx") * row.number("V_smith_hc") * row.number("F_schlick").max(0.02);
            let tolerance = 4e-6 + 4.0 * 6e-8 * row.number("cond_f32") + 2.0 * row.number("len_err_f32");
            let value = f64::from(values::<f32>(&point(row))[at("spec_schlick")]);
            let error = (value - row.number("spec_schlick")).abs() / scale / tolerance;
            assert!(error <= 0.5, "row {}: {error:.2} of the tolerance", row.text("id"));
            worst = worst.max(error);
            rows += 1;
        }
        println!("f32 spec_schlick: {rows} of {rows} rows pass, worst {worst:.2} of the data's tolerance");
    }
}
