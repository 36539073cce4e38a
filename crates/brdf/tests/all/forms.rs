//! What each form is known for, measured: normalisation, energy, and its distance from the form that it stands for. The
//! figures in the functions' documentation are the bounds of these tests.

use halfvector_brdf::anisotropic::{d_ggx_anisotropic, v_smith_ggx_anisotropic};
use halfvector_brdf::beckmann::{
    d_beckmann, n_dot_w_lambda_beckmann, v_smith_beckmann_correlated, v_smith_beckmann_exact,
    v_smith_beckmann_separable,
};
use halfvector_brdf::diffuse::{
    average_albedo_fon, diffuse_burley, diffuse_eon, diffuse_eon_exact, diffuse_fon, diffuse_lambert,
    diffuse_oren_nayar, directional_albedo_eon, directional_albedo_fon, directional_albedo_fon_exact,
};
use halfvector_brdf::fresnel::{f_conductor, f_dielectric, f_f82_tint, f_f82_tint_of_complement, f_schlick};
use halfvector_brdf::ggx::{d_ggx, v_smith_ggx_correlated};
use halfvector_brdf::math::PI;
use halfvector_brdf::sheen::{d_charlie, v_neubelt};
use halfvector_brdf::visibility::{v_cook_torrance, v_hammon, v_kelemen, v_schlick_smith};

/// The integral over the hemisphere of f(sin, cos) cos, f without azimuth: uniform in the logarithm of the tangent.
fn projected(f: impl Fn(f64, f64) -> f64) -> f64 {
    let (steps, low, high) = (4000, 1e-12_f64.ln(), 1e12_f64.ln());
    let step = (high - low) / f64::from(steps);
    let at = |i: i32| {
        let tan = (low + (f64::from(i) + 0.5) * step).exp();
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        let sin = tan * cos;
        f(sin, cos) * cos * 2.0 * PI * sin * cos * sin * step
    };
    (0..steps).map(at).sum()
}

#[test]
fn distributions_have_a_projected_area_of_1() {
    for alpha in [1e-4, 0.01, 0.3, 1.0] {
        let beckmann = projected(|sin, cos| d_beckmann(cos, sin * sin, alpha));
        assert!((beckmann - 1.0).abs() < 1e-9, "Beckmann, alpha {alpha}: {beckmann}");
        let charlie = projected(|sin, cos| d_charlie(cos, sin * sin, alpha));
        assert!((charlie - 1.0).abs() < 1e-6, "Charlie, alpha {alpha}: {charlie}");
    }
    for (alpha_t, alpha_b) in [(0.1, 0.4), (1.0, 0.05), (0.3, 0.3)] {
        let rays = 512;
        let ray = |i: i32| {
            let (s, c) = ((f64::from(i) + 0.5) / f64::from(rays) * 2.0 * PI).sin_cos();
            projected(|sin, cos| d_ggx_anisotropic([sin * c, sin * s, cos], alpha_t, alpha_b)) / f64::from(rays)
        };
        let area: f64 = (0..rays).map(ray).sum();
        assert!((area - 1.0).abs() < 1e-6, "anisotropic {alpha_t} {alpha_b}: {area}");
    }
}

#[test]
fn equal_widths_are_isotropic() {
    let v = [0.3, 0.4, 0.75_f64.sqrt()];
    let l = [-0.6, 0.1, 0.63_f64.sqrt()];
    for alpha in [1e-6, 0.1, 1.0] {
        let (d, iso) = (d_ggx_anisotropic(v, alpha, alpha), d_ggx(v[2], 0.25, alpha));
        assert!((d / iso - 1.0).abs() < 1e-13, "D of {alpha}: {d}, {iso}");
        let visibility = v_smith_ggx_anisotropic(v, l, alpha, alpha);
        assert!((visibility / v_smith_ggx_correlated(v[2], l[2], 0.0, alpha) - 1.0).abs() < 1e-13);
    }
}

#[test]
fn exact_lambda_of_beckmann() {
    // psi(a) = (exp(-a^2) / sqrt(pi) - a erfc(a)) / 2 with 30 digits.
    for (a, psi) in PSI {
        // n.w = a alpha sin: tan(theta) = 1 / (a alpha), alpha 1/2.
        let tan = 2.0 / a;
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        let value = n_dot_w_lambda_beckmann(cos, 0.5) / (0.5 * tan * cos);
        assert!((value / psi - 1.0).abs() < 2e-13, "psi({a}) = {value}, not {psi}");
    }
}

