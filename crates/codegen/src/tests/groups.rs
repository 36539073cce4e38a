//! Groups and reroutes: they order a document and leave no trace in a shader.

use std::collections::HashMap;

use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::edit::apply;
use halfvector_graph::library::Library;
use halfvector_graph::operation::{collapse, ungroup};
use halfvector_graph::value::Type;
use halfvector_shaders::{TokenKind, tokens};

use super::{document, environment, exported, made, material, sun};
use crate::reflection::{Resource, UniformSource};
use crate::target::{export, target};
use crate::{CodegenError, Fold, Origin, input_value, line_map, shader};

/// A shader without its comments, and with its names numbered in the order in which they come.
fn without_names(wgsl: &str) -> String {
    let mut numbers: HashMap<&str, usize> = HashMap::new();
    let mut number = |word| {
        let next = numbers.len();
        *numbers.entry(word).or_insert(next)
    };
    tokens(wgsl)
        .iter()
        .filter(|token| !token.kind.is_comment())
        .map(|token| match token.kind {
            TokenKind::Identifier => format!("#{}", number(token.text(wgsl))),
            _ => token.text(wgsl).to_string(),
        })
        .collect::<Vec<String>>()
        .join(" ")
}

/// Two of one group, one in the other's input, and one that holds another.
fn grouped(parameters: &str) -> Document {
    document(&format!(
        r#"{{ "halfvector": 1, "name": "Test",
          "nodes": {{
            "first": {{"node": "group/rust", "label": "First", "values": {{"scale": 3}}}},
            "second": {{"node": "group/rust", "values": {{"tint": [0.5, 0.25, 0.125]}}}},
            "surface": {{"node": "surface/surface"}}
          }},
          "links": [
            {{"from": "first.amount", "to": "second.scale"}},
            {{"from": "second.color", "to": "surface.base_color"}},
            {{"from": "second.amount", "to": "surface.perceptual_roughness"}}
          ],
          "parameters": [{parameters}],
          "groups": {{
            "grain": {{
              "inputs": [
                {{"name": "uv", "type": "vec2f", "context": "uv0"}},
                {{"name": "scale", "type": "f32", "default": 8}}
              ],
              "outputs": [{{"name": "out", "type": "f32"}}],
              "nodes": {{
                "in": {{"node": "group/input"}},
                "noise": {{"node": "procedural/value_noise_2d", "label": "Noise"}},
                "output": {{"node": "group/output"}}
              }},
              "links": [
                {{"from": "in.uv", "to": "noise.uv"}},
                {{"from": "in.scale", "to": "noise.scale"}},
                {{"from": "noise.out", "to": "output.out"}}
              ]
            }},
            "rust": {{
              "label": "Rust",
              "inputs": [
                {{"name": "scale", "type": "f32", "default": 2}},
                {{"name": "tint", "type": "vec3f", "default": [1, 0.5, 0.25]}}
              ],
              "outputs": [{{"name": "color", "type": "vec3f"}}, {{"name": "amount", "type": "f32"}}],
              "nodes": {{
                "in": {{"node": "group/input"}},
                "in_again": {{"node": "group/input"}},
                "grain": {{"node": "group/grain"}},
                "more": {{"node": "math/multiply", "label": "More"}},
                "bend": {{"node": "utility/reroute"}},
                "dye": {{"node": "math/multiply", "label": "Dye"}},
                "output": {{"node": "group/output"}}
              }},
              "links": [
                {{"from": "in.scale", "to": "grain.scale"}},
                {{"from": "grain.out", "to": "more.a"}},
                {{"from": "in_again.scale", "to": "more.b"}},
                {{"from": "more.out", "to": "bend.value"}},
                {{"from": "bend.out", "to": "dye.a"}},
                {{"from": "in.tint", "to": "dye.b"}},
                {{"from": "dye.out", "to": "output.color"}},
                {{"from": "bend.out", "to": "output.amount"}}
              ]
            }}
          }}
        }}"#
    ))
}

