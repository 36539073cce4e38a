//! Copy, cut and paste: what travels with the nodes, within a window and between two.

use std::fs;

use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::{Document, Node, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::to_json;
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

use super::hands::*;
use super::{open, settle};

/// What the window has put into the clipboard in the frame before.
fn clipboard(window: &Window) -> String {
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    copied.expect("something was copied")
}

/// Copies or cuts, the pointer over the graph.
fn take(window: &mut Window, event: egui::Event) -> String {
    let at = empty_place(window);
    go(window, at);
    window.event(event);
    window.step();
    let text = clipboard(window);
    window.step();
    text
}

fn paste(window: &mut Window, text: &str) {
    let at = empty_place(window);
    go(window, at);
    window.event(egui::Event::Paste(text.to_owned()));
    window.run_steps(3);
}

fn parameters(window: &Window) -> Vec<String> {
    document(window).parameters.iter().map(|one| format!("{} {}", one.name, one.socket)).collect()
}

fn is_told(window: &Window, words: &str) -> bool {
    use egui_kittest::kittest::Queryable;
    window.query_all_by_label_contains(words).next().is_some()
}

/// A window whose material offers an input of the node `chips`.
fn offering() -> Window {
    let mut window = open(Options::default());
    window.run_steps(3);
    let socket = SocketRef::new("surface", "metallic");
    let parameter = halfvector_graph::document::Parameter {
        name: "how_metallic".to_owned(),
        label: Some("Metal".to_owned()),
        socket: SocketRef::new("grain", "scale"),
        range: Some([1.0, 9.0]),
    };
    let other = halfvector_graph::document::Parameter { name: "metallic".to_owned(), socket, ..parameter.clone() };
    let add = |parameter| Edit::AddParameter { place: None, parameter };
    let had: Vec<Edit> = (0..document(&window).parameters.len()).map(|_| Edit::RemoveParameter { place: 0 }).collect();
    let edits = had.into_iter().chain([add(parameter), add(other)]).collect();
    window.state_mut().act(Action::edit("Offer", Edit::Many(edits)));
    window.state_mut().act(Action::Select(vec!["grain".into()]));
    window.run_steps(3);
    window
}

#[test]
fn what_is_cut_and_pasted_is_offered_as_before() {
    let mut window = offering();
    let whole = document(&window).parameters.clone();
    let cut = take(&mut window, egui::Event::Cut);
    assert!(!cut.contains("copied_from"), "without pictures nobody needs to know whose folder it was");
    assert_eq!(parameters(&window), ["metallic surface.metallic"]);
    paste(&mut window, &cut);
    assert_eq!(parameters(&window), ["metallic surface.metallic", "how_metallic grain.scale"]);
    assert_eq!(document(&window).parameters[1], whole[0], "with label and range");
    assert!(is_told(&window, "the parameter `how_metallic` came along"));
    // A second one is offered under a name of its own, and both steps can be undone.
    paste(&mut window, &cut);
    assert_eq!(parameters(&window)[2], "how_metallic_2 grain_2.scale");
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::D);
    window.run_steps(2);
    assert_eq!(parameters(&window)[3], "how_metallic_3 grain_3.scale");
    assert!(is_told(&window, "came along as `how_metallic_3`"));
    for _ in 0..4 {
        window.state_mut().act(Action::Undo);
    }
    assert_eq!(document(&window).parameters, whole);
    // Into another window, which has the name already.
    let mut other = offering();
    paste(&mut other, &cut);
    assert_eq!(parameters(&other)[2], "how_metallic_2 grain_2.scale");
}

#[test]
fn what_cannot_stand_in_a_group_is_told() {
    let mut window = offering();
    let copied = take(&mut window, egui::Event::Copy);
    window.state_mut().act(Action::Select(vec!["chips".into()]));
    window.step();
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::G);
    window.run_steps(2);
    let group = document(&window).groups.keys().next().expect("a group").clone();
    window.state_mut().act(Action::Enter(vec![group.clone()]));
    window.run_steps(3);
    paste(&mut window, &copied);
    assert!(document(&window).groups[&group].graph.nodes.contains_key("grain"));
    assert!(is_told(&window, "the parameter `how_metallic` was left out, as only the top level's nodes have"));
}

#[test]
fn a_picture_is_the_same_file_in_a_window_of_another_folder() {
    let folder = std::env::temp_dir().join(format!("halfvector-clipboard-{}", std::process::id()));
    let file = |place: &str| {
        let path = folder.join(place).join("it.material.json");
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        path
    };
    let (first, second) = (file("one"), file("two/deep"));
    let mut with = Document::with_surface("One");
    let [wrap_u, wrap_v] = [Wrap::Repeat; 2];
    let (color_space, filter) = (ColorSpace::Srgb, Filter::Linear);
    let image = Value::Image(ImageRef { file: "textures/wood.png".into(), color_space, wrap_u, wrap_v, filter });
    with.graph.nodes.insert("wood".into(), Node::new("textures/image").with("image", image));
    with.graph.layout.insert("wood".into(), [-300.0, 0.0]);
    fs::write(&first, to_json(&with)).expect("written");
    fs::write(&second, to_json(&Document::with_surface("Two"))).expect("written");
    let open = |path: &std::path::Path| {
        let mut window = open(Options { document: Some(path.to_owned()), ..Options::default() });
        settle(&mut window);
        window
    };
    let mut window = open(&first);
    window.state_mut().act(Action::Select(vec!["wood".into()]));
    window.run_steps(2);
    let copied = take(&mut window, egui::Event::Copy);
    let named = |window: &Window, node: &str| match document(window).graph.nodes[node].values.get("image") {
        Some(Value::Image(image)) => image.file.clone(),
        other => panic!("{other:?}"),
    };
    paste(&mut window, &copied);
    assert_eq!(named(&window, "wood_2"), "textures/wood.png", "in its own folder it is written as before");
    let mut other = open(&second);
    paste(&mut other, &copied);
    assert_eq!(named(&other, "wood"), "../../one/textures/wood.png");
    fs::remove_dir_all(&folder).expect("removed");
}
