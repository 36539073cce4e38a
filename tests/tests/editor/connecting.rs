//! Wires by keys alone.

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Options, egui};

use super::hands::*;
use super::open;

const NONE: egui::Modifiers = egui::Modifiers::NONE;

/// The graph has the focus, and the pointer is far away.
fn by_keys() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    window.get_by_label("Graph canvas").focus();
    window.remove_cursor();
    window.run_steps(2);
    window
}

#[test]
fn two_nodes_are_connected_by_keys() {
    let mut window = by_keys();
    let before = text(&window);
    // To the first node, and from it to the surface.
    key(&mut window, NONE, egui::Key::Tab);
    key(&mut window, NONE, egui::Key::C);
    write(&mut window, "metallic");
    key(&mut window, NONE, egui::Key::Enter);
    assert_eq!(source(&window, "surface", "metallic").as_deref(), Some("chips.out"));
    assert_eq!(window.state().session().steps()[0], Some("Connect"));
    assert!(window.get_by_label("Graph canvas").is_focused());
    // The same wire is taken away again.
    key(&mut window, NONE, egui::Key::C);
    write(&mut window, "metallic");
    key(&mut window, NONE, egui::Key::Enter);
    assert_eq!(source(&window, "surface", "metallic"), None);
    // From the other end: an input of the node gets what another one gives.
    window.state_mut().act(Action::Select(vec!["surface".into()]));
    window.step();
    key(&mut window, NONE, egui::Key::C);
    write(&mut window, "ior: from rust grain");
    key(&mut window, NONE, egui::Key::Enter);
    assert_eq!(source(&window, "surface", "ior").as_deref(), Some("grain.out"));
    undo_all(&mut window);
    assert_eq!(text(&window), before);
}

#[test]
fn what_does_not_fit_is_not_offered_and_escape_changes_nothing() {
    let mut window = by_keys();
    let before = text(&window);
    window.state_mut().act(Action::Select(vec!["base_color".into()]));
    window.step();
    key(&mut window, NONE, egui::Key::C);
    let offered = |window: &Window, text: &str| window.query_all_by_label_contains(text).next().is_some();
    assert!(offered(&window, "to emission of Surface"));
    assert!(!offered(&window, "to metallic of Surface"), "a colour is no number");
    assert!(!offered(&window, "t: from Surface"), "that would be a ring");
    key(&mut window, NONE, egui::Key::ArrowDown);
    key(&mut window, NONE, egui::Key::Escape);
    assert_eq!(text(&window), before);
    assert!(window.query_by_label("Search connections").is_none());
    // Of two selected nodes what can be among them.
    window.state_mut().act(Action::Select(vec!["grain".into(), "surface".into()]));
    window.step();
    key(&mut window, NONE, egui::Key::C);
    assert!(offered(&window, "to metallic of Surface"));
    assert!(!offered(&window, "of Rust, dark and light"));
}

#[test]
fn the_list_begins_with_what_needs_no_conversion_and_is_near_and_ends_with_what_is_there() {
    let mut window = by_keys();
    window.state_mut().act(Action::Select(vec!["base_color".into()]));
    window.step();
    key(&mut window, NONE, egui::Key::C);
    window.run_steps(2);
    let height = |window: &Window, text: &str| {
        let found = window.query_all_by_label_contains(text).map(|line| line.rect().top()).reduce(f32::min);
        found.unwrap_or_else(|| panic!("{text} is not offered"))
    };
    let wired = source(&window, "surface", "base_color");
    assert_eq!(wired.as_deref(), Some("base_color.out"));
    write(&mut window, "surface");
    // Words find the same lines in the order of how well they fit, so that the order is looked at without words.
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::A);
    window.key_press(egui::Key::Backspace);
    window.run_steps(2);
    let colour = height(&window, "to emission of Surface");
    let vector = height(&window, "to normal of Surface");
    assert!(colour.is_finite() && vector.is_finite());
    // A number becomes a colour on its way; a colour goes as it is.
    let (own, converted) = (height(&window, "a: from Enamel"), height(&window, "from Rust grain"));
    assert!(own < converted, "{own} {converted}");
    // Enter makes the first one.
    let before = document(&window).graph.links.len();
    key(&mut window, NONE, egui::Key::Enter);
    assert_ne!(document(&window).graph.links.len(), before + 2);
    key(&mut window, NONE, egui::Key::C);
    window.run_steps(2);
    key(&mut window, NONE, egui::Key::PageDown);
    let there = window.query_all_by_label_contains("(take away)").map(|line| line.rect().top()).collect::<Vec<_>>();
    let others = window.query_all_by_label_contains("to emission of Surface").map(|line| line.rect().top());
    let others: Vec<f32> = others.collect();
    assert!(there.iter().all(|top| others.iter().all(|other| other < top)), "{there:?}");
}

#[test]
fn with_nothing_selected_it_says_what_to_do() {
    let mut window = by_keys();
    for (pressed, words) in [
        (egui::Key::C, "Select a node to connect it. Tab goes from one to the next."),
        (egui::Key::F2, "Select one node, frame or comment to name it."),
        (egui::Key::Enter, "Select a node to go on from."),
    ] {
        key(&mut window, NONE, pressed);
        assert!(window.query_all_by_label_contains(words).next().is_some(), "{words}");
    }
    key(&mut window, egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT), egui::Key::G);
    assert!(window.query_all_by_label_contains("No group is selected").next().is_some());
}

#[test]
fn it_stands_in_the_menu_and_in_the_sheet_of_keys() {
    let mut window = by_keys();
    window.get_by_label("Node Rust grain").click();
    window.run_steps(2);
    window.get_by_label("Edit").click();
    window.run_steps(2);
    window.get_by_label("Connect… C").click();
    window.run_steps(3);
    assert!(window.query_by_label("Search connections").is_some());
    key(&mut window, NONE, egui::Key::Escape);
    key(&mut window, NONE, egui::Key::F1);
    assert!(window.query_by_label("Connect the selected node with another one, by words").is_some());
}

#[test]
fn a_press_on_a_socket_by_a_screen_reader_offers_what_it_can_be_connected_with() {
    let mut window = by_keys();
    window.get_by_label("Output out of Rust grain").click_accesskit();
    window.run_steps(3);
    write(&mut window, "metallic");
    key(&mut window, NONE, egui::Key::Enter);
    assert_eq!(source(&window, "surface", "metallic").as_deref(), Some("grain.out"));
}
