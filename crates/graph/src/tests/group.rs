//! Groups: what is told of them, and how they are taken apart.

use std::time::{Duration, Instant};

use proptest::prelude::*;

use super::{any_document, document, link, small, socket};
use crate::check::{MAX_GROUPS, MAX_LIVE_NODES, Severity, check};
use crate::document::{Document, Group, GroupInput, GroupOutput, Node};
use crate::flatten::{FlattenError, find, flatten};
use crate::group::MAX_GROUP_DEPTH;
use crate::node_def::Default as InputDefault;
use crate::value::{SocketType, Type, Value};

/// A group `mix(x, 0.25, t)`, with a socket for where.
fn band() -> Group {
    let mut group = Group::new("Band");
    group.interface.inputs = vec![
        GroupInput::new("x", Type::F32, Value::Number(0.5)),
        GroupInput {
            default: InputDefault::Context("uv0".into()),
            ..GroupInput::new("uv", Type::Vec2, Value::Number(0.0))
        },
    ];
    group.interface.outputs = vec![GroupOutput::new("out", Type::F32)];
    group.graph.nodes.insert("in".into(), Node::new("group/input"));
    group.graph.nodes.insert("m".into(), Node::new("math/mix").with("b", Value::Number(0.25)));
    group.graph.nodes.insert("s".into(), Node::new("vector/separate"));
    group.graph.links =
        vec![link("in.x", "m.a"), link("in.uv", "s.v"), link("s.x", "m.t"), link("m.out", "output.out")];
    group
}

/// Two bands, one after the other.
fn banded() -> Document {
    let nodes = [("a", "group/band"), ("b", "group/band")];
    let mut d = document(&nodes, &[("a.out", "b.x"), ("b.out", "surface.perceptual_roughness")]);
    d.groups.insert("band".into(), band());
    d
}

#[track_caller]
fn told(d: &Document, severity: Severity, part: &str) {
    let problems = check(d, small());
    let found = problems.iter().filter(|p| p.severity == severity && p.to_string().contains(part)).count();
    assert_eq!(found, 1, "wanted {part:?}, got {:#?}", problems.iter().map(ToString::to_string).collect::<Vec<_>>());
}

/// A link of a group to a node that is not there is as bad as the use of the group.
#[test]
fn a_link_to_nothing_is_an_error_where_the_group_is_used() {
    let mut d = banded();
    d.groups.get_mut("band").expect("the group").graph.links.push(link("in.x", "gone.a"));
    told(&d, Severity::Error, "leads to `gone.a`, but there is no such node");
    d.graph.links.clear();
    told(&d, Severity::Warning, "leads to `gone.a`, but there is no such node");
}

#[test]
fn a_group_is_a_node_of_its_document() {
    let d = banded();
    assert_eq!(check(&d, small()), []);
    let own = small().of(&d);
    let def = own.get("group/band").expect("the group");
    assert_eq!(
        (def.label.as_str(), def.inputs[0].name.as_str(), def.outputs[0].ty),
        ("Band", "x", SocketType::Value(Type::F32))
    );
    assert!(small().get("group/band").is_none());
    let inside = own.inside(&d.groups["band"]);
    assert_eq!(inside.get("group/input").map(|def| def.outputs.len()), Some(2));
    // A value of the wrong type on it, and a socket that it does not have.
    let mut wrong = d.clone();
    wrong.graph.nodes.get_mut("a").expect("a").values.insert("x".into(), Value::Vec2([0.0; 2]));
    told(&wrong, Severity::Error, "the value is two numbers, but a f32 is wanted");
    wrong.graph.links[1] = link("b.gone", "surface.perceptual_roughness");
    told(&wrong, Severity::Error, "`group/band` has no such output; it has out");
}

