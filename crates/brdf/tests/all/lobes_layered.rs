//! Sheen and anisotropy: exchange of v and l, energy, and arguments that are no numbers.

use halfvector_brdf::albedo::{directional_albedo_charlie, gauss_legendre};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::lobe_anisotropic::{
    Anisotropic, anisotropic_alphas_gltf, anisotropic_alphas_openpbr, anisotropic_environment, anisotropic_eval,
    anisotropic_reflection,
};
use halfvector_brdf::lobe_sheen::{Sheen, sheen_albedo, sheen_base, sheen_environment, sheen_eval};
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::math::PI;
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::vector::dot;
use proptest::prelude::*;

use crate::lobes::{direction, exchange, seen_from};

proptest! {
    #[test]
    fn reciprocal_forms(zv in 0.01..1.0_f64, zl in 0.01..1.0_f64, phi in 0.0..6.3_f64, r in 0.1..1.0_f64, strength in 0.0..1.0_f64) {
        let (v, l) = (direction(zv, 0.3), direction(zl, phi));
        let sheen = Sheen { color: [0.8; 3], perceptual_roughness: r };
        prop_assert!(exchange(|v, l| sheen_eval(seen_from(v), l, sheen)[0], v, l) < 1e-9);
        for [alpha_t, alpha_b] in [anisotropic_alphas_gltf(r, strength), anisotropic_alphas_openpbr(r, 0.99 * strength)] {
            let p = Anisotropic { f0: [0.5; 3], f90: [1.0; 3], tangent: [1.0, 0.0, 0.0], alpha_t, alpha_b };
            prop_assert!(exchange(|v, l| anisotropic_eval(seen_from(v), l, p)[0], v, l) < 1e-9);
        }
        // No anisotropy is the isotropic lobe.
        let [alpha_t, alpha_b] = anisotropic_alphas_gltf(r, 0.0);
        let p = Anisotropic { f0: [0.5; 3], f90: [1.0; 3], tangent: [1.0, 0.0, 0.0], alpha_t, alpha_b };
        let there = anisotropic_eval(seen_from(v), l, p)[0];
        let isotropic = specular_eval(seen_from(v), l, Specular { f0: [0.5; 3], f90: [1.0; 3], alpha: r * r })[0];
        prop_assert!((there - isotropic).abs() <= 1e-9 * isotropic.max(1e-6), "{there} {isotropic}");
    }

    #[test]
    fn lobes_of_any_bits_are_finite(bits in prop::array::uniform24(any::<u32>())) {
        let x = bits.map(f32::from_bits);
        let at = |i: usize| [x[i], x[i + 1], x[i + 2]];
        let frame = frame_from_normal(at(0), at(3));
        let sheen = Sheen { color: at(6), perceptual_roughness: x[9] };
        let p = Anisotropic { f0: at(6), f90: at(9), tangent: at(12), alpha_t: x[15], alpha_b: x[16] };
        for c in [
            sheen_eval(frame, at(17), sheen),
            sheen_environment(sheen, x[20], at(17)),
            anisotropic_eval(frame, at(17), p),
            anisotropic_environment(p, at(17), [x[20], x[21]]),
        ] {
            prop_assert!(c.iter().all(|x| x.is_finite()), "{c:?}");
        }
        prop_assert!((0.0..=1.0).contains(&sheen_base(sheen, x[20])));
        prop_assert!(sheen_albedo(x[20], x[21]).is_finite());
    }
}

/// The integral over the hemisphere of f(n.l, azimuth from v) with weight 1 (f has n.l in it).
fn over_hemisphere(f: impl Fn([f64; 3]) -> f64) -> f64 {
    let rule = gauss_legendre::<32>();
    let mut sum = 0.0;
    for [x, w] in rule {
        let t = (x + 1.0) / 2.0;
        for k in 0..128 {
            let phi = 2.0 * PI * (f64::from(k) + 0.5) / 128.0;
            sum += w / 2.0 * 2.0 * t * (2.0 * PI / 128.0) * f(direction(t * t, phi));
        }
    }
    sum
}

#[test]
fn sheen_reflects_no_more_than_arrives() {
    let (mut worst, mut most, mut published, mut differs) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for roughness in [0.1, 0.2, 0.3, 0.5, 0.7, 1.0] {
        let alpha = roughness * roughness;
        for n_dot_v in [0.004, 0.02, 0.1, 0.3, 0.6, 1.0] {
            let frame = seen_from(direction(n_dot_v, 0.0));
            let raw = over_hemisphere(|l| {
                let h = halfvector_brdf::frame::half_from_light(frame, l);
                d_charlie(h.n_dot_h, h.sin2_theta_h, alpha) * v_neubelt(n_dot_v, h.n_dot_l, h.l_dot_h, alpha) * l[2]
            });
            let fit = sheen_albedo(n_dot_v, roughness);
            worst = worst.max((fit - raw).abs() / raw.max(1.0));
            let truth = directional_albedo_charlie(n_dot_v, roughness);
            differs = differs.max((truth - raw).abs() / raw.max(1.0));
            published = published.max(raw);
            let sheen = Sheen { color: [1.0; 3], perceptual_roughness: roughness };
            let held = over_hemisphere(|l| sheen_eval(frame, l, sheen)[0]);
            let base = sheen_base(sheen, n_dot_v);
            most = most.max(held + base);
            assert!(held <= 1.0 + 1e-3 && base >= 0.0, "{roughness} {n_dot_v}: {held} {base}");
            assert!(held + base < 1.03, "{roughness} {n_dot_v}: {held} and {base} of the base");
        }
    }
    println!(
        "sheen: the fit is off by {worst:.4}, E reaches {published:.2} as published; with the base at most {most:.4}"
    );
    println!("two quadratures of E differ by {differs:.1e}");
    assert!(worst < 0.05 && published > 3.0 && differs < 1e-3);
}

#[test]
fn alphas_of_anisotropy() {
    assert_eq!(anisotropic_alphas_gltf(0.5, 0.0), [0.25, 0.25]);
    assert_eq!(anisotropic_alphas_gltf(0.5, 1.0), [1.0, 0.25]);
    assert_eq!(anisotropic_alphas_gltf(f64::NAN, -1.0), [0.0, 0.0]);
    let [t, b] = anisotropic_alphas_openpbr(0.5_f64, 0.6);
    assert!((t * t + b * b - 2.0 * 0.0625).abs() < 1e-15 && (b / t - 0.4).abs() < 1e-15);
}

#[test]
fn bent_reflections() {
    let frame = seen_from(direction(0.6, 0.4));
    let tangent = [1.0, 0.0, 0.0];
    let plain = anisotropic_reflection(frame, tangent, 0.0, 0.5);
    let mirror = [-frame.view_dir[0], -frame.view_dir[1], frame.view_dir[2]];
    for i in 0..3 {
        assert!((plain[i] - mirror[i]).abs() < 1e-12);
    }
    let bent = anisotropic_reflection(frame, tangent, 0.9, 0.2);
    assert!((dot(bent, bent) - 1.0).abs() < 1e-12 && (bent[0] - plain[0]).abs() > 0.05);
    // Seen along the bitangent there is no plane to bend to.
    let along = frame_from_normal([0.0, 0.0, 1.0_f64], [0.0, 1.0, 0.0]);
    assert!(anisotropic_reflection(along, tangent, 1.0, 0.0).iter().all(|x| x.is_finite()));
}
