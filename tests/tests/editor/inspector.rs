//! The inspector: what it sets is in the document, a drag is one step of undo, and what it offers fits the socket.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Options, egui};
use halfvector_graph::document::{Document, Parameter, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::value::Value;

use egui::accesskit::Role;

use super::hands::write_into;
use super::{open, settle};

fn window(selected: &str) -> Harness<'static, Editor> {
    let mut harness = open(Options::default());
    settle(&mut harness);
    select(&mut harness, selected);
    harness
}

fn select(harness: &mut Harness<'_, Editor>, id: &str) {
    harness.state_mut().act(Action::Select(vec![id.to_owned()]));
    harness.run_steps(2);
}

fn document<'h>(harness: &'h Harness<'_, Editor>) -> &'h Document {
    harness.state().session().document()
}

fn value(harness: &Harness<'_, Editor>, node: &str, socket: &str) -> Option<Value> {
    harness.state().session().value(&SocketRef::new(node, socket)).cloned()
}

fn press(harness: &mut Harness<'_, Editor>, key: egui::Key, times: usize) {
    for _ in 0..times {
        harness.key_press(key);
        harness.step();
    }
}

#[test]
fn a_slider_is_one_step_of_undo() {
    let mut harness = window("chips");
    let before = document(&harness).clone();
    harness.get_by_role_and_label(Role::Slider, "gain").focus();
    // A widget keeps the arrow keys for itself from the second frame on.
    harness.run_steps(3);
    press(&mut harness, egui::Key::ArrowRight, 4);
    let Some(Value::Number(gain)) = value(&harness, "chips", "gain") else { panic!("no number") };
    assert!(gain > 0.6 && gain < 0.8, "{gain}");
    harness.state_mut().act(Action::Undo);
    assert_eq!(*document(&harness), before);
}

#[test]
fn a_node_is_renamed_and_its_problem_is_told() {
    let mut harness = window("chips");
    write_into(&mut harness, "Label of the node", "Chips of paint");
    assert_eq!(document(&harness).graph.nodes["chips"].label.as_deref(), Some("Chips of paint"));
    harness.state_mut().act(Action::Undo);
    harness.step();
    assert_eq!(document(&harness).graph.nodes["chips"].label.as_deref(), Some("Where the enamel is gone"));
}

#[test]
fn an_input_tells_where_it_comes_from() {
    let mut harness = window("base_color");
    harness.get_by_label("Rust · out").click();
    harness.run_steps(2);
    assert!(harness.state().session().selection().contains("rust"));
}

#[test]
fn a_value_is_reset_and_exposed() {
    let mut harness = window("grain");
    let menu = |harness: &mut Harness<'_, Editor>, row: usize, entry: &str| {
        harness.get_all_by_role_and_label(Role::Button, "…").nth(row).unwrap().click();
        harness.run_steps(3);
        // The menu lies above the rest.
        harness.get_all_by_label(entry).last().unwrap().click();
        harness.run_steps(3);
    };
    let place = |harness: &Harness<'_, Editor>, socket: &str| {
        let node = &document(harness).graph.nodes["grain"].node;
        let def = halfvector_graph::library::Library::standard().get(node).unwrap();
        def.inputs.iter().position(|input| input.name == socket).unwrap()
    };
    let scale = place(&harness, "scale");
    assert_eq!(value(&harness, "grain", "scale"), Some(Value::Number(14.0)));
    menu(&mut harness, scale, "Reset to default");
    assert_eq!(value(&harness, "grain", "scale"), None);
    menu(&mut harness, scale, "Expose as parameter");
    let parameter = document(&harness).parameter("scale").unwrap();
    assert_eq!(parameter.socket, SocketRef::new("grain", "scale"));
    write_into(&mut harness, "name of the parameter", "rust_scale");
    assert!(document(&harness).parameter("rust_scale").is_some());
    menu(&mut harness, scale, "Stop exposing");
    assert!(document(&harness).parameter("rust_scale").is_none());
    while harness.state().session().steps()[0].is_some() {
        harness.state_mut().act(Action::Undo);
    }
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn a_colour_is_written_as_its_code() {
    let mut harness = window("rust");
    write_into(&mut harness, "color a", "#ff8000");
    let Some(Value::Vec3([r, g, b])) = value(&harness, "rust", "color_a") else { panic!("no colour") };
    // IEC 61966-2-1: 128 / 255 is 0.2158605.
    assert!((r - 1.0).abs() < 1e-6 && (g - 0.215_860_5).abs() < 1e-6 && b == 0.0, "{r} {g} {b}");
}

