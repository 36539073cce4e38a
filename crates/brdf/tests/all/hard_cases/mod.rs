//! The rows of `hard_cases.csv` that a BRDF can meet, each a test in f32 and in f64. The same list runs on a GPU in the tests
//! of twins. What only Rust has (samplers, exact albedos) and what is more than one number stands below it.

mod list;

use halfvector_brdf::Scalar;
use halfvector_brdf::diffuse::{diffuse_eon, directional_albedo_fon, directional_albedo_fon_exact};
use halfvector_brdf::frame::{Frame, frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_exact, f_schlick, f0_from_ior, ior_from_f0};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated};
use halfvector_brdf::lobe_diffuse::{Diffuse, diffuse_eval};
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::multiscatter::energy_compensation;
use halfvector_brdf::sampling::{pdf_solid_angle_ggx_vndf, sample_ggx_vndf};

use crate::data::table;
use list::{Case, case_names, cases};

const UP: [f32; 3] = [0.0, 0.0, 1.0];

/// Calls a function by its name.
fn call<R: Scalar>(function: &str, x: &[R]) -> Vec<R> {
    let v = |at: usize| [x[at], x[at + 1], x[at + 2]];
    let frame = || Frame { normal: v(0), view_dir: v(3), n_dot_v: x[6] };
    match function {
        "d_ggx" => vec![d_ggx(x[0], x[1], x[2])],
        "v_smith_ggx_correlated" => vec![v_smith_ggx_correlated(x[0], x[1], x[2], x[3])],
        "specular_eval" => specular_eval(frame(), v(7), Specular { f0: v(10), f90: v(13), alpha: x[16] }).to_vec(),
        "frame_from_normal" => {
            let f = frame_from_normal(v(0), v(3));
            [f.normal.as_slice(), &f.view_dir, &[f.n_dot_v]].concat()
        }
        "half_from_light" => {
            let h = half_from_light(frame(), v(7));
            vec![h.n_dot_l, h.n_dot_h, h.l_dot_h, h.sin2_theta_h]
        }
        "f_schlick" => f_schlick(v(0), v(3), x[6]).to_vec(),
        "f_exact" => f_exact(v(0), v(3), x[6]).to_vec(),
        "f_dielectric" => vec![f_dielectric(x[0], x[1])],
        "f_conductor" => vec![f_conductor(x[0], x[1], x[2])],
        "ior_from_f0" => vec![ior_from_f0(x[0])],
        "diffuse_eon" => diffuse_eon(v(0), x[3], x[4], x[5], x[6]).to_vec(),
        "directional_albedo_fon" => vec![directional_albedo_fon(x[0], x[1])],
        "energy_compensation" => energy_compensation(v(0), v(3), [x[6], x[7]]).to_vec(),
        other => panic!("`{other}` is not called here"),
    }
}

fn check<R: Scalar>(case: &Case, type_name: &str) {
    let arguments: Vec<R> = case.arguments.iter().map(|x| R::of(f64::from(*x as f32))).collect();
    let value = call(case.function, &arguments)[case.component].to_f64();
    let error = (value - case.answer).abs();
    assert!(
        error <= case.tolerance * case.answer.abs(),
        "{type_name} {} of {:?}: {value}, the right answer is {}",
        case.function,
        case.arguments,
        case.answer
    );
}

fn check_by_name(name: &str) {
    let cases = cases();
    let case = cases.iter().find(|c| c.name == name).expect("a case of the list");
    check::<f32>(case, "f32");
    check::<f64>(case, "f64");
}

