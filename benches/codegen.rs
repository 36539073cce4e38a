//! Time from document to WGSL for materials of 30 and of 1,002 nodes with four maps in an environment, with and without naga's
//! validation, numbers live and folded. Promised, without naga: 1 ms and 15 ms.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use halfvector_codegen::{Fold, shader, validate};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};

/// Four maps, and between the albedo and the surface a chain of steps of three nodes: a noise that weighs a mix with a product.
fn chain(steps: usize) -> Document {
    let image = |id: &str, space: &str| {
        let picture = format!(r#"{{"image": {{"file": "{id}.png", "color_space": "{space}"}}}}"#);
        format!(r#""{id}": {{"node": "textures/image", "label": "{id} map", "values": {picture}}}"#)
    };
    let link = |from: &str, to: &str| format!(r#"{{"from": "{from}", "to": "{to}"}}"#);
    let mut nodes = vec![
        image("albedo", "srgb"),
        image("metalness", "linear"),
        image("normal", "linear"),
        image("roughness", "linear"),
        r#""bend": {"node": "textures/normal_map"}, "surface": {"node": "surface/surface"}"#.to_owned(),
    ];
    let mut links = vec![
        link("metalness.r", "surface.metallic"),
        link("roughness.r", "surface.perceptual_roughness"),
        link("normal.color", "bend.color"),
        link("bend.out", "surface.normal"),
    ];
    let mut from = "albedo.color".to_owned();
    for step in 0..steps {
        nodes.push(format!(
            r#""noise{step}": {{"node": "procedural/value_noise_2d", "values": {{"scale": {}}}}},
               "tint{step}": {{"node": "math/multiply", "label": "Tint {step}", "values": {{"b": [0.9, 0.8, 0.7]}}}},
               "mix{step}": {{"node": "math/mix", "label": "Mix {step}"}}"#,
            step + 2
        ));
        links.push(link(&from, &format!("tint{step}.a")));
        links.push(link(&from, &format!("mix{step}.a")));
        links.push(link(&format!("tint{step}.out"), &format!("mix{step}.b")));
        links.push(link(&format!("noise{step}.out"), &format!("mix{step}.t")));
        from = format!("mix{step}.out");
    }
    links.push(link(&from, "surface.base_color"));
    let json = format!(
        r#"{{"halfvector": 1, "name": "A chain", "nodes": {{{}}}, "links": [{}]}}"#,
        nodes.join(","),
        links.join(",")
    );
    let document = halfvector_graph::file::from_json(&json).expect("a sound document");
    assert_eq!(document.graph.nodes.len(), 6 + 3 * steps);
    document
}

fn codegen(criterion: &mut Criterion) {
    let library = Library::standard();
    let needs = Needs {
        directional_lights: 0,
        point_lights: 0,
        spot_lights: 0,
        environment: Some(EnvironmentNeeds { rotated: false }),
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    for steps in [8, 332] {
        let document = chain(steps);
        let nodes = document.graph.nodes.len();
        let mut group = criterion.benchmark_group(format!("codegen, {nodes} nodes, four maps, environment"));
        for (name, fold) in [("export", Fold::Export), ("live", Fold::Live)] {
            let make = || shader(black_box(&document), library, &needs, fold).expect("a shader");
            group.bench_function(format!("{name}, without validation"), |b| b.iter(make));
            group.bench_function(format!("{name}, with validation"), |b| {
                b.iter(|| {
                    let shader = make();
                    validate(&shader).expect("valid");
                    shader
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, codegen);
criterion_main!(benches);