const PSI: [(f64, f64); 5] = [
    (0.01, 0.277123000782906948),
    (0.3, 0.15710924132360988),
    (1.0, 0.0251272708300061105),
    (2.5, 0.0000358810357819787556),
    (5.0, 7.40671466842467016e-14),
];

/// Cosines from `low` to 1, uniform in the logarithm.
fn cosines(low: f64) -> impl Iterator<Item = f64> + Clone {
    (0..=40).map(move |i| low.powf(f64::from(i) / 40.0))
}

/// Largest and root mean square of the relative distance of two V, cosines from 0.01, alpha from 0.002.
fn distance(form: fn(f64, f64, f64, f64) -> f64, truth: fn(f64, f64, f64, f64) -> f64) -> (f64, f64) {
    let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
    for alpha in cosines(0.002) {
        for n_dot_v in cosines(0.01) {
            for n_dot_l in cosines(0.01) {
                let error = form(n_dot_v, n_dot_l, 0.5, alpha) / truth(n_dot_v, n_dot_l, 0.5, alpha) - 1.0;
                worst = worst.max(error.abs());
                squares += error * error;
                count += 1.0;
            }
        }
    }
    (worst, (squares / count).sqrt())
}

#[test]
fn distances_of_fitted_visibility() {
    let beckmann = distance(v_smith_beckmann_correlated, v_smith_beckmann_exact);
    let hammon = distance(v_hammon, v_smith_ggx_correlated);
    let schlick = distance(v_schlick_smith, v_smith_ggx_correlated);
    println!(
        "V, largest and rms relative distance: Walter's fit {beckmann:.4?}, Hammon {hammon:.3?}, Schlick-Smith {schlick:.3?}"
    );
    assert!(beckmann.0 < 0.0065 && hammon.0 < 0.3 && hammon.1 < 0.14 && schlick.1 < 0.77);
}

#[test]
fn visibility_forms_at_normal_incidence() {
    // G = 1: V = 1/4.
    for v in [v_hammon, v_schlick_smith, v_cook_torrance, v_kelemen, v_neubelt, v_smith_beckmann_correlated] {
        assert!((v(1.0, 1.0, 1.0, 0.3) - 0.25_f64).abs() < 1e-15);
    }
    assert!((v_smith_beckmann_separable(1.0, 1.0, 1.0, 0.3) - 0.25_f64).abs() < 1e-15);
    // Cook and Torrance's G = min(1, 2 n.h n.v / v.h, 2 n.h n.l / v.h) at v = l at 75 degrees and 80 degrees apart.
    let (n_dot_v, n_dot_l) = (75_f64.to_radians().cos(), 5_f64.to_radians().cos());
    let (l_dot_h, n_dot_h) = (40_f64.to_radians().cos(), 35_f64.to_radians().cos());
    let g = (2.0 * n_dot_h * n_dot_v / l_dot_h).min(2.0 * n_dot_h * n_dot_l / l_dot_h).min(1.0);
    assert!((v_cook_torrance(n_dot_v, n_dot_l, l_dot_h, 0.3) * 4.0 * n_dot_v * n_dot_l - g).abs() < 1e-14);
}

#[test]
fn conductors_without_extinction_are_dielectrics() {
    for eta in [0.5, 0.8, 1.0, 1.000_001, 1.5, 4.0_f64] {
        for cosine in cosines(1e-5) {
            let (metal, glass) = (f_conductor(eta, 0.0, cosine), f_dielectric(eta, cosine));
            assert!((metal - glass).abs() <= 1e-13 * glass.max(1e-3), "{eta} {cosine}: {metal}, {glass}");
        }
    }
    // Normal incidence: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    for (n, k) in [(0.05, 4.0), (0.001, 10.0), (1.0, 1e4), (1e3, 1e3)] {
        let truth: f64 = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
        assert!((f_conductor(n, k, 1.0) / truth - 1.0).abs() < 1e-14, "{n} {k}");
    }
}

