//! Documents as text.

use proptest::prelude::*;

use super::{any_document, document, link};
use crate::document::{Document, Node, Rect};
use crate::file::{FileError, from_json, load, replace, save, to_json};
use crate::value::Value;

const RUST: &str = r##"{
  "halfvector": 1,
  "name": "Rust \"old\" 錆",
  "nodes": {
    "mask": {"node": "procedural/value_noise", "values": {"scale": 4, "seed": -0.25}},
    "rust": {"node": "textures/image", "label": "Rust", "values": {"image": {"file": "t/rust.png", "color_space": "srgb", "wrap_u": "mirror", "filter": "nearest"}, "tint": [1, 0.5, 1e-8]}, "color": "#ff0000"},
    "surface": {"node": "surface/surface", "values": {"double": true}}
  },
  "links": [
    {"from": "rust.color", "to": "surface.base_color"},
    {"from": "mask.out", "to": "surface.perceptual_roughness", "curved": true}
  ],
  "parameters": [
    {"name": "metallic", "socket": "surface.metallic", "label": "Metal", "range": [0, 1], "hidden": false},
    {"name": "ior", "socket": "surface.ior"}
  ],
  "surface": {"alpha_mode": "mask", "alpha_cutoff": 0.25, "double_sided": false, "shadow": "none"},
  "groups": {
    "band": {
      "label": "Band 帯",
      "help": "Two\nlines.",
      "inputs": [
        {"name": "x", "type": "f32", "label": "X", "default": 0.5, "range": [0, 1], "help": "where", "folded": true},
        {"name": "uv", "type": "vec2f", "context": "uv0"},
        {"name": "tint", "type": "vec3f", "default": [1, 0, 0], "unit": "color"},
        {"name": "picture", "type": "texture", "color_space": "linear"}
      ],
      "outputs": [
        {"name": "out", "type": "f32", "help": "the band", "folded": true}
      ],
      "nodes": {
        "in": {"node": "group/input"},
        "output": {"node": "group/output", "values": {"out": 1}}
      },
      "links": [
        {"from": "in.x", "to": "output.out"}
      ],
      "layout": {
        "in": [0, 1]
      },
      "frames": {
        "f": {"title": "", "rect": [0, 0, 10, 10]}
      },
      "author": "x"
    },
    "empty": {
      "inputs": [],
      "outputs": [],
      "nodes": {},
      "links": []
    }
  },
  "functions": {
    "stripes": [
      "/// Stripes",
      "fn f() -> f32 { return 1.0; }",
      ""
    ]
  },
  "layout": {
    "mask": [-10, 0.5],
    "rust": [0, 0]
  },
  "frames": {
    "f1": {"title": "weathering 風", "color": "#0a80ff", "rect": [-20, 0.5, 300, 200], "folded": true}
  },
  "comments": {
    "c1": {"text": "see\nthe photo", "rect": [0, 0, 120, 40], "pinned": false}
  },
  "colours": [{"title": "weathering"}]
}
"##;

/// A file of a later version, in which most things have another shape.
const NEWER: &str = r#"{
  "halfvector": 3,
  "name": "Later",
  "nodes": {
    "group": {"graph": {"nodes": {}}},
    "note": "a comment",
    "rust": {"node": "textures/image", "label": {"de": "Rost"}, "values": {"image": {"url": "x"}, "tint": {"curve": [0, 1]}, "u": 2}},
    "surface": {"node": "surface/surface", "values": ["compact"]}
  },
  "links": [
    {"from": "rust.color", "to": "surface.base_color"},
    {"bundle": ["a", "b"]}
  ],
  "parameters": [
    {"name": "metallic", "socket": "surface.metallic", "range": {"curve": 2}}
  ],
  "surface": {"alpha_mode": "hashed", "alpha_cutoff": 0.5, "double_sided": true},
  "groups": {
    "later": {"wasm": "AGFzbQ"}
  },
  "layout": {
    "group": {"x": 1},
    "rust": [1, 2]
  },
  "frames": [1, 2],
  "comments": {
    "a": {"svg": []},
    "b": {"text": {"de": "ja"}, "rect": [0, 0, 1, 1]}
  }
}
"#;

