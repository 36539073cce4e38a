//! What `T` becomes.

use super::{document, small};
use crate::resolve::resolve_types;
use crate::value::{SocketType, Type, Value};

fn mix_type(nodes: &[(&str, &str)], links: &[(&str, &str)], values: &[(&str, Value)]) -> Type {
    let mut document = document(nodes, links);
    for (input, value) in values {
        document.graph.nodes.get_mut("m").expect("m").values.insert(input.to_string(), value.clone());
    }
    let types = resolve_types(&document.graph, small());
    let types = types.get("m").expect("types of m");
    assert_eq!(types.output("out"), types.input("a"));
    assert_eq!(types.input("t"), Some(SocketType::Value(Type::F32)));
    types.generic.expect("a type")
}

#[test]
fn the_widest_input_decides() {
    let nodes = [("m", "math/mix"), ("c", "vector/combine"), ("e", "vector/extend"), ("s", "vector/separate")];
    assert_eq!(mix_type(&nodes, &[], &[]), Type::F32);
    assert_eq!(mix_type(&nodes, &[("c.out", "m.a")], &[]), Type::Vec3);
    assert_eq!(mix_type(&nodes, &[("s.x", "m.a"), ("c.out", "m.b")], &[]), Type::Vec3);
    assert_eq!(mix_type(&nodes, &[("c.out", "m.t")], &[]), Type::F32, "t is not generic");
    assert_eq!(mix_type(&nodes, &[("c.out", "m.a"), ("e.out", "m.b")], &[]), Type::Vec4, "no type fits both");
    assert_eq!(mix_type(&nodes, &[], &[("a", Value::Vec3([0.0; 3]))]), Type::Vec3, "set values count");
    assert_eq!(mix_type(&nodes, &[("c.out", "m.a")], &[("b", Value::Number(2.0))]), Type::Vec3);
    assert_eq!(
        mix_type(&nodes, &[("s.x", "m.a")], &[("a", Value::Vec4([0.0; 4]))]),
        Type::F32,
        "a link hides the value"
    );
}

#[test]
fn types_run_through_chains_and_end_at_rings() {
    let chain = [("c", "vector/combine"), ("n", "math/mix"), ("m", "math/mix")];
    assert_eq!(mix_type(&chain, &[("n.out", "m.b"), ("c.out", "n.a")], &[]), Type::Vec3);
    let ring = [("c.out", "n.a"), ("n.out", "m.a"), ("m.out", "n.b")];
    assert_eq!(mix_type(&chain, &ring, &[]), Type::Vec3);
    assert_eq!(mix_type(&[("m", "math/mix"), ("u", "no/such")], &[("u.out", "m.a")], &[]), Type::F32);
}
