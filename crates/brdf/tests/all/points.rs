//! Every function against 60-digit truth at points of twelve classes: 72 that stand in this package, and some 2,000 where
//! there is the folder of truth data.

use halfvector_brdf::Scalar;
use halfvector_brdf::diffuse::{diffuse_burley, diffuse_lambert};
use halfvector_brdf::frame::{frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_dielectric, f_exact, f_schlick, f0_from_ior};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::math::normalize_or;
use halfvector_brdf::sampling::{g1_smith_ggx, pdf_solid_angle_ggx_vndf};
use halfvector_brdf::vector::scale;

use crate::data::{Row, Table, points};

/// A term: its name, what we compute from a row, the truth, and the number that an error is taken relative to.
struct Term<R> {
    name: &'static str,
    ours: fn(Row) -> R,
    truth: fn(Row) -> f64,
    scale: fn(Row) -> f64,
    tolerance: f64,
}

fn col<R: Scalar>(row: Row, column: &str) -> R {
    R::of(row.number(column))
}

/// The terms that are functions of given scalars. `epsilon` is the type's: tolerances are multiples of it.
fn terms<R: Scalar>(epsilon: f64) -> Vec<Term<R>> {
    let tolerance = 8.0 * epsilon;
    let schlick = |row: Row| row.number("F_schlick").max(0.02);
    vec![
        Term {
            name: "alpha_from_perceptual_roughness",
            ours: |r| alpha_from_perceptual_roughness(col(r, "roughness")),
            truth: |r| r.number("alpha"),
            scale: |r| r.number("alpha"),
            tolerance,
        },
        Term {
            name: "d_ggx",
            ours: |r| d_ggx(col(r, "noh"), col(r, "sin2_theta_h"), col(r, "alpha")),
            truth: |r| r.number("D_ggx"),
            scale: |r| r.number("D_ggx"),
            tolerance,
        },
        Term {
            name: "v_smith_ggx_correlated",
            ours: |r| v_smith_ggx_correlated(col(r, "nov"), col(r, "nol"), col(r, "voh"), col(r, "alpha")),
            truth: |r| r.number("V_smith_hc"),
            scale: |r| r.number("V_smith_hc"),
            tolerance,
        },
        Term {
            name: "v_smith_ggx_separable",
            ours: |r| v_smith_ggx_separable(col(r, "nov"), col(r, "nol"), col(r, "voh"), col(r, "alpha")),
            truth: |r| r.number("G2_smith_sep") / (4.0 * r.number("nov") * r.number("nol")),
            scale: |r| r.number("G2_smith_sep") / (4.0 * r.number("nov") * r.number("nol")),
            tolerance,
        },
        Term {
            name: "g1_smith_ggx",
            ours: |r| g1_smith_ggx(col(r, "nol"), col(r, "alpha")),
            truth: |r| r.number("G1_l"),
            scale: |r| r.number("G1_l"),
            tolerance,
        },
        Term {
            name: "pdf_solid_angle_ggx_vndf",
            ours: |r| pdf_solid_angle_ggx_vndf(col(r, "nov"), col(r, "noh"), col(r, "sin2_theta_h"), col(r, "alpha")),
            truth: |r| r.number("pdf_vndf_l"),
            scale: |r| r.number("pdf_vndf_l"),
            tolerance,
        },
        Term {
            name: "f_schlick",
            ours: |r| f_schlick([col(r, "f0"); 3], [R::ONE; 3], col(r, "voh"))[0],
            truth: |r| r.number("F_schlick"),
            scale: schlick,
            tolerance,
        },
        Term {
            name: "f_dielectric 1.33",
            ours: |r| f_dielectric(R::of(1.33), col(r, "voh")),
            truth: |r| r.number("F_diel_1p33"),
            scale: |r| r.number("F_diel_1p33"),
            tolerance: 2.0 * tolerance,
        },
        Term {
            name: "f_dielectric 1.5",
            ours: |r| f_dielectric(R::of(1.5), col(r, "voh")),
            truth: |r| r.number("F_diel_1p5"),
            scale: |r| r.number("F_diel_1p5"),
            tolerance: 2.0 * tolerance,
        },
        Term {
            name: "f_dielectric 2.4",
            ours: |r| f_dielectric(R::of(2.4), col(r, "voh")),
            truth: |r| r.number("F_diel_2p4"),
            scale: |r| r.number("F_diel_2p4"),
            tolerance: 2.0 * tolerance,
        },
        Term {
            name: "f_exact, ior 2.4",
            ours: |r| f_exact([f0_from_ior(R::of(2.4)); 3], [R::ONE; 3], col(r, "voh"))[2],
            truth: |r| r.number("F_diel_2p4"),
            scale: |r| r.number("F_diel_2p4"),
            tolerance: 2.0 * tolerance,
        },
        Term {
            name: "diffuse_lambert",
            ours: |r| {
                diffuse_lambert([col(r, "rho"); 3], col(r, "nov"), col(r, "nol"), col(r, "voh"), col(r, "roughness"))[0]
            },
            truth: |r| r.number("lambert"),
            scale: |r| r.number("lambert"),
            tolerance,
        },
        Term {
            name: "diffuse_burley",
            ours: |r| {
                diffuse_burley([col(r, "rho"); 3], col(r, "nov"), col(r, "nol"), col(r, "voh"), col(r, "roughness"))[0]
            },
            truth: |r| r.number("burley"),
            scale: |r| r.number("burley"),
            tolerance,
        },
    ]
}

