//! Whole documents through codegen.

mod cost;
mod custom;
mod explain;
mod figures;
mod folding;
mod groups;
mod hostile;
mod integers;
mod mixed;
mod nodes;
mod only_needed;
mod stages;
mod targets;

use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};

use crate::{Fold, Shader, shader, validate};

pub(super) fn document(json: &str) -> Document {
    halfvector_graph::file::from_json(json).unwrap_or_else(|e| panic!("{e}\n{json}"))
}

/// A document of a surface node named `surface` with these values, nodes and links (JSON).
pub(super) fn material(values: &str, nodes: &str, links: &str) -> Document {
    with_parameters(values, nodes, links, "")
}

pub(super) fn with_parameters(values: &str, nodes: &str, links: &str, parameters: &str) -> Document {
    let comma = if nodes.is_empty() { "" } else { "," };
    document(&format!(
        r#"{{ "halfvector": 1, "name": "Test",
            "nodes": {{ "surface": {{"node": "surface/surface", "values": {{{values}}}}}{comma} {nodes} }},
            "links": [{links}], "parameters": [{parameters}] }}"#
    ))
}

pub(super) fn nothing() -> Needs {
    Needs {
        directional_lights: 0,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    }
}

pub(super) fn sun() -> Needs {
    Needs { directional_lights: 1, ..nothing() }
}

pub(super) fn environment() -> Needs {
    Needs { environment: Some(EnvironmentNeeds { rotated: false }), ..nothing() }
}

pub(super) fn methods(chosen: &[(&str, &str)]) -> Methods {
    let mut methods = Methods::default();
    for (term, method) in chosen {
        methods.set(term, method).expect("a method of the list");
    }
    methods
}

/// Where a judge must be there, its absence fails the test.
pub(super) fn judge_may_miss(name: &str) {
    assert!(std::env::var("HALFVECTOR_REQUIRE_JUDGES").as_deref() != Ok("1"), "{name} is not installed");
}

/// The shader of a document, which naga has accepted.
pub(super) fn made(document: &Document, needs: &Needs, fold: Fold) -> Shader {
    let shader = shader(document, Library::standard(), needs, fold).unwrap_or_else(|e| panic!("{e}"));
    validate(&shader).unwrap_or_else(|e| panic!("{e}\n{}", shader.wgsl));
    let covered = shader.segments.windows(2).all(|pair| pair[0].end == pair[1].start);
    assert!(covered && shader.segments.last().is_some_and(|s| s.end == shader.wgsl.len()), "segments have gaps");
    shader
}

pub(super) fn exported(document: &Document, needs: &Needs) -> Shader {
    made(document, needs, Fold::Export)
}

/// Four maps.
pub(super) fn maps() -> Document {
    let image = |id: &str, space: &str| {
        format!(
            r#""{id}": {{"node": "textures/image", "label": "{id} map", "values": {{"image": {{"file": "{id}.png", "color_space": "{space}"}}}}}}"#
        )
    };
    material(
        "",
        &[
            image("albedo", "srgb"),
            image("roughness", "linear"),
            image("metalness", "linear"),
            image("normal", "linear"),
            r#""bent": {"node": "textures/normal_map", "label": "Normal map"}"#.into(),
        ]
        .join(","),
        r#"{"from": "albedo.color", "to": "surface.base_color"}, {"from": "metalness.r", "to": "surface.metallic"},
           {"from": "roughness.r", "to": "surface.perceptual_roughness"},
           {"from": "normal.color", "to": "bent.color"}, {"from": "bent.out", "to": "surface.normal"}"#,
    )
}
