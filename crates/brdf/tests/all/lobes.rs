//! The lobes: exchange of v and l, what they leave to the base, and arguments that are no numbers.

use halfvector_brdf::albedo::directional_albedo_ggx;
use halfvector_brdf::coupling::{coupling_light, coupling_single};
use halfvector_brdf::frame::{Frame, frame_from_normal};
use halfvector_brdf::fresnel::f0_from_ior;
use halfvector_brdf::lobe_coat::{Coat, coat_base, coat_environment, coat_eval};
use halfvector_brdf::lobe_multiscatter::{multiscatter_environment, multiscatter_eval, multiscatter_from_dfg};
use halfvector_brdf::lobe_sampling::{
    transmission_pdf, transmission_sample, transmission_thin_pdf, transmission_thin_sample,
};
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use halfvector_brdf::lobe_transmission::{
    Transmission, f0_of_sheet, transmission_compensation, transmission_direction, transmission_environment,
    transmission_eval, transmission_thin_compensation, transmission_thin_eval,
};
use halfvector_brdf::vector::{dot, scale};
use proptest::prelude::*;

pub(crate) const UP: [f64; 3] = [0.0, 0.0, 1.0];

pub(crate) fn direction(z: f64, phi: f64) -> [f64; 3] {
    let s = (1.0 - z * z).sqrt();
    [s * phi.cos(), s * phi.sin(), z]
}

pub(crate) fn seen_from(view: [f64; 3]) -> Frame<f64> {
    frame_from_normal(UP, view)
}

/// Relative difference of a BRDF (times n.l) and itself with v and l exchanged.
pub(crate) fn exchange(eval: impl Fn([f64; 3], [f64; 3]) -> f64, v: [f64; 3], l: [f64; 3]) -> f64 {
    let (there, back) = (eval(v, l) / l[2].abs(), eval(l, v) / v[2].abs());
    (there - back).abs() / there.abs().max(back.abs()).max(1e-9)
}

