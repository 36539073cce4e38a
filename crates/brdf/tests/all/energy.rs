//! Energy: what lobes reflect of uniform light, with exact albedos. The same through the table that shaders read is tested
//! where the table is made.

use halfvector_brdf::albedo::{average_albedo_ggx, directional_albedo_ggx, gauss_legendre};
use halfvector_brdf::coupling::{coupling_compensated, coupling_light, coupling_single};
use halfvector_brdf::dfg::dfg_fit;
use halfvector_brdf::diffuse::{diffuse_burley, diffuse_eon, diffuse_fon, diffuse_lambert, diffuse_oren_nayar};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::lobe_multiscatter::{multiscatter_eval, multiscatter_from_dfg};
use halfvector_brdf::math::PI;
use halfvector_brdf::multiscatter::{
    average_loss_ggx, energy_compensation, energy_compensation_fdez_aguera, multiscatter_color,
};

use crate::data::table;

const WHITE: [f64; 3] = [1.0; 3];
const VIEWS: [f64; 7] = [0.01, 0.05, 0.1, 0.3, 0.5, 0.8, 1.0];
const ROUGHNESS: [f64; 7] = [0.089, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0];

/// The cosines of a quadrature over the hemisphere, their weights 2 mu dmu, and the albedo pair of each.
fn lights(roughness: f64) -> Vec<([f64; 2], f64, f64)> {
    gauss_legendre::<24>()
        .iter()
        .map(|[x, w]| {
            let t = (x + 1.0) / 2.0;
            (directional_albedo_ggx(t * t, roughness), t * t, w / 2.0 * 4.0 * t * t * t)
        })
        .collect()
}

fn direction(cosine: f64) -> [f64; 3] {
    [(1.0 - cosine * cosine).sqrt(), 0.0, cosine]
}

/// `albedo_of_single_scattering`: the committed closed forms, and the truth table where there is one.
#[test]
fn single_scattering_is_the_truth() {
    for n_dot_v in VIEWS {
        let exact = 1.0 - n_dot_v * (1.0 + 1.0 / n_dot_v).ln();
        let [a, b] = directional_albedo_ggx(n_dot_v, 1.0);
        assert!((a + b - exact).abs() < 1e-6, "n.v {n_dot_v}: {} instead of {exact}", a + b);
    }
    let exact = (4.0 - 4.0 * 2.0_f64.ln()) / 3.0;
    let [a, b] = average_albedo_ggx(1.0);
    assert!((a + b - exact).abs() < 2e-6, "average {} instead of {exact}", a + b);
    let Some(truth) = table("dfg_grid_shared.csv") else { return };
    let (mut sum, mut bias) = (0.0_f64, 0.0_f64);
    for row in truth.rows() {
        let [a, b] = directional_albedo_ggx(row.number("nov"), row.number("roughness"));
        sum = sum.max((a + b - row.number("E_ss_white")).abs());
        bias = bias.max((b - row.number("dfg_bias")).abs());
    }
    println!("albedo by quadrature: a + b off by {sum:.1e}, b by {bias:.1e}");
    assert!(sum < 1e-5 && bias < 1e-5, "{sum:.1e} {bias:.1e}");
}

#[test]
fn averages_and_their_fits() {
    let Some(truth) = table("eavg_shared.csv") else { return };
    for row in truth.rows() {
        let r = row.number("roughness");
        let [a, b] = average_albedo_ggx(r);
        let (albedo, bias) = (row.number("E_avg"), row.number("bias_avg"));
        assert!((a + b - albedo).abs() < 1e-5 && (b - bias).abs() < 1e-5, "{r}: {} {albedo}, {b} {bias}", a + b);
        assert!(
            (average_loss_ggx(r) - (1.0 - albedo)).abs() < 4e-3 * (1.0 - albedo).max(2e-3),
            "{r}: {}",
            average_loss_ggx(r)
        );
    }
}

