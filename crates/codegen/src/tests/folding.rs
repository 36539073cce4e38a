//! Constants, identities, and numbers that stay open.

use super::{environment, exported, made, maps, material, sun, with_parameters};
use crate::{CodegenError, Fold, shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::value::Value;

#[test]
fn constant_subgraphs_are_one_number() {
    let document = material(
        "",
        r#""sum": {"node": "math/add", "values": {"a": 0.25, "b": 0.125}},
           "twice": {"node": "math/multiply", "values": {"b": 2.0}}"#,
        r#"{"from": "sum.out", "to": "twice.a"}, {"from": "twice.out", "to": "surface.perceptual_roughness"}"#,
    );
    let text = exported(&document, &sun()).wgsl;
    assert!(text.contains("max(0.75, PUNCTUAL_ROUGHNESS_FLOOR)"), "{text}");
    assert!(!text.contains("node_math"), "{text}");
}

#[test]
fn f0_is_folded() {
    let text = exported(&material(r#""ior": 1.5"#, "", ""), &sun()).wgsl;
    assert!(text.contains("Specular(vec3f(0.04"), "{text}");
    assert!(!text.contains("f0_from_ior"), "{text}");
}

#[test]
fn identities_vanish() {
    let document = material(
        "",
        r#""noise": {"node": "procedural/value_noise_2d"},
           "same": {"node": "math/multiply", "label": "Same", "values": {"b": 1.0}},
           "also": {"node": "math/add", "label": "Also", "values": {"b": 0.0}},
           "still": {"node": "math/mix", "label": "Still", "values": {"b": 7.0, "t": 0.0}}"#,
        r#"{"from": "noise.out", "to": "same.a"}, {"from": "same.out", "to": "also.a"},
           {"from": "also.out", "to": "still.a"}, {"from": "still.out", "to": "surface.perceptual_roughness"}"#,
    );
    let text = exported(&document, &sun()).wgsl;
    for label in ["Same", "Also", "Still"] {
        assert!(!text.contains(&format!("// {label}")), "{label} is an identity\n{text}");
    }
}

/// No line of any example computes what changes nothing.
#[test]
fn no_example_holds_an_identity() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut paths = Vec::new();
    for folder in [folder.clone(), folder.join("nodes"), folder.join("unstable"), folder.join("../tests/golden")] {
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        paths.extend(entries.flatten().map(|entry| entry.path()));
    }
    paths.retain(|path| path.to_string_lossy().ends_with(".material.json"));
    assert!(paths.len() > 30, "{} examples", paths.len());
    paths.sort();
    for path in &paths {
        let document = halfvector_graph::file::load(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        for needs in [sun(), environment()] {
            let wgsl = exported(&document, &needs).wgsl;
            for line in wgsl.lines() {
                let code = line.split("//").next().unwrap_or_default();
                let ends = |at: usize| !code[at..].starts_with(|c: char| c.is_ascii_digit() || c == 'e');
                for part in ["* 1.0", "/ 1.0", "+ 0.0", "- 0.0", "(1.0 *", "= 1.0 *", ", 1.0 *", " 0.0 +", "(0.0 +"] {
                    let found = code.match_indices(part).find(|(at, _)| ends(at + part.len()));
                    assert!(found.is_none(), "{}: {line}", path.display());
                }
                let weight = code.match_indices("mix(").filter_map(|(at, _)| last_argument(&code[at + 4..]));
                let end = weight.into_iter().find(|weight| matches!(*weight, "0.0" | "1.0"));
                assert!(end.is_none(), "{}: {line}", path.display());
            }
        }
    }
}

/// The last argument of a call whose brackets have just been opened.
fn last_argument(text: &str) -> Option<&str> {
    let (mut depth, mut first) = (0, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth == 0 => return Some(text[first..at].trim()),
            ')' => depth -= 1,
            ',' if depth == 0 => first = at + 1,
            _ => {}
        }
    }
    None
}

/// What some known arguments leave of a function: an argument, or two that are joined.
#[test]
fn identities_of_several_arguments_vanish() {
    let document = material(
        "",
        r#""noise": {"node": "procedural/value_noise_2d"}, "other": {"node": "procedural/value_noise_2d", "values": {"scale": 3.0}},
           "same": {"node": "math/multiply_add", "label": "Same", "values": {"b": 1.0, "c": 0.0}},
           "range": {"node": "math/remap", "label": "Range"},
           "part": {"node": "math/divide", "label": "Part", "values": {"b": 1.0}},
           "sum": {"node": "math/multiply_add", "label": "Sum", "values": {"b": 1.0}}"#,
        r#"{"from": "noise.out", "to": "same.a"}, {"from": "same.out", "to": "range.x"}, {"from": "range.out", "to": "part.a"},
           {"from": "part.out", "to": "sum.a"}, {"from": "other.out", "to": "sum.c"}, {"from": "sum.out", "to": "surface.perceptual_roughness"}"#,
    );
    let text = exported(&document, &sun()).wgsl;
    for label in ["Same", "Range", "Part"] {
        assert!(!text.contains(&format!("// {label}")), "{label} is an identity\n{text}");
    }
    assert!(text.contains("let sum = value_noise_2_d + value_noise_2_d_2; // Sum"), "{text}");
}

/// Each blend node at an opacity of 0 and 1, and the nodes that change nothing: no line of them holds an opacity, and none a power.
#[test]
fn nodes_that_change_nothing_leave_nothing() {
    const BLENDS: [&str; 19] = [
        "multiply",
        "screen",
        "overlay",
        "soft_light",
        "dodge",
        "difference",
        "subtract",
        "divide",
        "linear_light",
        "darken",
        "lighten",
        "burn",
        "hard_light",
        "exclusion",
        "add",
        "hue",
        "saturation",
        "color",
        "luminosity",
    ];
    let export = |node: &str, input: &str, output: &str, values: &str| {
        let nodes = format!(
            r#""noise": {{"node": "procedural/vector_noise_3d"}}, "x": {{"node": "{node}", "label": "Here", "values": {{{values}}}}}"#
        );
        let links = format!(
            r#"{{"from": "noise.{output}", "to": "x.{input}"}}, {{"from": "x.out", "to": "surface.base_color"}}"#
        );
        exported(&material("", &nodes, &links), &sun()).wgsl
    };
    for blend in BLENDS {
        let node = format!("color/blend_{blend}");
        for (opacity, top) in [("1.0", "[0.2, 0.3, 0.4]"), ("0.0", "[0.2, 0.3, 0.4]")] {
            let text = export(&node, "base", "out", &format!(r#""opacity": {opacity}, "top": {top}"#));
            assert!(!text.contains("node_color_blend_") && !text.contains("mix(vector_noise"), "{blend}: {text}");
            assert!(opacity == "1.0" || !text.contains("// Here"), "{blend}: {text}");
        }
        let half = export(&node, "base", "out", r#""opacity": 0.5, "top": [0.2, 0.3, 0.4]"#);
        assert!(half.contains("0.5"), "{blend}: {half}");
    }
    for (node, input, values, left) in [
        ("math/power", "base", r#""exponent": [1.0, 1.0, 1.0]"#, "max("),
        ("color/gamma", "color", r#""gamma": 1.0"#, "max("),
        ("color/levels", "color", "", "saturate("),
    ] {
        let text = export(node, input, "out", values);
        let line = text.lines().find(|line| line.contains("// Here")).unwrap_or_default();
        assert!(line.contains(left) && !text.contains("power"), "{node}: {text}");
    }
    for (node, input, values) in [
        ("color/exposure", "color", r#""stops": 0.0"#),
        ("color/channel_mixer", "color", ""),
        ("vector/matrix_transform", "v", ""),
        ("vector/rotate_euler", "v", ""),
        ("vector/rotate_about_axis", "v", r#""angle": 0.0"#),
    ] {
        let text = export(node, input, "out", values);
        assert!(!text.contains("// Here"), "{node}: {text}");
    }
}

#[test]
fn what_is_not_finite_is_a_problem_of_its_node() {
    let document = material(
        "",
        r#""huge": {"node": "math/multiply", "label": "Huge", "values": {"a": 3e38, "b": 10.0}}"#,
        r#"{"from": "huge.out", "to": "surface.base_color"}"#,
    );
    for fold in [Fold::Live, Fold::Export] {
        let error = shader(&document, Library::standard(), &sun(), fold).expect_err("infinity");
        let CodegenError::Problems(problems) = &error else { panic!("{error}") };
        assert_eq!(problems[0].node.as_deref(), Some("huge"));
        assert!(error.to_string().contains("Huge"), "{error}");
    }
}

/// Every number of a document, changed, leaves a live shader as it is.
#[test]
fn live_numbers_change_no_text() {
    let mut document = maps();
    for (id, node) in [("scaled", "math/multiply"), ("noise", "procedural/fbm_2d")] {
        document.graph.nodes.insert(
            id.into(),
            super::document(&format!(
                r#"{{"halfvector": 1, "name": "", "nodes": {{"{id}": {{"node": "{node}"}}}}, "links": []}}"#
            ))
            .graph
            .nodes
            .remove(id)
            .expect("the node"),
        );
    }
    let before = made(&document, &environment(), Fold::Live).wgsl;
    let ids: Vec<String> = document.graph.nodes.keys().cloned().collect();
    let mut tried = 0;
    for id in ids {
        let def = Library::standard().get(&document.graph.nodes[&id].node).expect("a standard node");
        for input in &def.inputs {
            let halvfector_default = match &input.default {
                halfvector_graph::node_def::Default::Value(value) => value.clone(),
                _ => continue,
            };
            if document.graph.links.iter().any(|l| l.to.node == id && l.to.socket == input.name) {
                continue;
            }
            let changed = match &halvfector_default {
                Value::Bool(b) => Value::Bool(!b),
                Value::Number(_)
                    if input.ty == halfvector_graph::value::SocketType::Value(halfvector_graph::value::Type::I32) =>
                {
                    Value::Number(3.0)
                }
                Value::Integer(_) => Value::whole(3),
                Value::Number(_) | Value::Decimal { .. } => Value::Number(0.37),
                Value::Vec2(_) => Value::Vec2([0.37, 0.2]),
                Value::Vec3(_) => Value::Vec3([0.37, 0.2, 0.9]),
                Value::Vec4(_) => Value::Vec4([0.37, 0.2, 0.9, 0.1]),
                Value::Image(_) => continue,
            };
            // A neutral weight is the one number that specialises, see `lobe_weights_specialise_live`.
            const WEIGHTS: [&str; 10] = [
                "specular",
                "occlusion",
                "emission",
                "opacity",
                "height",
                "coat_weight",
                "sheen_color",
                "transmission_weight",
                "anisotropy",
                "thin_film_weight",
            ];
            if id == "surface" && WEIGHTS.contains(&input.name.as_str()) {
                continue;
            }
            let mut other = document.clone();
            other.graph.nodes.get_mut(&id).expect("the node").values.insert(input.name.clone(), changed);
            let after = shader(&other, Library::standard(), &environment(), Fold::Live).expect("a shader").wgsl;
            assert_eq!(before, after, "{id}.{}", input.name);
            tried += 1;
        }
    }
    assert!(tried >= 5, "{tried}");
}

#[test]
fn lobe_weights_specialise_live() {
    let live = |values: &str| made(&material(values, "", ""), &environment(), Fold::Live).wgsl;
    let mixed = live(r#""metallic": 0.5, "emission": [1, 0, 0], "occlusion": 0.5"#);
    assert!(mixed.contains("parameters.surface_metallic") && mixed.contains("parameters.surface_emission"));
    assert_eq!(mixed, live(r#""metallic": 0.25, "emission": [0, 2, 0], "occlusion": 0.9"#));
    assert!(!live(r#""metallic": 1"#).contains("Diffuse("));
    assert!(!live(r#""specular": 0"#).contains("Specular("));
    assert!(!live("").contains("surface_emission"));
    assert!(!live("").contains("parameters.surface_metallic"));
    let coated = live(r#""coat_weight": 0.5"#);
    assert!(coated.contains("parameters.surface_coat_weight"));
    assert_eq!(coated, live(r#""coat_weight": 0.9, "coat_roughness": 0.3"#));
}

/// Under export an exposed parameter never specialises, whatever its default.
#[test]
fn exposed_parameters_stay() {
    let exposed = |fold| {
        let parameter = r#"{"name": "metallic", "socket": "surface.metallic", "range": [0, 1]}"#;
        made(&with_parameters(r#""metallic": 1"#, "", "", parameter), &environment(), fold)
    };
    let export = exposed(Fold::Export);
    assert!(export.wgsl.contains("parameters.metallic") && export.wgsl.contains("Diffuse("), "{}", export.wgsl);
    assert_eq!(export.reflection.parameters[0].name, "metallic");
    assert_eq!(export.reflection.parameters[0].default, [1.0]);
    assert!(!exposed(Fold::Live).wgsl.contains("Diffuse("));
}

#[test]
fn moving_a_node_changes_nothing() {
    let here = maps();
    let mut there = here.clone();
    there.graph.layout.insert("albedo".into(), [512.0, -3.5]);
    let wgsl = |document: &Document| exported(document, &environment()).wgsl;
    assert_eq!(wgsl(&here), wgsl(&there));
}

#[test]
fn the_order_of_links_changes_nothing() {
    let here = maps();
    let mut there = here.clone();
    there.graph.links.reverse();
    assert_eq!(exported(&here, &environment()), exported(&there, &environment()));
}

#[test]
fn equal_nodes_are_computed_once() {
    let noise = |id: &str| format!(r#""{id}": {{"node": "procedural/value_noise_2d"}}"#);
    let document = material(
        "",
        &format!("{}, {}", noise("one"), noise("two")),
        r#"{"from": "one.out", "to": "surface.base_color"}, {"from": "two.out", "to": "surface.perceptual_roughness"}"#,
    );
    let text = exported(&document, &sun()).wgsl;
    let entry = text.split("fn fs_main").nth(1).expect("an entry point").split("\n}").next().expect("a body");
    assert_eq!(entry.matches("node_procedural_value_noise_2d(").count(), 1, "{entry}");
}
