//! What shaders cost, estimated.

use halfvector_graph::document::Document;
use halfvector_graph::needs::Needs;

use super::{environment, exported, maps, material, sun};
use crate::cost;

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
