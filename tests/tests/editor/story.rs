//! One day of a person's: a material from nothing, by clicks, drags and keys; looked at, saved, exported, taken back to the
//! beginning, done again and opened once more.

use std::path::Path;

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use halfvector_editor::{Action, Folders, Options, START_MATERIAL, egui};
use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::value::Value;

use super::hands::*;
use super::{open, settle};

/// A window whose file dialogs open in a folder.
fn window(folder: &Path) -> Window {
    let file = folder.join("another.material.json");
    std::fs::write(&file, START_MATERIAL).expect("written");
    let folders = Folders { settings: Some(folder.join("settings")), recovery: Some(folder.join("recovery")) };
    let mut window = open(Options { document: Some(file), folders, ..Options::default() });
    settle(&mut window);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::N);
    settle(&mut window);
    assert_eq!(window.state().session().file(), None);
    window
}

/// Presses a button of the file dialog that is open, and waits for what comes of it.
fn choose(window: &mut Window, button: &str) {
    // The folder is read on a thread of the dialog's own.
    for _ in 0..200 {
        window.step();
        let found = window.query_by_role_and_label(Role::Button, button);
        if found.is_some_and(|button| !button.accesskit_node().is_disabled()) {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    window.get_by_role_and_label(Role::Button, button).click();
    settle(window);
}

/// Adds a node at a place of the canvas, in its shares, and gives back its id.
fn place(window: &mut Window, at: [f32; 2], words: &str) -> String {
    let canvas = window.get_by_label("Graph canvas").rect();
    add(window, canvas.min + canvas.size() * egui::Vec2::from(at), words);
    let selection = window.state().session().selection();
    assert_eq!(selection.len(), 1, "{words} is added and selected");
    selection.first().expect("one").clone()
}

fn wire(window: &mut Window, output: &str, input: &str) {
    let [from, to] = [output, input].map(|label| center(window, label));
    drag(window, from, to);
}

#[test]
fn a_material_from_nothing_is_drawn_saved_exported_undone_redone_and_opened_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(folder.path());
    let first = text(&window);

    // Nothing but ground.
    let at = empty_place(&window);
    go(&mut window, at);
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::A);
    key(&mut window, egui::Modifiers::NONE, egui::Key::Delete);
    assert!(document(&window).graph.nodes.is_empty());
    settle(&mut window);
    write_into(&mut window, "Name of the material", "Chequered floor");

    let surface = place(&mut window, [0.66, 0.1], "surface");
    assert_eq!(document(&window).graph.nodes[&surface].node, "surface/surface");
    let checker = place(&mut window, [0.05, 0.08], "checker 2d");
    let noise = place(&mut window, [0.05, 0.5], "fractal noise 2d");
    let rough = place(&mut window, [0.36, 0.5], "remap");
    wire(&mut window, "Output out of Checker 2D", "Input base_color of Surface");
    let nodes = &document(&window).graph.nodes;
    let names = [&noise, &rough].map(|id| nodes[id].node.clone());
    assert_eq!(names, ["procedural/fbm_2d", "math/remap"]);
    wire(&mut window, "Output out of Fractal Noise 2D", "Input x of Remap");
    wire(&mut window, "Output out of Remap", "Input perceptual_roughness of Surface");
    for (node, input, from) in
        [(&surface, "base_color", &checker), (&surface, "perceptual_roughness", &rough), (&rough, "x", &noise)]
    {
        let link = document(&window).graph.incoming(&SocketRef::new(node, input));
        assert_eq!(link.map(|from| &from.node), Some(from), "{input} of {node}");
    }
    window.get_by_label("Value metallic of Surface").click();
    window.run_steps(3);
    write(&mut window, "1");
    key(&mut window, egui::Modifiers::NONE, egui::Key::Enter);
    assert_eq!(document(&window).graph.value(&SocketRef::new(&surface, "metallic")), Some(&Value::Number(1.0)));

    // It is drawn, and nobody complains.
    settle(&mut window);
    assert!(window.query_by_label("Picture of the material").is_some());
    assert!(window.state().session().problems().is_empty(), "{:?}", window.state().session().problems());
    let last = text(&window);

    key(&mut window, egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT), egui::Key::S);
    choose(&mut window, "📥  Save");
    let file = folder.path().join("chequered-floor.material.json");
    assert_eq!(std::fs::read_to_string(&file).expect("it is saved"), last);
    assert!(!window.state().session().is_unsaved());

    window.get_by_role_and_label(Role::Button, "Export…").click();
    window.step();
    choose(&mut window, "🗀  Open");
    let wgsl = std::fs::read_to_string(folder.path().join("chequered-floor.wgsl")).expect("it is exported");
    let module = naga::front::wgsl::parse_str(&wgsl).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&wgsl)));
    assert!(module.entry_points.iter().any(|entry| entry.stage == naga::ShaderStage::Fragment));
    assert!(wgsl.contains("Checker 2D"), "a node's name stands in its shader");

    undo_all(&mut window);
    assert_eq!(text(&window), first);
    redo_all(&mut window);
    assert_eq!(text(&window), last);
    assert!(!window.state().session().is_unsaved(), "this is what was saved");
    let before: Document = document(&window).clone();

    key(&mut window, egui::Modifiers::COMMAND, egui::Key::N);
    settle(&mut window);
    assert_eq!(text(&window), first);
    window.state_mut().act(Action::Open(file.clone()));
    settle(&mut window);
    assert_eq!(window.state().session().file(), Some(file.as_path()));
    assert_eq!(*document(&window), before);
    assert_eq!(text(&window), last);
}
