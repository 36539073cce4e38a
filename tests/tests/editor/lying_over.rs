//! What lies over the graph for a while: menus, dialogs, the sheet of keys, and words beside the pointer.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};

use egui::accesskit::Role;

use super::hands::*;
use super::{open, settle};

const NONE: egui::Modifiers = egui::Modifiers::NONE;

fn secondary(window: &mut Window, pos: egui::Pos2) {
    go(window, pos);
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: NONE });
        window.step();
    }
    window.run_steps(2);
}

/// Escape closes what is open and does nothing else, the pointer over the graph.
fn escape_closes(window: &mut Window, what: &str) {
    let selection = window.state().session().selection().clone();
    let is_open = |window: &Window| window.query_all_by_label_contains(what).next().is_some();
    assert!(is_open(window), "{what} is not open");
    key(window, NONE, egui::Key::Escape);
    window.run_steps(2);
    assert!(!is_open(window), "Escape leaves {what} open");
    assert_eq!(*window.state().session().selection(), selection, "Escape closes {what} and takes the selection");
}

#[test]
fn escape_closes_menus_and_dialogs_before_the_graph_takes_it() {
    for selected in [Vec::new(), vec!["surface".to_owned()]] {
        let mut window = open(Options::default());
        window.run_steps(3);
        window.state_mut().act(Action::Select(selected));
        let at = empty_place(&window);
        secondary(&mut window, at);
        escape_closes(&mut window, "Select all");
        let [from, to] =
            ["Output out of Where the enamel is gone", "Input x of Enamel is left"].map(|it| center(&window, it));
        secondary(&mut window, from + (to - from) * 0.5);
        escape_closes(&mut window, "Insert");
        let at = center(&window, "Node Surface");
        secondary(&mut window, at);
        escape_closes(&mut window, "Disconnect");
        for menu in ["File", "Edit", "Mesh"] {
            window.get_by_role_and_label(Role::Button, menu).click();
            window.run_steps(2);
            let at = empty_place(&window);
            go(&mut window, at);
            let selection = window.state().session().selection().clone();
            key(&mut window, NONE, egui::Key::Escape);
            window.run_steps(2);
            assert!(!egui::Popup::is_any_open(&window.ctx), "Escape leaves {menu} open");
            assert_eq!(*window.state().session().selection(), selection, "{menu}");
        }
        window.get_by_label("Graph canvas").focus();
        key(&mut window, NONE, egui::Key::F1);
        window.run_steps(2);
        escape_closes(&mut window, "Go to the inspector");
        go(&mut window, at);
        key(&mut window, NONE, egui::Key::Space);
        window.run_steps(2);
        escape_closes(&mut window, "Search nodes");
    }
}

#[test]
fn the_sheet_of_keys_keeps_its_columns() {
    for size in [[1280.0, 720.0], [1440.0, 900.0]] {
        let mut window: Window = Harness::builder()
            .with_size(size)
            .build_eframe(|context| Editor::new(&context.egui_ctx, Options::default()));
        window.run_steps(3);
        key(&mut window, NONE, egui::Key::F1);
        window.run_steps(3);
        let place = |window: &Window, label: &str| window.get_by_label(label).rect();
        // Of both columns a row of each list: all descriptions of a column begin at the same place, and none reaches the next one.
        let left = ["Go to the inspector: the values of what is selected", "Undo", "Next or previous control"];
        let right = [
            "Make a group, take it apart",
            "Connect the selected node with another one, by words",
            "Nearer or farther",
        ];
        let [left, right] = [left, right].map(|labels| labels.map(|label| place(&window, label)));
        for rects in [left, right] {
            assert!(rects.iter().all(|rect| (rect.left() - rects[0].left()).abs() < 0.5), "{size:?}: {rects:?}");
            assert!(rects.iter().all(|rect| rect.right() < size[0]), "{size:?}: {rects:?}");
        }
        let keys = place(&window, "Ctrl+G, Ctrl+Shift+G");
        assert!(left.iter().all(|rect| rect.right() < keys.left()), "{size:?}: {left:?} {keys:?}");
        assert!(right.iter().all(|rect| rect.left() > keys.right()), "{size:?}: {right:?} {keys:?}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_told_in_the_window_and_not_written_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("broken.material.json");
    std::fs::write(&path, "{\"halfvector\": 1,").expect("written");
    let mut window = open(Options { document: Some(path.clone()), ..Options::default() });
    settle(&mut window);
    assert!(window.query_by_label("The file cannot be opened").is_some());
    assert!(window.query_all_by_label_contains("broken.material.json").next().is_some());
    assert_eq!(window.state().session().file(), None);
    // Once it is mended it is opened.
    std::fs::write(&path, halfvector_editor::START_MATERIAL).expect("written");
    window.get_by_label("Try again").click();
    settle(&mut window);
    assert!(window.query_by_label("The file cannot be opened").is_none());
    assert_eq!(window.state().session().file(), Some(path.as_path()));
}

#[test]
fn a_node_dropped_on_a_wire_that_it_does_not_fit_says_why() {
    let mut window = open(Options::default());
    window.run_steps(3);
    let at = empty_place(&window);
    add(&mut window, at, "surface");
    let [from, to] =
        ["Output out of Where the enamel is gone", "Input x of Enamel is left"].map(|it| center(&window, it));
    let links = document(&window).graph.links.clone();
    let new = window.state().session().selection().first().expect("it is selected").clone();
    assert_ne!(new, "surface");
    let nodes = window.query_all_by_label("Node Surface").map(|node| node.rect()).collect::<Vec<_>>();
    let title = nodes.into_iter().min_by(|a, b| a.left().total_cmp(&b.left())).expect("its card");
    drag(&mut window, title.center(), from + (to - from) * 0.5);
    assert!(window.query_by_label_contains("no free input and output that fit").is_some());
    assert_eq!(document(&window).graph.links, links);
}
