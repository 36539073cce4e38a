//! The graphs of the materials that come with the program can be read: no wire runs behind a card, no card lies on another one. And
//! arranging makes such graphs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::{Comment, Document, Frame, Link, Node, Rect, SocketRef};
use halfvector_graph::file::{from_json, to_json};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

use super::hands::*;
use super::open;

fn materials() -> Vec<(PathBuf, Document)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let files = ["editor/library", "examples"].map(|folder| std::fs::read_dir(root.join(folder)).expect("a folder"));
    let files = files.into_iter().flatten().flatten().map(|file| file.path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.to_string_lossy().ends_with(".material.json")).collect();
    files.sort();
    // An instance has no graph of its own.
    let read = |path: PathBuf| Some((path.clone(), from_json(&std::fs::read_to_string(&path).expect("text")).ok()?));
    files.into_iter().filter_map(read).collect()
}

fn window() -> Window {
    let mut window = open(Options { without_gpu: true, ..Options::default() });
    window.set_size(egui::vec2(2400.0, 1800.0));
    window
}

fn show(window: &mut Window, document: Document) {
    window.state_mut().act(Action::NewFrom(Arc::new(document)));
    window.run_steps(3);
}

/// Presses the key that arranges all.
fn arrange(window: &mut Window) {
    let at = empty_place(window);
    go(window, at);
    key(window, egui::Modifiers::NONE, egui::Key::L);
}

/// With `REARRANGE` set the files are written anew.
#[test]
fn in_what_is_shipped_no_wire_runs_behind_a_card() {
    let mut window = window();
    let mut wrong = Vec::new();
    for (path, document) in materials() {
        show(&mut window, document);
        let tangles = window.state().tangles();
        if !tangles.is_empty() {
            if std::env::var_os("REARRANGE").is_some() {
                arrange(&mut window);
                std::fs::write(&path, text(&window)).expect("written");
                undo_all(&mut window);
            }
            wrong.push(format!("{}: {}", path.display(), tangles.join(", ")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn arranging_what_is_shipped_takes_wires_out_from_behind_cards_and_changes_nothing_twice() {
    let mut window = window();
    let mut wrong = Vec::new();
    for (path, document) in materials() {
        show(&mut window, document);
        arrange(&mut window);
        let (once, tangles) = (text(&window), window.state().tangles());
        if !tangles.is_empty() {
            wrong.push(format!("{}: {}", path.display(), tangles.join(", ")));
        }
        let steps = window.state().session().parts_of_undo();
        arrange(&mut window);
        assert_eq!(text(&window), once, "{}", path.display());
        assert_eq!(window.state().session().parts_of_undo(), steps, "nothing to undo");
        undo_all(&mut window);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const KINDS: [&str; 5] = ["math/mix", "procedural/fbm_3d", "color/ramp2", "vector/separate", "utility/reroute"];

/// Nodes, wires, frames and comments anywhere.
fn any_graph() -> impl Strategy<Value = Document> {
    let node = (0..KINDS.len(), -900.0..900.0_f32, -900.0..900.0_f32);
    let rect = (-900.0..900.0_f32, -900.0..900.0_f32, 40.0..700.0_f32, 40.0..500.0_f32);
    let rect = rect.prop_map(|(x, y, width, height)| Rect { position: [x, y], size: [width, height] });
    let wire = (0..12usize, 0..12usize, 0..3usize);
    let nodes = prop::collection::vec(node, 1..12);
    let rects = || prop::collection::vec(rect.clone(), 0..5);
    (nodes, prop::collection::vec(wire, 0..16), rects(), rects()).prop_map(|(nodes, wires, frames, comments)| {
        let mut document = Document::new("Any");
        let graph = &mut document.graph;
        for (i, (kind, x, y)) in nodes.iter().enumerate() {
            graph.nodes.insert(format!("n{i}"), Node::new(KINDS[*kind]));
            graph.layout.insert(format!("n{i}"), [*x, *y]);
        }
        for (from, to, input) in wires {
            let (from, to) = (from % nodes.len(), to % nodes.len());
            let input = match KINDS[nodes[to].0] {
                "math/mix" => ["a", "b", "t"][input],
                "color/ramp2" => "t",
                "utility/reroute" => "value",
                _ => "scale",
            };
            let from = SocketRef::new(
                &format!("n{from}"),
                if KINDS[nodes[from].0] == "vector/separate" { "x" } else { "out" },
            );
            graph.links.push(Link::new(from, SocketRef::new(&format!("n{to}"), input)));
        }
        for (i, rect) in frames.into_iter().enumerate() {
            graph.frames.insert(format!("f{i}"), Frame { title: "F".into(), rect, ..Frame::default() });
        }
        for (i, rect) in comments.into_iter().enumerate() {
            graph.comments.insert(format!("c{i}"), Comment { text: "C".into(), rect, ..Comment::default() });
        }
        document
    })
}

/// Whatever lies anywhere: arranged once, cards lie apart, and arranging again changes nothing.
#[test]
fn arranging_twice_is_arranging_once() {
    let mut window = window();
    let strategy = any_graph();
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    for _ in 0..cases() {
        let document = strategy.new_tree(&mut runner).expect("a graph").current();
        show(&mut window, document.clone());
        arrange(&mut window);
        let once = text(&window);
        let on: Vec<String> = window.state().tangles().into_iter().filter(|what| what.contains(" on ")).collect();
        assert!(on.is_empty(), "{}\n{on:?}", to_json(&document));
        arrange(&mut window);
        assert_eq!(text(&window), once, "{}", to_json(&document));
    }
}

fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(40)
}
