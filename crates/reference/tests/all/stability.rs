//! Every planted fault is found and named, and every other example is quiet.

use std::path::{Path, PathBuf};

use halfvector_reference::{Stability, stability};
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
    let judged = stability(&scene, 0).unwrap_or_else(|e| panic!("{e}"));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let list = |kind: &str, findings: &[halfvector_reference::Finding]| {
        for f in findings {
            println!("{name}: {kind}: {}.{} {} for {} at {:?}", f.node, f.output, f.single, f.exact, f.input);
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
    for path in materials("examples") {
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
    let found = stability(&scene, 0).expect("judged");
    assert!(found.unstable.is_empty(), "{:?}", found.unstable);
    assert_eq!(found.edges.iter().map(|finding| finding.node.as_str()).collect::<Vec<_>>(), ["checker"]);
}
