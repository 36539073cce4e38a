//! Whole numbers keep all their digits from the document to the shader, though an f32 holds only those up to 16777216.

use halfvector_graph::check::{Severity, check};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::value::Value;

use super::{exported, made, sun, with_parameters};
use crate::reflection::Resource;
use crate::target::{TARGETS, export};
use crate::uniforms::fill_input;
use crate::{Fold, Shader};

const INTEGERS: [i32; 7] = [3, 16_777_216, 16_777_217, -16_777_217, 123_456_789, i32::MAX, i32::MIN];

/// A document whose roughness is how far `n` lies above `minus`.
fn above(n: i32, minus: i32, parameters: &str) -> Document {
    let node = format!(r#""far": {{"node": "custom/far", "values": {{"n": {n}, "minus": {minus}}}}}"#);
    let link = r#"{"from": "far.out", "to": "surface.perceptual_roughness"}"#;
    let mut document = with_parameters("", &node, link, parameters);
    let function = "/// Far\n///\n/// How far one lies above the other.\n/// @node custom/far\n/// - n: one [0]\n/// - minus: other [0]\n\
        fn far(n: i32, minus: i32) -> f32 {\n    return f32(n - minus);\n}\n";
    document.functions.insert("far".into(), function.into());
    let problems = check(&document, Library::standard());
    assert!(problems.iter().all(|p| p.severity != Severity::Error), "{n}: {problems:?}");
    document
}

/// The bytes of the parameters.
fn parameters(document: &Document, shader: &Shader) -> Vec<u8> {
    let mut blocks = shader.reflection.bindings.iter().filter_map(|binding| match &binding.resource {
        Resource::Uniform(block) if binding.group == 1 => Some(block),
        _ => None,
    });
    let block = blocks.next().expect("a block of parameters");
    let fill = |source: &_, numbers: &mut _| fill_input(document, Library::standard(), block, source, numbers);
    block.pack(fill).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn files_keep_every_digit() {
    for n in INTEGERS {
        let document = above(n, 0, "");
        let text = halfvector_graph::file::to_json(&document);
        assert_eq!(halfvector_graph::file::from_json(&text).ok().as_ref(), Some(&document), "{text}");
        assert_eq!(document.graph.nodes["far"].values["n"], Value::whole(n));
        assert_eq!(Value::whole(n).numbers(), Some(vec![f64::from(n)]));
    }
}

/// What is written is no whole number of 32 bits though its nearest f32 is one: refused, and kept for a number of another kind.
#[test]
fn what_is_no_integer_is_not_rounded_to_one() {
    let written = |n: &str| {
        let text = halfvector_graph::file::to_json(&above(7_654_321, 0, ""));
        halfvector_graph::file::from_json(&text.replace("7654321", n)).unwrap_or_else(|e| panic!("{n}: {e}"))
    };
    for n in ["16777217.5", "-2147483649", "2147483648", "0.99999999999", "1e-60", "4194303.1"] {
        let document = written(n);
        let problems = check(&document, Library::standard());
        let told = problems.iter().any(|p| p.severity == Severity::Error && p.message.contains("a whole number from"));
        assert!(told, "{n}: {problems:?}");
        let text = halfvector_graph::file::to_json(&document);
        assert_eq!(halfvector_graph::file::from_json(&text).ok().as_ref(), Some(&document), "{text}");
        let value = &document.graph.nodes["far"].values["n"];
        assert_eq!(value.numbers(), Some(vec![f64::from(n.parse::<f32>().expect("a number"))]), "{n}");
    }
    for (n, whole) in [("16777217.0", 16_777_217), ("-2147483648.0", i32::MIN), ("1.6777217e7", 16_777_217)] {
        assert_eq!(written(n).graph.nodes["far"].values["n"], Value::whole(whole), "{n}");
    }
}

#[test]
fn folding_and_uniforms_keep_every_digit() {
    for n in INTEGERS {
        let minus = n.wrapping_sub(1);
        let folded = exported(&above(n, minus, ""), &sun()).wgsl;
        assert!(folded.contains("max(1.0, PUNCTUAL_ROUGHNESS_FLOOR)"), "{n}: {folded}");
        let document = above(n, minus, "");
        let live = made(&document, &sun(), Fold::Live);
        let bytes = parameters(&document, &live);
        let holds = |x: i32| bytes.chunks_exact(4).any(|word| word == x.to_le_bytes());
        assert!(holds(n) && holds(minus), "{n}: {bytes:?}");
    }
}

/// Beside a parameter the other number stands in the text, in every language; the parameter's own is its default.
#[test]
fn every_target_writes_every_digit() {
    for n in [16_777_217, -16_777_217, i32::MAX] {
        let document = above(3, n, r#"{"name": "n", "socket": "far.n"}"#);
        let opposite = above(n, 3, r#"{"name": "n", "socket": "far.n"}"#);
        for target in TARGETS {
            let needs = target.needs(sun());
            let text = |document: &Document| -> String {
                let files = export(&exported(document, &needs), target, "m").unwrap_or_else(|e| panic!("{e}"));
                files.iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect()
            };
            let words = |document: &Document| -> bool {
                let files = export(&exported(document, &needs), target, "m").unwrap_or_else(|e| panic!("{e}"));
                files.iter().any(|file| file.bytes.chunks_exact(4).any(|word| word == n.to_le_bytes()))
            };
            assert!(text(&document).contains(&n.to_string()) || words(&document), "{}: {n}", target.name);
            assert!(text(&opposite).contains(&n.to_string()), "{}: the default {n}", target.name);
        }
    }
}

/// What no i32 holds is refused with what it holds.
#[test]
fn what_is_too_large_is_refused_with_the_range() {
    let mut document = above(1, 0, "");
    for (x, words) in [(2_147_483_648.0, "2147483648"), (-3e9, "-3000000000"), (0.5, "0.5")] {
        let far = document.graph.nodes.get_mut("far").expect("the node");
        far.values.insert("n".into(), Value::Number(x));
        let problems = check(&document, Library::standard());
        let told = format!("the value is the number {words}, but a i32 is wanted");
        let range = "from -2147483648 to 2147483647";
        let said = problems.iter().any(|p| p.message.contains(&told) && p.message.contains(range));
        assert!(said, "{x}: {problems:?}");
    }
}
