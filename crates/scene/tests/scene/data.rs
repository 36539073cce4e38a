//! Real models beside the project, when they are there: `HALFVECTOR_DATA`, or `../shared/data` from the root.

use std::path::PathBuf;

use halfvector_scene::{Scene, gltf};

use crate::support::errors;

pub(crate) fn data(path: &str) -> Option<PathBuf> {
    let root = std::env::var_os("HALFVECTOR_DATA")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let path = root.join(path);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} is not there", path.display());
    None
}

/// (file, triangles that are drawn, materials), by Khronos' validator.
const MODELS: [(&str, usize, usize); 6] = [
    ("NormalTangentTest.glb", 7774, 1),
    ("MetalRoughSpheresNoTextures.glb", 1_040_409, 98),
    ("FlightHelmet/FlightHelmet.gltf", 94722, 6),
    ("shaderball.glb", 88264, 1),
    ("SpecularTest.glb", 44828, 24),
    ("TextureSettingsTest.glb", 72, 10),
];

#[test]
fn real_models_are_read() {
    for (file, triangles, materials) in MODELS {
        let Some(path) = data(&format!("models/{file}")) else { continue };
        let model = gltf::load(&path).unwrap();
        let drawn: usize = model.objects.iter().map(|o| model.meshes[o.mesh].indices.len() / 3).sum();
        let of_the_file = model.materials.iter().filter(|m| m.document.name != "glTF default").count();
        assert_eq!((drawn, of_the_file), (triangles, materials), "{file}");
        for material in &model.materials {
            let problems = errors(&material.document);
            assert!(problems.is_empty(), "{file}, {}: {problems:?}", material.document.name);
        }
        for mesh in &model.meshes {
            for (normal, tangent) in mesh.normals.iter().zip(&mesh.tangents) {
                let length: f32 = normal.iter().map(|x| x * x).sum();
                let across: f32 = tangent[..3].iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-4 && (across - 1.0).abs() < 1e-4 && tangent[3].abs() == 1.0);
            }
        }
        println!("{file}: {} meshes, {} objects, notes {:?}", model.meshes.len(), model.objects.len(), model.notes);
    }
}

#[test]
fn a_textured_model_has_its_images() {
    let Some(path) = data("models/FlightHelmet/FlightHelmet.gltf") else { return };
    let scene = Scene::from_model(&path).unwrap();
    assert_eq!(scene.images.images().len(), 15);
    let bounds = scene.bounds().unwrap();
    assert!(bounds.radius() > 0.2 && bounds.radius() < 1.0, "a helmet is {} m", bounds.radius());
    let Some(path) = data("models/NormalTangentTest.glb") else { return };
    let scene = Scene::from_model(&path).unwrap();
    assert!(!scene.images.images().is_empty());
}

#[test]
fn a_tiny_model_is_seen() {
    let Some(path) = data("models/MetalRoughSpheresNoTextures.glb") else { return };
    let scene = Scene::from_model(&path).unwrap();
    let bounds = scene.bounds().unwrap();
    let near = scene.camera.near(Some(bounds));
    let distance = (scene.camera.position - bounds.center()).length();
    assert!(distance < 0.1 && near > 0.0 && near < distance - bounds.radius() * 0.5, "{distance} {near}");
}
