//! Samples against densities.

use halfvector_graph::method::Methods;

use super::*;
use crate::random::Random;

fn surface() -> Surface {
    Surface {
        base_color: [0.8, 0.5, 0.2],
        metallic: 0.0,
        perceptual_roughness: 0.5,
        ior: 1.5,
        specular: 1.0,
        normal: [0.0, 0.0, 1.0],
        occlusion: 1.0,
        emission: [0.0; 3],
        opacity: 1.0,
        coat_weight: 0.0,
        coat_color: [1.0; 3],
        coat_roughness: 0.3,
        coat_ior: 1.5,
        coat_normal: [0.0, 0.0, 1.0],
        sheen_color: [0.0; 3],
        sheen_roughness: 0.4,
        transmission_weight: 0.0,
        anisotropy: 0.0,
        anisotropy_rotation: 0.0,
        thin_film_weight: 0.0,
        thin_film_thickness: 0.4,
        thin_film_ior: 1.4,
    }
}

const TANGENT: [f64; 4] = [0.8, 0.6, 0.0, 1.0];

/// What is drawn by the lobes and what is drawn evenly over the sphere have the same mean, and densities integrate to 1 at
/// most.
#[test]
fn samples_fit_their_densities() {
    let tilted = [0.28, -0.1, 0.954_777_5].map(|x: f64| x / (0.28_f64.powi(2) + 0.01 + 0.954_777_5_f64.powi(2)).sqrt());
    let surfaces = [
        surface(),
        Surface { metallic: 1.0, perceptual_roughness: 0.7, ..surface() },
        Surface { coat_weight: 0.8, coat_roughness: 0.5, coat_normal: tilted, ..surface() },
        Surface { sheen_color: [0.7; 3], ..surface() },
        Surface { transmission_weight: 0.9, perceptual_roughness: 0.7, ..surface() },
        Surface { normal: tilted, metallic: 0.5, ..surface() },
        Surface { anisotropy: 0.7, anisotropy_rotation: 0.4, metallic: 1.0, ..surface() },
        Surface { anisotropy: 0.9, thin_film_weight: 0.8, normal: tilted, ..surface() },
        Surface { transmission_weight: 0.9, thin_film_weight: 1.0, perceptual_roughness: 0.6, ..surface() },
    ];
    for (case, surface) in surfaces.iter().enumerate() {
        let sheet = case + 1 == surfaces.len();
        for compensation in ["turquin", "kulla_conty", "none"] {
            let mut methods = Methods::default();
            methods.set("compensation", compensation).expect("a method");
            let model = Model::new(&methods, None);
            let view = [0.6, 0.0, 0.8];
            let bsdf = Bsdf::new(&model, surface, view, TANGENT, sheet);
            let n = 60_000_u32;
            let (mut by_lobes, mut evenly, mut densities) = ([0.0; 2], [0.0; 2], 0.0);
            for i in 0..n {
                let mut random = Random::new(3, u64::from(i), case as u64);
                let l = bsdf.sample(random.number(), random.pair());
                let (reflected, density) = bsdf.eval_with_density(l);
                assert!(reflected == bsdf.eval(l));
                let x = if density > 0.0 { reflected[1] / density } else { 0.0 };
                by_lobes = [by_lobes[0] + x, by_lobes[1] + x * x];
                let [u, v] = random.pair();
                let (z, phi) = (1.0 - 2.0 * u, 2.0 * std::f64::consts::PI * v);
                let s = (1.0 - z * z).sqrt();
                let l = [s * phi.cos(), s * phi.sin(), z];
                let (reflected, density) = bsdf.eval_with_density(l);
                let x = reflected[1] * 4.0 * std::f64::consts::PI;
                evenly = [evenly[0] + x, evenly[1] + x * x];
                densities += density * 4.0 * std::f64::consts::PI / f64::from(n);
            }
            let mean = |[sum, square]: [f64; 2]| {
                let mean = sum / f64::from(n);
                (mean, ((square / f64::from(n) - mean * mean) / f64::from(n)).sqrt())
            };
            let ((a, da), (b, db)) = (mean(by_lobes), mean(evenly));
            assert!((a - b).abs() < 4.5 * da.hypot(db), "case {case}, {compensation}: {a} +- {da}, {b} +- {db}");
            assert!((0.8..1.03).contains(&densities) && da < db, "case {case}: {densities}, {da} {db}");
        }
    }
}
