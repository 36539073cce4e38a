//! Every planted fault is found and named, and every other example is quiet.

use std::path::{Path, PathBuf};

use halfvector_reference::{Precision, Stability, stability};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

/// Fewest planted cases.
const CASES: usize = 10;

fn materials(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../").join(folder);
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(&folder).expect("the folder").map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(".material.json"));
    files.sort();
    files
}

fn judged(path: &Path) -> Stability {
    let document = halfvector_graph::file::load(path).unwrap_or_else(|e| panic!("{e}"));
    let folder = path.parent().expect("a folder");
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, folder, &sphere).unwrap_or_else(|e| panic!("{e}"));
    let judged = stability(&scene, 0, Precision::Single).unwrap_or_else(|e| panic!("{e}"));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let list = |kind: &str, findings: &[halfvector_reference::Finding]| {
        for f in findings {
            println!("{name}: {kind}: {}.{} {} for {} at {:?}", f.node, f.output, f.narrow, f.exact, f.input);
        }
    };
    list("unstable", &judged.unstable);
    list("edge", &judged.edges);
    judged
}

#[test]
fn planted_faults_are_found_and_named() {
    let files = materials("examples/unstable");
    assert!(files.len() >= CASES);
    let mut wrong = Vec::new();
    for path in files {
        let found: Vec<String> = judged(&path).unstable.into_iter().map(|finding| finding.node).collect();
        if found != ["culprit"] {
            wrong.push(format!("{}: {found:?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn other_examples_are_quiet() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/models").exists();
    let mut loud = Vec::new();
    for path in materials("examples").into_iter().chain(materials("examples/nodes")) {
        if models || !path.to_string_lossy().contains("flight-helmet") {
            let found = judged(&path).unstable;
            if !found.is_empty() {
                loud.push(path);
            }
        }
    }
    assert!(loud.is_empty(), "{loud:?}");
}

/// A checker and the borders of Worley's cells jump; that is no fault, and they are told apart.
#[test]
fn steps_are_edges() {
    let text = r#"{"halfvector": 1, "name": "Steps",
        "nodes": {
            "far": {"node": "coordinates/uv_transform", "values": {"scale": [3.3, 3.3], "offset": [40.1, 40.7]}},
            "checker": {"node": "procedural/checker"},
            "surface": {"node": "surface/surface"}
        },
        "links": [{"from": "far.out", "to": "checker.uv"}, {"from": "checker.out", "to": "surface.metallic"}]}"#;
    let document = halfvector_graph::file::from_json(text).expect("a document");
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, Path::new(""), &sphere).expect("a scene");
    let found = stability(&scene, 0, Precision::Single).expect("judged");
    assert!(found.unstable.is_empty(), "{:?}", found.unstable);
    assert_eq!(found.edges.iter().map(|finding| finding.node.as_str()).collect::<Vec<_>>(), ["checker"]);
}

/// What f32 does well f16 may not: a product beyond its largest number. What f16 computes well is not named.
#[test]
fn f16_is_judged_where_it_is_asked_for() {
    let text = r#"{"halfvector": 1, "name": "Half",
        "nodes": {
            "large": {"node": "math/multiply", "label": "Large", "values": {"b": 10000}},
            "larger": {"node": "math/multiply", "label": "Larger", "values": {"b": 10000}},
            "back": {"node": "math/divide", "label": "Back", "values": {"b": 1e8}},
            "tint": {"node": "math/multiply", "label": "Tint", "values": {"b": 0.5}},
            "uv": {"node": "coordinates/uv"},
            "parts": {"node": "vector/separate2"},
            "surface": {"node": "surface/surface"}
        },
        "links": [
            {"from": "uv.out", "to": "parts.v"},
            {"from": "parts.x", "to": "large.a"}, {"from": "large.out", "to": "larger.a"}, {"from": "larger.out", "to": "back.a"},
            {"from": "parts.y", "to": "tint.a"},
            {"from": "back.out", "to": "surface.metallic"}, {"from": "tint.out", "to": "surface.perceptual_roughness"}
        ]}"#;
    let document = halfvector_graph::file::from_json(text).expect("a document");
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, Path::new(""), &sphere).expect("a scene");
    let single = stability(&scene, 0, Precision::Single).expect("judged");
    assert!(single.unstable.is_empty(), "{:?}", single.unstable);
    let half = stability(&scene, 0, Precision::Half).expect("judged");
    let [found] = half.unstable.as_slice() else { panic!("{:?}", half.unstable) };
    assert_eq!((found.node.as_str(), found.narrow.is_finite()), ("larger", false), "{found:?}");
    assert!(found.not_finite > 0 && found.exact.is_finite() && found.error().is_infinite());
    let plain = r#"{"halfvector": 1, "name": "Plain", "nodes": {"surface": {"node": "surface/surface"},
        "tint": {"node": "math/multiply", "values": {"b": 0.5}}, "uv": {"node": "coordinates/uv"},
        "parts": {"node": "vector/separate2"}}, "links": [{"from": "uv.out", "to": "parts.v"},
        {"from": "parts.x", "to": "tint.a"}, {"from": "tint.out", "to": "surface.metallic"}]}"#;
    let document = halfvector_graph::file::from_json(plain).expect("a document");
    let scene = Scene::from_material(document, Path::new(""), &sphere).expect("a scene");
    let half = stability(&scene, 0, Precision::Half).expect("judged");
    assert!(half.unstable.is_empty(), "{:?}", half.unstable);
}
