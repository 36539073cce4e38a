//! The error of each function's f32 form, in units of the last place of the f64 form's value, over a lattice of the
//! documented domain. The figures in the functions' documentation are these bounds.

use halfvector_brdf::Scalar;
use halfvector_brdf::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use halfvector_brdf::beckmann::{v_smith_beckmann_correlated, v_smith_beckmann_separable};
use halfvector_brdf::dfg::dfg_karis;
use halfvector_brdf::diffuse::{
    average_albedo_fon, diffuse_burley, directional_albedo_eon, directional_albedo_fon, directional_albedo_fon_exact,
};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_exact, f_f82_tint, f_schlick, f0_from_ior, ior_from_f0};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::math::{normalize_or, pow5};
use halfvector_brdf::multiscatter::energy_compensation;
use halfvector_brdf::sampling::{g1_smith_ggx, pdf_solid_angle_ggx_vndf};
use halfvector_brdf::sheen::v_neubelt;
use halfvector_brdf::thin_film::f_thin_film;
use halfvector_brdf::visibility::{v_cook_torrance, v_hammon, v_kelemen, v_schlick_smith};

/// A function of four numbers in [0, 1), in both types.
struct Case {
    name: &'static str,
    f32: fn([f32; 4]) -> f32,
    f64: fn([f64; 4]) -> f64,
    /// Bound of the error in ulp.
    ulp: f64,
    /// Smallest value whose ulp counts: a smaller one has the error of this one.
    floor: f64,
}

macro_rules! case {
    ($name:literal, $ulp:expr, $floor:expr, |$u:ident| $body:expr) => {{
        fn body<R: Scalar>($u: [R; 4]) -> R {
            $body
        }
        Case { name: $name, f32: body::<f32>, f64: body::<f64>, ulp: $ulp, floor: $floor }
    }};
}

/// u of [0, 1) to a cosine in (1e-6, 1): half of them uniform, half logarithmic.
fn cosine<R: Scalar>(u: R) -> R {
    log_uniform(u, -20.0)
}

fn roughness<R: Scalar>(u: R) -> R {
    log_uniform(u, -13.3)
}

/// 2^(low u') or uniform: the same number in both types, by rounding to 20 bits below its leading one.
fn log_uniform<R: Scalar>(u: R, low: f64) -> R {
    let u = u.to_f64();
    let x = if u < 0.5 { (low * 2.0 * u).exp2() } else { 2.0 * u - 1.0 + 1e-6 };
    R::of(f64::from(x as f32))
}

