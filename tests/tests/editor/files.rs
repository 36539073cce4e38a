//! Files: nothing is lost, whatever happens, and nothing is overwritten without asking.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use halfvector_editor::{Action, Editor, Folders, Options, START_MATERIAL, egui};
use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::edit::Edit;
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value, Wrap};
use tempfile::TempDir;

use super::hands::drop_file;
use super::{open, settle};

/// A folder with a material in it, and folders for the editor's own files.
pub(super) struct Place {
    pub(super) folder: TempDir,
}

impl Place {
    pub(super) fn new() -> Place {
        let place = Place { folder: TempDir::new().unwrap() };
        std::fs::write(place.file(), START_MATERIAL).unwrap();
        place
    }

    pub(super) fn file(&self) -> PathBuf {
        self.folder.path().join("enamel.material.json")
    }

    pub(super) fn folders(&self) -> Folders {
        folders_in(self.folder.path())
    }

    pub(super) fn open(&self) -> Harness<'static, Editor> {
        let mut harness = open(Options { document: Some(self.file()), folders: self.folders(), ..Options::default() });
        settle(&mut harness);
        harness
    }

    pub(super) fn open_new(&self) -> Harness<'static, Editor> {
        let mut harness = open(Options { folders: self.folders(), ..Options::default() });
        settle(&mut harness);
        harness
    }

    pub(super) fn read(&self) -> Document {
        halfvector_graph::file::load(&self.file()).unwrap()
    }
}

pub(super) fn folders_in(path: &Path) -> Folders {
    Folders { settings: Some(path.join("settings")), recovery: Some(path.join("recovery")) }
}

pub(super) fn rename(name: &str) -> Action {
    Action::edit("Rename", Edit::SetName { name: name.to_owned() })
}

/// Draws frames until something is true.
pub(super) fn wait_for(harness: &mut Harness<'_, Editor>, what: &str, is_true: impl Fn(&Harness<'_, Editor>) -> bool) {
    let start = Instant::now();
    while !is_true(harness) {
        harness.step();
        assert!(start.elapsed() < Duration::from_secs(60), "{what} does not come");
        std::thread::sleep(Duration::from_millis(10));
    }
}

pub(super) fn click(harness: &mut Harness<'_, Editor>, button: &str) {
    harness.get_by_role_and_label(egui::accesskit::Role::Button, button).click();
    settle(harness);
}

#[test]
fn a_saved_material_is_the_one_that_was_worked_on() {
    let place = Place::new();
    let mut harness = place.open();
    harness.state_mut().act(rename("Other"));
    assert!(harness.state().session().is_unsaved());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    settle(&mut harness);
    assert!(!harness.state().session().is_unsaved());
    assert_eq!(place.read(), **harness.state().session().document());
    let recent = std::fs::read_to_string(place.folder.path().join("settings/editor.json"));
    drop(harness);
    let recent = recent.or_else(|_| std::fs::read_to_string(place.folder.path().join("settings/editor.json"))).unwrap();
    assert!(recent.contains("enamel.material.json"), "{recent}");
    assert_eq!(
        std::fs::read_dir(place.folder.path().join("recovery")).unwrap().count(),
        0,
        "a clean end leaves nothing"
    );
}

