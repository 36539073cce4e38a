//! Functions that a document brings along: what they may be, and how what they may not be is told.

use std::time::{Duration, Instant};

use proptest::prelude::*;

use super::{document, small};
use crate::check::{Severity, check};
use crate::file::{from_json, group_from_json, group_to_json};
use crate::library::custom::{CodeError, MAX_BYTES, read_function};
use crate::operation::{Pick, collapse, copy, export_group, group_as_copied, paste};
use crate::value::{SocketType, Type};

/// A function `name(x: f32) -> f32` with this body, and items beside it.
fn text(body: &str, beside: &str) -> String {
    format!(
        "{beside}/// Test\n///\n/// A test.\n/// @node custom/test\n/// - x: number [0.5; 0..1]\nfn f(x: f32) -> f32 {{\n{body}\n}}\n"
    )
}

fn error(text: &str) -> CodeError {
    let start = Instant::now();
    let error = read_function("test", text).expect_err("a refusal");
    // Well below a second on a quiet machine.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    error
}

#[track_caller]
fn refused(text: &str, part: &str) {
    let error = error(text).to_string();
    assert!(error.contains(part), "wanted {part:?}, got {error}");
}

#[test]
fn a_function_is_a_node() {
    let source = text(
        "    var sum = 0.0;\n    for (var i = 0; i < COUNT; i++) {\n        sum += mix(x, f32(i));\n    }\n    return sum;",
        "const COUNT: i32 = 4;\nfn mix(a: f32, b: f32) -> f32 {\n    let f = a * b;\n    return f;\n}\n",
    );
    let function = read_function("test", &source).unwrap_or_else(|e| panic!("{e}"));
    let def = &function.def;
    assert_eq!((def.id.as_str(), def.label.as_str(), def.file.as_str()), ("custom/test", "Test", "custom/test"));
    assert_eq!((def.inputs[0].name.as_str(), def.inputs[0].ty), ("x", SocketType::Value(Type::F32)));
    assert_eq!(def.function.name, "node_custom_test");
    // All names are its own: a `mix` of the user's shadows nothing, and the local `f` stays a local.
    assert!(function.source.contains("fn custom_test_mix(") && function.source.contains("custom_test_mix(x, f32(i))"));
    assert!(function.source.contains("i < custom_test_COUNT") && function.source.contains("let f = a * b"));
    let mut d = document(&[("n", "custom/test")], &[("n.out", "surface.height")]);
    d.functions.insert("test".into(), source);
    assert_eq!(check(&d, small()), []);
    assert_eq!(small().of(&d).get("custom/test"), Some(def));
    assert!(small().get("custom/test").is_none());
}

/// The library's functions are called by their names; what they need comes along, in a shader too.
#[test]
fn the_librarys_functions_can_be_called() {
    let read = |body: &str| read_function("test", &text(body, "")).map(|f| f.source.clone()).map_err(|e| e.to_string());
    let source = read("    return luminance(vec3f(x)) + d_ggx(0.5, 0.75, x) + INV_PI;").expect("the library's");
    assert!(source.contains("luminance(vec3f(x))") && !source.contains("fn luminance"), "{source}");
    read("    return node_procedural_value_noise_3d_vertex(vec3f(x), 4.0, 1);").expect("a node's function");
    let own = text("    return luminance(x);", "fn luminance(x: f32) -> f32 {\n    return x;\n}\n");
    let own = read_function("test", &own).unwrap_or_else(|e| panic!("{e}"));
    assert!(own.source.contains("custom_test_luminance(x)"), "one's own comes first: {}", own.source);
    for (body, part) in [
        ("    return luminanse(vec3f(x));", "did you mean the library's `luminance`?"),
        ("    return zzzzzzzzz(x);", "none of WGSL's, of yours and of the library's"),
        ("    return node_math_mix(x, x, x);", "`node_math_mix` works on any type"),
        ("    return luminance(x);", "`luminance` takes vec3f as `c`"),
        ("    return node_procedural_value_noise_3d(vec3f(x), 4.0, 1);", "the form of the vertex stage"),
        (
            "    var s = 0.0;\n    for (var i = 0; i < 2000; i++) {\n        s += node_procedural_fbm_2d_vertex(vec2f(x), 4.0, 3, 2.0, 0.5, 1);\n    }\n    return s;",
            "turns of loops and calls",
        ),
    ] {
        let why = read(body).expect_err(body);
        assert!(why.contains(part), "{body}: {why}");
    }
}

