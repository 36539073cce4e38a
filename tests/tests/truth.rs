//! Every lobe lit by lamps, where nothing is filtered or fitted but albedos: what the shader draws on the CPU in f64 is what
//! the reference says.

use std::path::Path;

use halfvector_codegen::Fold;
use halfvector_graph::document::Document;
use halfvector_graph::value::Value;
use halfvector_raster::RasterOptions;
use halfvector_reference::{Reference, RenderOptions};
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Scene};

/// Pixels on a side.
const SIZE: u32 = 32;
/// Blocks on a side.
const BLOCKS: u32 = 4;

fn scene(values: &[(&str, f32)], colors: &[(&str, [f32; 3])], thin_walled: bool) -> Scene {
    let mut document = Document::with_surface("lobes");
    document.surface.thin_walled = thin_walled;
    let surface = document.graph.nodes.get_mut("surface").expect("the surface");
    let numbers = values.iter().map(|(name, x)| ((*name).to_owned(), Value::Number(*x)));
    surface.values.extend(numbers.chain(colors.iter().map(|(name, x)| ((*name).to_owned(), Value::Vec3(*x)))));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let mut scene = Scene::from_material(document, Path::new(""), &sphere).expect("sound");
    scene.environment = EnvironmentSource::None;
    scene.background = Background::None;
    let behind = values.iter().any(|(name, _)| *name == "transmission_weight");
    let lights = ["directional:1,2,2:3", if behind { "directional:0.3,0.4,-1:2" } else { "directional:-2,0.5,1:1" }];
    scene.lights = lights.iter().map(|light| parse_light(light).expect("a light")).collect();
    scene
}

/// Root mean square difference of blocks over the mean of the reference, of pixels that the sphere covers whole. One pixel is
/// noisy where a highlight has its edge.
fn apart(scene: &Scene) -> f64 {
    let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side: 8, fold: Fold::Export };
    let drawn = halfvector_raster::draw::<f64>(scene, None, &options, |_| {}).expect("drawn");
    let options = RenderOptions { width: SIZE, height: SIZE, shadows: false, ..RenderOptions::default() };
    let mut reference = Reference::new(scene, None, options).expect("a sound scene");
    reference.add_samples(64, &|_| {}).expect("rendered");
    assert_eq!(reference.faults(), [""; 0]);
    let truth = reference.picture();
    let mut blocks = [[[0.0; 2]; 3]; (BLOCKS * BLOCKS) as usize];
    for (i, (drawn, truth)) in drawn.pixels.iter().zip(&truth.pixels).enumerate() {
        if drawn[3] < 1.0 || truth[3] < 1.0 {
            continue;
        }
        let [x, y] = [i as u32 % SIZE, i as u32 / SIZE].map(|k| k * BLOCKS / SIZE);
        for (block, (a, b)) in blocks[(y * BLOCKS + x) as usize].iter_mut().zip(drawn.iter().zip(truth)) {
            *block = [block[0] + f64::from(*a), block[1] + b];
        }
    }
    let all: Vec<[f64; 2]> = blocks.into_iter().flatten().collect();
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
    mean(&|[a, b]| (a - b).powi(2)).sqrt() / mean(&|[_, b]| *b)
}

/// Name, numbers and colours of the surface, and whether it is a thin wall.
type Case = (&'static str, &'static [(&'static str, f32)], &'static [(&'static str, [f32; 3])], bool);

#[test]
fn lobes_under_lamps_are_those_of_the_reference() {
    const METAL: &[(&str, f32)] = &[("metallic", 1.0), ("perceptual_roughness", 0.5)];
    const BRUSHED: &[(&str, f32)] =
        &[("metallic", 1.0), ("perceptual_roughness", 0.4), ("anisotropy", 0.8), ("anisotropy_rotation", 0.6)];
    const FILM: &[(&str, f32)] =
        &[("thin_film_weight", 0.9), ("thin_film_thickness", 0.42), ("perceptual_roughness", 0.4)];
    const COATED: &[(&str, f32)] = &[("coat_weight", 0.8), ("coat_roughness", 0.4), ("perceptual_roughness", 0.6)];
    const GLASS: &[(&str, f32)] = &[("transmission_weight", 0.8), ("perceptual_roughness", 0.5)];
    const SOAP: &[(&str, f32)] =
        &[("transmission_weight", 0.9), ("perceptual_roughness", 0.4), ("thin_film_weight", 1.0)];
    const SHEEN: &[(&str, [f32; 3])] = &[("sheen_color", [0.6, 0.5, 0.4])];
    const FILM_ON_METAL: &[(&str, f32)] = &[METAL[0], METAL[1], FILM[0], FILM[1]];
    let cases: [Case; 9] = [
        ("dielectric", &[("perceptual_roughness", 0.4)], &[], false),
        ("metal", METAL, &[], false),
        ("brushed", BRUSHED, &[], false),
        ("film", FILM, &[], false),
        ("film on metal", FILM_ON_METAL, &[], false),
        ("coat", COATED, &[], false),
        ("sheen", &[], SHEEN, false),
        ("glass", GLASS, &[], false),
        ("soap", SOAP, &[], true),
    ];
    let mut wrong = Vec::new();
    for (name, values, colors, thin_walled) in cases {
        let rms = apart(&scene(values, colors, thin_walled));
        println!("{name:<14} {:.3} %", 100.0 * rms);
        // Light from behind makes the rim of a sphere bright, where its triangles are seen.
        let bound = if name == "glass" || name == "soap" { 0.03 } else { 0.01 };
        if rms > bound {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
