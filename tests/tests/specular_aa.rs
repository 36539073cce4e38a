//! Specular anti-aliasing, measured: pictures of one sample for each pixel against the mean of many, in linear radiance.

use std::path::Path;

use glam::Vec3;
use halfvector_codegen::Fold;
use halfvector_graph::file::from_json;
use halfvector_raster::RasterOptions;
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Scene};

const SIZE: u32 = 32;

const BUMPS: &str = r#""functions": {"bumps": ["/// Bumps", "///", "/// Waves of a normal map.", "/// @node custom/bumps",
    "/// - uv: where [context uv0]", "/// - count: waves over the unit [9]", "/// - return: as in a normal map",
    "fn bumps(uv: vec2f, count: f32) -> vec3f {", "    let w = 6.2831853 * count * uv;",
    "    return vec3f(0.5 + 0.12 * cos(w.x) * cos(0.7 * w.y), 0.5 - 0.1 * sin(w.x) * sin(0.7 * w.y), 1.0);", "}"]},"#;

/// A metal of this roughness that a sun shines on, bumpy or smooth, this far away.
fn scene(mesh: BuiltinMesh, bumpy: bool, roughness: f32, distance: f32) -> Scene {
    let (nodes, links) = match bumpy {
        true => (
            r#""waves": {"node": "custom/bumps"}, "map": {"node": "textures/normal_map"},"#,
            r#"{"from": "waves.out", "to": "map.color"}, {"from": "map.out", "to": "surface.normal"}"#,
        ),
        false => ("", ""),
    };
    let text = format!(
        r#"{{"halfvector": 1, "name": "Bumps", {BUMPS} "nodes": {{{nodes}
            "surface": {{"node": "surface/surface", "values": {{"metallic": 1, "perceptual_roughness": {roughness}}}}}}}, "links": [{links}]}}"#
    );
    let document = from_json(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let mut scene = Scene::from_material(document, Path::new(""), &MeshSource::Builtin(mesh)).expect("a scene");
    (scene.environment, scene.background) = (EnvironmentSource::None, Background::None);
    scene.camera.position = Vec3::new(0.013, 0.007, distance);
    scene
}

fn drawn(scene: &Scene, samples_per_side: u32) -> Vec<[f32; 4]> {
    let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side, fold: Fold::Export };
    halfvector_raster::draw::<f32>(scene, None, &options, |_| {}).expect("a picture").pixels
}

/// Where the sun stands, one picture for each: where a highlight lies between pixels is chance.
const SUNS: [&str; 5] = ["0.3,0.4,1", "-0.5,0.1,1", "0.1,-0.55,1", "-0.2,0.33,1", "0.62,-0.21,1"];
const METHODS: [&str; 3] = ["none", "box", "tokuyoshi"];

/// Root mean square of the difference on covered pixels beside the mean of the many samples, over all suns, for each method.
fn errors(scene: &mut Scene) -> [f64; 3] {
    let (mut squares, mut sum, mut count) = ([0.0; 3], 0.0, 0.0);
    for sun in SUNS {
        scene.lights = vec![parse_light(&format!("directional:{sun}:3")).expect("a light")];
        scene.methods.set("specular_aa", "none").expect("a method");
        let many = drawn(scene, 16);
        let covered = |pixels: &[[f32; 4]]| -> Vec<f64> {
            let inside = pixels.iter().zip(&many).filter(|(_, many)| many[3] == 1.0);
            inside.map(|(pixel, _)| f64::from(pixel[0])).collect()
        };
        let wanted = covered(&many);
        (sum, count) = (sum + wanted.iter().sum::<f64>(), count + wanted.len() as f64);
        for (method, squares) in METHODS.into_iter().zip(&mut squares) {
            scene.methods.set("specular_aa", method).expect("a method");
            let one = covered(&drawn(scene, 1));
            *squares += one.iter().zip(&wanted).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        }
    }
    squares.map(|squares| (squares / count).sqrt() / (sum / count))
}

/// A turn of the normal within the pixel, as roughness, is nearer to the mean over the pixel than the normal at its middle alone.
#[test]
fn sharp_highlights_are_nearer_to_the_mean_over_the_pixel() {
    println!("{:<36} {:>8} {:>8} {:>10}", "rms over mean", "none", "box", "tokuyoshi");
    let mut failed = Vec::new();
    for (name, mesh, bumpy, distance) in [
        ("sphere of 12 pixels", BuiltinMesh::Sphere, false, 10.0),
        ("bumps of 3 pixels", BuiltinMesh::Plane, true, 5.0),
        ("bumps of 2 pixels", BuiltinMesh::Plane, true, 8.0),
    ] {
        for roughness in [0.15, 0.3] {
            let [none, own, tokuyoshi] = errors(&mut scene(mesh, bumpy, roughness, distance));
            println!("{:<36} {none:>8.3} {own:>8.3} {tokuyoshi:>10.3}", format!("{name}, roughness {roughness}"));
            if own > 0.8 * none {
                failed.push(format!("{name} at {roughness}: {own} instead of {none}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