/// A name of the user's hides one that the library's own text needs: told at the user's.
#[test]
fn a_name_that_the_library_needs_is_told_where_it_stands() {
    let body = "    return energy_compensation_fdez_aguera(vec3f(x), vec3f(1.0), vec2f(x)).x;";
    let e = error(&text(body, "const A: f32 = 1.0;\nfn average_fresnel(x: f32) -> f32 {\n    return x;\n}\n"));
    assert_eq!((e.line, e.column), (2, 1), "{e}");
    assert!(e.to_string().contains("its `energy_compensation_fdez_aguera` needs"), "{e}");
}

#[test]
fn errors_point_into_the_users_text() {
    let source = text("    let a = 1.0;\n\treturn y + a;", "");
    let e = error(&source);
    assert_eq!((e.line, e.column, e.excerpt.as_str()), (8, 9, "\treturn y + a;"));
    assert!(e.to_string().ends_with("\n    \treturn y + a;\n    \t       ^"), "{e}");
    let mut d = document(&[("n", "custom/test")], &[("n.out", "surface.height")]);
    d.functions.insert("test".into(), source.clone());
    let problems = check(&d, small());
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(
        problems[0].severity == Severity::Error
            && problems[0].message.contains("the function `test`, line 8, column 9"),
        "{}",
        problems[0]
    );
    d.graph.nodes.remove("n");
    d.graph.links.clear();
    assert_eq!(check(&d, small())[0].severity, Severity::Warning, "nothing uses it");
    d.graph.nodes.insert("n".into(), crate::document::Node::new("custom/gone"));
    assert!(check(&d, small()).iter().any(|p| p.message.contains("there is no function `gone`")));
    // The grammar's problems stand on their line too.
    refused(
        &text("return x;", "").replace("/// - x: number", "/// - y: number"),
        "line 5, column 1: the function has no argument `y`",
    );
    refused(
        &source.replace("return y", "return x").replace("@node custom/test", "@node custom/other"),
        "line 4, column 1: write `/// @node custom/test`",
    );
    refused(&text("return \"é\";", ""), "line 7");
    refused(&text("return x;", "fn g(a: f32) -> f32 { return vec2f(a); }\n"), "line 1");
    refused(&text("return 1;", "").replace("-> f32", "-> u32"), "a node returns");
}

#[test]
fn what_reaches_beyond_a_node_is_refused() {
    for (beside, part) in [
        ("var<private> p: f32;\n", "no variables, bindings or overrides"),
        ("@group(0) @binding(0) var<uniform> p: f32;\n", "bindings"),
        ("@group(0) @binding(0) var t: texture_2d<f32>;\n", "bindings"),
        ("override o: f32 = 1.0;\n", "overrides"),
        ("@fragment fn g() {}\n", "attributes"),
        ("@compute @workgroup_size(1) fn g() {}\n", "attributes"),
        ("enable f16;\n", "expected `fn`"),
        ("diagnostic(off, derivative_uniformity);\n", "expected `fn`"),
        ("fn g(p: ptr<function, f32>) -> f32 { return *p; }\n", "works on values only"),
        ("alias T = f32;\n", "`T` is the library's name"),
        ("struct Surface { x: f32 }\n", "`Surface` is the library's name"),
        ("//! T = f32 | vec2f\n", "fixed types"),
        ("const A = 1;\nconst A = 2;\n", "`A` stands twice"),
        ("struct A { x: f32 }\nstruct B { a: A, b: A }\n", "numbers, vectors, matrices and arrays"),
        ("fn g() -> array<array<f32, 4>, 4> { return array<array<f32, 4>, 4>(); }\n", "an array holds"),
        ("const A = array<f32, 1000000000>();\n", "at most 256"),
        ("const A = array<f32, 4 * 4>();\n", "at most 256"),
        ("const B = array(1.0, 2.0);\nconst A = array(B, B, B, B);\n", "write the array's type"),
    ] {
        refused(&text("return x;", beside), part);
    }
    refused(&text("discard;", ""), "cannot discard");
    refused(&text("workgroupBarrier(); return x;", ""), "leave it out");
    refused(&text("return fwidth(x);", ""), "compares neighbouring pixels");
    refused(&text("return node_math_mix(x, x, x);", ""), "node_math_mix");
    let sample = "/// Test\n///\n/// A test.\n/// @node custom/test\n/// - image: which [image srgb]\n/// - uv: where [context uv0]\nfn f(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> vec4f { return textureSample(image, image_sampler, uv); }";
    refused(sample, "textureSampleLevel or textureSampleGrad");
    let fixed =
        sample.replace("textureSample(image, image_sampler, uv)", "textureSampleLevel(image, image_sampler, uv, 0.0)");
    assert!(read_function("test", &fixed).is_ok());
}

