//! Reading node definitions from WGSL.

use super::{FILES, MIX, small};
use crate::docs;
use crate::library::Library;
use crate::node_def::{Argument, Default, Input};
use crate::value::{ColorSpace, SocketType, Type, Value};

fn problems(files: &[(&str, &str)]) -> Vec<String> {
    match Library::parse(files) {
        Ok(_) => Vec::new(),
        Err(e) => e.problems.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn the_standard_library_is_read_whole() {
    let library = Library::standard();
    assert!(library.iter().count() >= 60, "{} nodes", library.iter().count());
    assert!(library.get("surface/surface").is_some());
    for def in library.iter().filter(|def| def.vertex_function.is_none() && def.function.implicit_derivatives) {
        println!("{} works in the fragment stage only", def.id);
    }
}

#[test]
fn a_generic_node_is_read() {
    let def = small().get("math/mix").expect("the node");
    assert_eq!((def.label.as_str(), def.help.as_str()), ("Mix", "a (1 - t) + b t"));
    assert_eq!(def.synonyms, ["lerp", "blend"]);
    assert_eq!(def.generic, [Type::F32, Type::Vec2, Type::Vec3, Type::Vec4]);
    assert_eq!(def.outputs[0].ty, SocketType::Generic);
    let input = |name: &str, ty, default: f32, range| Input {
        label: None,
        name: name.into(),
        ty,
        default: Default::Value(Value::Number(default)),
        range,
        unit: String::new(),
        help: if name == "t" {
            "weight of b"
        } else if name == "a" {
            "first"
        } else {
            "second"
        }
        .into(),
    };
    let inputs = [
        input("a", SocketType::Generic, 0.0, None),
        input("b", SocketType::Generic, 1.0, None),
        input("t", SocketType::Value(Type::F32), 0.5, Some([0.0, 1.0])),
    ];
    assert_eq!(def.inputs, inputs);
}

#[test]
fn structs_textures_and_contexts_are_read() {
    let separate = small().get("vector/separate").expect("the node");
    let outputs: Vec<(&str, &str)> = separate.outputs.iter().map(|o| (o.name.as_str(), o.help.as_str())).collect();
    assert_eq!(outputs, [("x", "first"), ("y", "second and last")]);
    assert!(separate.function.returns_struct);
    assert_eq!(separate.output_functions[0].1.name, "node_vector_separate_x");
    let image = small().get("textures/image").expect("the node");
    assert_eq!(image.inputs[0].ty, SocketType::Texture);
    assert_eq!(image.inputs[0].default, Default::Image(ColorSpace::Srgb));
    assert_eq!(image.inputs[1].default, Default::Context("uv0".into()));
    let arguments = [Argument::Input("image".into()), Argument::Sampler("image".into()), Argument::Input("uv".into())];
    assert_eq!(image.function.arguments, arguments);
    let surface = small().get("surface/surface").expect("the node");
    assert_eq!(surface.outputs[0].ty, SocketType::Surface);
    assert!(!surface.function.returns_struct);
    assert_eq!((surface.inputs[4].unit.as_str(), surface.inputs[4].range), ("m", Some([-1.0, 1.0])));
    let extend = small().get("vector/extend").expect("the node");
    assert_eq!(extend.inputs[0].default, Default::Value(Value::Vec3([0.5; 3])), "one number is spread");
}

#[test]
fn implicit_derivatives_are_found_through_calls() {
    let image = small().get("textures/image").expect("the node");
    assert!(image.function.implicit_derivatives);
    assert!(image.vertex_function.as_ref().is_some_and(|f| !f.implicit_derivatives));
    assert!(small().get("textures/slope").is_some_and(|def| def.function.implicit_derivatives));
    assert!(small().get("math/mix").is_some_and(|def| !def.function.implicit_derivatives));
}

/// The file of `math/mix` with one thing exchanged, and the problem that must come of it.
#[test]
fn each_slip_is_told_with_file_and_line() {
    let cases = [
        ("/// Mix\n///\n", "/// Mix\n", 5, "leave the second one empty"),
        ("/// a (1 - t) + b t\n", "", 4, "help is missing"),
        ("/// Mix", "///", 4, "label"),
        ("@node math/mix ", "@node Math/mix ", 7, "small letters"),
        ("@node math/mix ", "@node math/blend ", 7, "named `node_math_blend`"),
        ("@node math/mix ", "@node color/mix ", 7, "nodes/color/"),
        ("@node math/mix ", "@nod math/mix ", 7, "without `@node`"),
        ("@also lerp, blend", "@also lerp, lerp", 7, "twice"),
        ("@also lerp", "@alias lerp", 7, "`@alias` is unknown"),
        ("- a: first [0; -inf..inf]", "- a: first", 8, "default of `a` is missing"),
        ("- a: first [0; -inf..inf]", "- a: [0]", 8, "help of `a` is missing"),
        ("- a: first [0; -inf..inf]", "- a: first [zero]", 8, "`zero` is no default"),
        ("- a: first [0; -inf..inf]", "- a: first [0,0,0]", 8, "one number"),
        ("- a: first [0; -inf..inf]", "- a: first [inf]", 8, "no default"),
        ("- a: first [0; -inf..inf]", "- a: first [context uv0]", 8, "type T"),
        ("- a: first [0; -inf..inf]", "- c: first [0]", 8, "no argument `c`"),
        ("/// - a: first [0; -inf..inf]\n", "", 7, "`a` has no line"),
        ("- b: second [1]", "- a: second [1]", 9, "stands twice"),
        ("- b: second [1]", "- b: second [1; 0..2; m; mm]", 9, "`mm` is too much"),
        ("[0.5; 0..1]", "[0.5; 1..0]", 10, "no range"),
        ("[0.5; 0..1]", "[1.5; 0..1]", 10, "outside its range"),
        ("[0.5; 0..1]", "[true]", 10, "does not fit"),
        ("[0.5; 0..1]", "[context uv0]", 10, "is a vec2f"),
        ("[0.5; 0..1]", "[context uv7]", 10, "no context `uv7`"),
        ("[0.5; 0..1]", "[image srgb]", 10, "only a texture"),
        ("[0.5; 0..1]\n", "[0.5; 0..1]\n/// more words\n", 11, "help stands above"),
        ("[0.5; 0..1]\n", "[0.5; 0..1]\n/// @vertex nowhere\n", 11, "no function `nowhere`"),
        ("[0.5; 0..1]\n", "[0.5; 0..1]\n/// @output y node_math_mix\n", 11, "no output `y`"),
        ("[0.5; 0..1]\n", "[0.5; 0..1]\n/// @method normal=wrong node_math_mix\n", 11, "no method `normal=wrong`"),
        ("t: f32) -> T", "t: u32) -> T", 7, "no socket has the type of `t`"),
        ("-> T { return a + (b - a) * t; }", "{ }", 7, "a node returns"),
        ("//! T = f32 | vec2f", "//! T = vec2f | f32", 1, "narrowest first"),
        ("//! T = f32 | vec2f", "//! T = f32 | f32", 1, "twice"),
        ("//! T = f32 | vec2f", "//! T = f32 | mat3x3f", 1, "cannot be `mat3x3f`"),
        ("//! T = ", "// T = ", 2, "`alias T` is for generic files"),
        ("alias T = vec3f;", "", 1, "needs `alias T"),
        ("return a + (b - a) * t;", "return a + nothing;", 11, "nothing"),
        ("return a + (b - a) * t; }", "return a", 11, "does not end"),
    ];
    for (old, new, line, part) in cases {
        assert!(MIX.1.contains(old), "{old}");
        let text = MIX.1.replacen(old, new, 1);
        let told = problems(&[(MIX.0, &text)]);
        let place = format!("{}:{line}: ", MIX.0);
        assert!(
            told.iter().any(|problem| problem.starts_with(&place) && problem.contains(part)),
            "{new:?}: wanted {line}: {part}, got {told:#?}"
        );
    }
}

#[test]
fn stand_ins_are_held_against_the_node() {
    let image = FILES[2];
    let cases = [
        ("@vertex node_textures_image_vertex", "@vertex node_textures_image", "implicit derivatives"),
        ("@vertex node_textures_image_vertex", "@vertex sampled", "returns another type"),
        (
            "uv: vec2f) -> ImageOutputs { let t = textureSampleLevel",
            "uv: vec2f, lod: f32) -> ImageOutputs { let t = textureSampleLevel",
            "`lod` is no input",
        ),
        ("/// @vertex node_textures_image_vertex\n", "", "no comment makes it one"),
        (
            "image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs { let t = sampled",
            "image_sampler: sampler, image: texture_2d<f32>, uv: vec2f) -> ImageOutputs { let t = sampled",
            "followed by",
        ),
        ("    /// all four\n", "", "`ImageOutputs.rgba` has no"),
    ];
    for (old, new, part) in cases {
        assert!(image.1.contains(old), "{old}");
        let told = problems(&[(image.0, &image.1.replacen(old, new, 1))]);
        assert!(told.iter().any(|problem| problem.contains(part)), "wanted {part}, got {told:#?}");
    }
}

#[test]
fn the_same_node_twice_is_refused_and_hostile_text_is_survived() {
    assert!(!problems(&[MIX, ("nodes/math/mix2.wgsl", MIX.1)]).is_empty());
    for text in
        ["fn", "fn f(", &"(".repeat(100_000), &format!("const A = {}1;", "1+".repeat(100_000)), "/// @node", "\u{0}"]
    {
        assert!(!problems(&[("nodes/math/x.wgsl", text)]).is_empty() || text == "/// @node");
    }
}

#[test]
fn the_documents_name_everything() {
    let markdown = docs::nodes_markdown(small());
    let json = docs::nodes_json(small());
    assert_eq!(json["nodes"].as_array().map(Vec::len), Some(small().iter().count()));
    for def in small().iter() {
        assert!(markdown.contains(&format!("### {}\n\n`{}`", def.label, def.id)));
        assert!(def.inputs.iter().all(|input| markdown.contains(&format!("| `{}` |", input.name))));
    }
    for term in crate::method::TERMS {
        assert!(docs::methods_markdown().contains(&format!("## {}\n", term.name)));
        assert!(term.methods.iter().any(|method| method.name == term.report), "{}: {}", term.name, term.report);
    }
    assert_eq!(docs::methods_json()["methods"].as_array().map(Vec::len), Some(crate::method::TERMS.len()));
}
