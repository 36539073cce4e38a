//! Groups as files: one is written with what it needs, and comes into another material of another folder.

use std::path::PathBuf;

use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, egui};
use halfvector_graph::document::Node;
use halfvector_graph::edit::Edit;
use halfvector_graph::file::load_group;
use halfvector_graph::library::Library;
use halfvector_graph::operation::collapse;
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

use super::files::Place;
use super::hands::*;
use super::settle;

/// Presses one of the menu File.
fn from_menu(window: &mut Window, name: &str) {
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label(name).click();
    window.run_steps(3);
}

/// A material with the group `blots`, which reads `marks/blot.png` beside it, and the path of the picture.
fn with_group(place: &Place) -> (Window, PathBuf) {
    let picture = place.folder.path().join("marks/blot.png");
    std::fs::create_dir_all(picture.parent().expect("a folder")).expect("made");
    image::RgbImage::from_pixel(2, 2, image::Rgb([9, 9, 9])).save(&picture).expect("written");
    let mut window = place.open();
    let (color_space, wrap_u, wrap_v, filter) = (ColorSpace::Linear, Wrap::Repeat, Wrap::Repeat, Filter::Linear);
    let image = ImageRef { file: "marks/blot.png".into(), color_space, wrap_u, wrap_v, filter };
    let node = Node::new("textures/image").with("image", Value::Image(image));
    window.state_mut().act(Action::edit("Add", Edit::AddNode { id: "blot".into(), node }));
    let group = collapse(document(&window), Library::standard(), None, &["blot".into()], "Blots").expect("a group");
    window.state_mut().act(Action::edit("Group", group));
    settle(&mut window);
    (window, picture)
}

#[test]
fn a_group_goes_by_a_file_into_another_material() {
    let place = Place::new();
    let (mut window, picture) = with_group(&place);
    // Beside the material's folder: the picture's path is another one there.
    let shelf = place.folder.path().join("shelf");
    std::fs::create_dir_all(&shelf).expect("made");
    let path = shelf.join("blots.group.json");
    window.state_mut().act(Action::Select(vec!["blots".into()]));
    window.state_mut().act(Action::SaveGroup("blots".into(), path.clone()));
    settle(&mut window);
    let file = load_group(&path).expect("a group");
    let Value::Image(image) = &file.groups["blots"].graph.nodes["blot"].values["image"] else { panic!("a picture") };
    assert_eq!(image.file, "../marks/blot.png");

    let other = Place::new();
    let mut window = other.open();
    let before = document(&window).clone();
    drop_file(&mut window, &path);
    settle(&mut window);
    let after = document(&window).clone();
    assert_eq!(after.graph.nodes["blots"].node, "group/blots");
    assert!(window.state().session().selection().contains("blots"), "it is selected");
    let Value::Image(image) = &after.groups["blots"].graph.nodes["blot"].values["image"] else { panic!("a picture") };
    let meant = other.folder.path().join(&image.file).canonicalize().expect("a file");
    assert_eq!(meant, picture.canonicalize().expect("a file"));
    // Once more: the group is there, and only a node comes.
    drop_file(&mut window, &path);
    settle(&mut window);
    assert_eq!(
        (document(&window).groups.len(), document(&window).graph.nodes["blots_2"].node.as_str()),
        (1, "group/blots")
    );
    undo_all(&mut window);
    assert_eq!(*document(&window), before);
}

#[test]
fn a_group_that_cannot_come_is_told() {
    let place = Place::new();
    let (mut window, _) = with_group(&place);
    let path = place.folder.path().join("blots.group.json");
    window.state_mut().act(Action::SaveGroup("blots".into(), path.clone()));
    settle(&mut window);
    let before = document(&window).clone();
    // Into itself.
    window.state_mut().act(Action::Enter(vec!["blots".into()]));
    settle(&mut window);
    drop_file(&mut window, &path);
    settle(&mut window);
    assert!(window.query_all_by_label_contains("a group cannot hold itself").next().is_some());
    // A file that lacks what it is about.
    std::fs::write(&path, "{\"halfvector\": 1, \"group\": \"gone\", \"groups\": {}}").expect("written");
    drop_file(&mut window, &path);
    settle(&mut window);
    assert!(window.query_all_by_label_contains("blots.group.json").next().is_some());
    assert_eq!(*document(&window), before);
}

#[test]
fn both_ways_stand_in_menus() {
    let place = Place::new();
    let (mut window, _) = with_group(&place);
    from_menu(&mut window, "Add a group…");
    assert!(window.query_by_label("Add a group").is_some(), "the dialog is open");
    key(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    window.run_steps(3);
    window.state_mut().act(Action::Enter(vec!["blots".into()]));
    settle(&mut window);
    window.get_by_label("Save to a file…").click();
    window.run_steps(3);
    assert!(window.query_by_label("Save the group").is_some(), "the dialog is open");
}