#[test]
fn curves_and_ramps_are_bent_by_hand() {
    let mut harness = window("rust");
    let stop = harness.get_by_label("Stop a").rect().center();
    harness.drag_at(stop);
    harness.step();
    harness.hover_at(stop + egui::vec2(30.0, 0.0));
    harness.step();
    harness.drop_at(stop + egui::vec2(30.0, 0.0));
    harness.run_steps(2);
    let Some(Value::Number(position)) = value(&harness, "rust", "position_a") else { panic!("no number") };
    assert!(position > -0.34, "{position}");

    let node = halfvector_graph::document::Node::new("math/curve");
    harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: "bend".into(), node }));
    select(&mut harness, "bend");
    harness.get_by_label("Point 3 of the curve").focus();
    // A widget keeps the arrow keys for itself from the second frame on.
    harness.run_steps(3);
    press(&mut harness, egui::Key::ArrowUp, 3);
    let Some(Value::Number(middle)) = value(&harness, "bend", "at_50") else { panic!("no number") };
    assert!((middle - 0.53).abs() < 1e-5, "{middle}");
}

#[test]
fn a_metal_becomes_another_one() {
    let mut harness = window("surface");
    let node = halfvector_graph::document::Node::new("optics/gold");
    harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: "metal".into(), node }));
    let link = halfvector_graph::document::Link::new(
        SocketRef::new("metal", "color"),
        SocketRef::new("surface", "base_color"),
    );
    harness.state_mut().act(Action::edit("Link", Edit::AddLink { link: link.clone() }));
    select(&mut harness, "metal");
    harness.get_by_role_and_label(Role::ComboBox, "metal").click();
    harness.run_steps(3);
    harness.get_by_label("Copper").click();
    harness.run_steps(3);
    assert_eq!(document(&harness).graph.nodes["metal"].node, "optics/copper");
    assert!(document(&harness).graph.links.contains(&link));
    assert!(harness.query_by_label("No problems").is_some() || !harness.state().session().problems().is_empty());
}

#[test]
fn a_conductor_takes_the_constants_of_a_metal() {
    let mut harness = window("surface");
    let node = halfvector_graph::document::Node::new("optics/gold");
    harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: "metal".into(), node }));
    select(&mut harness, "metal");
    let choose = |harness: &mut Harness<'_, Editor>, choice: &str, entry: &str| {
        harness.get_by_role_and_label(Role::ComboBox, choice).click();
        harness.run_steps(3);
        harness.get_all_by_label(entry).last().unwrap().click();
        harness.run_steps(3);
    };
    choose(&mut harness, "metal", "By optical constants");
    assert_eq!(document(&harness).graph.nodes["metal"].node, "optics/conductor");
    // Gold at 650 nm: it begins as what it was.
    let eta = |harness: &Harness<'_, Editor>| match value(harness, "metal", "eta") {
        Some(Value::Vec3([red, ..])) => red,
        other => panic!("{other:?}"),
    };
    assert_eq!(eta(&harness), 0.156);
    choose(&mut harness, "eta and k of", "Copper");
    assert_eq!(eta(&harness), 0.238);
    assert!(matches!(value(&harness, "metal", "k"), Some(Value::Vec3([red, ..])) if red == 3.626));
    harness.state_mut().act(Action::Undo);
    assert_eq!(eta(&harness), 0.156);
}

/// A metal that loses an input is not exposed there any more, and undo brings it all back.
#[test]
fn a_metal_without_an_input_has_no_parameter_for_it() {
    let mut harness = window("surface");
    let node = halfvector_graph::document::Node::new("optics/conductor");
    let exposed = |name: &str, node: &str, socket: &str| Edit::AddParameter {
        place: Some(0),
        parameter: Parameter { name: name.into(), label: None, socket: SocketRef::new(node, socket), range: None },
    };
    let edits = vec![
        Edit::AddNode { id: "metal".into(), node },
        exposed("metal_eta", "metal", "eta"),
        exposed("kept", "chips", "gain"),
        exposed("metal_k", "metal", "k"),
    ];
    harness.state_mut().act(Action::edit("Add", Edit::Many(edits)));
    select(&mut harness, "metal");
    let before = document(&harness).clone();
    harness.get_by_role_and_label(Role::ComboBox, "metal").click();
    harness.run_steps(3);
    harness.get_all_by_label("Gold").last().unwrap().click();
    harness.run_steps(3);
    assert_eq!(document(&harness).graph.nodes["metal"].node, "optics/gold");
    assert!(document(&harness).parameter("kept").is_some());
    assert!(document(&harness).parameters.iter().all(|parameter| parameter.socket.node != "metal"));
    harness.state_mut().act(Action::Undo);
    assert_eq!(*document(&harness), before);
}

