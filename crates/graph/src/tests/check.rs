//! Every problem, found and told.

use proptest::prelude::*;

use super::{any_document, document, link, small, socket};
use crate::check::{MAX_MIXTURES, Problem, Severity, check, node_label, surface_node};
use crate::document::{AlphaMode, Document, Node, Parameter, SURFACE_MIX};
use crate::value::{ColorSpace, ImageRef, Value};

fn told(document: &Document) -> Vec<Problem> {
    check(document, small())
}

/// Asserts that exactly one problem stands at this place and says this.
#[track_caller]
fn one(document: &Document, severity: Severity, place: &str, part: &str) {
    let problems = told(document);
    let at = |p: &Problem| [p.node.clone().unwrap_or_default(), p.socket.clone().unwrap_or_default()].join(".");
    let found: Vec<&Problem> =
        problems.iter().filter(|p| at(p).trim_end_matches('.') == place && p.message.contains(part)).collect();
    assert_eq!(found.len(), 1, "wanted {part} at {place}, got {problems:#?}");
    assert_eq!(found[0].severity, severity, "{}", found[0]);
}

fn set(document: &mut Document, input: &str, value: Value) {
    let input = socket(input);
    document.graph.nodes.get_mut(&input.node).expect("a node").values.insert(input.socket, value);
}

fn picture(file: &str) -> Value {
    let (wrap_u, wrap_v, filter) = Default::default();
    Value::Image(ImageRef { file: file.into(), color_space: ColorSpace::Srgb, wrap_u, wrap_v, filter })
}

/// A sound document: picture into colour, generic chain into roughness.
fn sound() -> Document {
    let mut document = document(
        &[("rust", "textures/image"), ("m", "math/mix")],
        &[("rust.color", "surface.base_color"), ("m.out", "surface.perceptual_roughness")],
    );
    set(&mut document, "rust.image", picture("rust.png"));
    document.graph.nodes.get_mut("rust").expect("rust").label = Some("錆".into());
    document
}

#[test]
fn a_sound_document_has_no_problems() {
    assert_eq!(told(&sound()), []);
    assert_eq!(told(&Document::with_surface("plain")), []);
    assert_eq!(surface_node(&sound(), small()), Some("surface"));
    assert_eq!(node_label(&sound().graph, small(), "m"), "Mix");
}

#[test]
fn definitions_and_names() {
    let mut d = sound();
    d.graph.nodes.get_mut("m").expect("m").node = "math/lerp".into();
    one(&d, Severity::Error, "m", "did you mean `math/mix`?");
    d.graph.nodes.get_mut("m").expect("m").node = "math/mixx".into();
    one(&d, Severity::Error, "m", "did you mean `math/mix`?");
    let mut d = sound();
    let node = d.graph.nodes["m"].clone();
    d.graph.nodes.insert("9 lives".into(), node);
    one(&d, Severity::Error, "9 lives", "no name");
    let mut d = sound();
    d.graph.nodes.get_mut("m").expect("m").label = Some("a\nb".into());
    one(&d, Severity::Warning, "m", "line breaks");
    assert!(told(&d)[0].to_string().starts_with("warning: \u{201c}a b\u{201d} (m): "), "{}", told(&d)[0]);
}

#[test]
fn surfaces() {
    one(&Document::new("empty"), Severity::Error, "", "no surface node");
    let d = document(&[("zweite", "surface/surface")], &[]);
    one(&d, Severity::Error, "zweite", "one surface node");
    assert_eq!(surface_node(&d, small()), None);
    let d = document(&[("m", "math/mix")], &[]);
    one(&d, Severity::Warning, "m", "does not reach the surface");
    let mut d = sound();
    set(&mut d, "surface.opacity", Value::Number(0.5));
    one(&d, Severity::Warning, "surface.opacity", "alpha mode is opaque");
    d.surface.alpha_mode = AlphaMode::Blend;
    assert_eq!(told(&d), []);
    d.surface.alpha_cutoff = f32::NAN;
    one(&d, Severity::Error, "", "alpha_cutoff");
}

