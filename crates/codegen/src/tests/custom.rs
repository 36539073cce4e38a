//! Functions of the user's own in a shader.

use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::value::Type;

use super::{document, environment, exported, made, sun};
use crate::{CodegenError, Fold, Origin, input_value, material, shader, validate};

/// A document of one function `f(x) -> f32` that feeds the roughness.
fn with(function: &str) -> Document {
    let mut document = super::material(
        "",
        r#""n": {"node": "custom/f", "label": "Mine", "values": {"x": 0.25}}"#,
        r#"{"from": "n.out", "to": "surface.perceptual_roughness"}"#,
    );
    document.functions.insert("f".into(), function.into());
    document
}

#[test]
fn a_function_of_the_users_is_linked_with_what_it_calls() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/custom-wgsl.material.json");
    let document = document(&std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}")));
    for fold in [Fold::Live, Fold::Export] {
        let shader = made(&document, &environment(), fold);
        for name in [
            "fn node_custom_tartan(",
            "fn custom_tartan_sett(",
            "const custom_tartan_BANDS",
            "struct custom_tartan_Tartan",
        ] {
            assert_eq!(shader.wgsl.matches(name).count(), 1, "{name}\n{}", shader.wgsl);
        }
        assert!(shader.wgsl.contains("// ---- custom/tartan") && !shader.wgsl.contains("@also"), "{}", shader.wgsl);
        assert!(shader.segments.iter().any(|s| s.origin == Origin::Library("custom/tartan".into())));
        assert!(shader.segments.iter().any(|s| s.origin == Origin::Node("tartan".into())));
    }
    // What is not set is filled in from the function's own defaults.
    let softness = input_value(&document, Library::standard(), &SocketRef::new("tartan", "softness"), Type::F32);
    assert_eq!(softness, Some(vec![f64::from(0.01_f32)]));
    let alone = material(&document, Library::standard(), &sun().methods).unwrap_or_else(|e| panic!("{e}"));
    validate(&alone).unwrap_or_else(|e| panic!("{e}\n{}", alone.wgsl));
}

/// What it calls of the library is linked once, whoever calls it.
#[test]
fn it_calls_the_library() {
    let mut document = with(
        "/// F\n///\n/// Grey.\n/// @node custom/f\n/// - x: number [0]\n/// - uv: where [context uv0]\nfn grey(x: f32, uv: vec2f) -> f32 {\n    let c = srgb_from_linear(vec3f(x, uv));\n    return luminance(c);\n}\n",
    );
    for fold in [Fold::Live, Fold::Export] {
        let wgsl = made(&document, &sun(), fold).wgsl;
        for name in ["fn node_custom_f(", "fn srgb_from_linear(", "fn luminance("] {
            assert_eq!(wgsl.matches(name).count(), 1, "{name}\n{wgsl}");
        }
    }
    let text = document.functions["f"].replace("srgb_from_linear", "srgb_of_linear");
    document.functions.insert("f".into(), text);
    let why = shader(&document, Library::standard(), &sun(), Fold::Export).expect_err("an unknown name").to_string();
    assert!(why.contains("did you mean the library's `srgb_from_linear`?"), "{why}");
}

/// A function that no node uses is not in the shader; a constant one is folded away.
#[test]
fn nothing_of_it_stays_that_is_not_needed() {
    let document = with(
        "/// F\n///\n/// Twice.\n/// @node custom/f\n/// - x: number [0]\nfn twice(x: f32) -> f32 {\n    var s = 0.0;\n    for (var i = 0; i < 2; i++) { s += x; }\n    return s;\n}\n",
    );
    let folded = exported(&document, &sun()).wgsl;
    assert!(!folded.contains("custom"), "{folded}");
    assert!(folded.contains("0.5"), "{folded}");
    let live = made(&document, &sun(), Fold::Live).wgsl;
    assert!(live.contains("let mine = node_custom_f("), "{live}");
    let mut unused = document.clone();
    unused.graph.links.clear();
    assert!(!made(&unused, &sun(), Fold::Live).wgsl.contains("custom"));
}

#[test]
fn an_error_in_it_is_told_with_a_caret() {
    let document = with(
        "/// F\n///\n/// Twice.\n/// @node custom/f\n/// - x: number [0]\nfn twice(x: f32) -> f32 {\n    return x * y;\n}\n",
    );
    let error = shader(&document, Library::standard(), &sun(), Fold::Export).expect_err("an unknown name");
    assert!(matches!(error, CodegenError::Problems(_)));
    let told = error.to_string();
    assert!(told.contains("the function `f`, line 7, column 16: "), "{told}");
    assert!(told.contains("\n        return x * y;\n                   ^"), "{told}");
}

