//! The examples of the nodes: one document for each category under `examples/nodes/`, in which each of its nodes stands, and which becomes a
//! shader.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_codegen::{Fold, shader, validate};
use halfvector_graph::check::check;
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};

use crate::support::root;

fn examples() -> Vec<(String, Document)> {
    let folder = root().join("examples/nodes");
    let mut paths: Vec<_> = std::fs::read_dir(&folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    paths.sort();
    let load = |path: std::path::PathBuf| {
        let document = halfvector_graph::file::load(&path).unwrap_or_else(|e| panic!("{e}"));
        let name =
            path.file_name().unwrap_or_default().to_string_lossy().trim_end_matches(".material.json").to_string();
        (name, document)
    };
    paths.into_iter().map(load).collect()
}

#[test]
fn every_node_stands_in_the_example_of_its_category() {
    let mut used: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, document) in examples() {
        used.entry(name).or_default().extend(document.graph.nodes.values().map(|node| node.node.clone()));
    }
    let missing: Vec<&str> = Library::standard()
        .iter()
        .map(|def| def.id.as_str())
        .filter(|id| !used.get(id.split('/').next().unwrap_or("")).is_some_and(|ids| ids.contains(*id)))
        .collect();
    assert!(missing.is_empty(), "in no example: {missing:?}");
}

#[test]
fn examples_of_nodes_become_shaders() {
    let needs = Needs {
        directional_lights: 0,
        point_lights: 0,
        spot_lights: 0,
        environment: Some(EnvironmentNeeds { rotated: false }),
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    for (name, document) in examples() {
        let problems = check(&document, Library::standard());
        assert!(problems.is_empty(), "{name}: {problems:?}");
        let made =
            shader(&document, Library::standard(), &needs, Fold::Export).unwrap_or_else(|e| panic!("{name}: {e}"));
        validate(&made).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}
