//! What a person's hands do: pointer and keys, and what they find by its label.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, egui};
use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::file::to_json;

use egui::accesskit::Role;

pub(super) type Window = Harness<'static, Editor>;

pub(super) fn document(window: &Window) -> &Document {
    window.state().session().document()
}

pub(super) fn text(window: &Window) -> String {
    to_json(document(window))
}

pub(super) fn center(window: &Window, label: &str) -> egui::Pos2 {
    window.get_by_label(label).rect().center()
}

/// An empty place of the canvas: left of all nodes, above the middle.
pub(super) fn empty_place(window: &Window) -> egui::Pos2 {
    let graph = window.get_by_label("Graph canvas").rect();
    graph.left_bottom() + egui::vec2(40.0, -40.0)
}

pub(super) fn press(window: &mut Window, at: egui::Pos2, pressed: bool, modifiers: egui::Modifiers) {
    let button = egui::PointerButton::Primary;
    window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    window.step();
}

pub(super) fn go(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.step();
}

/// Presses at a point, goes to another one in steps and stays there with the button down.
pub(super) fn hold(window: &mut Window, from: egui::Pos2, to: egui::Pos2) {
    go(window, from);
    press(window, from, true, egui::Modifiers::NONE);
    for i in 1..=5 {
        go(window, from + (to - from) * (i as f32 / 5.0));
    }
}

pub(super) fn drag(window: &mut Window, from: egui::Pos2, to: egui::Pos2) {
    hold(window, from, to);
    press(window, to, false, egui::Modifiers::NONE);
    window.run_steps(2);
}

pub(super) fn key(window: &mut Window, modifiers: egui::Modifiers, key: egui::Key) {
    window.key_press_modifiers(modifiers, key);
    window.step();
    window.step();
}

pub(super) fn write(window: &mut Window, words: &str) {
    window.event(egui::Event::Text(words.to_owned()));
    window.step();
    window.step();
}

/// Writes a text in the place of what stands in a field, and leaves the field.
pub(super) fn write_into(window: &mut Harness<'_, Editor>, label: &str, text: &str) {
    window.get_by_role_and_label(Role::TextInput, label).focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.step();
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    window.run_steps(3);
}

/// Adds a node with the keys alone, the pointer at a place.
pub(super) fn add(window: &mut Window, at: egui::Pos2, words: &str) {
    go(window, at);
    key(window, egui::Modifiers::NONE, egui::Key::Space);
    write(window, words);
    key(window, egui::Modifiers::NONE, egui::Key::Enter);
}

/// A file as a window system hands it over.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

/// Drops a file where the pointer is.
pub(super) fn drop_file(window: &mut Harness<'_, Editor>, path: &Path) {
    window.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    window.step();
}

pub(super) fn undo_all(window: &mut Window) {
    while window.state().session().steps()[0].is_some() {
        window.state_mut().act(Action::Undo);
    }
    window.step();
}

pub(super) fn redo_all(window: &mut Window) {
    while window.state().session().steps()[1].is_some() {
        window.state_mut().act(Action::Redo);
    }
    window.step();
}

pub(super) fn source(window: &Window, node: &str, input: &str) -> Option<String> {
    document(window).graph.incoming(&SocketRef::new(node, input)).map(SocketRef::to_string)
}
