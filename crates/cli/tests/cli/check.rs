//! `halfvector check`: problems, the cost of nodes, what f32 gets wrong.

use std::path::Path;

use crate::Folder;

#[test]
fn check_tells_all_problems() {
    let folder = Folder::new();
    folder.write(
        "bad.material.json",
        r#"{"halfvector": 1, "name": "bad", "nodes": {
            "surface": {"node": "surface/surface", "label": "Skin", "values": {"metallic": [1, 2], "shine": 3}},
            "what": {"node": "math/nothing"}},
          "links": [{"from": "what.out", "to": "surface.base_color"}]}"#,
    );
    let sound = folder.run(&["check", "plain.material.json"]).ends(0);
    assert_eq!(sound.stdout.trim(), "no problems");
    let empty = folder.run(&["check", "plain.material.json", "--format", "json"]).ends(0).json();
    assert_eq!(empty, serde_json::json!({ "problems": [] }));

    let text = folder.run(&["check", "plain.material.json", "bad.material.json"]).ends(3).stdout;
    for words in ["bad.material.json", "Skin", "metallic", "shine", "math/nothing"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let run = folder.run(&["check", "bad.material.json", "--format", "json"]).ends(3);
    let problems = run.json();
    let problems = problems["problems"].as_array().expect("a list");
    assert!(problems.len() >= 3, "{problems:?}");
    assert!(problems.iter().any(|p| p["node"] == "surface" && p["node_label"] == "Skin" && p["socket"] == "metallic"));

    folder.write("cut.material.json", "{");
    let cut = folder.run(&["check", "cut.material.json", "bad.material.json", "--format", "json"]).ends(1);
    assert!(cut.json()["problems"].as_array().is_some_and(|list| list.len() > problems.len()));
}

/// What is said of many nodes alike is said of some, and the others are counted.
#[test]
fn equal_warnings_are_summed_up() {
    let folder = Folder::new();
    let dead: String = (0..49_000).map(|i| format!(r#","dead{i}": {{"node": "math/sin"}}"#)).collect();
    folder.write(
        "dead.material.json",
        &format!(
            r#"{{"halfvector": 1, "name": "dead", "nodes": {{"surface": {{"node": "surface/surface"}}{dead}}}, "links": []}}"#
        ),
    );
    let text = folder.run(&["check", "--cost", "dead.material.json"]).ends(0).stdout;
    let lines: Vec<_> = text.lines().filter(|line| line.contains("warning: ")).collect();
    assert_eq!(lines.len(), 22, "{text}");
    assert!(lines[20].contains("there are 39000 more warnings"), "{text}");
    assert!(lines[21].contains("of 9980 nodes more: the node does not reach the surface"), "{text}");
    let all = folder.run(&["check", "dead.material.json", "--format", "json"]).ends(0).json();
    assert_eq!(all["problems"].as_array().map(Vec::len), Some(10_001));
}

/// Constants that compute no number are told at their node, like every other problem.
#[test]
fn a_constant_that_is_no_number_is_told_at_its_node() {
    let folder = Folder::new();
    folder.write(
        "log.material.json",
        r#"{"halfvector": 1, "name": "log", "nodes": {"surface": {"node": "surface/surface"},
            "part": {"node": "math/multiply", "label": "Part", "values": {"a": 1e38, "b": 1e38}}},
          "links": [{"from": "part.out", "to": "surface.metallic"}]}"#,
    );
    let text = folder.run(&["check", "log.material.json"]).ends(3).stdout;
    assert_eq!(text.matches("error: ").count(), 1, "{text}");
    assert!(text.starts_with("log.material.json: error: \u{201c}Part\u{201d} (part): "), "{text}");
    let json = folder.run(&["check", "--format", "json", "log.material.json"]).ends(3).json();
    assert!(json["problems"][0]["node"] == "part" && json["problems"][0]["node_label"] == "Part", "{json}");
}