fn cases() -> Vec<Case> {
    vec![
        case!("pow5", 3.0, 0.0, |u| pow5(cosine(u[0]))),
        case!("normalize_or", 3.0, 0.0, |u| normalize_or(
            [cosine(u[0]), -cosine(u[1]), cosine(u[2])],
            [R::ZERO, R::ZERO, R::ONE]
        )[2]),
        case!("alpha_from_perceptual_roughness", 0.5, 0.0, |u| alpha_from_perceptual_roughness(roughness(u[0]))),
        // sin^2 logarithmic from 1e-12: the cosine goes with it.
        case!("d_ggx", 8.0, 0.0, |u| {
            let sin2 = f64::from((2f64).powf(-40.0 * u[1].to_f64()) as f32);
            let n_dot_h = f64::from((1.0 - sin2).sqrt() as f32);
            d_ggx(R::of(n_dot_h), R::of(sin2), alpha_of(u[0]))
        }),
        case!("v_smith_ggx_correlated", 4.0, 0.0, |u| v_smith_ggx_correlated(
            cosine(u[0]),
            cosine(u[1]),
            R::ZERO,
            alpha_of(u[2])
        )),
        case!("v_smith_ggx_separable", 5.0, 0.0, |u| v_smith_ggx_separable(
            cosine(u[0]),
            cosine(u[1]),
            R::ZERO,
            alpha_of(u[2])
        )),
        case!("g1_smith_ggx", 3.0, 0.0, |u| g1_smith_ggx(cosine(u[0]), alpha_of(u[1]))),
        case!("pdf_solid_angle_ggx_vndf", 10.0, 0.0, |u| {
            let sin2 = f64::from((2f64).powf(-40.0 * u[1].to_f64()) as f32);
            let n_dot_h = f64::from((1.0 - sin2).sqrt() as f32);
            pdf_solid_angle_ggx_vndf(cosine(u[2]), R::of(n_dot_h), R::of(sin2), alpha_of(u[0]))
        }),
        // Relative to values of 0.02 and more: at f0 = 0, 1 - l.h has the error of one rounding of 1. f90 >= f0.
        case!("f_schlick", 8.0, 0.02, |u| {
            f_schlick([unit(u[0]) * unit(u[1]); 3], [unit(u[1]); 3], cosine(u[2]))[0]
        }),
        case!("f_exact", 64.0, 0.02, |u| f_exact([unit(u[0]) * R::of(0.875); 3], [R::ONE; 3], cosine(u[2]))[0]),
        case!("f_dielectric", 16.0, 1e-4, |u| f_dielectric(unit(u[0]) * R::of(2.0) + R::ONE, cosine(u[1]))),
        case!("f0_from_ior", 2.0, 0.0, |u| f0_from_ior(unit(u[0]) * R::of(2.0) + R::ONE)),
        case!("diffuse_burley", 8.0, 0.0, |u| diffuse_burley(
            [R::ONE; 3],
            cosine(u[0]),
            cosine(u[1]),
            cosine(u[2]),
            roughness(u[3])
        )[0]),
        case!("dfg_karis a", 4.0, 1.0, |u| dfg_karis(cosine(u[0]), roughness(u[1]))[0]),
        case!("dfg_karis b", 4.0, 1.0, |u| dfg_karis(cosine(u[0]), roughness(u[1]))[1]),
        case!("d_ggx_anisotropic", 12.0, 0.0, |u| {
            let (x, y) = (cosine::<R>(u[0]), cosine::<R>(u[1]));
            d_ggx_anisotropic([x * R::of(0.5), y * R::of(0.5), R::of(0.75)], alpha_of(u[2]), alpha_of(u[3]))
        }),
        case!("v_smith_ggx_anisotropic", 6.0, 0.0, |u| {
            let (view, light) =
                ([cosine(u[0]), cosine(u[3]), cosine(u[1])], [cosine(u[1]), cosine(u[0]), cosine(u[3])]);
            v_smith_ggx_anisotropic(view, light, alpha_of(u[2]), alpha_of(u[3]))
        }),
        case!("v_smith_beckmann_correlated", 10.0, 0.0, |u| {
            v_smith_beckmann_correlated(cosine(u[0]), cosine(u[1]), R::ZERO, alpha_of(u[2]))
        }),
        case!("v_smith_beckmann_separable", 10.0, 0.0, |u| {
            v_smith_beckmann_separable(cosine(u[0]), cosine(u[1]), R::ZERO, alpha_of(u[2]))
        }),
        case!("v_hammon", 6.0, 0.0, |u| v_hammon(cosine(u[0]), cosine(u[1]), R::ZERO, alpha_of(u[2]))),
        case!("v_schlick_smith", 10.0, 0.0, |u| v_schlick_smith(cosine(u[0]), cosine(u[1]), R::ZERO, alpha_of(u[2]))),
        case!("v_cook_torrance", 6.0, 0.0, |u| v_cook_torrance(cosine(u[0]), cosine(u[1]), cosine(u[2]), R::ONE)),
        case!("v_kelemen", 3.0, 0.0, |u| v_kelemen(R::ONE, R::ONE, cosine(u[0]), R::ONE)),
        case!("v_neubelt", 4.0, 0.0, |u| v_neubelt(cosine(u[0]), cosine(u[1]), R::ONE, R::ONE)),
        case!("ior_from_f0", 6.0, 0.0, |u| ior_from_f0(unit(u[0]) * R::of(0.875))),
        case!("f_f82_tint", 6.0, 1.0, |u| f_f82_tint([unit(u[0]); 3], [unit(u[1]); 3], cosine(u[2]))[0]),
        case!("f_conductor", 16.0, 0.01, |u| {
            f_conductor(unit(u[0]) * R::of(16.0) + R::of(0.0009765625), unit(u[1]) * R::of(16.0), cosine(u[2]))
        }),
        case!("average_albedo_fon", 3.0, 0.0, |u| average_albedo_fon(roughness(u[0]))),
        case!("directional_albedo_fon", 6.0, 0.0, |u| directional_albedo_fon(cosine(u[0]), roughness(u[1]))),
        case!("directional_albedo_fon_exact", 4.0, 0.0, |u| directional_albedo_fon_exact(
            cosine(u[0]),
            roughness(u[1])
        )),
        case!("directional_albedo_eon", 12.0, 0.0, |u| {
            directional_albedo_eon([unit(u[0]); 3], cosine(u[1]), roughness(u[2]))[0]
        }),
        // In ulp of 1: 1e-5.
        case!("f_thin_film", 168.0, 1.0, |u| {
            let base = unit(u[2]) * R::of(4.0) + R::of(0.25);
            f_thin_film(
                unit(u[0]) * R::of(2.0) + R::ONE,
                unit(u[1]) * R::of(1000.0),
                [base; 3],
                [base; 3],
                cosine(u[3]),
            )[1]
        }),
        case!("energy_compensation", 2.0, 0.0, |u| energy_compensation(
            [unit(u[0]); 3],
            [R::ONE; 3],
            [unit(u[1]) * R::of(0.5), R::of(0.375)]
        )[0]),
    ]
}