/// The same by hand, without groups.
fn by_hand() -> Document {
    material(
        "",
        r#""n1": {"node": "procedural/value_noise_2d", "values": {"scale": 3}},
           "m1": {"node": "math/multiply", "values": {"b": 3}},
           "n2": {"node": "procedural/value_noise_2d"},
           "m2": {"node": "math/multiply"},
           "d2": {"node": "math/multiply", "values": {"b": [0.5, 0.25, 0.125]}}"#,
        r#"{"from": "n1.out", "to": "m1.a"}, {"from": "m1.out", "to": "n2.scale"}, {"from": "n2.out", "to": "m2.a"},
           {"from": "m1.out", "to": "m2.b"}, {"from": "m2.out", "to": "d2.a"}, {"from": "d2.out", "to": "surface.base_color"},
           {"from": "m2.out", "to": "surface.perceptual_roughness"}"#,
    )
}

#[test]
fn a_group_is_the_shader_of_its_nodes() {
    for needs in [sun(), environment()] {
        let (one, other) = (exported(&grouped(""), &needs), exported(&by_hand(), &needs));
        assert_eq!(without_names(&one.wgsl), without_names(&other.wgsl), "{}\n{}", one.wgsl, other.wgsl);
    }
    // The test can tell shaders apart.
    let mut other = by_hand();
    other.graph.links.swap_remove(3);
    assert_ne!(without_names(&exported(&grouped(""), &sun()).wgsl), without_names(&exported(&other, &sun()).wgsl));
}

#[test]
fn lines_and_names_say_where_in_which_group() {
    let shader = exported(&grouped(""), &sun());
    assert!(shader.wgsl.contains("// First \u{203a} grain \u{203a} Noise"), "{}", shader.wgsl);
    assert!(shader.wgsl.contains("let rust_more ="), "{}", shader.wgsl);
    let of_node = |id: &str| shader.segments.iter().any(|s| s.origin == Origin::Node(id.into()));
    assert!(of_node("first/grain/noise") && of_node("second/dye") && !of_node("first/dye"));
}

/// Each line that the map names is the line of what it names.
#[test]
fn the_line_map_names_lines() {
    let shader = exported(&grouped(""), &sun());
    let lines: Vec<&str> = shader.wgsl.lines().collect();
    let map = line_map(&shader);
    let of = |origin: &Origin| map.iter().find(|l| l.origin == *origin).map(|l| lines[l.first - 1..l.last].to_vec());
    let noise = of(&Origin::Node("first/grain/noise".into())).expect("its line");
    assert!(noise.len() == 1 && noise[0].ends_with("// First \u{203a} grain \u{203a} Noise"), "{noise:?}");
    let file = of(&Origin::Library("nodes/procedural/value_noise.wgsl".into())).expect("its lines");
    assert_eq!(file.first(), Some(&"// ---- nodes/procedural/value_noise.wgsl"));
    assert!(map.windows(2).all(|pair| pair[0].last < pair[1].first), "in order, without overlap");
    let files = export(&shader, target("wgsl").expect("a target"), "x").expect("files");
    let json = files.iter().find(|file| file.name == "x.json").expect("the reflection");
    let json: serde_json::Value = serde_json::from_slice(&json.bytes).expect("JSON");
    assert_eq!(json["lines"].as_array().map(Vec::len), Some(map.len()));
}

#[test]
fn a_parameter_of_a_group_is_one_number() {
    let document = grouped(r#"{"name": "size", "socket": "first.scale"}"#);
    let shader = exported(&document, &sun());
    assert_eq!(shader.reflection.parameters.len(), 1, "it goes to two nodes inside and is there once");
    assert_eq!(shader.wgsl.matches("parameters.size").count(), 2, "{}", shader.wgsl);
}

/// What a live shader wants filled in is found by the path that it names.
#[test]
fn live_numbers_are_found_by_path() {
    let document = grouped("");
    let shader = made(&document, &sun(), Fold::Live);
    let mut found = Vec::new();
    let blocks = shader.reflection.bindings.iter().filter_map(|binding| match &binding.resource {
        Resource::Uniform(block) => Some(block),
        _ => None,
    });
    for member in blocks.flat_map(|block| &block.members) {
        if let UniformSource::Input(socket) = &member.source {
            let value = input_value(&document, Library::standard(), socket, Type::F32);
            assert!(value.is_some(), "{socket}");
            found.push(socket.to_string());
        }
    }
    assert!(found.contains(&"first.scale".into()) && found.contains(&"second.tint".into()), "{found:?}");
    let inside = SocketRef::new("first/grain/noise", "scale");
    assert!(input_value(&document, Library::standard(), &inside, Type::F32).is_some());
    let default = input_value(&document, Library::standard(), &SocketRef::new("first", "tint"), Type::Vec3);
    assert_eq!(default, Some(vec![1.0, 0.5, 0.25]));
}

/// A picture is an input like another.
#[test]
fn a_group_takes_a_picture() {
    let with = |group: bool| {
        let image = r#"{"file": "a.png", "color_space": "srgb"}"#;
        let (node, socket) = if group { ("group/look", "picture") } else { ("textures/image", "image") };
        let mut document = material(
            "",
            &format!(r#""x": {{"node": "{node}", "label": "Photo", "values": {{"{socket}": {image}}}}}"#),
            r#"{"from": "x.color", "to": "surface.base_color"}"#,
        );
        let group = self::document(
            r#"{"halfvector": 1, "nodes": {}, "groups": {"look": {
                "inputs": [{"name": "picture", "type": "texture"}], "outputs": [{"name": "color", "type": "vec3f"}],
                "nodes": {"in": {"node": "group/input"}, "t": {"node": "textures/image", "label": "Photo"}, "output": {"node": "group/output"}},
                "links": [{"from": "in.picture", "to": "t.image"}, {"from": "t.color", "to": "output.color"}]}}}"#,
        );
        document.groups = group.groups;
        exported(&document, &sun())
    };
    assert_eq!(without_names(&with(true).wgsl), without_names(&with(false).wgsl));
}