/// A link to a node that is not there is no shader without what it was to feed.
#[test]
fn a_link_to_nothing_is_an_error() {
    let folder = Folder::new();
    folder.write(
        "slip.material.json",
        r#"{"halfvector": 1, "name": "slip", "nodes": {"surface": {"node": "surface/surface"},
            "grain": {"node": "procedural/value_noise_2d"}},
          "links": [{"from": "grain.out", "to": "surfcae.metallic"}]}"#,
    );
    let text = folder.run(&["check", "slip.material.json"]).ends(3).stdout;
    assert!(text.contains("error: surfcae, metallic: a link from grain.out leads to `surfcae.metallic`"), "{text}");
    folder.run(&["export", "slip.material.json", "--target", "wgsl", "-o", "x"]).ends(1).says("surfcae.metallic");
    assert!(!folder.path("x").exists(), "nothing is written");
}

#[test]
fn the_cost_of_nodes_is_told() {
    let folder = Folder::new();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    std::fs::copy(examples.join("custom-wgsl.material.json"), folder.path("own.material.json")).expect("copied");
    let text = folder.run(&["check", "--cost", "own.material.json"]).ends(0).stdout;
    assert!(text.contains("cost, estimated: each pixel ") && text.contains("`Tartan` (tartan): "), "{text}");
    let json = folder.run(&["check", "--cost", "--format", "json", "own.material.json"]).ends(0).json();
    let cost = &json["cost"][0];
    let node = &cost["nodes"].as_array().expect("nodes")[0];
    assert!(node["node"] == "colors" || node["node"] == "tartan", "{node}");
    assert!(cost["fragment_total"].as_u64() > node["total"].as_u64(), "{cost}");
    assert!(cost["per_turn"].is_boolean() && node["per_turn"].is_boolean(), "{cost}");
    // A time where there is a device with a clock, a reason where there is none: one of the two.
    let is_needed = std::env::var("HALFVECTOR_REQUIRE_GPU").as_deref() == Ok("1");
    assert!(cost["measured"].is_object() || !is_needed, "{cost}");
    let measured = text.contains("cost, measured: each pixel ") && text.contains(" ns (spread ");
    assert_eq!(measured, cost["measured"].is_object(), "{text}{cost}");
    for one in cost["nodes"].as_array().into_iter().flatten().chain([cost]) {
        assert_ne!(one["measured"].is_object(), one["not_measured"].is_string(), "{one}");
        let time = &one["measured"];
        assert!(time.is_null() || time["ns"].as_f64() > Some(0.0) && time["spread"].as_f64() >= Some(0.0), "{one}");
    }
    assert!(cost["measured"].is_null() || cost["measured"]["device"].is_string(), "{cost}");

    // Of many nodes the costliest are listed.
    let sine = |i: usize| format!(r#""n{i}": {{"node": "math/sin"}}"#);
    let link = |i: usize| format!(r#"{{"from": "n{i}.out", "to": "n{}.x"}}"#, i + 1);
    folder.write(
        "many.material.json",
        &format!(
            r#"{{"halfvector": 1, "name": "many", "nodes": {{"grain": {{"node": "procedural/value_noise_2d"}},
                "surface": {{"node": "surface/surface"}}, {}}},
              "links": [{}, {{"from": "grain.out", "to": "n0.x"}}, {{"from": "n29.out", "to": "surface.metallic"}}]}}"#,
            (0..30).map(sine).collect::<Vec<_>>().join(","),
            (0..29).map(link).collect::<Vec<_>>().join(",")
        ),
    );
    let text = folder.run(&["check", "--cost", "many.material.json"]).ends(0).stdout;
    assert_eq!(text.lines().count(), 23, "{text}");
    assert!(text.contains("(grain): ") && text.contains("cost: 11 nodes more: 11 instructions together"), "{text}");
    let json = folder.run(&["check", "--cost", "--format", "json", "many.material.json"]).ends(0).json();
    assert_eq!(json["cost"][0]["nodes"].as_array().map(Vec::len), Some(31));
}

