//! Every term over every f32 of its domain, denormal numbers included: nothing is NaN, infinite or negative.

use halfvector_brdf::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use halfvector_brdf::beckmann::{
    d_beckmann, v_smith_beckmann_correlated, v_smith_beckmann_exact, v_smith_beckmann_separable,
};
use halfvector_brdf::diffuse::{
    average_albedo_fon, diffuse_burley, diffuse_eon, diffuse_eon_exact, diffuse_fon, diffuse_lambert,
    diffuse_oren_nayar, directional_albedo_eon, directional_albedo_fon, directional_albedo_fon_exact,
};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_exact, f_f82_tint, f_schlick, f0_from_ior, ior_from_f0};
use halfvector_brdf::ggx::{alpha_from_perceptual_roughness, d_ggx, v_smith_ggx_correlated, v_smith_ggx_separable};
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::thin_film::f_thin_film;
use halfvector_brdf::visibility::{v_cook_torrance, v_hammon, v_kelemen, v_schlick_smith};
use proptest::prelude::*;

type Visibility = fn(f32, f32, f32, f32) -> f32;
type Diffuse = fn([f32; 3], f32, f32, f32, f32) -> [f32; 3];

/// Every f32 from 0 to 1, each as likely as another: half of them below 1e-19, one in 127 a denormal number.
fn unit() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => (0..=1.0_f32.to_bits()).prop_map(f32::from_bits),
        4 => 0.0..=1.0_f32,
        1 => (0..0x80_0000_u32).prop_map(f32::from_bits),
        1 => prop::sample::select(vec![0.0, 1.0, f32::MIN_POSITIVE, 1e-40, f32::from_bits(1)]),
    ]
}

/// Every finite f32 from 0 on.
fn positive() -> impl Strategy<Value = f32> {
    prop_oneof![(0..=f32::MAX.to_bits()).prop_map(f32::from_bits), 0.0..10.0_f32]
}

fn color() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(unit())
}

fn good(name: &str, values: &[f32]) -> Result<(), TestCaseError> {
    prop_assert!(values.iter().all(|x| x.is_finite() && *x >= 0.0), "{name} is {values:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: std::env::var("PROPTEST_CASES").ok().and_then(|c| c.parse().ok()).unwrap_or(4096), ..ProptestConfig::default() })]

    #[test]
    fn distributions_and_visibilities(n_dot_v in unit(), n_dot_l in unit(), l_dot_h in unit(), roughness in unit(), sin2 in unit(), width in unit()) {
        let alpha = alpha_from_perceptual_roughness(roughness);
        // n.h of this sine, and any n.h: what rounding makes of the two.
        for n_dot_h in [(1.0 - sin2).sqrt(), l_dot_h] {
            good("d_ggx", &[d_ggx(n_dot_h, sin2, alpha)])?;
            good("d_charlie", &[d_charlie(n_dot_h, sin2, alpha)])?;
        }
        let (sin, cos) = (sin2.sqrt(), (1.0 - sin2).sqrt());
        good("d_ggx_anisotropic", &[d_ggx_anisotropic([0.6 * sin, 0.8 * sin, cos], alpha, width)])?;
        // Beckmann's cos^4 in the denominator needs the sine that belongs to it.
        good("d_beckmann", &[d_beckmann((1.0 - sin2).sqrt(), sin2, alpha), d_beckmann(sin2, 1.0 - sin2 * sin2, alpha)])?;
        let forms: [(&str, Visibility); 10] = [
            ("v_smith_ggx_correlated", v_smith_ggx_correlated),
            ("v_smith_ggx_separable", v_smith_ggx_separable),
            ("v_smith_beckmann_correlated", v_smith_beckmann_correlated),
            ("v_smith_beckmann_separable", v_smith_beckmann_separable),
            ("v_smith_beckmann_exact", v_smith_beckmann_exact),
            ("v_hammon", v_hammon),
            ("v_schlick_smith", v_schlick_smith),
            ("v_cook_torrance", v_cook_torrance),
            ("v_kelemen", v_kelemen),
            ("v_neubelt", v_neubelt),
        ];
        for (name, form) in forms {
            good(name, &[form(n_dot_v, n_dot_l, l_dot_h, alpha)])?;
        }
        let (view, light) = ([sin2, l_dot_h, n_dot_v], [l_dot_h, sin2, n_dot_l]);
        good("v_smith_ggx_anisotropic", &[v_smith_ggx_anisotropic(view, light, alpha, width)])?;
    }

    #[test]
    fn reflectances(f0 in color(), f90 in color(), cosine in unit(), eta in positive(), k in positive(), thickness in positive()) {
        good("f_schlick", &f_schlick(f0, f90, cosine))?;
        good("f_exact", &f_exact(f0, f90, cosine))?;
        good("f0_from_ior", &[f0_from_ior(eta)])?;
        good("ior_from_f0", &[ior_from_f0(f0[0])])?;
        let held = [f_f82_tint(f0, f90, cosine), f_thin_film(eta, thickness, [eta, k, 1.5], [k, eta, 0.0], cosine)];
        good("f_f82_tint, f_thin_film", held.as_flattened())?;
        prop_assert!(held.as_flattened().iter().all(|f| *f <= 1.0));
        let eta = eta.max(1e-3);
        let both = [f_dielectric(eta, cosine), f_conductor(eta, k, cosine)];
        good("f_dielectric, f_conductor", &both)?;
        prop_assert!(both.iter().all(|f| *f <= 1.000_001), "{both:?} of {eta} {k} {cosine}");
    }

    #[test]
    fn diffuse_forms(albedo in color(), n_dot_v in unit(), n_dot_l in unit(), l_dot_h in unit(), roughness in unit()) {
        let forms: [(&str, Diffuse); 6] = [
            ("diffuse_lambert", diffuse_lambert),
            ("diffuse_burley", diffuse_burley),
            ("diffuse_oren_nayar", diffuse_oren_nayar),
            ("diffuse_fon", diffuse_fon),
            ("diffuse_eon", diffuse_eon),
            ("diffuse_eon_exact", diffuse_eon_exact),
        ];
        for (name, form) in forms {
            good(name, &form(albedo, n_dot_v, n_dot_l, l_dot_h, roughness))?;
        }
        let albedos =
            [directional_albedo_fon(n_dot_v, roughness), directional_albedo_fon_exact(n_dot_v, roughness), average_albedo_fon(roughness)];
        good("albedos of FON", &albedos)?;
        let eon = directional_albedo_eon(albedo, n_dot_v, roughness);
        good("directional_albedo_eon", &eon)?;
        prop_assert!(albedos.iter().chain(&eon).all(|e| *e <= 1.0005), "{albedos:?} {eon:?}");
    }
}
