//! Large and deep documents: 100,000 nodes, chains of 10,000, rings; in a second and without a deep stack.

use std::time::{Duration, Instant};

use super::{document, link, small, socket};
use crate::check::check;
use crate::document::{Document, Group, GroupInput, Interface, Link, Node, Parameter};
use crate::edit::{Edit, apply};
use crate::file::{from_json, to_json};
use crate::value::{Type, Value};
use crate::wiring::Wiring;

/// Runs on a small stack, so that recursion over the graph would overflow it, and tells the time.
fn timed<R: Send>(what: &str, work: impl FnOnce() -> R + Send) -> R {
    let (result, time) = std::thread::scope(|scope| {
        let worker = std::thread::Builder::new().stack_size(256 << 10).spawn_scoped(scope, || {
            let start = Instant::now();
            (work(), start.elapsed())
        });
        worker.expect("a thread").join().expect("no panic")
    });
    println!("{what}: {time:?}");
    // Below a second on a quiet machine. What grows with the square of the nodes takes minutes on any.
    assert!(time < Duration::from_secs(20), "{what} took {time:?}");
    result
}

/// `count` mix nodes, each fed by the one before it, the last one feeding the height.
fn chain(count: usize) -> Document {
    let mut d = document(&[], &[]);
    for i in 0..count {
        d.graph.nodes.insert(format!("n{i}"), Node::new("math/mix"));
        if i > 0 {
            d.graph.links.push(link(&format!("n{}.out", i - 1), &format!("n{i}.a")));
        }
    }
    d.graph.links.push(link(&format!("n{}.out", count - 1), "surface.height"));
    d
}

#[test]
fn a_deep_chain_is_checked_and_ordered() {
    let d = chain(10_000);
    assert_eq!(timed("checking a chain of 10,000", || check(&d, small())), []);
    let wiring = Wiring::new(&d.graph);
    let order = timed("ordering it", || wiring.order(&["surface"])).expect("no ring");
    assert_eq!(order.len(), 10_001);
    assert_eq!((order[0], order[9_999], order[10_000]), ("n0", "n9999", "surface"));
}

#[test]
fn a_wide_graph_and_its_file() {
    // Too many that reach the surface, and too many at all.
    for (count, most) in [(49_000, "no driver takes a shader of more than 20000"), (100_000, "at most 50000 are read")]
    {
        let d = chain(count);
        let problems = timed("checking a long chain", || check(&d, small()));
        assert_eq!(problems.len(), 1);
        assert!(problems[0].message.contains(most), "{}", problems[0]);
    }
    let d = chain(100_000);
    let text = timed("writing 100,000 nodes", || to_json(&d));
    let back = timed("reading them", || from_json(&text)).expect("a document");
    assert_eq!(back, d);
}

#[test]
fn rings_are_found() {
    let mut d = chain(40_000);
    d.graph.links.push(link("n39999.out", "n0.a"));
    let problems = timed("checking a ring of 40,000", || check(&d, small()));
    assert!(problems.iter().any(|p| p.message.contains("39992 more")), "{problems:?}");
    // Many small rings.
    let mut d = chain(2);
    for i in 0..20_000 {
        let (a, b) = (format!("a{i}"), format!("b{i}"));
        d.graph.nodes.extend([(a.clone(), Node::new("math/mix")), (b.clone(), Node::new("math/mix"))]);
        d.graph
            .links
            .extend([link(&format!("{a}.out"), &format!("{b}.a")), link(&format!("{b}.out"), &format!("{a}.a"))]);
    }
    let problems = timed("checking 20,000 rings", || check(&d, small()));
    assert_eq!(problems.iter().filter(|p| p.message.contains("in a ring")).count(), 10_000);
    assert!(problems.iter().any(|p| p.message.contains("10000 more errors")));
}

#[test]
fn a_hub_is_removed_and_restored() {
    let mut d = chain(2);
    for i in 0..50_000 {
        d.graph.nodes.insert(format!("x{i}"), Node::new("math/mix"));
        d.graph.links.push(link("n0.out", &format!("x{i}.a")));
    }
    let before = d.clone();
    let inverse = timed("removing a hub", || apply(&mut d, &Edit::RemoveNode { id: "n0".into() })).expect("an edit");
    timed("restoring it", || apply(&mut d, &inverse)).expect("an inverse");
    assert_eq!(d, before);
}

/// Ten thousand are told, and how many more there are.
#[test]
fn wrong_nodes_in_number_are_told_quickly() {
    let told = |node: &dyn Fn(usize) -> Node, links: &dyn Fn(usize) -> Link| {
        let mut d = document(&[], &[]);
        d.graph.nodes.extend((0..40_000).map(|i| (format!("n{i}"), node(i))));
        d.graph.links.extend((0..40_000).map(links));
        let problems = timed("checking 40,000 wrong nodes", || check(&d, small()));
        assert!((10_000..=20_002).contains(&problems.len()), "{}", problems.len());
        assert!(problems.iter().any(|p| p.message.starts_with("there are ")), "{problems:?}");
    };
    let to_one = |i: usize| link(&format!("n{i}.out"), "surface.height");
    let to_many = |i: usize| link("n0.out", &format!("surface.s{i}"));
    told(&|i| Node::new(&format!("math/mux{i}")), &to_one);
    told(&|_| Node::new("math/mix").with("c", Value::Bool(true)).with("a", Value::Number(f32::NAN)), &to_many);
    told(&|_| Node::new("surface/surface"), &to_many);
}

/// Links that lead nowhere, as many as there may be.
#[test]
fn broken_links_in_number_are_told_quickly() {
    let mut d = document(&[], &[]);
    d.graph.links.extend((0..190_000).map(|i| link(&format!("a{i}.out"), &format!("b{i}.a"))));
    let problems = timed("checking 190,000 broken links", || check(&d, small()));
    assert_eq!(problems.len(), 10_001);
    assert!(problems[10_000].message.contains("180000 more errors"), "{}", problems[10_000]);
}

/// Each kind of too much is told at once and alone, and what it is too much of.
#[test]
fn too_much_is_counted_before_anything_is_built() {
    let whole = document(&[], &[]);
    let with = |change: &dyn Fn(&mut Document)| {
        let mut d = whole.clone();
        change(&mut d);
        d
    };
    let sockets = |count: usize| Group {
        interface: Interface {
            inputs: (0..count).map(|i| GroupInput::new(&format!("i{i}"), Type::F32, Value::Number(0.0))).collect(),
            ..Interface::default()
        },
        ..Group::default()
    };
    let parameter = Parameter { name: "p".into(), label: None, socket: socket("surface.metallic"), range: None };
    for (d, words) in [
        (with(&|d| d.graph.links = vec![link("surface.out", "surface.out"); 200_001]), "200001 links; at most 200000"),
        (
            with(&|d| d.groups.extend((0..1001).map(|i| (format!("g{i}"), Group::default())))),
            "1001 groups; at most 1000",
        ),
        (
            with(&|d| d.functions.extend((0..257).map(|i| (format!("f{i}"), String::new())))),
            "257 functions; at most 256",
        ),
        (with(&|d| d.parameters = vec![parameter.clone(); 1025]), "1025 parameters; at most 1024"),
        (with(&|d| drop(d.groups.insert("g".into(), sockets(129)))), "129 inputs; at most 128"),
    ] {
        let problems = timed("counting", || check(&d, small()));
        assert!(problems.len() == 1 && problems[0].message.contains(words), "{words}: {problems:?}");
    }
}
