//! The graph by mouse and keys: what a person does there is in the document, and undo takes it back to the byte.

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::SocketRef;
use halfvector_graph::value::Value;

use super::hands::*;
use super::open;

fn window() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    window
}

#[test]
fn a_node_is_added_by_keys_and_undo_takes_it_back() {
    let mut window = window();
    let before = text(&window);
    let at = empty_place(&window);
    add(&mut window, at, "voronoi");
    let selection = window.state().session().selection();
    let id = selection.first().expect("the new node is selected").clone();
    assert!(document(&window).graph.nodes[&id].node.contains("voronoi"), "{id}");
    assert!(document(&window).graph.layout.contains_key(&id));
    assert_eq!(window.state().session().steps()[0].map(|step| step.starts_with("Add ")), Some(true));
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(text(&window), before);
}

#[test]
fn a_drag_between_sockets_connects_them() {
    let mut window = window();
    let from = center(&window, "Output out of Where the enamel is gone");
    let to = center(&window, "Input metallic of Surface");
    drag(&mut window, from, to);
    assert_eq!(source(&window, "surface", "metallic").as_deref(), Some("chips.out"));
    // From the input back to an output, over the one that is there.
    let from = center(&window, "Input ior of Surface");
    let to = center(&window, "Output out of Rust grain");
    drag(&mut window, from, to);
    assert_eq!(source(&window, "surface", "ior").as_deref(), Some("grain.out"));
}

#[test]
fn a_wire_that_does_not_fit_is_refused_with_the_reason_in_place() {
    let mut window = window();
    let before = text(&window);
    let from = center(&window, "Output out of Enamel over rust");
    let to = center(&window, "Input metallic of Surface");
    hold(&mut window, from, to);
    window.step();
    assert!(window.query_by_label_contains("components would be lost").is_some());
    press(&mut window, to, false, egui::Modifiers::NONE);
    assert_eq!(text(&window), before);
    // A ring is refused, too.
    let from = center(&window, "Output out of Enamel is left");
    let to = center(&window, "Input scale of Where the enamel is gone");
    hold(&mut window, from, to);
    window.step();
    assert!(window.query_by_label_contains("in a ring").is_some());
    press(&mut window, to, false, egui::Modifiers::NONE);
    assert_eq!(text(&window), before);
}

#[test]
fn keys_that_were_pressed_twice_since_the_last_frame_count_twice() {
    let mut window = window();
    let before = text(&window);
    for name in ["one", "two"] {
        window.state_mut().act(Action::edit("Rename", halfvector_graph::edit::Edit::SetName { name: name.into() }));
    }
    for _ in 0..2 {
        for pressed in [true, false] {
            let (modifiers, key) = (egui::Modifiers::COMMAND, egui::Key::Z);
            window.event(egui::Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
        }
    }
    window.step();
    assert_eq!(text(&window), before);
}

#[test]
fn the_graph_stays_whole_in_a_window_of_another_size_until_it_is_moved() {
    let mut window = window();
    let is_whole = |window: &Window| {
        let graph = window.get_by_label("Graph canvas").rect();
        let first = window.query_by_label("Node Where the enamel is gone").map(|node| node.rect());
        first.is_some_and(|first| first.width() > 20.0 && graph.contains_rect(first))
    };
    window.set_size(egui::vec2(900.0, 600.0));
    window.run_steps(4);
    assert!(is_whole(&window));
    let middle = window.get_by_label("Graph canvas").rect().center();
    go(&mut window, middle);
    let scroll = egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: egui::vec2(0.0, 9.0),
        phase: egui::TouchPhase::Move,
        modifiers: egui::Modifiers::COMMAND,
    };
    window.event(scroll);
    window.run_steps(20);
    assert!(!is_whole(&window));
    window.set_size(egui::vec2(860.0, 600.0));
    window.run_steps(4);
    assert!(!is_whole(&window), "the person's own view is kept");
}

