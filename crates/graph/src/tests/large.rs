//! Large and deep documents: 100,000 nodes, chains of 10,000, rings; in a second and without a deep stack.

use std::time::{Duration, Instant};

use super::{document, link, small};
use crate::check::check;
use crate::document::{Document, Node};
use crate::edit::{Edit, apply};
use crate::file::{from_json, to_json};
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
    let d = chain(100_000);
    let problems = timed("checking 100,000 nodes", || check(&d, small()));
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.contains("20000"), "{}", problems[0]);
    let text = timed("writing them", || to_json(&d));
    let back = timed("reading them", || from_json(&text)).expect("a document");
    assert_eq!(back, d);
}

#[test]
fn rings_are_found() {
    let mut d = chain(50_000);
    d.graph.links.push(link("n49999.out", "n0.a"));
    let problems = timed("checking a ring of 50,000", || check(&d, small()));
    assert!(problems.iter().any(|p| p.message.contains("49992 more")), "{problems:?}");
    // Many small rings.
    let mut d = chain(2);
    for i in 0..25_000 {
        let (a, b) = (format!("a{i}"), format!("b{i}"));
        d.graph.nodes.extend([(a.clone(), Node::new("math/mix")), (b.clone(), Node::new("math/mix"))]);
        d.graph
            .links
            .extend([link(&format!("{a}.out"), &format!("{b}.a")), link(&format!("{b}.out"), &format!("{a}.a"))]);
    }
    let problems = timed("checking 25,000 rings", || check(&d, small()));
    assert_eq!(problems.iter().filter(|p| p.message.contains("in a ring")).count(), 25_000);
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

#[test]
fn unknown_nodes_in_number_are_told_quickly() {
    let mut d = document(&[], &[]);
    d.graph.nodes.extend((0..100_000).map(|i| (format!("n{i}"), Node::new(&format!("math/mux{i}")))));
    assert!(timed("checking 100,000 unknown nodes", || check(&d, small())).len() >= 100_000);
}