#[test]
fn links() {
    let with = |from: &str, to: &str| {
        let mut d = sound();
        d.graph.links.push(link(from, to));
        d
    };
    one(&with("m.out", "surface.base_color"), Severity::Error, "surface.base_color", "two links");
    one(&with("m.out", "surface.base_colour"), Severity::Error, "surface.base_colour", "did you mean `base_color`?");
    one(&with("m.out", "surface.metal"), Severity::Error, "surface.metal", "it has base_color, perceptual_roughness");
    one(&with("m.value", "surface.height"), Severity::Error, "m.value", "no such output; it has out");
    one(&with("gone.out", "surface.height"), Severity::Error, "surface.height", "no such node");
    // What it was to feed may be what a shader needs.
    one(&with("m.out", "gone.a"), Severity::Error, "gone.a", "there is no such node; correct its name");
    one(&with("rust.rgba", "surface.normal"), Severity::Error, "surface.normal", "link its output `color` instead");
    one(&with("rust.color", "surface.height"), Severity::Error, "surface.height", "components would be lost");
    one(&with("surface.out", "m.a"), Severity::Error, "m.a", "the end of the material");
    one(&with("m.out", "rust.image"), Severity::Error, "rust.image", "set on the node, not linked");
    let mut d = with("rust.color", "m.a");
    d.graph.links.push(link("rust.rgba", "m.b"));
    one(&d, Severity::Error, "m.a", "link its output `rgba` instead");
    one(&d, Severity::Error, "surface.perceptual_roughness", "components would be lost");
    let nodes = [("c", "vector/combine"), ("s", "vector/separate"), ("m", "math/mix"), ("e", "vector/extend")];
    let d = document(&nodes, &[("c.out", "s.v"), ("e.out", "m.a"), ("c.out", "m.b"), ("s.x", "surface.height")]);
    one(&d, Severity::Error, "s.v", "components would be lost");
    one(&d, Severity::Warning, "m.b", "components are missing");
    let nodes = [("g", "vector/greater"), ("s", "vector/select")];
    let d = document(&nodes, &[("g.out", "s.which"), ("s.out", "g.a"), ("g.out", "surface.height"), ("g.out", "s.a")]);
    one(&d, Severity::Error, "s.a", "a switch is no number");
    let d = document(&nodes, &[("s.out", "s.n"), ("s.out", "surface.height")]);
    one(&d, Severity::Error, "s.n", "round it first");
}

#[test]
fn rings_name_their_nodes() {
    let nodes = [("a", "math/mix"), ("b", "math/mix"), ("c", "math/mix")];
    let links = [("a.out", "b.a"), ("b.out", "c.a"), ("c.out", "a.a"), ("c.out", "surface.height")];
    let mut d = document(&nodes, &links);
    d.graph.nodes.get_mut("b").expect("b").label = Some("Bee".into());
    one(
        &d,
        Severity::Error,
        "b",
        "\u{201c}Bee\u{201d} -> \u{201c}Mix\u{201d} -> \u{201c}Mix\u{201d} -> \u{201c}Bee\u{201d}",
    );
    let d = document(&nodes, &[("a.out", "a.b"), ("a.out", "surface.height")]);
    one(&d, Severity::Error, "a", "feeds itself");
}

#[test]
fn values() {
    let with = |input: &str, value: Value| {
        let mut d = sound();
        set(&mut d, input, value);
        d
    };
    one(&with("surface.height", Value::Number(f32::NAN)), Severity::Error, "surface.height", "no finite number");
    one(
        &with("surface.height", Value::Vec2([0.0; 2])),
        Severity::Error,
        "surface.height",
        "the value is two numbers, but a f32",
    );
    one(&with("surface.height", Value::Bool(true)), Severity::Error, "surface.height", "the value is true");
    one(&with("surface.heigth", Value::Number(0.0)), Severity::Error, "surface.heigth", "did you mean `height`?");
    one(&with("surface.height", picture("a.png")), Severity::Error, "surface.height", "a picture, but a f32");
    one(&with("rust.image", Value::Number(1.0)), Severity::Error, "rust.image", "a picture is wanted");
    one(&with("rust.image", picture("")), Severity::Error, "rust.image", "file name is empty");
    one(&with("rust.image", picture("/home/me/a.png")), Severity::Warning, "rust.image", "root of this disk");
    one(&with("rust.image", picture("C:\\a.png")), Severity::Warning, "rust.image", "root of this disk");
    one(
        &with("m.a", Value::Vec3([0.0; 3])),
        Severity::Error,
        "surface.perceptual_roughness",
        "components would be lost",
    );
    assert_eq!(told(&with("surface.base_color", Value::Number(0.5))), [], "one number is spread");
    let mut d = sound();
    d.graph.nodes.get_mut("rust").expect("rust").values.clear();
    one(&d, Severity::Error, "rust.image", "no picture is chosen");
    d.graph.links.remove(0);
    one(&d, Severity::Warning, "rust.image", "no picture is chosen");
    let mut d = document(&[("s", "vector/select")], &[("s.out", "surface.height")]);
    set(&mut d, "s.n", Value::Number(1.5));
    one(&d, Severity::Error, "s.n", "a whole number");
    set(&mut d, "s.n", Value::Number(3.0));
    assert_eq!(told(&d), []);
}