#[test]
fn white_metal_reflects_all() {
    let mut worst = 0.0_f64;
    for roughness in ROUGHNESS {
        let lights = lights(roughness);
        for n_dot_v in VIEWS {
            let dfg = directional_albedo_ggx(n_dot_v, roughness);
            let albedo = dfg[0] + dfg[1];
            let turquin = albedo * energy_compensation(WHITE, WHITE, dfg)[0];
            let fdez_aguera = albedo * energy_compensation_fdez_aguera(WHITE, WHITE, dfg)[0];
            let frame = frame_from_normal([0.0, 0.0, 1.0], direction(n_dot_v));
            let lobe = multiscatter_from_dfg(WHITE, WHITE, dfg, roughness);
            // BRDF n.l over the azimuth: pi weight / n.l of a lobe that is the same all around.
            let kulla_conty: f64 = albedo
                + lights
                    .iter()
                    .map(|(dfg, mu, weight)| multiscatter_eval(frame, direction(*mu), lobe, *dfg)[0] / mu * PI * weight)
                    .sum::<f64>();
            for (name, total) in [("turquin", turquin), ("fdez_aguera", fdez_aguera), ("kulla_conty", kulla_conty)] {
                worst = worst.max((total - 1.0).abs());
                assert!((total - 1.0).abs() < 1e-3, "{name}, n.v {n_dot_v}, roughness {roughness}: {total}");
            }
        }
    }
    println!("white metal: within {worst:.1e} of 1");
}

/// Coloured metals and dielectrics lose nothing that single scattering has, and gain nothing.
#[test]
fn compensation_never_gains() {
    for roughness in ROUGHNESS {
        for n_dot_v in VIEWS {
            let dfg = directional_albedo_ggx(n_dot_v, roughness);
            for f0 in [0.0, 0.04, 0.2, 0.5, 0.9] {
                let single = f0 * dfg[0] + dfg[1];
                for factor in [
                    energy_compensation([f0; 3], WHITE, dfg)[0],
                    energy_compensation_fdez_aguera([f0; 3], WHITE, dfg)[0],
                ] {
                    assert!(factor >= 1.0 && single * factor <= 1.0 + 1e-9, "{f0} {n_dot_v} {roughness}: {factor}");
                }
            }
        }
    }
}

/// The view-only factors are not reciprocal: the ratio of a light at n.l = 0.1 seen from n.v = 1 to the reverse.
#[test]
fn violation_of_reciprocity_of_the_view_only_forms() {
    let ratio = |factor: &dyn Fn([f64; 2]) -> f64, roughness| {
        factor(directional_albedo_ggx(1.0, roughness)) / factor(directional_albedo_ggx(0.1, roughness))
    };
    let turquin = |f0: f64| ratio(&move |dfg| energy_compensation([f0; 3], WHITE, dfg)[0], 1.0);
    let fdez_aguera = |f0: f64| ratio(&move |dfg| energy_compensation_fdez_aguera([f0; 3], WHITE, dfg)[0], 1.0);
    let coupling = ratio(&|dfg| coupling_single(0.04, 1.0, dfg), 0.1);
    println!(
        "roughness 1, n = 1 and 0.1: turquin {:.3} (white) {:.3} (f0 0.04), fdez_aguera {:.3} {:.3}; \
         coupling at roughness 0.1 {coupling:.3}",
        turquin(1.0),
        turquin(0.04),
        fdez_aguera(1.0),
        fdez_aguera(0.04),
    );
    assert!((2.4..2.6).contains(&turquin(1.0)) && (2.4..2.6).contains(&fdez_aguera(1.0)));
    assert!(turquin(0.04) < 1.1 && fdez_aguera(0.04) < 1.1 && (2.0..3.0).contains(&coupling));
}

/// A white base under a dielectric interface, with each compensation and each coupling.
#[test]
fn dielectric_over_white_reflects_all() {
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for f0 in [0.02, 0.04, 0.08, 0.17] {
        for roughness in ROUGHNESS {
            let lights = lights(roughness);
            for n_dot_v in VIEWS {
                let dfg = directional_albedo_ggx(n_dot_v, roughness);
                let single = f0 * dfg[0] + dfg[1];
                let lost = 1.0 - dfg[0] - dfg[1];
                let bounced = multiscatter_color([f0; 3], WHITE, 1.0 - average_loss_ggx(roughness))[0];
                let view = coupling_single(f0, 1.0, dfg);
                let light: f64 =
                    lights.iter().map(|(pair, _, weight)| weight * coupling_light(f0, 1.0, *pair, roughness)).sum();
                let bounded = coupling_compensated(f0, 1.0, dfg);
                for total in [
                    single + view,
                    single + view * light,
                    single * energy_compensation([f0; 3], WHITE, dfg)[0] + bounded,
                    single * energy_compensation_fdez_aguera([f0; 3], WHITE, dfg)[0] + bounded,
                    single + bounced * lost + bounded,
                ] {
                    (low, high) = (low.min(total), high.max(total));
                    assert!((0.97..=1.001).contains(&total), "f0 {f0}, n.v {n_dot_v}, roughness {roughness}: {total}");
                }
            }
        }
    }
    println!("white base under a dielectric: {low:.5} to {high:.5}");
}