fn alpha_of<R: Scalar>(u: R) -> R {
    // Squared in f32: both types get the same alpha.
    R::of(f64::from(alpha_from_perceptual_roughness(roughness::<f32>(u.to_f64() as f32))))
}

/// u rounded so that sums and products of it with small whole numbers are exact in f32.
fn unit<R: Scalar>(u: R) -> R {
    R::of((u.to_f64() * 4096.0).floor() / 4096.0)
}

/// Distance in units of the last place of an f32 of the size of `truth`, or of `floor` where that is more.
fn ulps(value: f32, truth: f64, floor: f64) -> f64 {
    let size = truth.abs().max(floor).max(f64::from(f32::MIN_POSITIVE)) as f32;
    let ulp = f64::from(f32::from_bits(size.to_bits() + 1)) - f64::from(size);
    (f64::from(value) - truth).abs() / ulp
}

#[test]
fn f32_is_within_the_stated_ulps() {
    const POINTS: u32 = 200_000;
    // The R4 sequence (Roberts 2018): powers of 1 / g, g^5 = g + 1.
    let g = 1.167_303_978_261_418_7_f64;
    let mut failures = Vec::new();
    for case in cases() {
        let (mut worst, mut at) = (0.0, [0.0_f32; 4]);
        for i in 0..POINTS {
            let u32 = [1, 2, 3, 4].map(|k| (0.5 + f64::from(i) * g.powi(-k)).fract() as f32 * 0.999_999);
            let error = ulps((case.f32)(u32), (case.f64)(u32.map(f64::from)), case.floor);
            // NaN is the worst error of all.
            if error.is_nan() || error > worst {
                (worst, at) = (error, u32);
            }
        }
        println!("f32 {}: max {worst:.2} ulp (bound {})", case.name, case.ulp);
        if worst.is_nan() || worst > case.ulp {
            failures.push(format!("{}: {worst:.2} ulp at {at:?}, bound {}", case.name, case.ulp));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
