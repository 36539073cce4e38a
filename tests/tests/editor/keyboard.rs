//! Without the pointer: a material from nothing by keys alone, and what screen readers press.

use egui_kittest::kittest::{NodeT, Queryable};
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::check::{Severity, check};
use halfvector_graph::document::{Comment, Frame, Rect, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::library::Library;
use halfvector_graph::value::Value;

use super::hands::*;
use super::{open, settle};

const NONE: egui::Modifiers = egui::Modifiers::NONE;
const CTRL: egui::Modifiers = egui::Modifiers::COMMAND;

/// The graph has the focus, and there is no pointer.
fn by_keys() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    window.remove_cursor();
    key(&mut window, CTRL, egui::Key::Num1);
    assert!(window.get_by_label("Graph canvas").is_focused());
    window
}

/// Opens a list with a key, writes into it and takes what is found first.
fn find(window: &mut Window, opens: egui::Key, words: &str) {
    key(window, NONE, opens);
    window.run_steps(2);
    write(window, words);
    key(window, NONE, egui::Key::Enter);
    window.run_steps(2);
}

fn selected(window: &Window) -> Vec<String> {
    window.state().session().selection().iter().cloned().collect()
}

/// The label of the control that has the focus.
fn focused(window: &Window) -> String {
    let labels = window.query_all_by(|node| node.is_focused()).map(|node| format!("{:?}", node)).collect::<Vec<_>>();
    labels.join("; ")
}

/// Goes on by Tab until a control of the inspector has the focus.
fn tab_to(window: &mut Window, label: &str) {
    for _ in 0..200 {
        // A menu's entry has its key behind its name.
        let is_it = |node: &egui_kittest::Node<'_>| {
            node.accesskit_node().label().is_some_and(|its| its == label || its.trim_end() == label)
        };
        let is_there = window.query_all_by(|node| node.is_focused()).any(|node| is_it(&node));
        if is_there {
            return;
        }
        key(window, NONE, egui::Key::Tab);
    }
    panic!("no Tab leads to {label}: {}", focused(window));
}

#[test]
fn a_material_is_made_from_nothing_by_keys_alone() {
    let mut window = by_keys();
    key(&mut window, CTRL, egui::Key::A);
    key(&mut window, NONE, egui::Key::Delete);
    assert!(document(&window).graph.nodes.is_empty());
    let empty = text(&window);

    find(&mut window, egui::Key::Space, "surface");
    let surface = selected(&window)[0].clone();
    assert_eq!(document(&window).graph.nodes[&surface].node, "surface/surface");
    find(&mut window, egui::Key::Space, "checker");
    let checker = selected(&window)[0].clone();
    let find_in = |words: &str, window: &mut Window| find(window, egui::Key::C, words);
    find_in("base color of surface", &mut window);
    assert!(source(&window, &surface, "base_color").is_some(), "{}", text(&window));
    // What is new does not lie on what is there.
    let layout = &document(&window).graph.layout;
    assert_ne!(layout[&checker], layout[&surface]);

    // Its values, in the inspector.
    window.state_mut().act(Action::Select(vec![surface.clone()]));
    window.run_steps(2);
    key(&mut window, CTRL, egui::Key::Num3);
    window.run_steps(3);
    assert!(!window.get_by_label("Graph canvas").is_focused());
    tab_to(&mut window, "metallic");
    // The slider has come first; behind it the number.
    key(&mut window, NONE, egui::Key::Tab);
    key(&mut window, CTRL, egui::Key::A);
    write(&mut window, "0,75");
    key(&mut window, NONE, egui::Key::Enter);
    window.run_steps(2);
    let metallic = SocketRef::new(&surface, "metallic");
    assert_eq!(document(&window).graph.value(&metallic), Some(&Value::Number(0.75)));

    // Back to the graph: a name, a frame around it, a comment by the menu, all in columns.
    key(&mut window, CTRL, egui::Key::Num1);
    assert!(window.get_by_label("Graph canvas").is_focused());
    key(&mut window, NONE, egui::Key::F2);
    window.run_steps(2);
    key(&mut window, CTRL, egui::Key::A);
    write(&mut window, "Board");
    key(&mut window, NONE, egui::Key::Enter);
    window.run_steps(2);
    assert_eq!(document(&window).graph.nodes[&surface].label.as_deref(), Some("Board"));
    key(&mut window, CTRL, egui::Key::J);
    assert_eq!(document(&window).graph.frames.len(), 1);
    key(&mut window, NONE, egui::Key::F10);
    key(&mut window, NONE, egui::Key::Tab);
    key(&mut window, NONE, egui::Key::Enter);
    window.run_steps(3);
    tab_to(&mut window, "Add comment");
    key(&mut window, NONE, egui::Key::Enter);
    window.run_steps(3);
    assert_eq!(document(&window).graph.comments.len(), 1, "{}", focused(&window));
    key(&mut window, CTRL, egui::Key::Num1);
    key(&mut window, NONE, egui::Key::L);
    settle(&mut window);
    let errors = check(document(&window), Library::standard());
    let errors: Vec<_> = errors.into_iter().filter(|problem| problem.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:?}");
    assert!(window.state().drawn_by().is_some());

    while text(&window) != empty {
        key(&mut window, CTRL, egui::Key::Z);
    }
}