#[test]
fn f82_at_its_knots() {
    let (f0, tint) = ([0.9, 0.5, 0.2], [0.7, 1.0, 0.3]);
    let schlick = f_schlick(f0, [1.0; 3], 1.0 / 7.0);
    let f = f_f82_tint(f0, tint, 1.0 / 7.0_f64);
    assert!((0..3).all(|i| (f[i] - schlick[i] * tint[i]).abs() < 1e-15));
    assert_eq!((f_f82_tint(f0, tint, 1.0), f_f82_tint(f0, tint, 0.0)), (f0, [1.0; 3]));
    let lowest = cosines(1e-3).map(|x| f_f82_tint_of_complement(0.0, 0.0, 1.0 - x)).fold(1.0, f64::min);
    println!("the lowest value of the F82 equation: {lowest:.3}");
    assert!((-0.13..-0.12).contains(&lowest) && f_f82_tint([0.0; 3], [0.0; 3], 0.2) == [0.0; 3]);
}

type Diffuse = fn([f64; 3], f64, f64, f64, f64) -> [f64; 3];

/// Directional albedo by the midpoint rule, which the polynomials of these forms suit.
fn albedo(form: Diffuse, n_dot_v: f64, roughness: f64) -> f64 {
    let (rings, rays) = (400, 400);
    let sin_v = (1.0 - n_dot_v * n_dot_v).sqrt();
    let mut sum = 0.0;
    for ring in 0..rings {
        // sin^2 uniform to the second power, which crowds points at the horizon.
        let x = (f64::from(ring) + 0.5) / f64::from(rings);
        let n_dot_l = x * x;
        let sin_l = (1.0 - n_dot_l * n_dot_l).sqrt();
        for ray in 0..rays {
            let cos_phi = ((f64::from(ray) + 0.5) / f64::from(rays) * PI).cos();
            let v_dot_l = sin_v * sin_l * cos_phi + n_dot_v * n_dot_l;
            let l_dot_h = (0.5 + 0.5 * v_dot_l).max(0.0).sqrt();
            sum += form([1.0; 3], n_dot_v, n_dot_l, l_dot_h, roughness)[0] * n_dot_l * 2.0 * x;
        }
    }
    sum * 2.0 * PI / f64::from(rings * rays)
}

#[test]
fn albedo_of_the_diffuse_forms() {
    for roughness in [0.0, 0.3, 1.0] {
        for n_dot_v in [0.02, 0.2, 0.6, 1.0] {
            let fon = albedo(diffuse_fon, n_dot_v, roughness);
            let exact = directional_albedo_fon_exact(n_dot_v, roughness);
            assert!((fon - exact).abs() < 2e-4, "FON, {roughness} {n_dot_v}: {fon}, {exact}");
            assert!((directional_albedo_fon(n_dot_v, roughness) / exact - 1.0).abs() < 6e-4);
            let eon = albedo(diffuse_eon_exact, n_dot_v, roughness);
            assert!((eon - 1.0).abs() < 2e-4, "EON, {roughness} {n_dot_v}: {eon}");
            let fitted = albedo(diffuse_eon, n_dot_v, roughness);
            assert!((fitted - 1.0).abs() < 8e-4, "EON by the polynomial, {roughness} {n_dot_v}: {fitted}");
            let grey = directional_albedo_eon([0.5, 1.0, 2.0], n_dot_v, roughness);
            assert!((grey[1] - 1.0).abs() < 1e-14 && grey[2] == grey[1] && grey[0] <= 0.5);
        }
        let points = 2000;
        let at = |i: i32| (f64::from(i) + 0.5) / f64::from(points);
        let average: f64 =
            (0..points).map(|i| 2.0 * at(i) * directional_albedo_fon_exact(at(i), roughness) / f64::from(points)).sum();
        assert!((average - average_albedo_fon(roughness)).abs() < 1e-6, "average, {roughness}: {average}");
    }
}

/// Published in the documentation: what a white surface of these forms reflects.
#[test]
fn albedo_of_forms_that_do_not_keep_energy() {
    let forms: [(&str, Diffuse, f64, f64); 4] = [
        ("Lambert", diffuse_lambert, 0.9999, 1.0001),
        ("Burley", diffuse_burley, 0.53, 1.53),
        ("Oren-Nayar", diffuse_oren_nayar, 0.62, 1.02),
        ("FON", diffuse_fon, 0.776, 1.0005),
    ];
    for (name, form, low, high) in forms {
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        for roughness in [0.0, 0.25, 0.5, 0.75, 1.0] {
            for n_dot_v in [0.02, 0.1, 0.3, 0.5, 0.7, 1.0] {
                let value = albedo(form, n_dot_v, roughness);
                (least, most) = (least.min(value), most.max(value));
            }
        }
        println!("albedo of white {name}: {least:.4} to {most:.4}");
        assert!(least > low && most < high, "{name}: {least:.4} to {most:.4}");
    }
}