fn compare_terms<R: Scalar>(type_name: &str, epsilon: f64, points: &Table) {
    let mut failures = Vec::new();
    for term in terms::<R>(epsilon) {
        let (mut rows, mut passed, mut worst) = (0, 0, 0.0_f64);
        for row in points.rows() {
            let error = ((term.ours)(row).to_f64() - (term.truth)(row)).abs() / (term.scale)(row);
            rows += 1;
            // A truth of 0 is one below 1e-300: its error is 0 / 0.
            if error <= term.tolerance || (term.scale)(row) == 0.0 {
                passed += 1;
                worst = worst.max(if error.is_nan() { 0.0 } else { error });
            } else {
                failures.push(format!("{} row {}: error {error:.2e}", term.name, row.text("id")));
            }
        }
        println!("{type_name} {}: {passed} of {rows} within {:.1e}, worst {worst:.1e}", term.name, term.tolerance);
        assert!(rows >= 72, "the table of points has only {rows} rows");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn terms_in_f64() {
    points().iter().for_each(|p| compare_terms::<f64>("f64", f64::EPSILON, p));
}

#[test]
fn terms_in_f32() {
    points().iter().for_each(|p| compare_terms::<f32>("f32", f64::from(f32::EPSILON), p));
}

fn vector<R: Scalar>(row: Row, columns: [&str; 3]) -> [R; 3] {
    columns.map(|c| R::of(row.number(c)))
}

fn specular<R: Scalar>(row: Row, view: [R; 3], light: [R; 3]) -> R {
    let frame = frame_from_normal([R::ZERO, R::ZERO, R::ONE], view);
    let p = Specular { f0: [col(row, "f0"); 3], f90: [R::ONE; 3], alpha: col(row, "alpha") };
    specular_eval(frame, light, p)[1]
}

/// What the error of the whole lobe is taken relative to: the lobe with its Fresnel term floored.
pub(crate) fn lobe_scale(row: Row) -> f64 {
    row.number("D_ggx") * row.number("V_smith_hc") * row.number("F_schlick").max(0.02) * row.number("nol")
}

#[test]
fn specular_lobe_in_f64() {
    points().iter().for_each(compare_lobe_in_f64);
}

fn compare_lobe_in_f64(points: &Table) {
    let mut worst = 0.0_f64;
    for row in points.rows() {
        // The truth normalises the f32 vectors first.
        let up = [0.0, 0.0, 1.0];
        let view = normalize_or(vector::<f64>(row, ["vx", "vy", "vz"]), up);
        let light = normalize_or(vector::<f64>(row, ["lx", "ly", "lz"]), up);
        let epsilon = f64::EPSILON;
        let value = specular(row, view, light);
        // What a rounding of the length of v does: the table's column is for f32, and not linear in it.
        let longer = scale(view, 1.0 + 4.0 * epsilon);
        let len_err = (specular(row, longer, light) - value).abs() / lobe_scale(row);
        let tolerance = 64.0 * epsilon + 4.0 * epsilon * row.number("cond_f32") + 2.0 * len_err;
        let error = (value - row.number("spec_schlick_cos")).abs() / lobe_scale(row);
        worst = worst.max(error / tolerance);
        assert!(error <= tolerance, "row {}: error {error:.2e}, tolerance {tolerance:.2e}", row.text("id"));
        let half = half_from_light(frame_from_normal(up, view), light);
        assert!((half.l_dot_h - row.number("voh")).abs() <= 4.0 * epsilon, "row {}: l.h", row.text("id"));
    }
    println!("f64 specular_eval: all rows, worst error {worst:.2} of the tolerance");
}

#[test]
fn specular_lobe_in_f32() {
    points().iter().for_each(compare_lobe_in_f32);
}

fn compare_lobe_in_f32(points: &Table) {
    let (mut rows, mut passed, mut shaded_rows, mut worst_shaded) = (0, 0, 0, 0.0_f64);
    for row in points.rows() {
        let value = specular::<f32>(row, vector(row, ["vx", "vy", "vz"]), vector(row, ["lx", "ly", "lz"]));
        // The acceptance of the data's README: rounding, the conditioning of the directions, and their lengths.
        let tolerance = 4e-6 + 4.0 * 6e-8 * row.number("cond_f32") + 2.0 * row.number("len_err_f32");
        let error = (f64::from(value) - row.number("spec_schlick_cos")).abs() / lobe_scale(row);
        rows += 1;
        if error <= tolerance {
            passed += 1;
        } else {
            // Highlights of which one f32 step of a direction is a good part: known, and nowhere else.
            let known = row.text("class") == "tiny_alpha" && row.number("roughness") < 0.0021;
            println!("f32 row {}: error {:.2} of the tolerance", row.text("id"), error / tolerance);
            assert!(known, "row {}: error {error:.2e}, tolerance {tolerance:.2e}", row.text("id"));
        }
        if row.number("roughness") >= 0.045 {
            shaded_rows += 1;
            worst_shaded = worst_shaded.max(error / tolerance);
        }
    }
    println!(
        "f32 specular_eval: {passed} of {rows}; {shaded_rows} rows of roughness >= 0.045, worst {worst_shaded:.2}"
    );
    assert!(rows - passed <= 4, "{} rows missed", rows - passed);
    assert!(worst_shaded <= 0.5, "worst error at roughness >= 0.045 is {worst_shaded:.2} of the tolerance");
}
