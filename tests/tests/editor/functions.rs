//! A material's own WGSL: written, renamed and removed in the window, with the last good shader in sight while it is wrong.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_graph::document::{Document, Link, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::to_json;

use egui::accesskit::Role;

use super::hands::write_into;
use super::{open, settle};

type Window = Harness<'static, Editor>;

fn document(window: &Window) -> &Document {
    window.state().session().document()
}

/// A window whose material has a new function, made in the palette and wired to the roughness.
fn with_function() -> Window {
    let mut window = open(Options::default());
    settle(&mut window);
    let graph = window.get_by_label("Graph canvas").rect();
    window.hover_at(graph.left_bottom() + egui::vec2(40.0, -40.0));
    window.step();
    window.key_press(egui::Key::Space);
    window.run_steps(2);
    window.event(egui::Event::Text("new function".to_owned()));
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    window.run_steps(3);
    let link = Link::new(SocketRef::new("new_function", "out"), SocketRef::new("surface", "emission"));
    window.state_mut().act(Action::edit("Link", Edit::AddLink { link }));
    settle(&mut window);
    window
}

/// Puts the cursor behind a word of the text, which must stand there once, and writes.
fn write_behind(window: &mut Window, function: &str, word: &str, text: &str) {
    let label = format!("WGSL of {function}");
    let whole = document(window).functions[function].clone();
    let at = whole.find(word).expect("the word") + word.len();
    let field = window.get_by_role_and_label(Role::TextInput, &label);
    field.focus();
    window.run_steps(2);
    let control = egui::Modifiers { ctrl: true, ..egui::Modifiers::COMMAND };
    window.key_press_modifiers(control, egui::Key::Home);
    window.step();
    for _ in 0..whole[..at].chars().count() {
        window.key_press(egui::Key::ArrowRight);
    }
    window.step();
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(2);
}

#[test]
fn a_function_is_written_and_a_mistake_keeps_the_last_good_shader() {
    let mut window = with_function();
    assert_eq!(document(&window).graph.nodes["new_function"].node, "custom/new_function");
    assert!(window.state().session().problems().is_empty(), "{:?}", window.state().session().problems());
    let good = document(&window).functions["new_function"].clone();

    write_behind(&mut window, "new_function", "return mix", "ed");
    settle(&mut window);
    assert!(document(&window).functions["new_function"].contains("return mixed(a, b, t)"));
    let line = good.lines().position(|line| line.contains("return")).unwrap() + 1;
    assert!(window.query_by_label_contains(&format!("Line {line}, column")).is_some());
    // The code stays, and says that it is older.
    window.get_by_role_and_label(Role::Button, "Code").click();
    settle(&mut window);
    assert!(window.query_by_label_contains("As it was before").is_some());
    assert!(window.query_by_label("Line 1").is_some());
    // The node keeps its sockets.
    assert!(window.query_by_label("Output out of New Function").is_some());
    // The problem leads to the text.
    window.get_by_label_contains("Problems").click();
    window.run_steps(3);
    window.get_by_label("new_function").click();
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::TextInput, "WGSL of new_function").is_some());

    window.state_mut().act(Action::Undo);
    settle(&mut window);
    assert_eq!(document(&window).functions["new_function"], good);
    assert!(window.state().session().problems().is_empty());
    assert!(window.query_by_label_contains("column").is_none());
}

#[test]
fn a_function_is_renamed_in_use_and_removed_when_nothing_uses_it() {
    let mut window = with_function();
    let before = to_json(document(&window));
    let write_name = |window: &mut Window, from: &str, to: &str| {
        let label = "Name of the function";
        assert_eq!(window.get_by_role_and_label(Role::TextInput, label).value().as_deref(), Some(from));
        write_into(window, label, to);
    };
    write_name(&mut window, "new_function", "Two words");
    assert!(window.query_by_label_contains("is no name of a function").is_some());
    write_name(&mut window, "new_function", "blend_it");
    let now = document(&window);
    assert_eq!(now.graph.nodes["new_function"].node, "custom/blend_it");
    assert!(now.functions["blend_it"].contains("@node custom/blend_it"));
    assert!(window.state().session().problems().is_empty(), "{:?}", window.state().session().problems());
    window.state_mut().act(Action::Undo);
    window.run_steps(2);
    assert_eq!(to_json(document(&window)), before);

    // In use it cannot be removed.
    window.get_by_role_and_label(Role::Button, "Remove").click();
    window.run_steps(2);
    assert_eq!(to_json(document(&window)), before);
    let edit = Edit::RemoveNode { id: "new_function".to_owned() };
    window.state_mut().act(Action::edit("Delete", edit));
    window.run_steps(2);
    window.get_by_role_and_label(Role::Button, "Remove").click();
    window.run_steps(3);
    assert!(document(&window).functions.is_empty());
    assert!(window.query_by_label("Nodes of your own, in WGSL").is_some());
    while window.state().session().steps()[0].is_some() {
        window.state_mut().act(Action::Undo);
    }
    assert!(!window.state().session().is_unsaved());
}