#[test]
fn files_come_back_as_they_were() {
    for text in [RUST, NEWER] {
        let document = from_json(text).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(to_json(&document), text);
    }
    let d = from_json(RUST).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((d.graph.nodes.len(), d.graph.links.len(), d.parameters.len(), d.graph.layout.len()), (3, 2, 2, 2));
    assert_eq!(d.graph.frames["f1"].color, Some([10, 128, 255]));
    assert_eq!(d.graph.frames["f1"].rect, Rect { position: [-20.0, 0.5], size: [300.0, 200.0] });
    assert_eq!(d.graph.comments["c1"].text, "see\nthe photo");
    assert_eq!(d.functions["stripes"], "/// Stripes\nfn f() -> f32 { return 1.0; }\n");
    let band = &d.groups["band"];
    assert_eq!((band.interface.inputs.len(), band.interface.outputs[0].name.as_str()), (4, "out"));
    assert_eq!(band.graph.links, [link("in.x", "output.out")]);
    assert_eq!(d.graph.nodes["rust"].values["tint"], Value::Vec3([1.0, 0.5, 1e-8]));
    assert_eq!(from_json(NEWER).unwrap_or_else(|e| panic!("{e}")).version, 3);
}

#[test]
fn what_is_kept_goes_with_what_it_belongs_to() {
    let mut d = from_json(RUST).unwrap_or_else(|e| panic!("{e}"));
    d.graph.links.pop();
    d.parameters.remove(0);
    let text = to_json(&d);
    assert!(!text.contains("curved") && !text.contains("hidden") && text.contains("shadow"), "{text}");
}

#[test]
fn a_plain_document_is_short() {
    let text = to_json(&Document::with_surface("x"));
    assert_eq!(
        text,
        "{\n  \"halfvector\": 1,\n  \"name\": \"x\",\n  \"nodes\": {\n    \"surface\": {\"node\": \"surface/surface\"}\n  },\n  \"links\": []\n}\n"
    );
}

#[test]
fn moving_one_node_changes_one_line() {
    let before = from_json(RUST).unwrap_or_else(|e| panic!("{e}"));
    let mut after = before.clone();
    after.graph.layout.insert("rust".into(), [3.0, 4.0]);
    let (before, after) = (to_json(&before), to_json(&after));
    assert_eq!(before.lines().zip(after.lines()).filter(|(a, b)| a != b).count(), 1);
}

#[test]
fn errors_name_line_column_and_remedy() {
    let cases: &[(&str, &str, &str)] = &[
        ("\"halfvector\": 1,", "", "line 1, column 1, at the document: the field `halfvector`"),
        ("\"halfvector\": 1,", "\"halfvector\": 0,", "line 2, column 17, at halfvector: "),
        ("\"name\": \"Rust", "\"name\": \"a\", \"name\": \"Rust", "line 3, column 16: `name` stands twice"),
        ("\"node\": \"textures/image\", ", "", "line 6, column 5, at nodes.rust: the field `node` is missing"),
        ("\"label\": \"Rust\"", "\"label\": 3", "at nodes.rust.label: a text in \" is needed, not a number"),
        ("[1, 0.5, 1e-8]", "[1]", "at nodes.rust.values.tint: a vector has 2, 3 or 4 numbers, not 1"),
        ("[1, 0.5, 1e-8]", "null", "at nodes.rust.values.tint: a value is a number"),
        ("[1, 0.5, 1e-8]", "1e999", "the number is too large"),
        ("\"color_space\": \"srgb\"", "\"color_space\": \"rec709\"", "\"rec709\" is none of \"srgb\", \"linear\""),
        ("\"color_space\": \"srgb\", ", "", "the image's field `color_space` is missing"),
        ("\"rust.color\"", "\"color\"", "at links[0].from: \"color\" names no socket; write it as \"node.socket\""),
        (
            "\"to\": \"surface.base_color\"",
            "\"too\": 1",
            "line 10, column 5, at links[0]: the link's field `to` is missing",
        ),
        ("\"range\": [0, 1]", "\"range\": [0]", "at parameters[0].range: two numbers are needed"),
        ("\"mask\", \"alpha_cutoff\"", "\"cut\", \"alpha_cutoff\"", "at surface.alpha_mode: \"cut\" is none of"),
        ("\"nodes\"", "\"nodez\"", "the field `nodes` is missing"),
        ("#0a80ff", "blue", "at frames.f1.color: \"blue\" is no colour; write it as \"#rrggbb\""),
        ("[0, 0, 120, 40]", "[0, 0]", "at comments.c1.rect: four numbers are needed"),
        ("\"type\": \"vec2f\"", "\"type\": \"mat3\"", "at groups.band.inputs[1].type: \"mat3\" is none of"),
        ("\"in.x\"", "\"x\"", "at groups.band.links[0].from: \"x\" names no socket"),
        ("\"nodes\": {},", "", "at groups.empty: the group's field `nodes` is missing"),
        ("  ],\n  \"parameters\"", "  \"parameters\"", "a , or ] is missing: `\"` stands here"),
    ];
    for (old, new, part) in cases {
        assert!(RUST.contains(old), "{old}");
        match from_json(&RUST.replacen(old, new, 1)) {
            Ok(_) => panic!("{new} was accepted"),
            Err(e) => assert!(e.to_string().contains(part), "{new}: wanted {part}, got {e}"),
        }
    }
    let mark = format!("\u{feff}{RUST}");
    assert!(from_json(&mark).is_ok(), "a byte order mark is no error");
}