#[test]
fn a_wire_taken_from_its_input_goes_elsewhere_or_away() {
    let mut window = window();
    let from = center(&window, "Input perceptual_roughness of Surface");
    let to = center(&window, "Input specular of Surface");
    drag(&mut window, from, to);
    assert_eq!(source(&window, "surface", "perceptual_roughness"), None);
    assert_eq!(source(&window, "surface", "specular").as_deref(), Some("roughness.out"));
    let from = center(&window, "Input specular of Surface");
    let to = empty_place(&window);
    drag(&mut window, from, to);
    assert_eq!(source(&window, "surface", "specular"), None);
    undo_all(&mut window);
    assert_eq!(source(&window, "surface", "perceptual_roughness").as_deref(), Some("roughness.out"));
}

#[test]
fn a_wire_dropped_on_the_ground_asks_for_a_node_that_fits() {
    let mut window = window();
    let from = center(&window, "Output out of Where the enamel is gone");
    let to = empty_place(&window);
    drag(&mut window, from, to);
    assert!(window.query_by_label("Search nodes").is_some());
    // A node that takes no number is not offered.
    write(&mut window, "not");
    assert!(window.query_by_label("Not").is_none());
    for _ in 0..3 {
        key(&mut window, egui::Modifiers::NONE, egui::Key::Backspace);
    }
    write(&mut window, "absolute");
    key(&mut window, egui::Modifiers::NONE, egui::Key::Enter);
    let id = window.state().session().selection().first().expect("the new node is selected").clone();
    assert_eq!(document(&window).graph.nodes[&id].node, "math/abs");
    assert_eq!(source(&window, &id, "x").as_deref(), Some("chips.out"));
}

#[test]
fn a_node_dropped_on_a_wire_is_put_into_it() {
    let mut window = window();
    let at = empty_place(&window);
    add(&mut window, at, "absolute");
    let id = window.state().session().selection().first().expect("the new node is selected").clone();
    let [from, to] =
        ["Output out of Where the enamel is gone", "Input x of Enamel is left"].map(|it| center(&window, it));
    let title = window.get_by_label("Node Absolute").rect();
    let grip = title.left_center() + egui::vec2(title.width() * 0.5, 0.0);
    drag(&mut window, grip, from + (to - from) * 0.5);
    assert_eq!(source(&window, &id, "x").as_deref(), Some("chips.out"));
    assert_eq!(source(&window, "enamel", "x"), Some(format!("{id}.out")));
}

#[test]
fn deleting_heals_when_asked() {
    let mut window = window();
    let before = text(&window);
    let at = center(&window, "Node Enamel is left");
    go(&mut window, at);
    window.get_by_label("Node Enamel is left").click();
    window.step();
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Delete);
    assert!(!document(&window).graph.nodes.contains_key("enamel"));
    assert_eq!(source(&window, "base_color", "t").as_deref(), Some("chips.out"));
    assert_eq!(source(&window, "roughness", "t").as_deref(), Some("chips.out"));
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(text(&window), before);
    window.state_mut().act(Action::Select(vec!["enamel".into()]));
    window.step();
    key(&mut window, egui::Modifiers::NONE, egui::Key::Delete);
    assert_eq!(source(&window, "base_color", "t"), None);
}

#[test]
fn nodes_go_from_one_window_to_another_as_text() {
    let (mut first, mut second) = (window(), window());
    let at = empty_place(&first);
    go(&mut first, at);
    key(&mut first, egui::Modifiers::COMMAND, egui::Key::A);
    assert_eq!(first.state().session().selection().len(), 7);
    first.event(egui::Event::Copy);
    first.step();
    let copied = first.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let copied = copied.expect("something was copied");
    go(&mut second, at);
    second.event(egui::Event::Paste(copied));
    second.step();
    second.step();
    // All but the surface, of which there is one already; with the wires among them and names of their own.
    let document = &document(&second).graph;
    assert_eq!(document.nodes.len(), 13);
    assert_eq!(document.incoming(&SocketRef::new("rust_2", "t")), Some(&SocketRef::new("grain_2", "out")));
    assert_eq!(document.nodes["rust_2"], document.nodes["rust"]);
    assert_eq!(second.state().session().selection().len(), 6);
    // What is no document is refused and told.
    second.event(egui::Event::Paste("a shopping list".into()));
    second.step();
    second.step();
    assert!(second.query_by_label_contains("he clipboard holds no nodes").is_some());
}