#[test]
fn an_instance_stays_one_when_it_is_saved() {
    let place = Place::new();
    let path = place.folder.path().join("blue.material.json");
    let text = r#"{"halfvector": 1, "base": "enamel.material.json", "set": {"enamel_roughness": 0.25}}"#;
    std::fs::write(&path, text).unwrap();
    let mut harness = place.open_new();
    harness.state_mut().act(Action::Open(path.clone()));
    settle(&mut harness);
    assert!(harness.query_by_label_contains("instance of enamel.material.json").is_some());
    let socket = SocketRef::new("roughness", "b");
    let set = |value: f32| {
        let edit = Edit::SetValue { socket: socket.clone(), value: Some(Value::Number(value)) };
        Action::edit("Set", edit)
    };
    assert_eq!(harness.state().session().value(&socket), Some(&Value::Number(0.25)));
    harness.state_mut().act(rename("Blue"));
    harness.state_mut().act(set(0.5));
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert!(!harness.state().session().is_unsaved());
    let saved = std::fs::read_to_string(&path).unwrap();
    assert!(saved.contains(r#""name": "Blue""#) && saved.contains(r#""enamel_roughness": 0.5"#), "{saved}");
    assert!(saved.contains(r#""base": "enamel.material.json""#) && !saved.contains("nodes"), "{saved}");
    let read = halfvector_graph::file::load(&path).unwrap();
    assert_eq!(read, **harness.state().session().document());

    // What it cannot hold is not written, and nothing is lost.
    harness.state_mut().act(Action::edit("Remove", Edit::RemoveNode { id: "rust".into() }));
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), saved);
    assert!(harness.state().session().is_unsaved());
    let own = place.folder.path().join("own.material.json");
    harness.state_mut().act(Action::SaveAs(own.clone()));
    settle(&mut harness);
    assert_eq!(halfvector_graph::file::load(&own).unwrap(), **harness.state().session().document());
    assert!(harness.query_by_label_contains("instance of").is_none(), "it is a material of its own now");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), saved);

    // The instance that is opened at the start, changed by others.
    let options = Options { document: Some(path.clone()), folders: place.folders(), ..Options::default() };
    let mut harness = open(options);
    settle(&mut harness);
    std::fs::write(&path, text).unwrap();
    wait_for(&mut harness, "the offer", |harness| harness.query_by_label("Reload").is_some());
    click(&mut harness, "Reload");
    assert_eq!(harness.state().session().value(&socket), Some(&Value::Number(0.25)));
    harness.state_mut().act(set(0.75));
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert!(std::fs::read_to_string(&path).unwrap().contains(r#""set": {"#));
}

#[test]
fn what_a_killed_save_left_behind_is_cleared_away_by_a_later_one() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("steel.material.json");
    let beside = |name: &str, minutes: u64| {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).expect("a file");
        file.set_modified(std::time::SystemTime::now() - Duration::from_secs(60 * minutes)).expect("a time");
        path
    };
    let old = beside(".steel.material.json.4711-0.tmp", 30);
    let others = [
        beside(".steel.material.json.4711-1.tmp", 1),
        beside(".brass.material.json.4711-0.tmp", 30),
        beside("a.tmp", 30),
    ];
    let mut harness = open(Options::default());
    harness.state_mut().act(Action::SaveAs(path.clone()));
    settle(&mut harness);
    assert!(path.exists() && !old.exists());
    assert!(others.iter().all(|other| other.exists()), "{others:?}");
}

#[test]
fn unsaved_work_is_asked_about() {
    let place = Place::new();
    let mut harness = place.open();
    harness.state_mut().act(rename("Other"));
    harness.state_mut().act(Action::New);
    settle(&mut harness);
    click(&mut harness, "Cancel");
    assert_eq!(harness.state().session().document().name, "Other");
    harness.state_mut().act(Action::New);
    settle(&mut harness);
    click(&mut harness, "Save");
    assert_eq!(place.read().name, "Other");
    assert_eq!(harness.state().session().file(), None);
    assert_eq!(harness.state().session().document().name, "Worn enamel");
    harness.state_mut().act(rename("Third"));
    harness.state_mut().act(Action::Open(place.file()));
    settle(&mut harness);
    click(&mut harness, "Discard");
    assert_eq!(harness.state().session().document().name, "Other");
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn the_window_does_not_close_over_unsaved_work() {
    let place = Place::new();
    let mut harness = place.open();
    let close = |harness: &mut Harness<'_, Editor>| {
        let viewports = &mut harness.input_mut().viewports;
        viewports.entry(egui::ViewportId::ROOT).or_default().events.push(egui::ViewportEvent::Close);
        harness.step();
        let output = &harness.output().viewport_output[&egui::ViewportId::ROOT];
        output.commands.contains(&egui::ViewportCommand::CancelClose)
    };
    assert!(!close(&mut harness), "nothing is unsaved");
    harness.state_mut().act(rename("Other"));
    assert!(close(&mut harness));
    settle(&mut harness);
    click(&mut harness, "Save");
    assert_eq!(place.read().name, "Other");
    assert!(!close(&mut harness));
}

