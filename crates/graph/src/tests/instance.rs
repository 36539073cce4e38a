//! Instances of materials.

use std::fs;
use std::path::Path;

use crate::document::Document;
use crate::file::{from_json, instance_to_json, load, load_whole, to_json};
use crate::value::Value;

const BASE: &str = r#"{"halfvector": 1, "name": "Paint", "nodes": {
    "map": {"node": "textures/image", "values": {"image": {"file": "maps/a.png", "color_space": "srgb"}}},
    "tint": {"node": "math/multiply", "values": {"b": 2}},
    "surface": {"node": "surface/surface", "values": {"perceptual_roughness": 0.3}}},
  "links": [{"from": "map.color", "to": "tint.a"}, {"from": "tint.out", "to": "surface.base_color"}],
  "parameters": [
    {"name": "roughness", "socket": "surface.perceptual_roughness", "range": [0.1, 0.9]},
    {"name": "picture", "socket": "map.image"}, {"name": "tint", "socket": "tint.b"},
    {"name": "gone", "socket": "nothing.at_all"}]}"#;

/// A folder with the base in a folder of its own, and this file.
fn with(name: &str, text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("base")).expect("a folder");
    fs::write(folder.path().join("base/paint.material.json"), BASE).expect("written");
    fs::write(folder.path().join(name), text).expect("written");
    folder
}