macro_rules! named_tests {
    ($($name:ident),* $(,)?) => {
        $(#[test] fn $name() { check_by_name(stringify!($name)); })*
        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

case_names!(named_tests);

#[test]
fn each_case_is_a_test() {
    let mut listed: Vec<_> = cases().iter().map(|c| c.name).collect();
    let mut tested = NAMES.to_vec();
    listed.sort_unstable();
    tested.sort_unstable();
    assert_eq!(listed, tested);
    // f16 ends at 65504.
    assert!(cases().iter().all(|c| c.half.is_none() || c.answer < 65504.0));
}

#[test]
fn answers_are_the_table_s() {
    let Some(table) = table("hard_cases.csv") else { return };
    let mut compared = 0;
    for case in cases() {
        let (name, input) = case.row;
        let mut rows = table.rows().filter(|r| r.text("case") == name && r.text("input").starts_with(input)).peekable();
        assert!(rows.peek().is_some(), "no row {name}, {input}");
        // Answers are written as `4.2`, `V=4; V*n.l=2` or `Lagrange |n x h|^2: 1269 (...)`; some are words.
        let is_it = rows.any(|row| {
            let answer = row.text("right_answer");
            let number = answer.trim_start_matches("V=").trim_start_matches("F(1)=").trim_start_matches("|n x h|^2 = ");
            let end = number.find([' ', ';', ',']).unwrap_or(number.len());
            number[..end].parse::<f64>().is_ok_and(|n| n.is_finite() && (n - case.answer).abs() <= 2e-3 * n.abs())
        });
        compared += usize::from(is_it);
    }
    println!("hard cases: {compared} of {} answers are numbers of the table", cases().len());
    assert!(compared >= 38, "only {compared} answers are in the table");
}

#[test]
fn exact_fon_albedo_at_grazing_angles() {
    let answers = [(0.0, 1.0), (1e-6, 0.999_999_753), (1e-4, 0.999_975_281), (0.01, 0.997_517_224)];
    for (cosine, answer) in answers {
        assert!((directional_albedo_fon_exact(cosine, 1.0_f64) - answer).abs() < 1e-9, "{cosine}");
        let single = directional_albedo_fon_exact(cosine as f32, 1.0_f32);
        assert!((f64::from(single) - answer).abs() < 1.2e-7, "{cosine}: {single}");
    }
}

#[test]
fn vndf_density_of_a_tiny_alpha() {
    // r = 1e-3 at h = n, n.v = 1/4: D G1 / (4 n.v) = D = 1 / (pi alpha^2).
    let alpha = alpha_from_perceptual_roughness(1e-3_f32);
    let pdf = pdf_solid_angle_ggx_vndf(0.25, 1.0, 0.0, alpha);
    assert!((f64::from(pdf) / 3.183_099e11 - 1.0).abs() < 1e-5, "{pdf}");
}

#[test]
fn sampling_at_the_ends_of_its_numbers() {
    for u in [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 1.0 - f32::EPSILON / 2.0]] {
        for alpha in [0.0, 1e-8, 1.0] {
            let h = sample_ggx_vndf(UP, alpha, u);
            assert!(h.iter().all(|x| x.is_finite()) && h[2] >= 0.0, "{u:?}, alpha {alpha}: {h:?}");
        }
    }
}

fn frame(view: [f32; 3]) -> Frame<f32> {
    frame_from_normal(UP, view)
}

fn mirror(alpha: f32) -> Specular<f32> {
    Specular { f0: [1.0; 3], f90: [1.0; 3], alpha }
}

#[test]
fn no_half_vector() {
    // v and l opposite, both in the horizon (`h_zero`), and so with a normal that tilts away from the viewer.
    let p = mirror(0.25);
    assert_eq!(specular_eval(frame([1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0], p), [0.0; 3]);
    let tilted = frame_from_normal([-0.6, 0.0, 0.8], [1.0, 0.0, 0.0]);
    let half = half_from_light(tilted, [-1.0, 0.0, 0.0]);
    assert_eq!((half.n_dot_h, half.l_dot_h, half.sin2_theta_h), (0.0, 0.0, 1.0));
    assert!(specular_eval(tilted, [-1.0, 0.0, 0.0], p).iter().all(|c| (0.0..1.0).contains(c)));
}

#[test]
fn both_at_the_horizon() {
    // V is infinite there, V n.l is 0: whatever alpha, the lobe is 0.
    for alpha in [0.0, 1e-8, 0.5, 1.0] {
        assert_eq!(specular_eval(frame([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0], mirror(alpha)), [0.0; 3]);
    }
}

#[test]
fn roughness_0() {
    // A delta cannot be drawn from a punctual light: 0, in the mirror direction too.
    assert_eq!(d_ggx(1.0, 0.0, 0.0_f32), 0.0);
    assert_eq!([f32::NAN, 2.0, -1.0, f32::INFINITY].map(alpha_from_perceptual_roughness), [1.0, 1.0, 0.0, 1.0]);
    assert_eq!(specular_eval(frame(UP), UP, mirror(0.0)), [0.0; 3]);
}

#[test]
fn behind_the_surface() {
    let p = Diffuse { color: [1.0; 3], perceptual_roughness: 1.0 };
    let below = [0.6, 0.0, -0.8];
    assert_eq!(diffuse_eval(frame(UP), below, p), [0.0; 3]);
    assert_eq!(specular_eval(frame(UP), below, mirror(1.0)), [0.0; 3]);
    // A shading normal that faces away from the viewer (`n.v<0`) is seen at grazing incidence.
    assert_eq!(frame([0.998_749_2, 0.0, -0.05]).n_dot_v, 1e-7);
}

#[test]
fn cosines_above_1() {
    // Dot products of unit f32 vectors reach 1 + 4e-7 (`dot>1`, `schlick_pow`).
    assert_eq!(f_schlick([0.04; 3], [1.0; 3], 1.000_000_1), [0.04; 3]);
    assert_eq!(f_dielectric(1.0, 1.000_000_1_f32), 0.0);
    let long = [0.0, 0.0, 1.000_000_4];
    let half = half_from_light(frame(long), long);
    assert_eq!(half.n_dot_l, 1.0);
    assert_eq!(frame(long).n_dot_v, 1.0);
}

#[test]
fn reflectances_at_their_ends() {
    // `ior_f0`: f0 = 1 implies an infinite index.
    assert!((f_exact([1.0_f32; 3], [1.0; 3], 1.0)[0] - 1.0).abs() < 2e-6);
    assert_eq!(f_exact([0.0_f32; 3], [0.0; 3], 0.5), [0.0; 3]);
    assert_eq!(f_exact([0.0_f32; 3], [1.0; 3], 0.5), [0.0; 3]);
    // KHR_materials_ior: 0 stands for infinite.
    assert_eq!([0.0, -1.0, f32::NAN, f32::INFINITY].map(f0_from_ior), [1.0; 4]);
    assert!((f0_from_ior(1.5_f32) - 0.04).abs() < 1e-8);
    assert_eq!(f0_from_ior(1.0_f32), 0.0);
    // `f0>1 in Kulla-Conty`: no pole.
    assert!((energy_compensation([1.5_f32; 3], [1.0; 3], [0.3, 0.109_137])[0] - 2.444_174).abs() < 1e-5);
    assert!(energy_compensation([1.0_f32; 3], [1.0; 3], [0.0, 0.0]).iter().all(|c| c.is_finite()));
}