#[test]
fn a_dropped_material_is_opened() {
    let place = Place::new();
    let mut harness = place.open_new();
    drop_file(&mut harness, &place.file());
    settle(&mut harness);
    assert_eq!(harness.state().session().file(), Some(place.file().as_path()));
}

#[test]
fn a_dropped_file_of_no_use_is_told() {
    let place = Place::new();
    let mut harness = place.open_new();
    drop_file(&mut harness, &place.folder.path().join("notes.txt"));
    settle(&mut harness);
    assert!(harness.query_all_by_label_contains("notes.txt: it is nothing to drop here").next().is_some());
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn paths_of_images_mean_the_same_files_in_another_folder() {
    let place = Place::new();
    let mut harness = place.open();
    let inner = place.folder.path().join("sets/steel");
    std::fs::create_dir_all(&inner).unwrap();
    let socket = SocketRef::new("texture", "image");
    let image = |file: &str| {
        let (wrap_u, wrap_v) = (Wrap::Repeat, Wrap::Repeat);
        let (color_space, filter) = (ColorSpace::Srgb, Filter::Linear);
        Value::Image(ImageRef { file: file.to_owned(), color_space, wrap_u, wrap_v, filter })
    };
    let node = halfvector_graph::document::Node::new("textures/image").with("image", image("maps/rust.png"));
    harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: "texture".into(), node }));
    let set = |file| Edit::SetValue { socket: socket.clone(), value: Some(image(file)) };
    harness.state_mut().act(Action::edit("Choose", set("sets/steel/paint.png")));
    harness.state_mut().act(Action::SaveAs(inner.join("steel.material.json")));
    settle(&mut harness);
    let value = |harness: &Harness<'_, Editor>| harness.state().session().value(&socket).cloned();
    assert_eq!(value(&harness), Some(image("paint.png")));
    let saved = halfvector_graph::file::load(&inner.join("steel.material.json")).unwrap();
    assert_eq!(saved, **harness.state().session().document());
    assert!(!harness.state().session().is_unsaved());
    // What undo brings back starts at the new folder too.
    harness.state_mut().act(Action::Undo);
    assert_eq!(value(&harness), Some(image("../../maps/rust.png")));
}

#[test]
fn pictures_that_cannot_be_read_are_problems_of_their_nodes() {
    let place = Place::new();
    let mut harness = place.open();
    let titles = |harness: &Harness<'_, Editor>, count: &str| harness.query_by_label_contains(count).is_some();
    assert!(!titles(&harness, "Problems ("));
    let image = |file: &str| {
        let (wrap_u, wrap_v) = (Wrap::Repeat, Wrap::Repeat);
        let (color_space, filter) = (ColorSpace::Srgb, Filter::Linear);
        Value::Image(ImageRef { file: file.to_owned(), color_space, wrap_u, wrap_v, filter })
    };
    std::fs::write(place.folder.path().join("text.png"), "no picture").unwrap();
    for (id, socket, file) in [("gone", "specular", "gone.png"), ("text", "ior", "text.png")] {
        let node = halfvector_graph::document::Node::new("textures/image").with("image", image(file));
        harness.state_mut().act(Action::edit("Add", Edit::AddNode { id: id.into(), node }));
        let link = halfvector_graph::document::Link::new(SocketRef::new(id, "r"), SocketRef::new("surface", socket));
        harness.state_mut().act(Action::edit("Link", Edit::AddLink { link }));
    }
    settle(&mut harness);
    assert!(titles(&harness, "Problems (2)"));
    harness.state_mut().act(Action::Select(vec!["gone".into()]));
    settle(&mut harness);
    let tells = |harness: &Harness<'_, Editor>, what: &str| harness.query_all_by_label_contains(what).next().is_some();
    assert!(tells(&harness, "gone.png could not be read"));
    // It is looked at again when something changes.
    let value = Some(image("missing.png"));
    let socket = SocketRef::new("gone", "image");
    harness.state_mut().act(Action::edit("Choose", Edit::SetValue { socket, value }));
    settle(&mut harness);
    assert!(tells(&harness, "missing.png could not be read"));
    harness.state_mut().act(Action::edit("Remove", Edit::RemoveNode { id: "text".into() }));
    settle(&mut harness);
    assert!(titles(&harness, "Problems (1)"));
    harness.state_mut().act(Action::edit("Remove", Edit::RemoveNode { id: "gone".into() }));
    settle(&mut harness);
    assert!(!titles(&harness, "Problems ("));
}