#[test]
fn what_need_not_end_is_refused() {
    const COUNTED: &str = "a loop counts from a number";
    for (body, part) in [
        ("loop { }\nreturn x;", "need not end"),
        ("while true { }\nreturn x;", "need not end"),
        ("for (;;) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i < 10; ) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i < 10; i += 0) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i < i32(x); i++) { }\nreturn x;", COUNTED),
        ("for (var i = 0.0; i < 1.0; i += 1e-30) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i != 10; i++) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i < 10; i--) { }\nreturn x;", COUNTED),
        ("for (var i = 10; i > 0; i++) { }\nreturn x;", COUNTED),
        ("for (var i = 8u; i >= 0u; i--) { }\nreturn x;", "counts below 0"),
        ("for (var i: u32 = 5; i > 0; i -= 2) { }\nreturn x;", "counts below 0"),
        ("for (var i = N; i >= 0; i--) { }\nreturn x;", "counts below 0"),
        ("for (var i = 10; i > -1000000; i--) { }\nreturn x;", "turns of loops and calls"),
        ("for (var i = 0; i <= 9; i++) { i = 0; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { i -= 1; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { i--; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { (i) = 0; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { ((i))--; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { (\n  i // here\n) -= 1; }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { let p = & ((i)); *p = 0; }\nreturn x;", "makes a pointer"),
        ("for (var i = 0; i < 10; i++) { let p = &i; *p = 0; }\nreturn x;", "makes a pointer"),
        ("for (var i = 0; i < 10; i++) { if x > 0.0 { i <<= 0u; } }\nreturn x;", "counter is changed"),
        ("for (var i = 0; i < 10; i++) { let p = true && &i; }\nreturn x;", "makes a pointer"),
        ("for (var i = 0; i < 10; i++) { let p = true &&&i; }\nreturn x;", "makes a pointer"),
        ("for (var i = 0; i < 1000000; i++) { }\nreturn x;", "turns of loops and calls"),
        ("for (var i = 0; i < 2147483647; i += 1048576) { }\nreturn x;", COUNTED),
        ("for (var i = 0; i < 8; i += 2147483647) { }\nreturn x;", COUNTED),
        ("let N = i32(x);\nfor (var i = 0; i < N; i++) { }\nreturn x;", COUNTED),
        (
            "for (var i = 0; i < 1000; i++) { for (var j = 0; j < 1000; j++) { } }\nreturn x;",
            "turns of loops and calls",
        ),
        ("return f(x);", "is recursive"),
    ] {
        refused(&text(body, "const N = 8;\n"), part);
    }
    for sound in ["if x > 0.5&&true&&x < 2.0 { return x; }\nreturn x;", "let n = 6 & 3;\nreturn f32(n&2);"] {
        assert_eq!(read_function("test", &text(sound, "")).err().map(|error| error.to_string()), None);
    }
    let shadows = "alias i32 = u32;\n";
    refused(&text("for (var j: i32 = 5; j >= 0; j--) { }\nreturn x;", shadows), "`i32` is a type of WGSL");
    // Two to the thirtieth calls, without a loop.
    let mut doubling = String::from("fn g0(x: f32) -> f32 { return x; }\n");
    for i in 1..30 {
        doubling += &format!("fn g{i}(x: f32) -> f32 {{ return g{}(x) + g{}(x); }}\n", i - 1, i - 1);
    }
    refused(&text("return g29(x);", &doubling), "turns of loops and calls");
    // What counts is not refused.
    let counted = "var s = 0.0;\nfor (var i: u32 = 1u; i <= 8u; i += 2u) { let a = (i) & 3u; if (i) == 7u { s += f32((i) + a) - (f32(i)); } if i == 2u { continue; } s += f32(a - i); }\nfor (var j = 0; j < 4; j++) { s += x; }\nreturn s;";
    assert!(read_function("test", &text(counted, "")).is_ok(), "{:?}", read_function("test", &text(counted, "")));
    let asked = "var s = 0.0;\nfor (var i = 0; i < 8; i++) { if (x > 0.5 && i > 3) || (x < 0.1&&i == 2) { s += x; } }\nreturn s;";
    assert!(read_function("test", &text(asked, "")).is_ok(), "{:?}", read_function("test", &text(asked, "")));
    for (head, turns) in [
        ("var j = -1; j <= 1; j++", 3),
        ("var j = 8; j > 0; j -= 3", 3),
        ("var j = 2; j >= -2; j--", 5),
        ("var j: u32 = 6; j > 0; j -= 2", 3),
        ("var j = N; j > 0; j--", 8),
        ("var j = 5; j < -5; j++", 0),
    ] {
        let source = text(&format!("var s = x;\nfor ({head}) {{ s += f32(j); }}\nreturn s;"), "const N = 8;\n");
        let function = read_function("test", &source).unwrap_or_else(|error| panic!("{head}: {error}"));
        assert_eq!(function.work, turns + 1, "{head}");
    }
}

