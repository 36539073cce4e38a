//! The project's examples: sound, in the program's own layout, and made by the project's own code.

use std::path::{Path, PathBuf};

use halfvector_graph::check::check;
use halfvector_graph::file;
use halfvector_graph::library::Library;
use halfvector_graph::value::Value;
use halfvector_scene::{EnvironmentSource, Scene, load_scene};

use crate::data::data;
use crate::support::errors;

#[path = "../../examples/maps/mod.rs"]
mod maps;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

fn files(ending: &str) -> Vec<PathBuf> {
    let mut files: Vec<_> = std::fs::read_dir(examples()).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(ending));
    files.sort();
    assert!(!files.is_empty(), "there are examples");
    files
}

fn scene(name: &str) -> Scene {
    load_scene(&examples().join(format!("{name}.scene.json"))).unwrap()
}

#[test]
fn materials_are_sound_and_in_the_programs_layout() {
    for path in files(".material.json") {
        let file::Loaded { document, instance, .. } = file::load_whole(&path).unwrap();
        let problems = check(&document, Library::standard());
        assert!(problems.is_empty(), "{}: {problems:?}", path.display());
        let text = std::fs::read_to_string(&path).unwrap();
        if let Some(instance) = instance {
            assert_eq!(file::instance_to_json(&instance), text, "{}", path.display());
            continue;
        }
        assert_eq!(file::to_json(&document), text, "{}", path.display());
        for node in document.graph.nodes.keys() {
            assert!(
                document.graph.layout.contains_key(node),
                "{}: `{node}` has no place on the canvas",
                path.display()
            );
        }
    }
}

#[test]
fn scenes_load() {
    for path in files(".scene.json").into_iter().filter_map(|path| crate::models::with_models(path, || data("models")))
    {
        let scene = load_scene(&path).unwrap();
        assert!(!scene.objects.is_empty() && !scene.name.is_empty(), "{}", path.display());
        for material in &scene.materials {
            let problems = errors(&material.document);
            assert!(problems.is_empty(), "{}: {problems:?}", path.display());
        }
    }
}

#[test]
fn the_surface_example_offers_every_input_that_can_be_a_number() {
    let document = file::load(&examples().join("surface.material.json")).unwrap();
    let surface = Library::standard().get("surface/surface").unwrap();
    let offered: Vec<_> = document.parameters.iter().map(|p| p.name.as_str()).collect();
    // A normal is a direction at each point: no number stands for it.
    let inputs: Vec<_> =
        surface.inputs.iter().map(|i| i.name.as_str()).filter(|name| !name.ends_with("normal")).collect();
    assert_eq!(offered, inputs);
    for parameter in &document.parameters {
        assert_eq!(parameter.socket.socket, parameter.name);
    }
}

#[test]
fn the_reports_scenes_say_what_the_report_says() {
    let value = |scene: &Scene, socket: &str| {
        scene.materials[scene.objects[0].material].document.graph.nodes["surface"].values[socket].clone()
    };
    let near = |value: Value, expected: &[f32]| {
        let there = value.components().unwrap().to_vec();
        assert!(there.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{there:?} {expected:?}");
    };
    let linear = |code: u8| halfvector_maps::color::linear_from_srgb([f32::from(code) / 255.0; 3])[0];

    let mirror = scene("report-1-mirror");
    near(value(&mirror, "base_color"), &[1.0; 3]);
    near(value(&mirror, "metallic"), &[1.0]);
    near(value(&mirror, "perceptual_roughness"), &[0.0]);
    let red = scene("report-2-red-metal");
    near(value(&red, "base_color"), &[linear(176), 0.0, 0.0]);
    near(value(&red, "perceptual_roughness"), &[0.0]);
    let rough = scene("report-3-rough-metal");
    near(value(&rough, "metallic"), &[0.865]);
    near(value(&rough, "perceptual_roughness"), &[0.18]);
    let punctual = scene("report-4-punctual-only");
    near(value(&punctual, "base_color"), &[linear(169), linear(126), linear(126)]);
    near(value(&punctual, "metallic"), &[0.715]);
    near(value(&punctual, "perceptual_roughness"), &[0.41]);
    assert_eq!(punctual.environment, EnvironmentSource::None);
    assert!(!punctual.lights.is_empty());
    assert!(scene("report-5-textured").images.images().len() >= 4);
    let height = scene("report-6-height");
    let document = &height.materials[height.objects[0].material].document;
    assert!(document.graph.links.iter().any(|l| l.to.node == "surface" && l.to.socket == "height"));
}

#[test]
fn an_absent_model_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight-helmet.scene.json");
    for name in ["flight-helmet.scene.json", "flight-helmet-leather.material.json"] {
        // Somewhere that no data folder stands for.
        let text = std::fs::read_to_string(examples().join(name)).unwrap().replace("../../shared/data", "absent");
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let error = load_scene(&path).unwrap_err().to_string();
    assert!(error.contains("FlightHelmet.gltf could not be read"), "{error}");
}

#[test]
fn textures_are_what_the_program_makes() {
    let folder = examples().join("textures");
    let mut bytes = 0;
    for (name, made) in maps::maps() {
        let path = folder.join(name);
        bytes += std::fs::metadata(&path).unwrap().len();
        let stored = image::open(&path).unwrap();
        assert!(stored == made, "{name} differs: cargo run -p halfvector-scene --example make_textures");
        assert!(stored.width() <= 512 && stored.height() <= 512);
    }
    assert!(bytes < 900_000, "the pictures take {bytes} bytes");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), maps::maps().len(), "nothing else lies there");
}

/// What stands left and right, and above and below, of a repeating picture continues it.
#[test]
fn textures_repeat_without_a_seam() {
    for (name, picture) in maps::maps() {
        let picture = picture.to_luma32f();
        let (width, height) = picture.dimensions();
        let at = |x: u32, y: u32| picture.get_pixel(x % width, y % height).0[0];
        // The step over the border is no larger than the largest step within.
        let step = |x: u32, y: u32| (at(x + 1, y) - at(x, y)).abs().max((at(x, y + 1) - at(x, y)).abs());
        let within = (0..height - 1)
            .flat_map(|y| (0..width - 1).map(move |x| (x, y)))
            .map(|(x, y)| step(x, y))
            .fold(0.0, f32::max);
        let across = (0..height).map(|y| (at(width, y) - at(width - 1, y)).abs());
        let down = (0..width).map(|x| (at(x, height) - at(x, height - 1)).abs());
        let seam = across.chain(down).fold(0.0, f32::max);
        assert!(seam <= within, "{name}: a step of {seam} at the border, {within} within");
    }
}