proptest! {
    #[test]
    fn reciprocal_forms(
        zv in 0.01..1.0_f64, zl in 0.01..1.0_f64, phi in 0.0..6.3_f64, alpha in 0.01..1.0_f64, f0 in 0.0..1.0_f64,
        loss in 0.001..0.6_f64,
    ) {
        let (v, l) = (direction(zv, 0.3), direction(zl, phi));
        let specular = Specular { f0: [f0; 3], f90: [1.0; 3], alpha };
        prop_assert!(exchange(|v, l| specular_eval(seen_from(v), l, specular)[0], v, l) < 1e-10);
        let coat = Coat { weight: 0.7, color: [0.5; 3], f0: 0.1 * f0, alpha };
        prop_assert!(exchange(|v, l| coat_eval(seen_from(v), l, coat)[0], v, l) < 1e-10);
        // Any loss that depends on the cosine alone will do.
        let pair = |z: f64| [1.0 - loss * z, 0.0];
        let multiscatter = |v: [f64; 3], l: [f64; 3]| {
            let p = multiscatter_from_dfg([f0; 3], [1.0; 3], pair(v[2]), alpha.sqrt());
            multiscatter_eval(seen_from(v), l, p, pair(l[2]))[0]
        };
        prop_assert!(exchange(multiscatter, v, l) < 1e-9);
        let coupled = |v: [f64; 3], l: [f64; 3]| {
            coupling_single(0.04, 1.0, pair(v[2])) * coupling_light(0.04, 1.0, pair(l[2]), alpha.sqrt()) * l[2]
        };
        prop_assert!(exchange(coupled, v, l) < 1e-10);
        let thin = Transmission { color: [1.0; 3], eta: 1.0 + f0, alpha };
        let below = scale(l, -1.0);
        let there = transmission_thin_eval(seen_from(v), below, thin)[0] / zl;
        // Seen from below, the normal is turned.
        let back = transmission_thin_eval(frame_from_normal(scale(UP, -1.0), below), v, thin)[0] / zv;
        prop_assert!((there - back).abs() <= 1e-9 * there.max(1e-6), "{there} {back}");
        // Solid: f(v, l) eta^2 is the same from both sides.
        let eta = 1.1 + f0;
        let inside = Transmission { eta: 1.0 / eta, ..thin };
        let there = transmission_eval(seen_from(v), below, Transmission { eta, ..thin })[0] / zl * eta * eta;
        let back = transmission_eval(frame_from_normal(scale(UP, -1.0), below), v, inside)[0] / zv;
        prop_assert!((there - back).abs() <= 1e-6 * there.max(1e-3), "{there} {back}");
    }

    #[test]
    fn what_is_left_is_no_less_than_0(
        weight in any::<f32>(), color in any::<f32>(), f0 in any::<f32>(), n_dot_v in any::<f32>(), a in any::<f32>(), b in any::<f32>(),
    ) {
        let coat = Coat { weight, color: [color; 3], f0, alpha: 0.1 };
        let base = coat_base(coat, n_dot_v, [a, b])[0];
        prop_assert!((0.0..=1.0).contains(&base), "{base}");
    }

    #[test]
    fn lobes_of_any_bits_are_finite(bits in prop::array::uniform24(any::<u32>())) {
        let x = bits.map(f32::from_bits);
        let at = |i: usize| [x[i], x[i + 1], x[i + 2]];
        let frame = frame_from_normal(at(0), at(3));
        let coat = Coat { weight: x[6], color: at(7), f0: x[10], alpha: x[11] };
        let multiscatter = multiscatter_from_dfg(at(6), at(7), [x[10], x[11]], x[12]);
        let transmission = Transmission { color: at(6), eta: x[9], alpha: x[10] };
        let l = at(13);
        for c in [
            coat_eval(frame, l, coat),
            coat_environment(coat, l, [x[16], x[17]]),
            multiscatter_eval(frame, l, multiscatter, [x[16], x[17]]),
            multiscatter_environment(multiscatter, l),
            transmission_eval(frame, l, transmission),
            transmission_thin_eval(frame, l, transmission),
            transmission_environment(transmission, x[16], l, [x[17], x[18]]),
        ] {
            prop_assert!(c.iter().all(|x| x.is_finite()), "{c:?}");
        }
    }
}

/// A coat over a base that reflects all: nothing gained.
#[test]
fn coat_and_base_reflect_no_more_than_arrives() {
    for roughness in [0.1, 0.3, 0.6, 1.0] {
        for n_dot_v in [0.02, 0.1, 0.4, 0.8, 1.0] {
            let dfg = directional_albedo_ggx(n_dot_v, roughness);
            for weight in [0.0, 0.5, 1.0] {
                let coat = Coat { weight, color: [1.0, 0.5, 0.0], f0: 0.04, alpha: roughness * roughness };
                let base = coat_base(coat, n_dot_v, dfg);
                let total = weight * (0.04 * dfg[0] + dfg[1]) + base[0];
                assert!((total - 1.0).abs() < 1e-12, "{roughness} {n_dot_v} {weight}: {total}");
                assert!(base[0] >= base[1] && base[1] >= base[2] && base[2] >= 0.0);
                if weight == 0.0 {
                    assert_eq!(base, [1.0; 3], "no coat leaves no trace");
                }
            }
        }
    }
    // The colour is the transmittance there and back at normal incidence.
    let coat = Coat { weight: 1.0, color: [0.5; 3], f0: 0.0, alpha: 0.1 };
    assert!((coat_base(coat, 1.0_f64, [0.0, 0.0])[0] - 0.5).abs() < 1e-12);
}

