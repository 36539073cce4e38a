//! What nodes cost.

use super::{exported, material, sun};
use crate::cost::{Figures, cost};

fn figures(values: &str, nodes: &str, links: &str, id: &str) -> Figures {
    let shader = exported(&material(values, nodes, links), &sun());
    let cost = cost(&shader).expect("a valid shader");
    let parts = cost.nodes.iter().fold(Figures::default(), |sum, (_, figures)| sum + *figures);
    let whole = cost.fragment + cost.vertex;
    assert!(parts.operations <= whole.operations && parts.samples <= whole.samples);
    assert!(cost.fragment.operations > 20, "the light costs something");
    cost.nodes.iter().find(|(node, _)| node == id).map(|(_, figures)| *figures).unwrap_or_default()
}

const TO_COLOR: &str = r#"{"from": "n.out", "to": "surface.base_color"}"#;

#[test]
fn a_noise_costs_more_than_a_sum() {
    let to_roughness = r#"{"from": "n.out", "to": "surface.perceptual_roughness"}"#;
    let add = r#""far": {"node": "vector/length"}, "n": {"node": "math/add", "values": {"b": 0.5}},
        "uv": {"node": "coordinates/uv"}"#;
    let links = r#"{"from": "uv.out", "to": "far.v"}, {"from": "far.out", "to": "n.a"}"#;
    let sum = figures("", add, &format!("{links}, {to_roughness}"), "n");
    let noise = r#""n": {"node": "procedural/fbm_3d", "values": {"octaves": 6}}"#;
    let noise = figures("", noise, to_roughness, "n");
    assert!(sum.operations >= 1 && noise.operations > 20 * sum.operations, "{sum:?}, {noise:?}");
}

#[test]
fn a_texture_is_a_sample() {
    let image = r#""n": {"node": "textures/image", "values": {"image": {"file": "a.png", "color_space": "srgb"}}}"#;
    let image = figures("", image, &TO_COLOR.replace("n.out", "n.color"), "n");
    assert_eq!(image.samples, 1, "{image:?}");
}