#[test]
fn parameters() {
    let parameter =
        |name: &str, input: &str| Parameter { name: name.into(), label: None, socket: socket(input), range: None };
    let with = |parameters: &[Parameter]| Document { parameters: parameters.to_vec(), ..sound() };
    assert_eq!(told(&with(&[parameter("height", "surface.height"), parameter("t", "m.t")])), []);
    one(
        &with(&[parameter("h", "surface.height"), parameter("h", "m.t")]),
        Severity::Error,
        "",
        "2 parameters are named `h`",
    );
    one(&with(&[parameter("my height", "surface.height")]), Severity::Error, "", "needs a name");
    one(&with(&[parameter("h", "gone.height")]), Severity::Error, "", "no such node");
    one(&with(&[parameter("h", "surface.hight")]), Severity::Error, "surface.hight", "did you mean `height`?");
    one(&with(&[parameter("c", "surface.base_color")]), Severity::Error, "surface.base_color", "fed by rust.color");
    one(&with(&[parameter("i", "rust.image")]), Severity::Error, "rust.image", "only numbers");
    one(&with(&[parameter("n", "surface.normal")]), Severity::Error, "surface.normal", "reads `world_normal`");
    for range in [[1.0, 0.0], [0.0, f32::INFINITY], [f32::NAN, 1.0]] {
        let parameter = Parameter { range: Some(range), ..parameter("h", "surface.height") };
        one(&with(&[parameter]), Severity::Error, "", "range of the parameter `h`");
    }
    let mut d = with(&[parameter("t", "m.t")]);
    d.graph.links.pop();
    one(&d, Severity::Warning, "m.t", "has no effect");
}

#[test]
fn the_vertex_stage() {
    let nodes = [("slope", "textures/slope"), ("rust", "textures/image"), ("split", "vector/separate")];
    let mut d = document(&nodes[..1], &[("slope.out", "surface.height")]);
    one(&d, Severity::Error, "slope", "fragment stage only");
    d.graph.links[0] = link("slope.out", "surface.perceptual_roughness");
    assert_eq!(told(&d), [], "the fragment stage has derivatives");
    let mut d = document(&nodes[1..2], &[("rust.color", "surface.height")]);
    set(&mut d, "rust.image", picture("a.png"));
    one(&d, Severity::Error, "surface.height", "components would be lost");
    assert_eq!(told(&d).len(), 1, "a picture has a function for the vertex stage");
}

#[test]
fn smooth_surfaces_and_newer_files() {
    let mut d = Document::with_surface("mirror");
    set(&mut d, "surface.perceptual_roughness", Value::Number(0.0));
    one(&d, Severity::Warning, "surface.perceptual_roughness", "0.045");
    d.version = 7;
    d.unknown.insert("groups".into(), 1.into());
    one(&d, Severity::Warning, "", "format 7");
    one(&d, Severity::Warning, "", "`groups`");
}

proptest! {
    #[test]
    fn any_document_is_checked(document in any_document()) {
        for problem in told(&document) {
            // One line, and below it the user's own code where that is meant.
            let has_code = problem.message.starts_with("the function `");
            prop_assert!(has_code || !problem.to_string().contains('\n'), "{problem}");
            prop_assert!(serde_json::to_string(&problem).is_ok());
        }
        check(&document, crate::library::Library::standard());
    }
}

/// Each is as much as twenty other nodes: a shader of ten thousand would take seconds to write.
#[test]
fn too_many_mixtures_are_refused() {
    let with = |count: usize| {
        let mut d = Document::with_surface("mixtures");
        for i in 0..count {
            d.graph.nodes.insert(format!("m{i}"), Node::new(SURFACE_MIX));
            let before = if i == 0 { "surface.out".to_owned() } else { format!("m{}.out", i - 1) };
            d.graph.links.push(link("surface.out", &format!("m{i}.a")));
            d.graph.links.push(link(&before, &format!("m{i}.b")));
        }
        check(&d, crate::library::Library::standard())
    };
    assert_eq!(with(MAX_MIXTURES), []);
    let problems = with(MAX_MIXTURES + 1);
    assert!(problems.iter().any(|p| p.message.contains("no shader has more than 1000")), "{problems:?}");
}

/// Where surfaces mix each other in a ring, none is the last one: the ring is what is told, and not that there is none.
#[test]
fn a_ring_of_mixtures_is_named() {
    let mut d = Document::new("ring");
    for (id, from) in [("a", "b"), ("b", "a")] {
        d.graph.nodes.insert(id.into(), Node::new(SURFACE_MIX));
        d.graph.links.push(link(&format!("{from}.out"), &format!("{id}.a")));
    }
    let problems = check(&d, crate::library::Library::standard());
    let of_document: Vec<&Problem> = problems.iter().filter(|p| p.node.is_none()).collect();
    assert_eq!(of_document.len(), 1, "{problems:?}");
    assert!(of_document[0].message.contains("in a ring") && of_document[0].message.contains("(a)"), "{problems:?}");
    assert!(!of_document[0].message.contains("no surface node"), "{problems:?}");
}
