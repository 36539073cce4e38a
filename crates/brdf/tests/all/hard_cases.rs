//! The rows of `hard_cases.csv` that speak of D, V, the half vector and Fresnel, in f32: each row's right answer is ours.

use halfvector_brdf::frame::{Frame, frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_dielectric, f_exact, f_schlick, f0_from_ior};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated};
use halfvector_brdf::lobe_diffuse::{Diffuse, diffuse_eval};
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::multiscatter::energy_compensation;

use crate::data::table;

const UP: [f32; 3] = [0.0, 0.0, 1.0];

fn d_peak(roughness: f32) -> f32 {
    d_ggx(1.0, 0.0, alpha_from_perceptual_roughness(roughness))
}

/// D at the half-width of the highlight, tan(theta_h) = alpha.
fn d_off_peak(roughness: f32) -> f32 {
    let alpha = f64::from(roughness).powi(2);
    let cos2 = 1.0 / (1.0 + alpha * alpha);
    d_ggx(cos2.sqrt() as f32, (alpha * alpha * cos2) as f32, alpha_from_perceptual_roughness(roughness))
}

fn frame(view: [f32; 3]) -> Frame<f32> {
    frame_from_normal(UP, view)
}

fn mirror(alpha: f32) -> Specular<f32> {
    Specular { f0: [1.0; 3], f90: [1.0; 3], alpha }
}

/// (case, start of the input, our value, relative tolerance); the right answer is the table's.
fn cases() -> Vec<(&'static str, &'static str, f32, f64)> {
    let tiny = half_from_light(frame([1.0, 0.0, 1e-4]), [-1.0, 1e-7, 1e-4]);
    let v =
        |n_dot_v, n_dot_l, r| v_smith_ggx_correlated(n_dot_v, n_dot_l, 0.0, alpha_from_perceptual_roughness::<f32>(r));
    let sin2_of_angle = |angle: f32| {
        let normal = [0.0, 0.0, 1.0];
        // l and v on both sides of a half vector at this angle from n: v = n, l = n turned by 2 angle.
        let (s, c) = (2.0 * f64::from(angle)).sin_cos();
        half_from_light(frame_from_normal(normal, UP), [s as f32, 0.0, c as f32]).sin2_theta_h
    };
    vec![
        ("D_peak_f32", "roughness=0.0001,", d_peak(0.0001), 1e-5),
        ("D_peak_f32", "roughness=0.01,", d_peak(0.01), 1e-5),
        ("D_peak_f32", "roughness=0.02,", d_peak(0.02), 1e-5),
        ("D_peak_f32", "roughness=0.045,", d_peak(0.045), 1e-5),
        ("D_peak_f32", "roughness=0.089,", d_peak(0.089), 1e-5),
        ("D_offpeak_f32", "r=0.02,", d_off_peak(0.02), 3e-6),
        ("D_offpeak_f32", "r=0.045,", d_off_peak(0.045), 3e-6),
        ("D_offpeak_f32", "r=0.089,", d_off_peak(0.089), 3e-6),
        ("D_offpeak_f32", "r=0.2,", d_off_peak(0.2), 3e-6),
        ("V_grazing_f32", "n.v=0, n.l=0.5", v(0.0, 0.5, 0.5), 1e-6),
        ("V_grazing_f32", "n.v=0.0001, n.l=0.5", v(1e-4, 0.5, 0.5), 2e-6),
        ("V_grazing_f32", "n.v=1e-20, n.l=0.5", v(1e-20, 0.5, 0.5), 1e-6),
        ("V_grazing_f32", "n.v=1e-30, n.l=1e-30", v(1e-30, 1e-30, 0.5), 1e-6),
        ("V_grazing_f32", "n.v=1e-06, n.l=1e-06", v(1e-6, 1e-6, 1e-4), 5e-6),
        ("h_tiny", "v=(1,0,1e-4)", tiny.l_dot_h, 1e-6),
        ("voh_from_vol", "same", tiny.l_dot_h, 1e-6),
        ("sin2_cancel", "theta_h=1e-4", sin2_of_angle(1e-4), 1e-6),
        ("sin2_cancel", "theta_h=3e-4", sin2_of_angle(3e-4), 1e-6),
        ("schlick_f0_eq_1", "f0=1", f_schlick([1.0; 3], [1.0; 3], 0.3)[0], 0.0),
        ("fresnel_diel", "eta=1, cos=0.001", f_dielectric(1.0, 0.001), 0.0),
        ("fresnel_diel", "eta=1, cos=0.7", f_dielectric(1.0, 0.7), 0.0),
        ("fresnel_diel", "eta=1.001, cos=0.001", f_dielectric(1.001, 0.001), 1e-5),
        // 1.001 is not an f32: the nearest one is 1.6e-8 off, which is 3e-5 of what eta exceeds 1 by.
        ("fresnel_diel", "eta=1.001, cos=0.7", f_dielectric(1.001, 0.7), 1e-4),
        ("fresnel_diel", "eta=0.6666667, cos=0.001", f_dielectric(0.6666667, 0.001), 0.0),
        ("fresnel_diel", "eta=0.6666667, cos=0.7", f_dielectric(0.6666667, 0.7), 0.0),
    ]
}

#[test]
fn right_answers() {
    let Some(table) = table("hard_cases.csv") else { return };
    let cases = cases();
    for (case, input, ours, tolerance) in &cases {
        let row = table
            .rows()
            .find(|r| r.text("case") == *case && r.text("input").starts_with(input))
            .unwrap_or_else(|| panic!("no row {case}, {input}"));
        let answer = row.text("right_answer");
        // Answers are written as `4.2`, `V=4; V*n.l=2` or `Lagrange |n x h|^2: 1269 (...)`.
        let number = answer.trim_start_matches("V=").split("^2: ").last().unwrap_or(answer);
        let end = number.find([' ', ';', ',']).unwrap_or(number.len());
        let (answer, ours) = (number[..end].parse::<f64>().expect("a number"), f64::from(*ours));
        assert!((ours - answer).abs() <= tolerance * answer, "{case}, {input}: {ours} instead of {answer}");
    }
    println!("hard cases: {} rows", cases.len());
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
    assert_eq!(d_peak(0.0), 0.0);
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
    assert!((energy_compensation([1.5_f32; 3], [0.3, 0.109_137])[0] - 3.166_261).abs() < 1e-5);
    assert!(energy_compensation([1.0_f32; 3], [0.0, 0.0]).iter().all(|c| c.is_finite()));
}