#[test]
fn tab_goes_through_frames_and_comments_too() {
    let mut window = by_keys();
    let rect = |position| Rect { position, size: [300.0, 200.0] };
    let frame = Frame { title: "Far".into(), rect: rect([-5000.0, 0.0]), ..Frame::default() };
    let comment = Comment { text: "Last".into(), rect: rect([9000.0, 0.0]), ..Comment::default() };
    let edits = vec![Edit::AddFrame { id: "far".into(), frame }, Edit::AddComment { id: "last".into(), comment }];
    window.state_mut().act(Action::edit("Notes", Edit::Many(edits)));
    window.run_steps(2);
    // The first from the left is the frame: what is chosen is seen, and the keys are for it.
    key(&mut window, NONE, egui::Key::Tab);
    window.run_steps(2);
    let canvas = window.get_by_label("Graph canvas").rect();
    assert!(canvas.contains(window.get_by_label("Frame Far").rect().center()));
    key(&mut window, NONE, egui::Key::ArrowDown);
    assert_eq!(document(&window).graph.frames["far"].rect.position, [-5000.0, 20.0]);
    let nodes = document(&window).graph.nodes.len();
    for _ in 0..nodes {
        key(&mut window, NONE, egui::Key::Tab);
        assert_eq!(selected(&window).len(), 1);
    }
    key(&mut window, NONE, egui::Key::Tab);
    assert!(selected(&window).is_empty());
    key(&mut window, NONE, egui::Key::Delete);
    assert!(document(&window).graph.comments.is_empty(), "the comment was chosen last");
    assert_eq!(document(&window).graph.nodes.len(), nodes);
    // And back again, from the end.
    key(&mut window, egui::Modifiers::SHIFT, egui::Key::Tab);
    assert_eq!(selected(&window).len(), 1);
}

#[test]
fn screen_readers_choose_notes_and_open_values_and_pictures() {
    let mut window = by_keys();
    let rect = Rect { position: [-200.0, -300.0], size: [300.0, 200.0] };
    let comment = Comment { text: "Why".into(), rect, ..Comment::default() };
    window.state_mut().act(Action::edit("Note", Edit::AddComment { id: "why".into(), comment }));
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::Home);
    window.run_steps(2);
    window.get_by_label("Comment Why").click_accesskit();
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::Delete);
    assert!(document(&window).graph.comments.is_empty());
    window.get_by_label("Picture of Rust grain").click_accesskit();
    window.run_steps(3);
    let state = window.get_by_label("Picture of Rust grain");
    assert_eq!(state.accesskit_node().is_selected(), Some(true));
    let value = "Value scale of Rust grain";
    window.get_by_label(value).click_accesskit();
    window.run_steps(3);
    key(&mut window, CTRL, egui::Key::A);
    write(&mut window, "7");
    key(&mut window, NONE, egui::Key::Enter);
    window.run_steps(2);
    assert_eq!(document(&window).graph.value(&SocketRef::new("grain", "scale")), Some(&Value::Number(7.0)));
}
