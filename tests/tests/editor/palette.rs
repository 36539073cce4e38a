//! The palette: what is searched for comes first, and the keys are enough.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Editor, Options, egui};

use super::open;

type Window = Harness<'static, Editor>;

/// A window with the palette open.
fn window() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    open_palette(&mut window);
    window
}

fn open_palette(window: &mut Window) {
    let graph = window.get_by_label("Graph canvas").rect();
    window.hover_at(graph.left_bottom() + egui::vec2(40.0, -40.0));
    window.step();
    key(window, egui::Key::Space);
    assert!(window.query_by_label("Search nodes").is_some());
}

fn key(window: &mut Window, key: egui::Key) {
    window.key_press(key);
    window.run_steps(2);
}

/// What the first row of a search adds.
fn first(window: &mut Window, words: &str) -> String {
    window.event(egui::Event::Text(words.to_owned()));
    window.run_steps(2);
    key(window, egui::Key::Enter);
    let id = window.state().session().selection().first().expect("a node was added").clone();
    window.state().session().document().graph.nodes[&id].node.clone()
}

#[test]
fn a_search_ranks_labels_before_synonyms_before_help() {
    for (words, wanted) in [
        ("mix", "math/mix"),
        ("lerp", "math/mix"),
        ("kelvin", "color/blackbody"),
        ("absol", "math/abs"),
        ("smothstep", "math/smoothstep"),
    ] {
        let mut window = window();
        assert_eq!(first(&mut window, words), wanted, "{words}");
    }
}

#[test]
fn categories_unfold_by_keys_and_what_was_used_comes_first() {
    let mut window = window();
    assert_eq!(window.query_all_by_label("Absolute").count(), 0);
    while window.query_all_by_label("Absolute").count() == 0 {
        key(&mut window, egui::Key::ArrowRight);
        key(&mut window, egui::Key::ArrowDown);
    }
    key(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("Search nodes").is_none());
    open_palette(&mut window);
    assert_eq!(first(&mut window, "kelvin"), "color/blackbody");
    open_palette(&mut window);
    assert!(window.query_by_label("Recently used").is_some());
    key(&mut window, egui::Key::Enter);
    let nodes = &window.state().session().document().graph.nodes;
    assert_eq!(nodes.values().filter(|node| node.node == "color/blackbody").count(), 2);
}

#[test]
fn a_search_without_a_result_adds_nothing() {
    let mut window = window();
    let before = window.state().session().document().clone();
    window.event(egui::Event::Text("no such node anywhere".into()));
    window.run_steps(2);
    assert!(window.query_by_label_contains("No node is called that").is_some());
    key(&mut window, egui::Key::Enter);
    assert_eq!(**window.state().session().document(), *before);
}