proptest! {
    #[test]
    fn any_document_is_written_and_read(document in any_document()) {
        let text = to_json(&document);
        let back = from_json(&text).map_err(|e| TestCaseError::fail(format!("{e}\n{text}")))?;
        prop_assert_eq!(to_json(&back), text);
        prop_assert_eq!(back.graph.links, document.graph.links);
    }

    #[test]
    fn damaged_files_are_survived(cut in 0..RUST.len() + NEWER.len(), with in "\\PC{0,3}", drop in 0..9usize) {
        let all = [RUST, NEWER].concat();
        let (text, at) = if cut < RUST.len() { (RUST, cut) } else { (&all[RUST.len()..], cut - RUST.len()) };
        let at = (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
        let end = (at + drop..=text.len()).find(|&i| text.is_char_boundary(i)).unwrap_or(text.len());
        let _ = from_json(&text[..at]);
        let damaged = format!("{}{with}{}", &text[..at], &text[end..]);
        if let Ok(document) = from_json(&damaged) {
            let written = to_json(&document);
            let again = from_json(&written).map_err(|e| TestCaseError::fail(format!("{e}\n{written}")))?;
            prop_assert_eq!(to_json(&again), written);
        }
    }

    /// What a newer version may write: nothing of it is lost.
    #[test]
    fn newer_files_lose_nothing(path in 0..6usize, odd in r#"(1|"x"|null|true|\[1, 2, 3, 4, 5\]|\{"y": \[\{\}\]\})"#) {
        let spots = ["\"u\": 2}", "\"a comment\"", "{\"bundle\": [\"a\", \"b\"]}", "{\"curve\": 2}", "{\"x\": 1}", "{\"de\": \"Rost\"}"];
        let new = if path == 0 { format!("\"u\": 2, \"z\": {odd}}}") } else { odd };
        let text = NEWER.replacen(spots[path], &new, 1);
        prop_assert_ne!(&text, NEWER);
        let document = from_json(&text).map_err(|e| TestCaseError::fail(format!("{e}\n{text}")))?;
        let plain = |text: &str| serde_json::from_str::<serde_json::Value>(text).expect("JSON");
        prop_assert_eq!(plain(&to_json(&document)), plain(&text));
    }
}

#[test]
fn saving_replaces_the_file_in_one_step() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("a.material.json");
    let first = document(&[("m", "math/mix")], &[("m.out", "surface.height")]);
    save(&path, &first)?;
    assert_eq!(load(&path)?, first);
    let mut second = first.clone();
    second.graph.nodes.insert("n".into(), Node::new("math/mix"));
    save(&path, &second)?;
    assert_eq!(load(&path)?, second);
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 1, "no temporary file is left");
    // A folder stands where the file should: the error comes, and nothing is left behind.
    let taken = folder.path().join("folder");
    std::fs::create_dir(&taken)?;
    std::fs::write(taken.join("inside"), "x")?;
    assert!(replace(&taken, b"x").is_err());
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 2);
    assert!(matches!(load(&folder.path().join("gone")), Err(FileError::Read { .. })));
    std::fs::write(&path, b"{\n\xff")?;
    assert!(load(&path).is_err_and(|e| e.to_string().contains("line 2: the bytes are no UTF-8")));
    Ok(())
}

/// A socket, for a device could be lost: both are no files, and keep their names.
#[cfg(unix)]
#[test]
fn what_is_no_file_keeps_its_name() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("socket");
    let _socket = std::os::unix::net::UnixListener::bind(&path).expect("a socket");
    assert!(replace(&path, b"x").is_err());
    assert!(std::fs::metadata(&path).expect("still there").file_type().is_socket());
}
