//! Under light that is 1 from everywhere, what leaves is the albedo: and 1 where all is given back.

use halfvector_ibl::white;
use halfvector_reference::{Reference, RenderOptions};
use halfvector_scene::{Background, BuiltinMesh};

use crate::{color, number, scene};

/// Mean of the pixels that are covered whole, and its standard error.
fn mean(
    shape: BuiltinMesh,
    values: &[(&str, halfvector_graph::value::Value)],
    methods: &[(&str, &str)],
    options: RenderOptions,
) -> (f64, f64) {
    let mut scene = scene(shape, values, methods);
    scene.background = Background::None;
    let mut reference = Reference::new(&scene, Some(&white()), options).expect("a sound scene");
    reference.add_samples(64, &|_| {}).expect("rendered");
    let picture = reference.picture();
    let whole: Vec<usize> = (0..picture.pixels.len()).filter(|i| picture.pixels[*i][3] == 1.0).collect();
    let n = whole.len() as f64;
    let sum: f64 = whole.iter().map(|i| picture.pixels[*i][1]).sum();
    let errors = picture.standard_error.as_ref().expect("of many samples");
    let variance: f64 = whole.iter().map(|i| errors[*i][1].powi(2)).sum();
    (sum / n, variance.sqrt() / n)
}

const SMALL: fn() -> RenderOptions = || RenderOptions { width: 32, height: 32, ..RenderOptions::default() };

#[test]
fn white_surfaces_give_all_back() {
    for (roughness, compensation) in [(0.05, "turquin"), (0.5, "turquin"), (1.0, "fdez_aguera"), (0.7, "kulla_conty")] {
        let values =
            [("base_color", color([1.0; 3])), ("metallic", number(1.0)), ("perceptual_roughness", number(roughness))];
        let (mean, error) = mean(BuiltinMesh::Sphere, &values, &[("compensation", compensation)], SMALL());
        println!("metal {roughness} {compensation}: {mean:.5} +- {error:.5}");
        assert!((mean - 1.0).abs() < 4.0 * error + 1e-3, "{roughness} {compensation}: {mean} +- {error}");
    }
    // A brushed metal, whose albedo is that of a round one of the same area nearly: each form of Smith's with its own.
    for v in ["correlated", "separable"] {
        let values = [
            ("base_color", color([1.0; 3])),
            ("metallic", number(1.0)),
            ("perceptual_roughness", number(0.8)),
            ("anisotropy", number(0.8)),
        ];
        let (mean, error) = mean(BuiltinMesh::Sphere, &values, &[("v", v), ("compensation", "turquin")], SMALL());
        println!("brushed metal, {v}: {mean:.5} +- {error:.5}");
        assert!(mean < 1.0 + 4.0 * error && mean > 0.96, "{v}: {mean} +- {error}");
    }
    let values = [("base_color", color([1.0; 3])), ("specular", number(0.0))];
    let (diffuse, _) = mean(BuiltinMesh::Sphere, &values, &[], SMALL());
    assert!((diffuse - 1.0).abs() < 1e-9, "{diffuse}");
    // A dielectric's interface and base together: 1 less what tables may be wrong by.
    let values = [("base_color", color([1.0; 3])), ("perceptual_roughness", number(0.3))];
    let (coupled, error) =
        mean(BuiltinMesh::Sphere, &values, &[("coupling", "view"), ("compensation", "turquin")], SMALL());
    println!("dielectric: {coupled:.5} +- {error:.5}");
    assert!((coupled - 0.9975).abs() < 4.0 * error + 1.5e-3, "{coupled} +- {error}");
}

/// A white body of any shape is not to be seen before light that is the same from everywhere, if light may bounce.
#[test]
fn a_white_torus_needs_its_bounces() {
    let values = [("base_color", color([1.0; 3])), ("specular", number(0.0))];
    let bounces = |bounces| RenderOptions { bounces, ..SMALL() };
    let (none, _) = mean(BuiltinMesh::Torus, &values, &[], bounces(0));
    let (many, error) = mean(BuiltinMesh::Torus, &values, &[], bounces(64));
    let (unshadowed, _) = mean(BuiltinMesh::Torus, &values, &[], RenderOptions { shadows: false, ..SMALL() });
    println!("torus: direct {none:.4}, all bounces {many:.4} +- {error:.4}, without shadows {unshadowed:.6}");
    // Interpolated normals turn some of the rays into the faces, where they are lost.
    assert!(none < 0.95 && (many - 1.0).abs() < 4.0 * error + 5e-3 && (unshadowed - 1.0).abs() < 1e-9);
}

/// What has the index of air lets all light through, however rough: its lobe is one direction.
#[test]
fn a_body_of_the_index_of_air_is_not_to_be_seen() {
    for (roughness, ior) in [(0.05, 1.0), (0.5, 1.0), (1.0, 1.0), (0.5, 1.0 + 1e-9), (0.5, 1.0 - 1e-7)] {
        let values = [
            ("base_color", color([1.0; 3])),
            ("transmission_weight", number(1.0)),
            ("perceptual_roughness", number(roughness)),
            ("ior", number(ior)),
        ];
        // Schlick's form reflects all at grazing incidence whatever the index.
        let (mean, error) =
            mean(BuiltinMesh::Sphere, &values, &[("compensation", "none"), ("fresnel", "exact")], SMALL());
        println!("roughness {roughness}, ior {ior}: {mean:.5} +- {error:.5}");
        // Facets that hide each other lose some of the light: nothing of a smooth body, a fifth of a rough one.
        let least = 1.0 - 0.25 * roughness;
        assert!(mean > least - 4.0 * error && mean < 1.0 + 4.0 * error, "{roughness} {ior}: {mean} +- {error}");
        assert!(error < 0.01, "{roughness} {ior}: {mean} +- {error}");
    }
}

#[test]
fn layers_never_gain() {
    let one = |name, value| vec![("base_color", color([1.0; 3])), (name, value)];
    for (values, least) in [
        (one("coat_weight", number(1.0)), 0.8),
        (one("sheen_color", color([1.0; 3])), 0.8),
        (one("transmission_weight", number(1.0)), 0.9),
    ] {
        let (mean, error) =
            mean(BuiltinMesh::Sphere, &values, &[("coupling", "view"), ("compensation", "turquin")], SMALL());
        println!("{}: {mean:.4} +- {error:.4}", values[1].0);
        assert!(mean < 1.03 + 4.0 * error && mean > least, "{values:?}: {mean} +- {error}");
    }
}
