//! Colours of vertices on their way from the mesh to the picture: by the CPU's rasteriser, the GPU and the reference alike; and that a
//! shader has them only where a node reads them.

use std::sync::Arc;

use glam::Vec3;
use halfvector_codegen::{Fold, shader, validate};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput};

use crate::spaces::{scene, told};

/// Between its vertices a colour runs as the place does.
#[test]
fn colors_run_between_vertices_in_every_engine() {
    let nodes = r#""painted": {"node": "geometry/vertex_color"}, "place": {"node": "coordinates/object_position"},
        "same": {"node": "math/multiply_add", "values": {"b": 0.25, "c": 0.5}}, "n": {"node": "math/subtract"}"#;
    let links = r#"{"from": "painted.color", "to": "n.a"}, {"from": "place.out", "to": "same.a"}, {"from": "same.out", "to": "n.b"},"#;
    let mut painted = scene(nodes, links, "n");
    for mesh in &mut painted.meshes {
        let mesh = Arc::make_mut(mesh);
        mesh.colors = mesh.positions.iter().map(|[x, y, z]| [x, y, z, &0.0].map(|x| 0.25 * x + 0.5)).collect();
    }
    told(&painted, Vec3::ZERO);
}

#[test]
fn meshes_without_colors_are_white() {
    let nodes = r#""painted": {"node": "geometry/vertex_color"}, "n": {"node": "math/multiply"}"#;
    let links = r#"{"from": "painted.color", "to": "n.a"}, {"from": "painted.alpha", "to": "n.b"},"#;
    told(&scene(nodes, links, "n"), Vec3::ONE);
}

/// A height is read in both stages: the normal follows it.
#[test]
fn a_shader_has_colors_of_vertices_only_where_they_are_read() {
    let needs = Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    for (links, is_read) in [
        ("", false),
        (r#"{"from": "painted.alpha", "to": "surface.height"}"#, true),
        (r#"{"from": "painted.color", "to": "surface.base_color"}"#, true),
    ] {
        let text = format!(
            r#"{{"halfvector": 1, "name": "Painted", "nodes": {{"painted": {{"node": "geometry/vertex_color"}},
                "surface": {{"node": "surface/surface"}}}}, "links": [{links}]}}"#
        );
        let document = halfvector_graph::file::from_json(&text).unwrap_or_else(|e| panic!("{e}"));
        let made = shader(&document, Library::standard(), &needs, Fold::Export).unwrap_or_else(|e| panic!("{e}"));
        validate(&made).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(made.reflection.vertex_inputs.iter().any(|input| input.name == "color"), is_read, "{links}");
        assert_eq!(made.wgsl.contains("vertex_color: vec4f"), is_read, "{links}");
    }
}
