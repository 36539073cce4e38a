//! What shaders cost, estimated.

use halfvector_graph::document::Document;
use halfvector_graph::needs::Needs;

use super::{environment, exported, maps, material, sun};
use crate::{NodeCost, cost};

#[test]
fn what_is_more_costs_more() {
    let of = |document: &Document, needs: &Needs| cost(&exported(document, needs)).unwrap_or_else(|e| panic!("{e}"));
    let plain = of(&material("", "", ""), &sun());
    let mapped = of(&maps(), &sun());
    assert!(plain.fragment.total() > 10, "{plain:?}");
    assert!(mapped.fragment.total() > plain.fragment.total());
    assert_eq!(mapped.fragment.samples, plain.fragment.samples + 4);
    assert!(of(&maps(), &environment()).fragment.samples > mapped.fragment.samples);
    assert!(plain.uniform_bytes > 0 && plain.vertex.total() > 0);
}

/// Each node has its own part, with what it calls; all of them are less than the whole.
#[test]
fn nodes_have_their_parts() {
    let document = material(
        "",
        r#""noise": {"node": "procedural/value_noise_2d"}, "sine": {"node": "math/sin"}"#,
        r#"{"from": "noise.out", "to": "sine.x"}, {"from": "sine.out", "to": "surface.base_color"}"#,
    );
    let cost = cost(&exported(&document, &sun())).unwrap_or_else(|e| panic!("{e}"));
    let of = |id: &str| cost.nodes.iter().find(|n| n.node == id).map(|n| n.instructions).expect("a part");
    assert_eq!((of("sine").transcendental, of("sine").total()), (1, 1));
    assert!(of("noise").total() > 20, "with the function that it calls: {:?}", of("noise"));
    let parts: u32 = cost.nodes.iter().map(|n| n.instructions.total()).sum();
    assert!(parts < cost.fragment.total() + cost.vertex.total());
}

/// A document of one function of the user's with this body.
fn looping(body: &str) -> Document {
    let mut document = material(
        "",
        r#""place": {"node": "procedural/value_noise_2d"}, "n": {"node": "custom/f"}"#,
        r#"{"from": "place.out", "to": "n.x"}, {"from": "n.out", "to": "surface.perceptual_roughness"}"#,
    );
    let text = format!(
        "const FOUR: i32 = 4;\n/// F\n///\n/// Sums.\n/// @node custom/f\n/// - x: number [0]\nfn f(x: f32) -> f32 {{\n{body}\n}}\n"
    );
    document.functions.insert("f".into(), text);
    document
}

/// A loop counts as often as it turns.
#[test]
fn loops_count_as_often_as_they_turn() {
    let of = |body: &str| {
        let cost = cost(&exported(&looping(body), &sun())).unwrap_or_else(|e| panic!("{e}"));
        let node = cost.nodes.into_iter().find(|node| node.node == "n");
        let NodeCost { instructions, per_turn, .. } = node.expect("the node's part");
        assert!(!per_turn, "{body}");
        instructions
    };
    for (head, turns) in [
        ("var i = 0; i < 10; i++", 10),
        ("var i = 0; i <= 10; i++", 11),
        ("var i = 3u; i < 10u; i += 2u", 4),
        ("var i: i32 = 0; i < FOUR; i++", 4),
        ("var i = 10; i < 4; i++", 0),
    ] {
        let sine = of(&format!("var s = x;\nfor ({head}) {{ s += sin(s); }}\nreturn s;"));
        assert_eq!(sine.transcendental, turns, "{head}: {sine:?}");
    }
    let nested = "var s = x;\nfor (var i = 0; i < 5; i++) { for (var j = 2; j < 5; j++) { s += sin(s); } s = cos(s); }\nreturn s;";
    assert_eq!(of(nested).transcendental, 5 * 3 + 5);
}

/// One that ends by a value counts once, and that is said.
#[test]
fn a_loop_that_ends_by_a_value_counts_once() {
    let noise = material(
        "",
        r#""noise": {"node": "procedural/fbm_2d"}"#,
        r#"{"from": "noise.out", "to": "surface.perceptual_roughness"}"#,
    );
    let of = |document: &Document| cost(&exported(document, &sun())).unwrap_or_else(|e| panic!("{e}"));
    let cost = of(&noise);
    assert!(cost.per_turn && cost.nodes.iter().any(|node| node.node == "noise" && node.per_turn), "{cost:?}");
    assert!(!of(&material("", "", "")).per_turn);
}