#[test]
fn problems_inside_name_the_path() {
    let mut d = banded();
    d.groups.get_mut("band").expect("band").graph.nodes.insert("m".into(), Node::new("math/mixx"));
    told(&d, Severity::Error, "\u{201c}Band \u{203a} m\u{201d} (m in group band): there is no node `math/mixx`");
    let mut d = banded();
    d.groups.get_mut("band").expect("band").graph.links[2] = link("in.uv", "m.t");
    told(&d, Severity::Error, "\u{201c}Band \u{203a} Mix\u{201d} (m in group band), t: it takes a f32");
    told(
        &d,
        Severity::Warning,
        "\u{201c}Band \u{203a} separate\u{201d} (s in group band): the node does not reach the group's outputs"
            .replace("separate", "Separate")
            .as_str(),
    );
    // A group that nothing uses can be half-made.
    d.graph.nodes.retain(|id, _| id == "surface");
    d.graph.links.clear();
    assert!(check(&d, small()).iter().all(|p| p.severity == Severity::Warning));
}

#[test]
fn what_a_group_lacks_is_told() {
    let change = |change: &dyn Fn(&mut Group)| {
        let mut d = banded();
        change(d.groups.get_mut("band").expect("band"));
        d
    };
    let d = change(&|g| {
        g.graph.nodes.remove("output");
        g.graph.links.pop();
    });
    told(&d, Severity::Error, "nothing comes out of the group");
    let d = change(&|g| {
        g.graph.nodes.insert("second".into(), Node::new("group/output"));
    });
    told(&d, Severity::Error, "second in group band): a group has one node for its outputs");
    let d = change(&|g| g.interface.inputs.push(GroupInput::new("x", Type::F32, Value::Number(0.0))));
    told(&d, Severity::Error, "2 inputs are named `x`");
    let d = change(&|g| g.interface.inputs.push(GroupInput::new("a b", Type::F32, Value::Number(0.0))));
    told(&d, Severity::Error, "`a b` among the inputs is no name");
    let d = change(&|g| g.interface.inputs[0].default = InputDefault::Value(Value::Vec2([0.0; 2])));
    told(&d, Severity::Error, "the input `x`: its default does not fit the type f32");
    let d = change(&|g| g.interface.inputs[1].default = InputDefault::Context("time".into()));
    told(&d, Severity::Error, "the input `uv`: the context `time` is a f32, not a vec2f");
    let mut d = banded();
    let group = d.groups.remove("band").expect("band");
    told(&d, Severity::Error, "error: a: there is no group `band` in this document");
    d.groups.insert("input".into(), group);
    told(&d, Severity::Error, "the group's id is no name");
    let mut d = banded();
    d.graph.nodes.insert("lost".into(), Node::new("group/output"));
    told(&d, Severity::Warning, "stands inside groups only");
}

#[test]
fn groups_that_hold_themselves_are_refused_by_name() {
    let mut d = banded();
    let inside = &mut d.groups.get_mut("band").expect("band").graph;
    inside.nodes.insert("again".into(), Node::new("group/band"));
    inside.links.push(link("again.out", "m.b"));
    told(&d, Severity::Error, "the group holds itself");
    assert!(matches!(flatten(&d, small()), Err(FlattenError::Recursion(ring)) if ring.groups == ["band"]));

    let mut d = banded();
    for (id, other) in [("p", "q"), ("q", "band"), ("band", "p")] {
        let mut group = Group::new(id);
        group.interface.outputs = vec![GroupOutput::new("out", Type::F32)];
        group.graph.nodes.insert("n".into(), Node::new(&format!("group/{other}")));
        group.graph.links.push(link("n.out", "output.out"));
        d.groups.insert(id.into(), group);
    }
    told(
        &d,
        Severity::Error,
        "the groups hold each other in a ring: \u{201c}band\u{201d} -> \u{201c}p\u{201d} -> \u{201c}q\u{201d} -> \u{201c}band\u{201d}",
    );
    assert!(matches!(flatten(&d, small()), Err(FlattenError::Recursion(_))));
}