#[test]
fn a_box_selects_and_what_is_selected_moves_together() {
    let mut window = window();
    let [chips, grain] = ["Node Where the enamel is gone", "Node Rust grain"].map(|it| window.get_by_label(it).rect());
    let from = chips.left_top() - egui::vec2(20.0, 12.0);
    drag(&mut window, from, grain.right_bottom() - egui::vec2(20.0, 4.0));
    let selection: Vec<&str> = window.state().session().selection().iter().map(String::as_str).collect();
    assert_eq!(selection, ["chips", "grain"]);
    let before = document(&window).graph.layout.clone();
    let grip = grain.center();
    drag(&mut window, grip, grip + egui::vec2(-60.0, 73.0));
    let after = document(&window).graph.layout.clone();
    let way = |id: &str| [after[id][0] - before[id][0], after[id][1] - before[id][1]];
    assert_eq!(way("chips"), way("grain"));
    assert!(way("chips")[0] < -20.0 && way("chips")[1] > 20.0, "{:?}", way("chips"));
    assert_eq!(way("surface"), [0.0, 0.0]);
    assert_eq!(window.state().session().steps()[0], Some("Move 2 nodes"));
    // The arrows move by the grid.
    key(&mut window, egui::Modifiers::NONE, egui::Key::ArrowRight);
    assert_eq!(document(&window).graph.layout["chips"][0], before["chips"][0] + way("chips")[0] + 20.0);
}

#[test]
fn a_number_is_dragged_on_its_card_in_one_step() {
    let mut window = window();
    let at = center(&window, "Value metallic of Surface");
    drag(&mut window, at, at + egui::vec2(20.0, 0.0));
    let value = document(&window).graph.value(&SocketRef::new("surface", "metallic")).cloned();
    let Some(halfvector_graph::value::Value::Number(metallic)) = value else { panic!("{value:?}") };
    assert!((0.05..0.2).contains(&metallic), "{metallic}");
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(document(&window).graph.value(&SocketRef::new("surface", "metallic")), None);
    assert!(!window.state().session().is_unsaved());
}

#[test]
fn a_number_is_written_on_its_card() {
    let mut window = window();
    window.get_by_label("Value metallic of Surface").click();
    window.run_steps(3);
    write(&mut window, "0.25");
    key(&mut window, egui::Modifiers::NONE, egui::Key::Enter);
    let value = document(&window).graph.value(&SocketRef::new("surface", "metallic"));
    assert_eq!(value, Some(&halfvector_graph::value::Value::Number(0.25)));
}

/// To look at a value changes nothing.
#[test]
fn a_number_that_was_opened_and_left_is_not_set() {
    let mut window = window();
    window.get_by_label("Value metallic of Surface").click();
    window.run_steps(3);
    key(&mut window, egui::Modifiers::NONE, egui::Key::Enter);
    assert_eq!(document(&window).graph.value(&SocketRef::new("surface", "metallic")), None);
    assert_eq!(window.state().session().steps()[0], None);
}

#[test]
fn escape_takes_a_drag_back() {
    let mut window = window();
    let first = text(&window);
    for (from, way) in [
        (center(&window, "Value metallic of Surface"), egui::vec2(20.0, 0.0)),
        (center(&window, "Node Rust grain"), egui::vec2(60.0, 40.0)),
    ] {
        hold(&mut window, from, from + way);
        key(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
        press(&mut window, from + way, false, egui::Modifiers::NONE);
        window.run_steps(3);
        assert_eq!(text(&window), first);
    }
}

#[test]
fn undo_all_and_redo_all_give_the_same_documents() {
    let mut window = window();
    let first = text(&window);
    let at = empty_place(&window);
    add(&mut window, at, "voronoi");
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::D);
    key(&mut window, egui::Modifiers::NONE, egui::Key::ArrowDown);
    let [from, to] = ["Output out of Rust grain", "Input metallic of Surface"].map(|it| center(&window, it));
    drag(&mut window, from, to);
    window.state_mut().act(Action::Select(vec!["enamel".into(), "rust".into()]));
    window.step();
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Delete);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::A);
    key(&mut window, egui::Modifiers::NONE, egui::Key::L);
    let last = text(&window);
    assert_ne!(first, last);
    undo_all(&mut window);
    assert_eq!(text(&window), first);
    redo_all(&mut window);
    assert_eq!(text(&window), last);
}

