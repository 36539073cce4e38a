//! Values on cards: what is dragged and written there.

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::{Node, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::value::Value;

use super::hands::*;
use super::open;

fn window() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    window
}

fn value(window: &Window, node: &str, input: &str) -> Option<Value> {
    document(window).graph.value(&SocketRef::new(node, input)).cloned()
}

#[test]
fn a_drag_on_a_card_keeps_to_the_range() {
    let mut window = window();
    let at = center(&window, "Value metallic of Surface");
    drag(&mut window, at, at + egui::vec2(600.0, 0.0));
    assert_eq!(value(&window, "surface", "metallic"), Some(Value::Number(1.0)));
    drag(&mut window, at, at - egui::vec2(900.0, 0.0));
    assert_eq!(value(&window, "surface", "metallic"), Some(Value::Number(0.0)));
    // What was written beyond it stays until it is dragged back.
    let edit = Edit::SetValue { socket: SocketRef::new("surface", "metallic"), value: Some(Value::Number(3.0)) };
    window.state_mut().act(Action::edit("Set", edit));
    window.run_steps(2);
    drag(&mut window, at, at + egui::vec2(100.0, 0.0));
    assert_eq!(value(&window, "surface", "metallic"), Some(Value::Number(3.0)));
    drag(&mut window, at, at - egui::vec2(10.0, 0.0));
    let Some(Value::Number(metallic)) = value(&window, "surface", "metallic") else { panic!("a number") };
    assert!((2.9..3.0).contains(&metallic), "{metallic}");
}

#[test]
fn a_vector_that_is_written_keeps_its_other_components() {
    let mut window = window();
    let node = Node::new("vector/dot").with("a", Value::Vec3([0.123_456_7, 2.0, 1.0e-5]));
    let edits = vec![
        Edit::AddNode { id: "dot".into(), node },
        Edit::MoveNode { id: "dot".into(), position: Some([-300.0, 400.0]) },
    ];
    window.state_mut().act(Action::edit("Add", Edit::Many(edits)));
    window.state_mut().act(Action::Show("dot".into()));
    window.run_steps(3);
    window.get_by_label_contains("Value a of Dot").click();
    window.run_steps(3);
    // The second number alone is written anew.
    key(&mut window, egui::Modifiers::NONE, egui::Key::Home);
    let comma = "0.1234567, ".len();
    (0..comma).for_each(|_| key(&mut window, egui::Modifiers::NONE, egui::Key::ArrowRight));
    key(&mut window, egui::Modifiers::NONE, egui::Key::Delete);
    write(&mut window, "7");
    key(&mut window, egui::Modifiers::NONE, egui::Key::Enter);
    assert_eq!(value(&window, "dot", "a"), Some(Value::Vec3([0.123_456_7, 7.0, 1.0e-5])));
}

#[test]
fn a_drag_that_is_given_up_leaves_no_trace() {
    let mut window = window();
    window.state_mut().act(Action::edit("Rename", Edit::SetName { name: "one".into() }));
    window.state_mut().act(Action::Undo);
    window.step();
    let at = center(&window, "Value metallic of Surface");
    hold(&mut window, at, at + egui::vec2(20.0, 0.0));
    key(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    press(&mut window, at, false, egui::Modifiers::NONE);
    window.run_steps(2);
    assert_eq!(value(&window, "surface", "metallic"), None);
    // What could be done again can be.
    assert_eq!(window.state().session().steps(), [None, Some("Rename")]);
}
