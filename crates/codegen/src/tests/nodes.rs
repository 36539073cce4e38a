//! Every node of the standard library, alone: each output wired into a surface, through naga.

use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::node_def::{Default, NodeDef};
use halfvector_graph::value::{SocketType, Type};

use super::{environment, made, material};
use crate::{Fold, material as material_alone, validate};

/// Documents in which each output of a node feeds a socket that it converts to.
fn documents(def: &NodeDef) -> Vec<Document> {
    let images = def.inputs.iter().filter(|input| matches!(input.default, Default::Image(_)));
    let values: Vec<String> =
        images.map(|i| format!(r#""{}": {{"file": "a.png", "color_space": "linear"}}"#, i.name)).collect();
    let node = format!(r#""probe": {{"node": "{}", "values": {{{}}}}}"#, def.id, values.join(","));
    let mut documents = Vec::new();
    for output in &def.outputs {
        let ty = match output.ty {
            SocketType::Value(ty) => ty,
            // Nothing connected: the narrowest.
            SocketType::Generic => def.generic[0],
            SocketType::Texture | SocketType::Surface => continue,
        };
        // Types that fit no socket of the surface are taken apart by a node.
        let (through, from) = match ty {
            Type::F32 | Type::I32 | Type::Vec3 => (String::new(), format!("probe.{}", output.name)),
            Type::Bool => (r#", "x": {"node": "math/switch"}"#.into(), "x.out".to_owned()),
            Type::Vec2 | Type::Vec4 => (r#", "x": {"node": "vector/length"}"#.into(), "x.out".to_owned()),
        };
        let socket = if ty == Type::Vec3 { "base_color" } else { "perceptual_roughness" };
        let mut links = format!(r#"{{"from": "{from}", "to": "surface.{socket}"}}"#);
        let into = match ty {
            Type::Bool => Some("condition"),
            Type::Vec2 | Type::Vec4 => Some("v"),
            _ => None,
        };
        if let Some(into) = into {
            let library = Library::standard();
            let helper = if ty == Type::Bool { "math/switch" } else { "vector/length" };
            let inputs = &library.get(helper).expect("a standard node").inputs;
            let input = inputs.iter().find(|i| i.name == into).unwrap_or(&inputs[0]);
            links += &format!(r#", {{"from": "probe.{}", "to": "x.{}"}}"#, output.name, input.name);
        }
        documents.push(material("", &format!("{node}{through}"), &links));
    }
    documents
}

#[test]
fn every_node_alone() {
    let mut tried = 0;
    for def in Library::standard().iter() {
        for document in documents(def) {
            for fold in [Fold::Live, Fold::Export] {
                let shader = made(&document, &environment(), fold);
                let named = shader.segments.iter().any(|s| s.origin == crate::Origin::Node("probe".into()));
                let traceless = fold == Fold::Export || def.forwards;
                assert!(named || traceless, "{}: live, its line is in the shader\n{}", def.id, shader.wgsl);
            }
            let alone = material_alone(&document, Library::standard(), &environment().methods)
                .unwrap_or_else(|e| panic!("{}: {e}", def.id));
            validate(&alone).unwrap_or_else(|e| panic!("{}: {e}\n{}", def.id, alone.wgsl));
            tried += 1;
        }
    }
    assert!(tried >= 60, "{tried}");
}

/// Every type of every generic node.
#[test]
fn every_type_of_generic_nodes() {
    for def in Library::standard().iter().filter(|def| !def.generic.is_empty()) {
        let Some(input) = def.inputs.iter().find(|i| i.ty == SocketType::Generic) else { continue };
        let SocketType::Generic = def.outputs[0].ty else { continue };
        for ty in &def.generic {
            if !matches!(ty, Type::F32 | Type::Vec3) {
                continue;
            }
            let value = if *ty == Type::F32 { "0.25" } else { "[0.25, 0.5, 0.75]" };
            let node = format!(r#""probe": {{"node": "{}", "values": {{"{}": {value}}}}}"#, def.id, input.name);
            let link = format!(r#"{{"from": "probe.{}", "to": "surface.base_color"}}"#, def.outputs[0].name);
            let shader = made(&material("", &node, &link), &environment(), Fold::Live);
            let wide = shader.wgsl.contains("vec3f(probe") || shader.wgsl.contains(": vec3f");
            assert!(wide, "{}", def.id);
        }
    }
}

/// A whole number spreads over a vector by way of a float.
#[test]
fn whole_numbers_become_vectors() {
    let node = r#""probe": {"node": "input/integer"}"#;
    let link = r#"{"from": "probe.out", "to": "surface.base_color"}"#;
    let text = made(&material("", node, link), &environment(), Fold::Live).wgsl;
    assert!(text.contains("vec3f(f32("), "{text}");
}