#[test]
fn tab_walks_along_the_nodes_and_lets_go_at_the_end() {
    let mut window = window();
    window.get_by_label("Graph canvas").focus();
    window.step();
    window.remove_cursor();
    window.step();
    let mut seen = Vec::new();
    for _ in 0..7 {
        key(&mut window, egui::Modifiers::NONE, egui::Key::Tab);
        seen.extend(window.state().session().selection().iter().cloned());
    }
    assert_eq!(seen, ["chips", "grain", "enamel", "rust", "base_color", "roughness", "surface"]);
    assert!(window.get_by_label("Graph canvas").is_focused());
    key(&mut window, egui::Modifiers::NONE, egui::Key::Tab);
    window.step();
    assert!(!window.get_by_label("Graph canvas").is_focused());
}

#[test]
fn a_frame_takes_along_what_lies_in_it() {
    let mut window = window();
    let before = text(&window);
    window.state_mut().act(Action::Select(vec!["chips".into(), "grain".into()]));
    let at = empty_place(&window);
    go(&mut window, at);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::J);
    assert_eq!(document(&window).graph.frames["frame"].title, "Frame");
    let layout = document(&window).graph.layout.clone();
    let grip = center(&window, "Frame Frame");
    drag(&mut window, grip, grip + egui::vec2(-40.0, 30.0));
    let moved = &document(&window).graph.layout;
    let way = |id: &str| [moved[id][0] - layout[id][0], moved[id][1] - layout[id][1]];
    assert!(way("chips")[0] < -20.0, "{:?}", way("chips"));
    assert_eq!(way("chips"), way("grain"));
    assert_eq!(way("surface"), [0.0, 0.0]);
    // The key deletes the frame alone.
    key(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    window.get_by_label("Frame Frame").click();
    window.run_steps(2);
    key(&mut window, egui::Modifiers::NONE, egui::Key::Delete);
    assert!(document(&window).graph.frames.is_empty());
    assert_eq!(document(&window).graph.nodes.len(), 7);
    undo_all(&mut window);
    assert_eq!(text(&window), before);
}

#[test]
fn a_card_shows_a_picture_of_what_its_node_gives() {
    let mut window = window();
    let before = window.get_by_label("Node Rust grain").rect();
    assert!(window.query_by_label("out of grain").is_none());
    window.get_by_label("Picture of Rust grain").click();
    window.run_steps(3);
    // The viewport has one of the selected node, too.
    let pictures: Vec<_> = window.get_all_by_label("out of grain").map(|picture| picture.rect()).collect();
    let below = |picture: &egui::Rect| {
        picture.top() > before.bottom() && before.expand(60.0).x_range().contains(picture.center().x)
    };
    assert_eq!(pictures.iter().filter(|picture| below(picture)).count(), 1, "{pictures:?}");
    window.get_by_label("Picture of Rust grain").click();
    window.run_steps(3);
    window.state_mut().act(Action::Select(Vec::new()));
    window.run_steps(3);
    assert!(window.query_by_label("out of grain").is_none());
    assert!(!window.state().session().is_unsaved());
}

#[test]
fn nodes_become_a_group_and_its_inside_is_worked_on() {
    let mut window = window();
    let before = text(&window);
    let at = empty_place(&window);
    go(&mut window, at);
    window.state_mut().act(Action::Select(vec!["grain".into(), "rust".into()]));
    window.step();
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::G);
    let groups: Vec<String> = document(&window).groups.keys().cloned().collect();
    let [group] = groups.as_slice() else { panic!("{groups:?}") };
    assert_eq!(document(&window).graph.nodes.len(), 6);
    assert!(window.state().session().problems().is_empty(), "{:?}", window.state().session().problems());

    // A number of a node inside is one of the inside.
    window.state_mut().act(Action::Enter(vec![group.clone()]));
    window.state_mut().act(Action::Select(vec!["grain".into()]));
    window.run_steps(3);
    assert!(window.query_by_label("Node Rust grain").is_some(), "the inside is shown");
    let node = window.state().session().node("grain").expect("the node inside");
    assert_eq!(node.label.as_deref(), Some("Rust grain"));
    window.state_mut().act(Action::Enter(Vec::new()));
    window.step();

    let id = document(&window).graph.nodes.iter().find(|(_, node)| node.node == format!("group/{group}"));
    let id = id.expect("the group's node").0.clone();
    window.state_mut().act(Action::Select(vec![id]));
    window.step();
    key(&mut window, egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT), egui::Key::G);
    assert_eq!(document(&window).graph.nodes.len(), 7);
    while window.state().session().steps()[0].is_some() {
        window.state_mut().act(Action::Undo);
    }
    assert_eq!(text(&window), before);
}

