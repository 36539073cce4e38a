//! The documents that people open first, as shaders for a scene with all that a scene may want: every target before the judges,
//! and every line of the WGSL in the map.

use halfvector_codegen::{Fold, Shader, line_map, shader};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput, ToneMap};

use crate::golden::judge;
use crate::support::root;

fn needs() -> Needs {
    Needs {
        directional_lights: 1,
        point_lights: 2,
        spot_lights: 0,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Display(ToneMap::PbrNeutral),
        methods: Methods::default(),
    }
}

/// Name and shader of each material of the examples.
fn examples() -> Vec<(String, Shader)> {
    let mut paths = Vec::new();
    for folder in ["examples", "examples/nodes", "examples/unstable"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder of examples");
        let files = entries.map(|entry| entry.expect("a file").path());
        paths.extend(files.filter(|path| path.to_string_lossy().ends_with(".material.json")));
    }
    paths.sort();
    assert!(paths.len() > 30, "{} examples", paths.len());
    let made = paths.iter().map(|path| {
        let name = path.file_name().expect("a name").to_string_lossy().replace(".material.json", "");
        let document = halfvector_graph::file::load(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let shader = shader(&document, Library::standard(), &needs(), Fold::Export);
        (name, shader.unwrap_or_else(|e| panic!("{}: {e}", path.display())))
    });
    made.collect()
}

#[test]
fn examples_pass_the_judges() {
    let examples = examples();
    judge(examples.iter().map(|(name, shader)| (name.as_str(), shader)));
}

/// Each line that is not empty stands in one entry of the map, and in no second one.
#[test]
fn every_line_is_in_the_map_once() {
    for (name, shader) in examples() {
        let map = line_map(&shader);
        let mut above = 0;
        for lines in &map {
            assert!(lines.first > above && lines.last >= lines.first, "{name}: {lines:?} after line {above}");
            above = lines.last;
        }
        for (number, line) in (1..).zip(shader.wgsl.lines()) {
            let covered = map.iter().any(|lines| (lines.first..=lines.last).contains(&number));
            assert!(covered || line.trim().is_empty(), "{name}: line {number} is in no entry: {line}");
        }
        assert!(above <= shader.wgsl.lines().count(), "{name}");
    }
}
