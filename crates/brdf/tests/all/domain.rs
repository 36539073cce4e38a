//! Nothing is NaN, infinite or negative over the documented domain; the lobes are finite for any bits whatever.

use halfvector_brdf::dfg::{dfg_karis, specular_albedo};
use halfvector_brdf::diffuse::diffuse_burley;
use halfvector_brdf::frame::{frame_from_normal, half_from_light};
use halfvector_brdf::fresnel::{f_dielectric, f_exact, f_schlick, f0_from_ior};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::lobe_diffuse::{Diffuse, diffuse_environment, diffuse_eval};
use halfvector_brdf::lobe_specular::{Specular, specular_environment, specular_eval};
use halfvector_brdf::math::normalize_or;
use halfvector_brdf::multiscatter::energy_compensation;
use halfvector_brdf::sampling::{g1_smith_ggx, pdf_solid_angle_ggx_vndf, sample_ggx_vndf};
use proptest::prelude::*;

/// Numbers in [low, 1], as many of each order of magnitude.
pub(crate) fn up_to_1(low: f32) -> impl Strategy<Value = f32> {
    prop_oneof![(low.ln()..=0.0_f32).prop_map(move |x| x.exp().clamp(low, 1.0)), Just(low), Just(1.0)]
}

fn color() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(prop_oneof![0.0..=1.0_f32, Just(0.0), Just(1.0)])
}

/// Unit vectors, axes and neighbours of axes among them.
pub(crate) fn unit() -> impl Strategy<Value = [f32; 3]> {
    let component = prop_oneof![-1.0..=1.0_f32, Just(0.0), Just(1.0), Just(-1.0), -1e-6..1e-6_f32];
    prop::array::uniform3(component).prop_map(|v| normalize_or(v, [0.0, 0.0, 1.0]))
}

/// Any bits, NaN and infinities often among them.
pub(crate) fn any_bits() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        prop::sample::select(vec![
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            0.0,
            -0.0,
            1.0,
            f32::MAX,
            f32::MIN,
            1e-40
        ]),
        -2.0..2.0_f32,
    ]
}

fn any_vector() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(any_bits())
}

fn good(name: &str, values: &[f32]) -> Result<(), TestCaseError> {
    prop_assert!(values.iter().all(|x| x.is_finite() && *x >= 0.0), "{name} is {values:?}");
    Ok(())
}