/// What rough glass reflects and what it lets through are all that arrives, but what single scattering loses: by sampling,
/// with the density of the sampler.
#[test]
fn rough_glass_keeps_energy() {
    const STRATA: usize = 96;
    for eta in [1.5, 1.0 / 1.5] {
        for alpha in [0.05, 0.2, 0.5] {
            for n_dot_v in [0.3, 0.7, 1.0] {
                let view = direction(n_dot_v, 0.0);
                let (p, frame) = (Transmission { color: [1.0; 3], eta, alpha }, seen_from(view));
                let (mut through, mut thin) = (0.0, 0.0);
                for i in 0..STRATA * STRATA {
                    let u = [i % STRATA, i / STRATA].map(|k| (k as f64 + 0.5) / STRATA as f64);
                    let l = transmission_sample(view, p, u);
                    if l[2] < 0.0 {
                        // Radiance is compressed by eta^2 on the way in: power is what is kept.
                        through += transmission_eval(frame, l, p)[0] / transmission_pdf(view, l, p) * eta * eta;
                    }
                    let l = transmission_thin_sample(view, alpha, u);
                    if l[2] < 0.0 {
                        thin += transmission_thin_eval(frame, l, p)[0] / transmission_thin_pdf(view, l, alpha);
                    }
                }
                let count = (STRATA * STRATA) as f64;
                (through, thin) = (through / count, thin / count);
                println!("eta {eta:.3}, alpha {alpha}, n.v {n_dot_v}: solid {through:.4}, thin {thin:.4}");
                assert!(through <= 1.0 && thin <= 1.0);
                let dfg = directional_albedo_ggx(n_dot_v, alpha.sqrt());
                // Both factors bring all of it back, of a sheet to the error of the quadrature.
                let sheet = f0_of_sheet(f0_from_ior(eta), 1.0);
                let gain = 1.0 / (dfg[0] + dfg[1]) - 1.0;
                let reflected = |f0: f64| (f0 * dfg[0] + dfg[1]) * (1.0 + f0 * gain);
                let whole = reflected(sheet) + thin * transmission_thin_compensation(sheet, dfg);
                assert!((whole - 1.0).abs() < 5e-3, "eta {eta}, alpha {alpha}, n.v {n_dot_v}: {whole} of a sheet");
                let whole = reflected(f0_from_ior(eta)) + through * transmission_compensation(n_dot_v, p);
                println!("  with its compensation and reflection: solid {whole:.4}");
                assert!(eta < 1.0 || (whole - 1.0).abs() < 0.06, "alpha {alpha}, n.v {n_dot_v}: {whole}");
                if eta > 1.0 && alpha < 0.1 && n_dot_v > 0.5 {
                    assert!(through > 0.93, "{through}");
                }
            }
        }
    }
}

#[test]
fn refraction_bends_by_snells_law() {
    for n_dot_v in [0.1, 0.5, 0.9, 1.0] {
        let frame = seen_from(direction(n_dot_v, 0.0));
        let t = transmission_direction(frame, 1.5);
        let (sin_v, sin_t) = ((1.0 - n_dot_v * n_dot_v).sqrt(), (t[0] * t[0] + t[1] * t[1]).sqrt());
        assert!((sin_v - 1.5 * sin_t).abs() < 1e-12 && t[2] < 0.0 && (dot(t, t) - 1.0).abs() < 1e-12);
    }
    // From inside, beyond the critical angle: the grazing ray, and nothing passes.
    let frame = seen_from(direction(0.3, 0.0));
    assert!(transmission_direction(frame, 1.0 / 1.5)[2].abs() < 1e-9);
    let p = Transmission { color: [1.0; 3], eta: 1.0 / 1.5, alpha: 1e-4 };
    for phi in [0.0, 1.0, 3.0] {
        for z in [-0.9, -0.5, -0.1] {
            assert!(transmission_eval(frame, direction(z, phi), p)[0] < 1e-3);
        }
    }
    // An index of 1 with l = -v has no half vector.
    let p = Transmission { color: [1.0; 3], eta: 1.0, alpha: 0.1 };
    assert!(transmission_eval(frame, scale(frame.view_dir, -1.0), p)[0].is_finite());
}