#[test]
fn taken_apart_a_group_is_its_nodes() {
    let mut d = banded();
    d.graph.nodes.get_mut("a").expect("a").label = Some("First".into());
    let flat = flatten(&d, small()).expect("flat");
    let graph = &flat.document.graph;
    let ids: Vec<&str> = graph.nodes.keys().map(String::as_str).collect();
    assert_eq!(ids, ["a", "a/m", "a/output", "a/s", "b", "b/m", "b/output", "b/s", "surface"]);
    assert_eq!(graph.incoming(&socket("a/m.a")), Some(&socket("a.x")));
    assert_eq!(graph.incoming(&socket("b.x")), Some(&socket("a/output.out")));
    assert_eq!(graph.incoming(&socket("surface.perceptual_roughness")), Some(&socket("b/output.out")));
    assert_eq!(graph.nodes["a/m"].label.as_deref(), Some("First \u{203a} Mix"));
    assert_eq!(graph.nodes["b/s"].label.as_deref(), Some("Band \u{203a} Separate"));
    assert_eq!(
        find(&d, "a/m").map(|(group, id, node)| (group, id, node.node.as_str())),
        Some((Some("band"), "m", "math/mix"))
    );
    assert_eq!(find(&d, "a").map(|(group, id, _)| (group, id)), Some((None, "a")));
    assert_eq!(find(&d, "a/gone"), None);
    // A document that uses no group is itself.
    let plain = document(&[("m", "math/mix")], &[]);
    assert_eq!(flatten(&plain, small()).expect("flat").document.as_ref(), &plain);
}

/// Groups of two groups of two groups: 2^60 nodes in sixty lines.
fn doubling(levels: usize) -> Document {
    let mut d = document(&[("top", &format!("group/g{}", levels - 1))], &[("top.out", "surface.height")]);
    for level in 0..levels {
        let mut group = Group::new("");
        group.interface.outputs = vec![GroupOutput::new("out", Type::F32)];
        group.graph.nodes.insert("m".into(), Node::new("math/mix"));
        group.graph.links.push(link("m.out", "output.out"));
        if level > 0 {
            for id in ["a", "b"] {
                group.graph.nodes.insert(id.into(), Node::new(&format!("group/g{}", level - 1)));
                group.graph.links.push(link(&format!("{id}.out"), &format!("m.{id}")));
            }
        }
        d.groups.insert(format!("g{level}"), group);
    }
    d
}

#[test]
fn bombs_of_groups_are_refused_at_once() {
    let start = Instant::now();
    told(&doubling(20), Severity::Error, &format!("no driver takes a shader of more than {MAX_LIVE_NODES}"));
    assert!(matches!(flatten(&doubling(20), small()), Err(FlattenError::TooMany(n)) if n > MAX_LIVE_NODES));
    told(&doubling(60), Severity::Error, &format!("groups lie more than {MAX_GROUP_DEPTH} deep"));
    told(&doubling(MAX_GROUPS), Severity::Error, "deep in each other");
    assert_eq!(flatten(&doubling(2000), small()).err(), Some(FlattenError::TooDeep));
    assert_eq!(check(&doubling(8), small()), []);
    told(&doubling(10_000), Severity::Error, "the document has 10000 groups");
    // As many groups as are read, which all hold the next one.
    let mut wide = doubling(MAX_GROUPS);
    let last = format!("group/g{}", MAX_GROUPS - 1);
    wide.groups.get_mut("g0").expect("g0").graph.nodes.insert("r".into(), Node::new(&last));
    wide.groups.get_mut("g0").expect("g0").graph.links.push(link("r.out", "m.a"));
    told(&wide, Severity::Error, "the groups hold each other in a ring");
    // Well below a second on a quiet machine.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

proptest! {
    /// Whatever the document, nothing panics, and what has no errors is taken apart.
    #[test]
    fn any_document_is_taken_apart_or_refused(d in any_document()) {
        let sound = check(&d, small()).iter().all(|p| p.severity == Severity::Warning);
        let flat = flatten(&d, small());
        prop_assert!(flat.is_ok() || !sound);
    }
}