proptest! {
    #[test]
    fn terms(
        n_dot_v in up_to_1(1e-6), n_dot_l in up_to_1(1e-6), cos_theta in up_to_1(1e-6), roughness in up_to_1(1e-4),
        sin2 in up_to_1(1e-30), eta in 1e-3..1e4_f32, f0 in color(), f90 in color(),
    ) {
        let alpha = alpha_from_perceptual_roughness(roughness);
        let n_dot_h = (1.0 - sin2).sqrt();
        good("d_ggx", &[d_ggx(n_dot_h, sin2, alpha)])?;
        good("v_smith_ggx_correlated", &[v_smith_ggx_correlated(n_dot_v, n_dot_l, cos_theta, alpha)])?;
        good("v_smith_ggx_separable", &[v_smith_ggx_separable(n_dot_v, n_dot_l, cos_theta, alpha)])?;
        good("g1_smith_ggx", &[g1_smith_ggx(n_dot_v, alpha)])?;
        good("pdf", &[pdf_solid_angle_ggx_vndf(n_dot_v, n_dot_h, sin2, alpha)])?;
        good("f_schlick", &f_schlick(f0, f90, cos_theta))?;
        good("f_exact", &f_exact(f0, f90, cos_theta))?;
        good("f_dielectric", &[f_dielectric(eta, cos_theta)])?;
        prop_assert!(f_dielectric(eta, cos_theta) <= 1.000_001);
        good("f0_from_ior", &[f0_from_ior(eta)])?;
        good("diffuse_burley", &diffuse_burley(f0, n_dot_v, n_dot_l, cos_theta, roughness))?;
        let dfg = dfg_karis(n_dot_v, roughness);
        good("dfg_karis", &dfg)?;
        good("specular_albedo", &specular_albedo(f0, f90, dfg))?;
        good("energy_compensation", &energy_compensation(f0, f90, dfg))?;
    }

    #[test]
    fn lobes(normal in unit(), view in unit(), light in unit(), roughness in up_to_1(1e-4), f0 in color(), f90 in color()) {
        let frame = frame_from_normal(normal, view);
        let half = half_from_light(frame, light);
        prop_assert!((0.0..=1.0).contains(&half.n_dot_l) && (0.0..=1.000_001).contains(&half.l_dot_h), "{half:?}");
        let unit_h = half.n_dot_h * half.n_dot_h + half.sin2_theta_h;
        prop_assert!((unit_h - 1.0).abs() < 2e-6, "cos^2 + sin^2 of n and h is {unit_h}");
        let alpha = alpha_from_perceptual_roughness(roughness);
        let specular = specular_eval(frame, light, Specular { f0, f90, alpha });
        let diffuse = diffuse_eval(frame, light, Diffuse { color: f0, perceptual_roughness: roughness });
        good("specular_eval", &specular)?;
        good("diffuse_eval", &diffuse)?;
        if half.n_dot_l == 0.0 {
            prop_assert_eq!((specular, diffuse), ([0.0; 3], [0.0; 3]));
        }
    }

    #[test]
    fn lobes_of_any_bits(
        normal in any_vector(), view in any_vector(), light in any_vector(), f0 in any_vector(), f90 in any_vector(),
        alpha in any_bits(), dfg in prop::array::uniform2(any_bits()),
    ) {
        let frame = frame_from_normal(normal, view);
        prop_assert!((1e-7..=1.0).contains(&frame.n_dot_v));
        prop_assert!((0.0..=1.0).contains(&half_from_light(frame, light).n_dot_l));
        let specular = Specular { f0, f90, alpha };
        let diffuse = Diffuse { color: f0, perceptual_roughness: alpha };
        let results = [
            specular_eval(frame, light, specular),
            specular_environment(specular, light, dfg),
            diffuse_eval(frame, light, diffuse),
            diffuse_environment(diffuse, light),
        ];
        prop_assert!(results.as_flattened().iter().all(|x| x.is_finite()), "{results:?}");
        let alpha = alpha_from_perceptual_roughness(alpha);
        prop_assert!((0.0..=1.0).contains(&alpha), "alpha is {alpha}");
    }

    #[test]
    fn terms_of_any_finite_number(
        a in any_bits(), b in any_bits(), roughness in any_bits(), f0 in any_vector(), dfg in prop::array::uniform2(any_bits()),
    ) {
        let alpha = alpha_from_perceptual_roughness(roughness);
        if a.is_finite() && b.is_finite() && a.abs() < 1e15 && b.abs() < 1e15 {
            good("d_ggx", &[d_ggx(a, b, alpha)])?;
            good("v_smith_ggx_correlated", &[v_smith_ggx_correlated(a.abs(), b.abs(), a, alpha)])?;
            good("v_smith_ggx_separable", &[v_smith_ggx_separable(a.abs(), b.abs(), a, alpha)])?;
        }
        good("f0_from_ior", &[f0_from_ior(a)])?;
        good("f_dielectric", &[f_dielectric(a.abs(), b)])?;
        if f0.iter().chain(&dfg).all(|x| x.is_finite() && x.abs() < 1e30) {
            prop_assert!(energy_compensation(f0, f0, dfg).iter().all(|x| x.is_finite()));
        }
        let h = sample_ggx_vndf([a, b, 0.5], alpha, [0.25, 0.75]);
        prop_assert!(h.iter().all(|x| x.is_finite()), "{h:?}");
    }
}