/// What a function takes and never reads is in no block, binding or line: not the number, the picture, or what feeds it.
#[test]
fn what_a_function_does_not_read_is_left_out() {
    let nodes = r#""noise": {"node": "procedural/value_noise_2d"},
        "n": {"node": "custom/f", "values": {"b": 0.25, "image": {"file": "a.png", "color_space": "linear"}}}"#;
    let links = r#"{"from": "noise.out", "to": "n.c"}, {"from": "n.out", "to": "surface.perceptual_roughness"}"#;
    let parameters = r#"{"name": "a", "socket": "n.a"}, {"name": "b", "socket": "n.b"}"#;
    let mut document = super::with_parameters("", nodes, links, parameters);
    let text = "/// F\n///\n/// Halves.\n/// @node custom/f\n/// - a: read [0.5]\n/// - b: not read [0.5]\n/// - c: not read [0.5]\n/// - image: not read [image linear]\n\
        fn f(a: f32, b: f32, c: f32, image: texture_2d<f32>, image_sampler: sampler) -> f32 {\n    let half = 0.5;\n    return half * a;\n}\n";
    document.functions.insert("f".into(), text.into());
    for fold in [Fold::Export, Fold::Live] {
        let made = super::made(&document, &sun(), fold);
        let names: Vec<&str> = made.reflection.parameters.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["a"], "{}", made.wgsl);
        assert!(!made.wgsl.contains("value_noise") && !made.wgsl.contains("@group(1) @binding(1)"), "{}", made.wgsl);
        assert!(made.wgsl.contains("node_custom_f(parameters.a)"), "{}", made.wgsl);
    }
    let alone = material(&document, Library::standard(), &Methods::default()).unwrap_or_else(|e| panic!("{e}"));
    validate(&alone).unwrap_or_else(|e| panic!("{e}\n{}", alone.wgsl));
    assert!(alone.wgsl.contains("node_custom_f(parameters.a)"), "{}", alone.wgsl);
}

/// What a function is given and does not use is gone from source, uniforms and bindings, however it is not used.
#[test]
fn what_has_no_effect_leaves_no_trace() {
    let function = |result: &str, body: &str, beside: &str| {
        format!(
            "struct Both {{\n    /// one\n    one: f32,\n    /// other\n    other: f32,\n}}\n{beside}\n/// F\n///\n/// F.\n/// @node custom/f\n/// - x: number [0.5]\n/// - y: another [0.5]\nfn f(x: f32, y: f32) -> {result} {{\n{body}\n}}\n"
        )
    };
    let ignoring = "fn g(a: f32, b: f32) -> f32 { return a; }\n";
    for (result, body, beside, output) in [
        ("f32", "return g(x, y);", ignoring, "out"),
        ("f32", "let unused = y * 2.0;\nlet more = unused;\nreturn x;", "", "out"),
        ("f32", "_ = y;\nreturn x;", "", "out"),
        ("f32", "return x + 0.0 * y;", "", "out"),
        ("f32", "{ let y = 2.0; return x * y; }", "", "out"),
        ("f32", "var v = y; v = x; return x;", "", "out"),
        ("Both", "return Both(x, y);", "", "one"),
        ("Both", "return Both(g(x, y), sin(y));", ignoring, "one"),
    ] {
        let mut document = super::material(
            "",
            r#""noise": {"node": "procedural/value_noise_2d", "label": "Noise"}, "n": {"node": "custom/f", "label": "Mine", "values": {"x": 0.25}}"#,
            &format!(
                r#"{{"from": "noise.out", "to": "n.y"}}, {{"from": "n.{output}", "to": "surface.perceptual_roughness"}}"#
            ),
        );
        let text = function(result, body, beside);
        document.functions.insert("f".into(), text.clone());
        document.parameters.push(halfvector_graph::document::Parameter {
            name: "noise_scale".into(),
            label: None,
            socket: SocketRef::new("noise", "scale"),
            range: None,
        });
        for fold in [Fold::Live, Fold::Export] {
            let wgsl = made(&document, &sun(), fold).wgsl;
            for trace in ["Noise", "noise", "struct Parameters {\n    noise"] {
                assert!(!wgsl.contains(trace), "{body}: {trace}\n{wgsl}");
            }
        }
        // The same with an effect keeps it.
        let used = text
            .replace("return x", "return y + x")
            .replace("Both(x, y)", "Both(x + y, y)")
            .replace("g(x, y)", "g(y, x)");
        document.functions.insert("f".into(), used);
        let wgsl = exported(&document, &sun()).wgsl;
        assert!(wgsl.contains("value_noise_2d") || body.starts_with('{'), "{body}\n{wgsl}");
    }
}