/// The estimate needs no device, and says in words why nothing is measured.
#[test]
fn the_cost_is_told_without_a_device() {
    let folder = Folder::new();
    let run = |more: &[&str]| {
        let arguments = [&["check", "--cost", "plain.material.json"], more].concat();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_halfvector"))
            .args(&arguments)
            .current_dir(folder.path(""))
            // No adapter has this name.
            .env("WGPU_ADAPTER_NAME", "no such adapter")
            .output()
            .expect("the program starts");
        crate::Run::new(&arguments, &output).ends(0)
    };
    let text = run(&[]).stdout;
    assert!(text.contains("cost, estimated: ") && text.contains("cost, not measured: no GPU was found"), "{text}");
    let cost = &run(&["--format", "json"]).json()["cost"][0];
    assert!(cost["measured"].is_null() && cost["fragment_total"].as_u64() > Some(0), "{cost}");
    assert!(cost["not_measured"].as_str().is_some_and(|why| why.contains("no GPU was found")), "{cost}");
}

#[test]
fn what_f32_gets_wrong_is_found_and_named() {
    let folder = Folder::new();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/unstable");
    std::fs::copy(examples.join("cancellation.material.json"), folder.path("wrong.material.json")).expect("copied");
    let run = folder.run(&["check", "--stability", "plain.material.json"]).ends(0);
    assert_eq!(run.stdout, "no problems\n");
    let steps = r#"{"halfvector": 1, "name": "Steps", "nodes": {"checker": {"node": "procedural/checker"}, "surface": {"node": "surface/surface"}},
        "links": [{"from": "checker.out", "to": "surface.metallic"}]}"#;
    std::fs::write(folder.path("steps.material.json"), steps).expect("written");
    let run = folder.run(&["check", "--stability", "steps.material.json"]).ends(0);
    assert!(
        run.stdout.starts_with("steps.material.json: edges") && run.stdout.contains("\nno problems: edges are"),
        "{}",
        run.stdout
    );
    folder.run(&["check", "wrong.material.json"]).ends(0);
    let run = folder.run(&["check", "--stability", "wrong.material.json"]).ends(3);
    assert!(run.stdout.starts_with("wrong.material.json: unstable in f32:\n  node "), "{}", run.stdout);
    assert!(run.stdout.contains("\n  `Back again`  culprit.out  "), "{}", run.stdout);
    // Only what the node reads.
    let place = run.stdout.lines().find(|line| line.starts_with("    at ")).unwrap_or_default();
    assert!(place.starts_with("    at uv0.x = ") && !place.contains(','), "{}", run.stdout);
    let run = folder.run(&["check", "--stability", "--format", "json", "wrong.material.json"]).ends(3);
    let json = run.json();
    assert_eq!(json["unstable"][0]["node"], "culprit");
    assert!(json["edges"].is_array() && json["problems"].is_array() && json["f16"].is_null());
    let run = folder.run(&["check", "--stability", "--f16", "--format", "json", "wrong.material.json"]).ends(3);
    let json = run.json();
    // A million is too large for f16: it goes wrong a node earlier. JSON has no infinity.
    let half = &json["f16"]["unstable"][0];
    assert!(half["node"] == "far" && half["f16"].is_null() && half["not_finite"].as_u64() > Some(0), "{json}");
    assert!(json["f16"]["edges"].is_array());
    let run = folder.run(&["check", "--stability", "--f16", "wrong.material.json"]).ends(3);
    assert!(run.stdout.contains("unstable in f32") && run.stdout.contains("unstable in f16"), "{}", run.stdout);
    folder.run(&["check", "--f16", "wrong.material.json"]).ends(2);
    // A message of a file that cannot be read is one line.
    std::fs::write(folder.path("cut.material.json"), "{\n").expect("written");
    let json = folder.run(&["check", "--format", "json", "cut.material.json"]).ends(1).json();
    let message = json["problems"][0]["message"].as_str().unwrap_or_default();
    assert!(message.contains("line 2") && !message.contains('\n'), "{json}");
    let run = folder.run(&["check", "--stability", "--format", "json", "steps.material.json"]).ends(0);
    let edge = &run.json()["edges"][0];
    assert!(edge["node"] == "checker" && edge["from"] != edge["to"] && edge["input"].is_object(), "{edge}");
}