/// A node of any type shows a swatch where it works on colours, and numbers elsewhere.
#[test]
fn what_is_wired_to_a_colour_has_swatches() {
    let mut harness = window("surface");
    let node = halfvector_graph::document::Node::new("math/add");
    harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: "sum".into(), node }));
    select(&mut harness, "sum");
    let swatches = |harness: &Harness<'_, Editor>| harness.query_all_by_role(Role::ColorWell).count();
    assert_eq!(swatches(&harness), 0);
    let to = SocketRef::new("surface", "base_color");
    let old: Vec<_> = document(&harness).graph.links.iter().filter(|link| link.to == to).cloned().collect();
    let mut edits: Vec<Edit> = old.into_iter().map(|link| Edit::RemoveLink { link }).collect();
    let link = halfvector_graph::document::Link::new(SocketRef::new("sum", "out"), to);
    let value = Some(Value::Vec3([0.2, 0.3, 0.4]));
    edits.push(Edit::SetValue { socket: SocketRef::new("sum", "a"), value });
    edits.push(Edit::AddLink { link });
    harness.state_mut().act(Action::edit("Link", Edit::Many(edits)));
    harness.run_steps(3);
    assert!(swatches(&harness) > 0, "{:?}", document(&harness).graph.nodes["sum"]);
}

#[test]
fn the_material_itself_is_set_when_nothing_is_selected() {
    let mut harness = window("chips");
    harness.state_mut().act(Action::Select(Vec::new()));
    harness.run_steps(2);
    write_into(&mut harness, "Name of the material", "Old enamel");
    assert_eq!(document(&harness).name, "Old enamel");
    let names = |harness: &Harness<'_, Editor>| {
        document(harness).parameters.iter().map(|parameter| parameter.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&harness), ["enamel_color", "enamel_roughness"]);
    harness.get_all_by_role_and_label(Role::Button, "Down").next().unwrap().click();
    harness.run_steps(3);
    assert_eq!(names(&harness), ["enamel_roughness", "enamel_color"]);
}

#[test]
fn several_nodes_are_deleted_together() {
    let mut harness = window("chips");
    harness.state_mut().act(Action::Select(vec!["chips".into(), "grain".into()]));
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Button, "Delete").click();
    harness.run_steps(2);
    let nodes = &document(&harness).graph.nodes;
    assert!(!nodes.contains_key("chips") && !nodes.contains_key("grain"));
}

/// What of a picture is used, and which way its normals run, is set where the picture is.
#[test]
fn a_picture_has_its_channel_and_the_sign_of_its_normals() {
    let document_file = crate::support::root().join("examples/painted-panel.material.json");
    let mut harness = open(Options { document: Some(document_file), ..Options::default() });
    harness.run_steps(3);
    let choose = |harness: &mut Harness<'_, Editor>, node: &str, what: &str, entry: &str| {
        select(harness, node);
        harness.get_by_role_and_label(Role::ComboBox, what).click();
        harness.run_steps(3);
        harness.get_by_role_and_label(Role::Button, entry).click();
        harness.run_steps(3);
    };
    choose(&mut harness, "bumps", "normals", "-Y (DirectX)");
    assert_eq!(value(&harness, "normal", "flip_y"), Some(Value::Bool(true)));
    choose(&mut harness, "roughness", "channel", "g");
    let fed = |harness: &Harness<'_, Editor>| {
        document(harness).graph.incoming(&SocketRef::new("surface", "perceptual_roughness")).map(SocketRef::to_string)
    };
    assert_eq!(fed(&harness).as_deref(), Some("roughness.g"));
    assert_eq!(harness.state().session().steps()[0], Some("Choose the channel"));
    // A picture that feeds no normal map has no sign.
    assert!(harness.query_by_role_and_label(Role::ComboBox, "normals").is_none());
    assert_eq!(document(&harness).graph.links.len(), 9);
}
