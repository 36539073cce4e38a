//! The inside of a group: its sockets are changed with all uses, its nodes have pictures, and drags in it are one small step.

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::file::to_json;
use halfvector_graph::library::Library;
use halfvector_graph::operation::collapse;
use halfvector_graph::value::Value;

use egui::accesskit::Role;

use super::hands::{key, write_into};
use super::{open, settle};

type Window = Harness<'static, Editor>;

fn document(window: &Window) -> &Document {
    window.state().session().document()
}

/// The start material with the rust in a group that takes the grain, entered.
fn inside() -> Window {
    let mut window = open(Options::default());
    let ids = ["rust".to_owned(), "base_color".to_owned()];
    let edit = collapse(document(&window), Library::standard(), None, &ids, "Coat").expect("a group");
    window.state_mut().act(Action::edit("Group", edit));
    window.state_mut().act(Action::Enter(vec!["coat".to_owned()]));
    settle(&mut window);
    assert!(errors(&window).is_empty());
    window
}

fn errors(window: &Window) -> Vec<String> {
    window.state().session().problems().iter().map(ToString::to_string).collect()
}

fn names(window: &Window) -> [Vec<String>; 2] {
    let interface = &document(window).groups["coat"].interface;
    let inputs = interface.inputs.iter().map(|input| input.name.clone()).collect();
    [inputs, interface.outputs.iter().map(|output| output.name.clone()).collect()]
}

#[test]
fn a_group_shows_what_is_wrong_inside() {
    let mut window = inside();
    let odd = Edit::AddNode { id: "odd".into(), node: Node::new("math/nothing") };
    window.state_mut().act(Action::edit("Add", Edit::In { group: "coat".into(), edit: Box::new(odd) }));
    window.state_mut().act(Action::Enter(Vec::new()));
    window.run_steps(3);
    let told = window.get_by_label("Node Coat").accesskit_node().value();
    assert!(told.as_deref().is_some_and(|told| told.starts_with("Inside, ")), "{told:?}");
    assert_eq!(window.get_by_label("Node Rust grain").accesskit_node().value(), None);
}

#[test]
fn sockets_are_renamed_added_moved_and_removed_with_all_uses() {
    let mut window = inside();
    let before = to_json(document(&window));
    let [inputs, outputs] = names(&window);
    let node = document(&window).graph.nodes.iter().find(|(_, node)| node.node == "group/coat").unwrap().0.clone();
    // The colour of the enamel is a parameter, which is an input of the group from now on.
    let exposed = document(&window).parameter("enamel_color").unwrap().socket.clone();
    assert_eq!(exposed.node, node);

    write_into(&mut window, &format!("Name of input {}", exposed.socket), "enamel");
    write_into(&mut window, &format!("Name of output {}", outputs[0]), "paint");
    assert!(names(&window)[0].contains(&"enamel".to_owned()));
    assert_eq!(names(&window)[1], ["paint"]);
    assert_eq!(document(&window).parameter("enamel_color").unwrap().socket, SocketRef::new(&node, "enamel"));
    let link = Link::new(SocketRef::new(&node, "paint"), SocketRef::new("surface", "base_color"));
    assert!(document(&window).graph.links.contains(&link));
    assert!(errors(&window).is_empty(), "{:?}", errors(&window));

    window.get_by_role_and_label(Role::Button, "Add input").click();
    window.run_steps(3);
    assert_eq!(names(&window)[0].len(), inputs.len() + 1);
    let added = names(&window)[0].last().unwrap().clone();
    window.get_by_role_and_label(Role::Button, &format!("Up input {added}")).click();
    window.run_steps(3);
    assert_eq!(names(&window)[0][inputs.len() - 1], added);
    // A name that is taken is refused.
    write_into(&mut window, &format!("Name of input {added}"), "enamel");
    assert!(names(&window)[0].contains(&added));
    window.get_by_role_and_label(Role::Button, "Remove input enamel").click();
    window.run_steps(3);
    assert!(!names(&window)[0].contains(&"enamel".to_owned()));
    assert!(document(&window).parameter("enamel_color").is_none());

    while window.state().session().steps()[0].is_some_and(|step| step != "Group") {
        window.state_mut().act(Action::Undo);
    }
    assert_eq!(to_json(document(&window)), before);
}

#[test]
fn a_new_group_is_selected_and_so_are_the_nodes_of_one_that_is_taken_apart() {
    let mut window = open(Options::default());
    settle(&mut window);
    let two = ["base_color".to_owned(), "rust".to_owned()];
    window.state_mut().act(Action::Select(two.to_vec()));
    let canvas = window.get_by_label("Graph canvas").rect();
    window.hover_at(canvas.left_bottom() + egui::vec2(20.0, -20.0));
    window.run_steps(2);
    let chosen = |window: &Window| window.state().session().selection().iter().cloned().collect::<Vec<_>>();
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::G);
    let [group] = <[String; 1]>::try_from(chosen(&window)).expect("one node");
    assert_eq!(document(&window).graph.nodes[&group].node, "group/group");
    key(&mut window, egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT), egui::Key::G);
    assert_eq!(chosen(&window), two);
}

#[test]
fn a_node_in_a_group_shows_what_it_gives() {
    let mut window = inside();
    window.get_by_label("Picture of Rust").click();
    let before = to_json(document(&window));
    window.state_mut().act(Action::Select(vec!["rust".to_owned()]));
    settle(&mut window);
    // On the card and in the corner of the picture.
    assert_eq!(window.get_all_by_label("out of rust").count(), 2);
    assert_eq!(to_json(document(&window)), before);
}

#[test]
fn a_drag_in_a_group_is_one_step_and_a_small_one() {
    let mut window = inside();
    let before = to_json(document(&window));
    for step in 0..200 {
        let value = Some(Value::Number(0.001 * step as f32));
        let socket = SocketRef::new("rust", "position_a");
        let edit = Edit::In { group: "coat".into(), edit: Box::new(Edit::SetValue { socket, value }) };
        window.state_mut().act(Action::drag("Set position a", edit, "drag"));
    }
    window.state_mut().act(Action::EndMerge);
    assert_eq!(window.state().session().parts_of_undo(), 1);
    window.state_mut().act(Action::Undo);
    assert_eq!(to_json(document(&window)), before);
}
