//! Specular occlusion and the horizon against integrals of the GGX lobe under a uniform environment, and the stated errors.

use halfvector_brdf::frame::{frame_from_normal, half_from_light};
use halfvector_brdf::ggx::v_smith_ggx_correlated;
use halfvector_ibl::occlusion::*;

/// Directions of a half-vector grid about n = +Z for the view direction `v`, each with the weight D V n.l of the lobe:
/// h = (tan t cos p, tan t sin p, 1) with tan t = alpha sqrt(u / (1 - u)) spreads points as D n.h does (Walter et al.
/// 2007), so that the weight left is V n.l 4 l.h / n.h.
fn lobe(v: [f64; 3], alpha: f64) -> Vec<([f64; 3], f64)> {
    const N: usize = 48;
    let frame = frame_from_normal([0.0, 0.0, 1.0], v);
    let mut lobe = Vec::new();
    for i in 0..N {
        let u = (i as f64 + 0.5) / N as f64;
        let theta = (alpha * (u / (1.0 - u)).sqrt()).atan();
        for j in 0..N {
            let phi = 2.0 * std::f64::consts::PI * (j as f64 + 0.5) / N as f64;
            let h = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            let v_dot_h = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
            let l: [f64; 3] = std::array::from_fn(|k| 2.0 * v_dot_h * h[k] - v[k]);
            if v_dot_h > 0.0 && l[2] > 0.0 {
                let half = half_from_light(frame, l);
                let visibility = v_smith_ggx_correlated(frame.n_dot_v, half.n_dot_l, v_dot_h, alpha);
                lobe.push((l, visibility * l[2] * v_dot_h / h[2]));
            }
        }
    }
    lobe
}

fn kept(lobe: &[([f64; 3], f64)], keeps: impl Fn([f64; 3]) -> bool) -> f64 {
    let whole: f64 = lobe.iter().map(|(_, w)| w).sum();
    lobe.iter().filter(|(l, _)| keeps(*l)).map(|(_, w)| w).sum::<f64>() / whole
}

#[derive(Default)]
struct Error {
    squares: f64,
    max: f64,
    count: f64,
}

impl Error {
    fn add(&mut self, error: f64) {
        self.squares += error * error;
        self.max = self.max.max(error.abs());
        self.count += 1.0;
    }
    fn check(&self, name: &str, rms: f64, max: f64) {
        let measured = (self.squares / self.count).sqrt();
        println!("{name}: {measured:.3} rms, {:.3} max", self.max);
        assert!(measured <= rms && self.max <= max, "{name}: {measured} rms, {} max", self.max);
    }
}

const STEPS: usize = 10;

fn step(i: usize, low: f64, high: f64) -> f64 {
    low + (high - low) * (i as f64 + 0.5) / STEPS as f64
}

fn view(n_dot_v: f64) -> [f64; 3] {
    [(1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v]
}

#[test]
fn specular_occlusion_is_the_cones() {
    let mut errors: [Error; 3] = Default::default();
    for i in 0..STEPS {
        let roughness = step(i, 0.05, 1.0);
        for j in 0..STEPS {
            let n_dot_v = step(j, 0.05, 1.0);
            let lobe = lobe(view(n_dot_v), roughness * roughness);
            for k in 0..STEPS {
                let occlusion = step(k, 0.0, 1.0);
                let truth = kept(&lobe, |l| l[2] * l[2] > 1.0 - occlusion);
                let forms = [specular_occlusion_cone, specular_occlusion_lagarde, |_, occlusion, _| occlusion];
                for (form, error) in forms.into_iter().zip(&mut errors) {
                    error.add(form(n_dot_v, occlusion, roughness) - truth);
                }
            }
        }
    }
    errors[0].check("cone", 0.047, 0.33);
    errors[1].check("lagarde", 0.25, 1.0);
    errors[2].check("plain", 0.25, 1.0);
}

#[test]
fn the_horizon_cuts_what_lies_below_it() {
    let mut errors: [Error; 3] = Default::default();
    for i in 0..STEPS {
        let roughness = step(i, 0.05, 1.0);
        for j in 0..STEPS {
            let n_dot_v = step(j, 0.05, 1.0);
            let v = view(n_dot_v);
            let lobe = lobe(v, roughness * roughness);
            for k in 0..STEPS * STEPS {
                let (sin, cos) = step(k / STEPS, 0.0, std::f64::consts::FRAC_PI_3).sin_cos();
                let azimuth = step(k % STEPS, 0.0, std::f64::consts::PI);
                let g = [sin * azimuth.cos(), sin * azimuth.sin(), cos];
                let dot = |a: [f64; 3]| a[0] * g[0] + a[1] * g[1] + a[2] * g[2];
                // The geometry faces the viewer.
                if dot(v) < 0.02 {
                    continue;
                }
                let truth = kept(&lobe, |l| dot(l) > 0.0);
                let r_dot_g = dot([-v[0], -v[1], v[2]]);
                for (form, error) in [horizon_cone, horizon_squared, |_, _, _, _| 1.0].into_iter().zip(&mut errors) {
                    error.add(form(r_dot_g, cos, n_dot_v, roughness) - truth);
                }
            }
        }
    }
    errors[0].check("cone", 0.031, 0.2);
    errors[1].check("squared", 0.175, 0.91);
    errors[2].check("none", 0.27, 1.0);
}

#[test]
fn ends_of_the_domain() {
    for i in 0..=20 {
        for j in 0..=20 {
            let (n_dot_v, r) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
            assert!((specular_occlusion_cone(n_dot_v, 1.0, r) - 1.0).abs() < 1e-12, "n.v {n_dot_v}, roughness {r}");
            assert_eq!(specular_occlusion_cone(n_dot_v, 0.0, r), 0.0, "n.v {n_dot_v}, roughness {r}");
            assert!((horizon_cone(n_dot_v, 1.0, n_dot_v, r) - 1.0).abs() < 1e-12, "n.v {n_dot_v}, roughness {r}");
        }
    }
    for x in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e-30, 7.0] {
        for y in [f32::NAN, 0.0, 1.0] {
            assert!((0.0..=1.0).contains(&horizon_cone(x, y, y, 0.0)), "{x} {y}");
        }
    }
}