#[test]
fn a_change_by_others_is_offered_and_never_overwritten_unasked() {
    let place = Place::new();
    let mut harness = place.open();
    let others = |name: &str| {
        let mut document = place.read();
        document.name = name.to_owned();
        halfvector_graph::file::save(&place.file(), &document).unwrap();
    };
    let offered = |harness: &Harness<'_, Editor>| harness.query_by_label("Reload").is_some();
    others("Theirs");
    wait_for(&mut harness, "the offer", offered);
    click(&mut harness, "Show what changed");
    assert!(harness.query_by_label_contains("“Theirs” instead of “Worn enamel”").is_some());
    click(&mut harness, "Reload");
    assert_eq!(harness.state().session().document().name, "Theirs");
    assert!(!harness.state().session().is_unsaved());

    others("Theirs again");
    wait_for(&mut harness, "the second offer", offered);
    click(&mut harness, "Keep mine");
    assert!(harness.state().session().is_unsaved());
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Theirs");

    harness.state_mut().act(rename("Mine"));
    // Faster than the window looks.
    others("Theirs, unseen");
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Theirs, unseen");
    click(&mut harness, "Overwrite");
    assert_eq!(place.read().name, "Mine");
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn a_file_that_is_gone_is_told_and_its_material_is_unsaved() {
    let place = Place::new();
    let mut harness = place.open();
    assert!(!harness.state().session().is_unsaved());
    std::fs::remove_file(place.file()).unwrap();
    wait_for(&mut harness, "the loss", |harness| harness.state().session().is_unsaved());
    assert!(harness.query_all_by_label_contains("is gone").next().is_some());
    harness.state_mut().act(Action::Save);
    settle(&mut harness);
    assert_eq!(place.read().name, "Worn enamel");
    assert!(!harness.state().session().is_unsaved());
}

#[test]
fn two_windows_on_one_file_notice_each_other() {
    let place = Place::new();
    let mut first = place.open();
    let second = place.open();
    let noticed = |harness: &Harness<'_, Editor>| harness.query_by_label_contains("open in another window").is_some();
    wait_for(&mut first, "the notice", noticed);
    drop(second);
    wait_for(&mut first, "the end of the notice", |harness| !noticed(harness));
}

#[test]
fn settings_of_two_windows_are_kept_together() {
    let place = Place::new();
    let other = place.folder.path().join("other.material.json");
    std::fs::write(&other, START_MATERIAL).unwrap();
    let mut first = place.open();
    let mut second = open(Options { document: Some(other.clone()), folders: place.folders(), ..Options::default() });
    settle(&mut second);
    first.ctx.set_zoom_factor(1.25);
    first.run_steps(2);
    // Each writes at its end what it has changed, and no more.
    drop(first);
    drop(second);
    let text = std::fs::read_to_string(place.folder.path().join("settings/editor.json")).unwrap();
    let settings: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(settings["scale"], 1.25, "{text}");
    let mut recent: Vec<&str> =
        settings["recent"].as_array().unwrap().iter().filter_map(|path| path.as_str()).collect();
    // Which one comes first is a matter of which window wrote last.
    recent.sort_unstable();
    let mut both = [other.to_str().unwrap().to_owned(), place.file().to_str().unwrap().to_owned()];
    both.sort_unstable();
    assert_eq!(recent, both);
}