fn instance(set: &str) -> Result<Document, String> {
    let text = format!(r#"{{"halfvector": 1, "name": "Blue", "base": "base/paint.material.json", "set": {{{set}}}}}"#);
    let folder = with("blue.material.json", &text);
    load(&folder.path().join("blue.material.json")).map_err(|e| e.to_string())
}

fn image(document: &Document) -> &str {
    match &document.graph.nodes["map"].values["image"] {
        Value::Image(image) => &image.file,
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_instance_is_its_base_with_other_values() {
    let made = instance(r#""roughness": 0.5, "tint": [1, 0.5, 0.25]"#).expect("an instance");
    let base = from_json(BASE).expect("the base");
    assert_eq!(
        (made.name.as_str(), &made.graph.links, &made.parameters),
        ("Blue", &base.graph.links, &base.parameters)
    );
    assert_eq!(made.graph.nodes["surface"].values["perceptual_roughness"], Value::Number(0.5));
    assert_eq!(made.graph.nodes["tint"].values["b"], Value::Vec3([1.0, 0.5, 0.25]));
    assert_eq!(image(&made), "base/maps/a.png", "the base's picture, from the instance's folder");
    let own = instance(r#""picture": {"file": "mine.png", "color_space": "srgb"}"#).expect("an instance");
    assert_eq!(image(&own), "mine.png", "its own picture, from its own folder");
}

#[test]
fn instances_of_instances() {
    let first = r#"{"halfvector": 1, "base": "../base/paint.material.json", "set": {"roughness": 0.5, "tint": 3}}"#;
    let folder =
        with("last.material.json", r#"{"halfvector": 1, "base": "b/first.material.json", "set": {"tint": 4}}"#);
    fs::create_dir(folder.path().join("b")).expect("a folder");
    fs::write(folder.path().join("b/first.material.json"), first).expect("written");
    let whole = load_whole(&folder.path().join("last.material.json")).expect("an instance");
    assert!(whole.instance.is_some() && whole.bytes.starts_with(b"{\"halfvector\": 1, \"base\": \"b/"));
    let made = whole.document;
    assert_eq!((made.name.as_str(), image(&made)), ("Paint", "b/../base/maps/a.png"));
    assert_eq!(made.graph.nodes["surface"].values["perceptual_roughness"], Value::Number(0.5));
    assert_eq!(made.graph.nodes["tint"].values["b"], Value::Number(4.0), "the outer one decides");
    assert!(load_whole(&folder.path().join("base/paint.material.json")).expect("the base").instance.is_none());
}

#[test]
fn an_instance_holds_changed_values_and_nothing_else() {
    let text = r#"{"halfvector": 1, "base": "base/paint.material.json", "set": {"tint": 3}}"#;
    let folder = with("red.material.json", text);
    let path = folder.path().join("red.material.json");
    let read = load_whole(&path).expect("an instance");
    let instance = read.instance.expect("an instance");
    assert_eq!(instance.changed(&read.document, &read.document), Some(instance.clone()));

    let mut now = read.document.clone();
    now.name = "Red".to_owned();
    let set = |document: &mut Document, node: &str, socket: &str, value: f32| {
        document.graph.nodes.get_mut(node).expect("a node").values.insert(socket.to_owned(), Value::Number(value));
    };
    set(&mut now, "surface", "perceptual_roughness", 0.25);
    set(&mut now, "tint", "b", 2.0);
    now.graph.layout.insert("tint".to_owned(), [4.0, 5.0]);
    let changed = instance.changed(&read.document, &now).expect("values alone");
    fs::write(&path, instance_to_json(&changed)).expect("written");
    let again = load_whole(&path).expect("an instance");
    assert_eq!(again.instance.as_ref(), Some(&changed));
    now.graph.layout.clone_from(&again.document.graph.layout);
    assert_eq!(again.document, now);

    set(&mut now, "surface", "metallic", 1.0);
    assert_eq!(instance.changed(&read.document, &now), None, "no parameter of the base");

    let newer = text.replace("1, ", "99, \"later\": [1], ");
    fs::write(&path, newer).expect("written");
    let read = load_whole(&path).expect("an instance");
    let text = instance_to_json(&read.instance.expect("an instance"));
    assert!(text.contains("\"halfvector\": 99") && text.contains("\"later\": [1]"), "{text}");
}

#[test]
fn what_is_wrong_with_an_instance_is_told() {
    for (set, parts) in [
        (r#""rougness": 0.5"#, ["set.rougness", "did you mean `roughness`?"]),
        (r#""zzz": 0.5"#, ["set.zzz", "roughness, picture, tint, gone"]),
        (r#""roughness": [1, 0, 0]"#, ["set.roughness", "a number, such as 0.5"]),
        (r#""roughness": true"#, ["set.roughness", "the value is true"]),
        (r#""roughness": "nan""#, ["set.roughness", "a f32 is wanted"]),
        (r#""roughness": 0.95"#, ["set.roughness: 0.95 is out of the range", "0.1 to 0.9"]),
        (r#""picture": 1"#, ["set.picture", "a picture, such as"]),
        (r#""gone": 1"#, ["set.gone", "`nothing.at_all`, which is no input"]),
    ] {
        let why = instance(set).expect_err(set);
        assert!(parts.iter().all(|part| why.contains(part)) && why.contains("blue.material.json"), "{set}: {why}");
    }
    let told = |text: &str| {
        let folder = with("a.material.json", text);
        let back = r#"{"halfvector": 1, "base": "a.material.json"}"#;
        fs::write(folder.path().join("b.material.json"), back).expect("written");
        load(&folder.path().join("a.material.json")).expect_err(text).to_string()
    };
    let why = told(r#"{"halfvector": 1, "base": "lost.material.json"}"#);
    assert!(
        why.contains("a.material.json: its base:") && why.contains("lost.material.json could not be read"),
        "{why}"
    );
    let why = told(r#"{"halfvector": 1, "base": "b.material.json"}"#);
    assert!(why.contains("an instance of itself") && why.matches("a.material.json").count() >= 2, "{why}");
    assert!(told(r#"{"halfvector": 1, "base": "a.material.json"}"#).contains("an instance of itself"));
    let why = told(r#"{"halfvector": 1, "base": "b.material.json", "nodes": {}}"#);
    assert!(why.contains("at nodes:") && why.contains("name, base and set"), "{why}");
    let why = told(r#"{"halfvector": 1, "set": {}}"#);
    assert!(why.contains("`base`"), "{why}");
    let why = from_json(r#"{"halfvector": 1, "base": "x.json"}"#).expect_err("no folder").to_string();
    assert!(why.contains("instance of `x.json`"), "{why}");
}

#[test]
fn a_long_row_of_instances_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |i: usize| folder.path().join(format!("{i}.material.json"));
    for i in 0..40 {
        fs::write(file(i), format!(r#"{{"halfvector": 1, "base": "{}.material.json"}}"#, i + 1)).expect("written");
    }
    fs::write(file(40), BASE).expect("written");
    let why = load(&file(0)).expect_err("too many").to_string();
    assert!(why.contains("32 instances"), "{why}");
    load(&file(9)).expect("31 of them");
    assert!(Path::new(&file(40)).exists());
}

/// A folder in the place of the base, and no name: neither is opened.
#[test]
fn a_base_is_a_stored_file() {
    let why = |base: &str| {
        let folder = with("a.material.json", &format!(r#"{{"halfvector": 1, "base": {base:?}}}"#));
        load(&folder.path().join("a.material.json")).expect_err("a refusal").to_string()
    };
    assert!(why("base").contains("it is no file that is stored"), "{}", why("base"));
    assert!(why("").contains("it names no file"), "{}", why(""));
}

/// What a newer version wrote beside is kept when what the instance stands for is saved, and its version is told; what cannot be joined with
/// the base is refused with the field and the version.
#[test]
fn instances_of_a_newer_version_lose_nothing() {
    let loaded = |text: &str| {
        let folder = with("new.material.json", text);
        load(&folder.path().join("new.material.json")).map_err(|e| e.to_string())
    };
    let text = r#"{"halfvector": 9, "base": "base/paint.material.json", "set": {"roughness": 0.5},
        "wear": {"amount": 0.25}, "tags": ["blue"]}"#;
    let made = loaded(text).expect("an instance");
    assert_eq!((made.version, made.unknown.len()), (9, 2));
    let saved = to_json(&made);
    assert!(saved.contains("\"halfvector\": 9") && saved.contains("\"wear\": {\"amount\": 0.25}"), "{saved}");
    assert_eq!(from_json(&saved).expect("a document"), made);
    let problems = crate::check::check(&made, crate::library::Library::standard());
    for part in ["format 9", "`wear`", "`tags`"] {
        assert!(problems.iter().any(|problem| problem.message.contains(part)), "{part}: {problems:?}");
    }
    for (field, place) in [
        (r#""nodes": {}"#, "at nodes:"),
        (r#""parameters": []"#, "at parameters:"),
        (r#""set": {"roughness": {"curve": [0, 1]}}"#, "at set.roughness.curve:"),
        (r#""set": [1]"#, "at set:"),
    ] {
        let why =
            loaded(&format!(r#"{{"halfvector": 9, "base": "base/paint.material.json", {field}}}"#)).expect_err(field);
        assert!(why.contains(place) && why.contains("format 9, this program knows up to 1"), "{field}: {why}");
    }
}

/// Its own picture is named from the folder of the instance that sets it, and a way from the root stays.
#[test]
fn pictures_of_instances_of_instances_are_found() {
    let picture = r#""picture": {"file": "own.png", "color_space": "srgb"}"#;
    let first = format!(r#"{{"halfvector": 1, "base": "../base/paint.material.json", "set": {{{picture}}}}}"#);
    let folder = with("last.material.json", r#"{"halfvector": 1, "base": "b/first.material.json"}"#);
    fs::create_dir(folder.path().join("b")).expect("a folder");
    let last = folder.path().join("last.material.json");
    fs::write(folder.path().join("b/first.material.json"), first).expect("written");
    assert_eq!(image(&load(&last).expect("an instance")), "b/own.png");
    let base = folder.path().join("base/paint.material.json");
    let text = format!(r#"{{"halfvector": 1, "base": {:?}}}"#, base.display().to_string());
    fs::write(folder.path().join("b/first.material.json"), text).expect("written");
    let found = image(&load(&last).expect("an instance")).to_owned();
    assert_eq!(Path::new(&found), folder.path().join("base/maps/a.png"));
}

#[test]
fn large_instances_are_refused() {
    let text = format!(r#"{{"halfvector": 1, "base": "base/paint.material.json"{}}}"#, " ".repeat(300 << 10));
    let folder = with("large.material.json", &text);
    let why = load(&folder.path().join("large.material.json")).expect_err("too large").to_string();
    assert!(why.contains("256 KiB"), "{why}");
}