/// Rows `f0>1 in Kulla-Conty` and `schlick_f0_eq_1` of the hard cases, and E towards 0.
#[test]
fn f0_above_1_and_albedo_0() {
    let at_1 = |f0: f64| multiscatter_color([f0; 3], WHITE, 0.409_137)[0];
    assert_eq!(at_1(1.5), at_1(1.0));
    assert!((at_1(1.0) - 1.0).abs() < 1e-12);
    for average in [0.0, 1e-30, 0.5, 1.0] {
        for f0 in [-1.0, 0.0, 1.0, 1.6924, 1e30, f64::NAN] {
            let color = multiscatter_color([f0; 3], WHITE, average)[0];
            assert!((0.0..=1.0 + 1e-9).contains(&color), "f0 {f0}, E_avg {average}: {color}");
            for dfg in [[0.0, 0.0], [1e-30, 0.0], [1.0, 0.0], [2.0, 3.0], [-1.0, 0.0]] {
                let turquin = energy_compensation([f0; 3], WHITE, dfg)[0];
                let fdez_aguera = energy_compensation_fdez_aguera([f0; 3], WHITE, dfg)[0];
                assert!((1.0..=10.000_001).contains(&turquin), "{f0} {dfg:?}: {turquin}");
                assert!((1.0..=10.000_001).contains(&fdez_aguera), "{f0} {dfg:?}: {fdez_aguera}");
            }
        }
    }
    for (f0, f90, dfg) in [(1.0, 1.0, [1.0, 0.5]), (f64::NAN, 1.0, [0.5, 0.5]), (0.04, 1.0, [f64::NAN, 0.1])] {
        for share in
            [coupling_single(f0, f90, dfg), coupling_compensated(f0, f90, dfg), coupling_light(f0, f90, dfg, 0.5)]
        {
            assert!(share >= 0.0 && share.is_finite(), "{share}");
        }
    }
}

/// The analytic fit against quadrature, and over all of its domain.
#[test]
fn the_fit_is_within_its_errors() {
    let (mut inner, mut anywhere, mut squares, mut count) = ([0.0_f64; 2], [0.0_f64; 2], [0.0_f64; 2], 0.0);
    for i in 0..24 {
        let roughness = 0.02 + 0.98 * f64::from(i) / 23.0;
        for j in 0..32 {
            let n_dot_v = 0.001 + 0.999 * (f64::from(j) / 31.0).powi(2);
            let ([a, b], truth) = (dfg_fit(n_dot_v, roughness), directional_albedo_ggx(n_dot_v, roughness));
            let errors = [(a + b - truth[0] - truth[1]).abs(), (b - truth[1]).abs()];
            count += 1.0;
            for k in 0..2 {
                squares[k] += errors[k] * errors[k];
                anywhere[k] = anywhere[k].max(errors[k]);
                if n_dot_v >= 0.05 && roughness >= 0.089 {
                    inner[k] = inner[k].max(errors[k]);
                }
            }
        }
    }
    let rms = squares.map(|s| (s / count).sqrt());
    println!("fit of a + b, b: {inner:.4?} inside, {anywhere:.4?} anywhere, rms {rms:.4?}");
    assert!(
        inner[0] < 0.0145 && inner[1] < 0.0175 && anywhere[0] < 0.027 && anywhere[1] < 0.064,
        "{inner:?} {anywhere:?}"
    );
    for n_dot_v in [f32::NAN, -1.0, 0.0, 1e-40, 1e-6, 1.0, 2.0] {
        for roughness in [f32::NAN, -1.0, 0.0, 1e-6, 0.01, 0.5, 1.0, 7.0] {
            let [a, b] = dfg_fit(n_dot_v, roughness);
            assert!((0.0..=1.0).contains(&a) && (0.0..=1.0).contains(&b), "{n_dot_v} {roughness}: {a} {b}");
        }
    }
}