#[test]
fn the_menu_does_what_the_keys_do() {
    let mut window = window();
    let before = text(&window);
    let nodes = document(&window).graph.nodes.len();
    let choose = |window: &mut Window, entry: &str| {
        window.get_by_label("Edit").click();
        window.run_steps(2);
        window.get_by_label(entry).click();
        window.run_steps(3);
    };
    window.get_by_label("Node Rust grain").click();
    window.run_steps(2);
    choose(&mut window, "Duplicate Ctrl+D");
    assert_eq!(document(&window).graph.nodes.len(), 1 + nodes);
    choose(&mut window, "Delete Del");
    assert_eq!(document(&window).graph.nodes.len(), nodes);
    window.get_by_label("Node Rust grain").click();
    window.run_steps(2);
    choose(&mut window, "Cut Ctrl+X");
    assert!(!document(&window).graph.nodes.contains_key("grain"));
    // The system hands over what is pasted: the graph has the focus for it.
    undo_all(&mut window);
    assert_eq!(text(&window), before);
}

#[test]
fn a_picture_that_is_dropped_on_the_graph_is_a_node() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window();
    let before = text(&window);
    let file = folder.path().join("bark.png");
    image::RgbImage::from_pixel(2, 2, image::Rgb([90, 60, 30])).save(&file).expect("written");
    let at = empty_place(&window);
    go(&mut window, at);
    drop_file(&mut window, &file);
    window.run_steps(2);
    let selected: Vec<_> = window.state().session().selection().iter().cloned().collect();
    let [id] = selected.as_slice() else { panic!("{selected:?}") };
    let node = &document(&window).graph.nodes[id];
    assert_eq!(node.node, "textures/image");
    assert!(matches!(&node.values["image"], Value::Image(image) if image.file.ends_with("bark.png")), "{node:?}");
    // Over an input that takes a picture it is the input's.
    let other = folder.path().join("moss.png");
    std::fs::copy(&file, &other).expect("copied");
    let slot = center(&window, "Thumbnail");
    go(&mut window, slot);
    drop_file(&mut window, &other);
    window.run_steps(2);
    let image = &document(&window).graph.nodes[id].values["image"];
    assert!(matches!(image, Value::Image(image) if image.file.ends_with("moss.png")), "{image:?}");
    // Over the node it is its picture; one of radiance is an environment, which is told at once and changes nothing.
    let environment = window.state().stage().environment.clone();
    let sky = folder.path().join("sky.hdr");
    std::fs::write(&sky, b"no picture yet").expect("written");
    let card = center(&window, "Node Image");
    for (at, file, name) in
        [(card, &file, "bark.png"), (card, &sky, "bark.png"), (slot, &other, "moss.png"), (slot, &sky, "moss.png")]
    {
        go(&mut window, at);
        drop_file(&mut window, file);
        window.run_steps(2);
        let image = &document(&window).graph.nodes[id].values["image"];
        assert!(matches!(image, Value::Image(image) if image.file.ends_with(name)), "{image:?}");
        assert_eq!(window.state().stage().environment, environment);
        let is_told = window.query_all_by_label_contains("sky.hdr is an environment").next().is_some();
        assert!(is_told || *file != sky, "{name}");
    }
    let viewport = window.get_by_label("Viewport").rect().center() + egui::vec2(0.0, 150.0);
    go(&mut window, viewport);
    drop_file(&mut window, &sky);
    window.run_steps(2);
    assert_ne!(window.state().stage().environment, environment);
    // Elsewhere it is told what to do.
    let menu = center(&window, "Edit");
    go(&mut window, menu);
    drop_file(&mut window, &other);
    window.run_steps(2);
    assert!(window.query_all_by_label_contains("a picture is dropped on the graph").next().is_some());
    undo_all(&mut window);
    assert_eq!(text(&window), before);
}