/// What all nodes take together is bounded like what one takes, wherever they stand. A call of a library function without loops is one
/// turn, and of one with loops many.
#[test]
fn turns_are_summed_over_the_nodes_that_reach_the_surface() {
    let looping =
        |turns: u64| text(&format!("var s = 0.0;\nfor (var i = 0; i < {turns}; i++) {{ s += x; }}\nreturn s;"), "");
    let work = |text: &str| read_function("test", text).unwrap_or_else(|e| panic!("{e}")).work;
    assert_eq!(work(&looping(30_000)), 30_001);
    assert_eq!(work(&text("return luminance(vec3f(x));", "")), 2);
    assert_eq!(work(&text("return node_procedural_fbm_2d_vertex(vec2f(x), 4.0, 3, 2.0, 0.5, 1);", "")), 65);
    // In a row, and one that reaches nothing.
    let mut d = document(
        &[("a", "custom/test"), ("b", "custom/test"), ("dead", "custom/test")],
        &[("a.out", "b.x"), ("b.out", "surface.height")],
    );
    d.functions.insert("test".into(), looping(30_000));
    assert!(check(&d, small()).iter().all(|p| p.severity == Severity::Warning));
    d.functions.insert("test".into(), looping(40_000));
    let told = |d: &crate::document::Document| {
        let problems = check(d, small());
        problems
            .iter()
            .any(|p| p.severity == Severity::Error && p.message.contains("take 80002 turns of loops and calls"))
    };
    assert!(told(&d), "{:?}", check(&d, small()));
    // A group counts as often as it is used.
    let edit = collapse(&d, small(), None, &["a".into(), "b".into()], "G").expect("a group");
    crate::edit::apply(&mut d, &edit).expect("applied");
    assert!(told(&d), "{:?}", check(&d, small()));
}

#[test]
fn hostile_texts_are_refused_at_once() {
    // naga takes the square of a function's length.
    refused(&text(&format!("var s = x;\n{}return s;", "s = s + x;\n".repeat(3000)), ""), "words and signs; 16384 are");
    let terms = vec!["x"; 10_000].join(" + ");
    refused(&text(&format!("return {terms};"), ""), "nested too deeply");
    refused(&text(&format!("return {}x{};", "(".repeat(5000), ")".repeat(5000)), ""), "nested too deeply");
    refused(&text(&format!("return {}x;", "-".repeat(10_000)), ""), "nested too deeply");
    refused(&text(&format!("{}{}return x;", "{".repeat(5000), "}".repeat(5000)), ""), "nested too deeply");
    refused(
        &text(&format!("if x > 0.0 {{ }} {}return x;", "else if x > 0.0 { } ".repeat(2000)), ""),
        "nested too deeply",
    );
    refused(&" ".repeat(MAX_BYTES + 1), "longer than 64 KiB");
    let two_thirds = format!("[{:?}]", " ".repeat(200 << 10));
    let document = format!(
        r#"{{"halfvector": 1, "name": "", "nodes": {{}}, "functions": {{"a": {two_thirds}, "b": {two_thirds}}}}}"#
    );
    let error = crate::file::from_json(&document).expect_err("a refusal").to_string();
    assert!(error.contains("together they are longer than 256 KiB"), "{error}");
    refused(&text("/* never closed", ""), "does not end");
    refused("", "there is no function");
    refused("fn f() {}", "write `/// @node custom/test`");
    let swizzles = format!("let v = vec4f(x){};\nreturn v.x;", ".xyzw".repeat(2000));
    let _ = read_function("test", &text(&swizzles, ""));
    let many = (0..1000).map(|i| format!("fn g{i}(x: f32) -> f32 {{ return x; }}\n")).collect::<String>();
    assert!(read_function("test", &text("return g999(x);", &many)).is_ok());
    // A chain of a thousand calls.
    let chain = (1..1000).map(|i| format!("fn g{i}(x: f32) -> f32 {{ return g{}(x); }}\n", i - 1)).collect::<String>();
    let first = "fn g0(x: f32) -> f32 { return x; }\n";
    let _ = read_function("test", &text("return g999(x);", &format!("{first}{chain}")));
}