type DiffuseForm = fn([f64; 3], f64, f64, f64, f64) -> [f64; 3];

/// Albedo of a diffuse form of albedo 1, seen at n.v, with a weight on each light.
fn diffuse_albedo(form: DiffuseForm, n_dot_v: f64, roughness: f64, weight: &dyn Fn(f64) -> f64) -> f64 {
    let view = direction(n_dot_v);
    let mut sum = 0.0;
    for [x, w] in gauss_legendre::<48>() {
        let t = (x + 1.0) / 2.0;
        let mu = t * t;
        for k in 0..96 {
            let (sin, cos) = (PI * (f64::from(k) + 0.5) / 96.0).sin_cos();
            let s = (1.0 - mu * mu).sqrt();
            let half = [s * cos + view[0], s * sin, mu + view[2]];
            let l_dot_h = 0.5 * half.iter().map(|c| c * c).sum::<f64>().sqrt();
            let brdf = form(WHITE, n_dot_v, mu, l_dot_h, roughness)[0];
            sum += w * t * (2.0 * PI / 96.0) * brdf * mu * weight(mu);
        }
    }
    sum
}

/// What `docs/energy.md` prints, and the furnace of the coupled base: Lambert and EON reflect all.
#[test]
fn diffuse_forms_reflect_what_is_published() {
    let whole = |_: f64| 1.0;
    for (name, form, roughness, albedos) in [
        ("burley", diffuse_burley as DiffuseForm, 0.0, [0.688, 0.894, 0.976]),
        ("burley", diffuse_burley, 0.5, [1.024, 1.019, 1.006]),
        ("burley", diffuse_burley, 1.0, [1.380, 1.151, 1.036]),
        ("fon", diffuse_fon, 0.5, [0.986, 0.955, 0.874]),
        ("fon", diffuse_fon, 1.0, [0.974, 0.920, 0.777]),
        ("oren_nayar", diffuse_oren_nayar, 0.25, [1.006, 0.992, 0.920]),
        ("oren_nayar", diffuse_oren_nayar, 1.0, [0.816, 0.784, 0.624]),
    ] {
        for (n_dot_v, published) in [0.1, 0.3, 1.0].into_iter().zip(albedos) {
            let albedo = diffuse_albedo(form, n_dot_v, roughness, &whole);
            assert!((albedo - published).abs() < 2e-3, "{name} {roughness}, n.v {n_dot_v}: {albedo} for {published}");
        }
    }
    let (mut low, mut high, mut reciprocal) = (f64::INFINITY, 0.0_f64, (f64::INFINITY, 0.0_f64));
    for specular_roughness in [0.089, 0.4, 1.0] {
        for n_dot_v in [0.05, 0.3, 0.7, 1.0] {
            let dfg = directional_albedo_ggx(n_dot_v, specular_roughness);
            let single = 0.04 * dfg[0] + dfg[1];
            let view = coupling_single(0.04, 1.0, dfg);
            for roughness in [0.0, 0.5, 1.0] {
                for form in [diffuse_lambert as DiffuseForm, diffuse_eon] {
                    let total = single + view * diffuse_albedo(form, n_dot_v, roughness, &whole);
                    (low, high) = (low.min(total), high.max(total));
                }
            }
            // The reciprocal coupling with EON, at a roughness whose albedo is Schlick's.
            if specular_roughness == 0.089 {
                let schlick = |mu: f64| coupling_light(0.04, 1.0, dfg_fit(mu, 0.0), 0.0);
                let total = single + view * diffuse_albedo(diffuse_eon, n_dot_v, 1.0, &schlick);
                reciprocal = (reciprocal.0.min(total), reciprocal.1.max(total));
            }
        }
    }
    println!("Lambert and EON under a dielectric: {low:.4} to {high:.4}; EON, reciprocal: {reciprocal:.4?}");
    assert!(low >= 0.97 && high <= 1.001, "{low} {high}");
    assert!(reciprocal.0 > 0.95 && reciprocal.1 < 1.01, "{reciprocal:?}");
}
