//! Documents that mean harm, or are merely very large.

use super::{exported, made, material, sun};
use crate::{Fold, Origin, validate};

#[test]
fn labels_cannot_leave_their_comment() {
    let hostile = [
        "x\\n} fn evil() {} //",
        "*/ discard; /*",
        "\\r\\nreturn vec4f(1.0);",
        "a\\u2028discard;",
        "a\\u0085discard;",
        "\\u202e evil",
        "mix",
        "金属",
        "let",
        "",
        "__",
        "node_math_add",
        "0",
        "vs_main",
    ];
    for label in hostile {
        let document = material(
            "",
            &format!(
                r#""a": {{"node": "procedural/value_noise_2d", "label": "{label}"}},
                   "b": {{"node": "math/sin", "label": "{label}"}}"#
            ),
            r#"{"from": "a.out", "to": "b.x"}, {"from": "b.out", "to": "surface.base_color"}"#,
        );
        let mut document = document;
        document.name = document.graph.nodes["a"].label.clone().unwrap_or_default();
        let shader = exported(&document, &sun());
        let code: Vec<&str> = shader.wgsl.lines().map(|l| l.split("//").next().unwrap_or("")).collect();
        assert!(!code.iter().any(|l| l.contains("discard;") || l.contains("fn evil")), "{label}\n{}", shader.wgsl);
    }
}

#[test]
fn names_of_parameters_are_kept_or_made_safe() {
    let parameter = |name: &str| format!(r#"{{"name": "{name}", "socket": "surface.metallic"}}"#);
    let text = |name: &str| {
        let document = super::with_parameters("", "", "", &parameter(name));
        exported(&document, &sun()).reflection.parameters[0].name.clone()
    };
    assert_eq!(text("metallic"), "metallic");
    assert_eq!(text("Metalness"), "Metalness");
}

/// A chain of ten thousand nodes is neither recursion in codegen nor in naga.
#[test]
fn deep_graphs() {
    const DEPTH: usize = 10_000;
    let mut nodes = vec![r#""n0": {"node": "procedural/value_noise_2d"}"#.to_owned()];
    let mut links = Vec::new();
    let from = |i: usize| format!("n{i}.out");
    for i in 1..=DEPTH {
        nodes.push(format!(r#""n{i}": {{"node": "math/add", "values": {{"b": {i}}}}}"#));
        links.push(format!(r#"{{"from": "{}", "to": "n{i}.a"}}"#, from(i - 1)));
    }
    links.push(format!(r#"{{"from": "{}", "to": "surface.perceptual_roughness"}}"#, from(DEPTH)));
    let document = material("", &nodes.join(","), &links.join(","));
    for fold in [Fold::Live, Fold::Export] {
        made(&document, &sun(), fold);
    }
}

#[test]
fn an_error_of_validation_names_its_node() {
    let document = material(
        "",
        r#""a": {"node": "procedural/value_noise_2d", "label": "Grain"}"#,
        r#"{"from": "a.out", "to": "surface.base_color"}"#,
    );
    let mut shader = exported(&document, &sun());
    let call = shader.wgsl.find("let grain = node_").expect("the node's line") + "let grain = ".len();
    // The name of a function that is not there, of the same length.
    shader.wgsl.replace_range(call..call + 4, "mode");
    let error = validate(&shader).expect_err("no such function");
    assert_eq!(error.place.as_ref().map(|p| &p.origin), Some(&Origin::Node("a".into())), "{error}");
    assert!(error.to_string().contains("node `a`"), "{error}");

    let mut shader = exported(&document, &sun());
    let body = shader.wgsl.find("fn d_ggx").expect("a library function");
    let at = body + shader.wgsl[body..].find("return").expect("a return");
    shader.wgsl.replace_range(at..at + 6, "retorn");
    let error = validate(&shader).expect_err("no such word");
    assert!(error.to_string().contains("shaders/brdf/ggx.wgsl"), "{error}");
}