/// However underscores stand in ids and names, two items of two functions have two names.
#[test]
fn no_two_functions_share_a_name() {
    let of = |id: &str, beside: &str, call: &str| {
        let source = text(&format!("return {call}(x);"), &format!("fn {beside}(x: f32) -> f32 {{ return x; }}\n"));
        let source = source.replace("custom/test", &format!("custom/{id}"));
        let function = read_function(id, &source).unwrap_or_else(|error| panic!("{id}: {error}"));
        let name = function.source.split("fn ").nth(1).and_then(|rest| rest.split('(').next()).map(str::to_owned);
        name.unwrap_or_default()
    };
    let names = [of("b", "c_a", "c_a"), of("b_c", "a", "a"), of("b_c_a", "d", "d"), of("b", "c_a_d", "c_a_d")];
    let distinct: std::collections::BTreeSet<_> = names.iter().collect();
    assert_eq!(distinct.len(), names.len(), "{names:?}");
}

#[test]
fn functions_go_along() {
    let json = r#"{"halfvector": 1, "nodes": {"n": {"node": "custom/test"}, "surface": {"node": "surface/surface"}},
        "links": [{"from": "n.out", "to": "surface.height"}]}"#;
    let mut d = from_json(json).unwrap_or_else(|e| panic!("{e}"));
    d.functions.insert("test".into(), text("return x;", ""));
    let copied = copy(&d, None, &Pick::nodes(["n".into()]));
    let mut other = document(&[], &[]);
    other.functions.insert("test".into(), text("return 2.0 * x;", ""));
    let edit = paste(&other, small(), None, &copied, [0.0; 2]).expect("an edit").edit;
    crate::edit::apply(&mut other, &edit).expect("applied");
    assert_eq!(other.graph.nodes["n"].node, "custom/test_2");
    assert!(other.functions["test_2"].contains("@node custom/test_2\n"));
    assert!(check(&other, small()).iter().all(|p| p.severity == Severity::Warning));

    let edit = collapse(&d, small(), None, &["n".into()], "G").expect("a group");
    crate::edit::apply(&mut d, &edit).expect("applied");
    let file = export_group(&d, "g").expect("a file");
    assert_eq!(file.functions.len(), 1);
    assert_eq!(group_from_json(&group_to_json(&file)).expect("a file"), file);
    let mut third = document(&[], &[]);
    let copied = group_as_copied(file).expect("whole");
    let edit = paste(&third, small(), None, &copied, [0.0; 2]).expect("an edit").edit;
    crate::edit::apply(&mut third, &edit).expect("applied");
    assert_eq!((&third.groups, &third.functions), (&d.groups, &d.functions));
}

proptest! {
    /// Whatever the text, an answer and no panic.
    #[test]
    fn any_text_gives_an_answer(cut in 0..400usize, with in "\\PC{0,8}|for \\(var i = 0; i < 9; i\\+\\+\\) \\{|array<f32, 9>|@|\\}|\\{", drop in 0..20usize) {
        let whole = text("    var s = 0.0;\n    for (var i = 0; i < N; i++) { s += g(x); }\n    return s;", "const N = 4;\nfn g(x: f32) -> f32 { return x * 2.0; }\n");
        let at = (0..=cut.min(whole.len())).rev().find(|&i| whole.is_char_boundary(i)).unwrap_or(0);
        let end = (at + drop).min(whole.len());
        let _ = read_function("test", &format!("{}{with}{}", &whole[..at], &whole[end..]));
    }
}