#[test]
fn a_reroute_leaves_no_trace() {
    let noise = r#""n": {"node": "procedural/value_noise_2d"}"#;
    let bends: String = (0..3).map(|i| format!(r#", "r{i}": {{"node": "utility/reroute"}}"#)).collect();
    let direct = material("", noise, r#"{"from": "n.out", "to": "surface.base_color"}"#);
    let bent = material(
        "",
        &format!("{noise}{bends}"),
        r#"{"from": "n.out", "to": "r0.value"}, {"from": "r0.out", "to": "r1.value"}, {"from": "r1.out", "to": "r2.value"},
           {"from": "r2.out", "to": "surface.base_color"}"#,
    );
    for fold in [Fold::Live, Fold::Export] {
        assert_eq!(made(&direct, &environment(), fold).wgsl, made(&bent, &environment(), fold).wgsl);
    }
    // A value set on it is a number like another.
    let set = material(
        "",
        r#""r": {"node": "utility/reroute", "values": {"value": [0.1, 0.2, 0.3]}}"#,
        r#"{"from": "r.out", "to": "surface.base_color"}"#,
    );
    let plain = material(r#""base_color": [0.1, 0.2, 0.3]"#, "", "");
    assert_eq!(exported(&set, &sun()).wgsl, exported(&plain, &sun()).wgsl);
}

#[test]
fn what_is_wrong_with_groups_is_told() {
    let mut document = grouped("");
    document.groups.remove("grain");
    let error = shader(&document, Library::standard(), &sun(), Fold::Export).expect_err("a missing group");
    assert!(
        matches!(&error, CodegenError::Problems(problems) if problems[0].group.as_deref() == Some("rust")),
        "{error}"
    );
    assert!(
        error
            .to_string()
            .contains("\u{201c}Rust \u{203a} grain\u{201d} (grain in group rust): there is no group `grain`"),
        "{error}"
    );
}

/// Whatever is made a group, the shader stays the same; and again when the group is taken apart.
#[test]
fn collapsing_and_taking_apart_change_no_shader() {
    let library = Library::standard();
    let mut tried = 0;
    for document in [by_hand(), super::maps()] {
        let before = without_names(&exported(&document, &sun()).wgsl);
        let ids: Vec<String> = document.graph.nodes.keys().filter(|id| *id != "surface").cloned().collect();
        for mask in 1..1usize << ids.len() {
            let picked: Vec<String> =
                ids.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, id)| id.clone()).collect();
            let Ok(edit) = collapse(&document, library, None, &picked, "G") else { continue };
            let mut after = document.clone();
            apply(&mut after, &edit).expect("an edit");
            assert_eq!(without_names(&exported(&after, &sun()).wgsl), before, "{picked:?}");
            let edit = ungroup(&after, library, None, "g").unwrap_or_else(|e| panic!("{picked:?}: {e}"));
            apply(&mut after, &edit).expect("an edit");
            assert_eq!(without_names(&exported(&after, &sun()).wgsl), before, "{picked:?}");
            tried += 1;
        }
    }
    assert!(tried > 20, "{tried}");
}
