//! `halfvector export --max-error` and `--explain`: need no GPU.

use serde_json::{Value, json};

use crate::{Folder, Run};

/// A rough metal: compensation matters, and nothing is diffuse.
const METAL: &str = r#"{"halfvector": 1, "name": "metal",
  "nodes": {"surface": {"node": "surface/surface",
    "values": {"base_color": [0.9, 0.7, 0.4], "metallic": 1, "perceptual_roughness": 0.7}}}, "links": []}"#;

fn export(folder: &Folder, output: &str, more: &[&str]) -> Run {
    folder.run(&[&["export", "metal.material.json", "--target", "wgsl", "-o", output], more].concat())
}

fn chosen(explained: &Value, term: &str) -> String {
    let chosen = explained["budget"]["chosen"].as_array().expect("a list");
    let of_term = chosen.iter().find(|choice| choice["term"] == term).unwrap_or_else(|| panic!("{term}: {explained}"));
    of_term["method"].as_str().expect("a name").to_owned()
}

/// A generous error is kept by the cheapest methods; one that nothing keeps is refused with the smallest that is kept, and that
/// one is kept indeed, by dearer methods.
#[test]
fn the_cheapest_choice_within_an_error_is_taken() {
    let folder = Folder::new();
    folder.write("metal.material.json", METAL);
    let generous = export(&folder, "generous", &["--max-error", "5", "--explain"]).ends(0);
    let explained = generous.json();
    // By the table the cheapest of each.
    for (term, method) in [("v", "kelemen"), ("compensation", "none")] {
        assert_eq!(chosen(&explained, term), method, "{explained}");
    }
    let reached = &explained["budget"]["reached"];
    let at_most = reached["studio"]["at_most"].as_f64().expect("a number");
    assert!(at_most <= 5.0 && reached["lamp"]["error"].as_f64().is_some_and(|error| error > 0.01), "{reached}");
    assert_eq!(explained["budget"]["kept"], serde_json::json!(["fresnel=schlick"]), "its figures are a dielectric's");
    assert!(explained["methods"]["v"] == "kelemen" && explained["instructions"]["fragment"].as_u64() > Some(20));

    let text = std::fs::read_to_string(folder.path("generous/metal.wgsl")).expect("the shader");
    for words in ["// budget: error 5 is kept: under studio ", "// chosen: v=kelemen (error ", "kept: fresnel=schlick"]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(text.contains("v_kelemen(") && !text.contains("energy_compensation"), "{text}");
    export(&folder, "again", &["--max-error", "5"]).ends(0);
    for name in ["metal.wgsl", "metal.json"] {
        let bytes = |output: &str| std::fs::read(folder.path(&format!("{output}/{name}"))).expect("a file");
        assert!(bytes("generous") == bytes("again"), "{name}: the same input, the same bytes");
    }

    let refused = export(&folder, "refused", &["--max-error", "1e-6"]).ends(1).says("no choice of methods");
    assert!(!folder.path("refused").exists());
    let words = "the smallest that can be reached is ";
    let smallest =
        refused.stderr.split(words).nth(1).and_then(|rest| rest.split_whitespace().next()).expect("a number");
    assert!(smallest.parse::<f64>().is_ok_and(|error| error > 1e-4 && error < 0.5), "{smallest}");
    let tight = export(&folder, "tight", &["--max-error", smallest, "--explain"]).ends(0).json();
    assert_ne!(chosen(&tight, "compensation"), "none", "{tight}");
    let at_most = tight["budget"]["reached"]["studio"]["at_most"].as_f64();
    assert!(at_most.zip(smallest.parse().ok()).is_some_and(|(reached, asked)| reached <= asked), "{tight}");
}

/// What the diffuse part means is Lambert's reflection unless another is named: then no model stands between the choice and the error.
#[test]
fn a_diffuse_model_is_kept_and_true() {
    let folder = Folder::new();
    let matt = r#"{"halfvector": 1, "name": "matt", "nodes": {"surface": {"node": "surface/surface",
        "values": {"base_color": [0.8, 0.8, 0.8], "specular": 0, "perceptual_roughness": 0.9}}}, "links": []}"#;
    folder.write("metal.material.json", matt);
    let budget = |output: &str, more: &[&str]| -> Value {
        let arguments = [&["--max-error", "5", "--explain"], more].concat();
        export(&folder, output, &arguments).ends(0).json()["budget"].clone()
    };
    let (own, named) = (budget("own", &[]), budget("named", &["--method", "diffuse=lambert"]));
    let at_most = |budget: &Value| budget["reached"]["studio"]["at_most"].as_f64().expect("a number");
    for budget in [&own, &named] {
        assert!(budget["kept"].as_array().is_some_and(|kept| kept.contains(&"diffuse=lambert".into())), "{budget}");
        assert!(
            at_most(budget) < 0.06,
            "an environment's irradiance is Lambert's own, but for the truth's noise: {budget}"
        );
    }
    assert_eq!(own["reached"], named["reached"]);
    // Another model is true where it is named, and irradiance approximates it.
    let rough = budget("rough", &["--method", "diffuse=eon"]);
    assert!(at_most(&rough) > 0.12, "{rough} {own}");
}

/// Errors are of shading: nothing is displaced for them, on either side.
#[test]
fn a_height_does_not_change_the_error() {
    let folder = Folder::new();
    let with = |nodes: &str, links: &str| {
        let text = METAL.replace("\"nodes\": {", &format!("\"nodes\": {{{nodes}")).replace("[]", &format!("[{links}]"));
        folder.write("metal.material.json", &text);
        export(&folder, "x", &["--max-error", "5", "--explain"]).ends(0).json()["budget"].clone()
    };
    let flat = with("", "");
    let noise = r#""noise": {"node": "procedural/value_noise_2d", "values": {"scale": 9}},"#;
    let displaced = with(noise, r#"{"from": "noise.out", "to": "surface.height"}"#);
    assert!(flat["reached"]["studio"]["error"].as_f64().is_some_and(|error| error > 0.0), "{flat}");
    assert_eq!(flat["reached"], displaced["reached"]);
    let text = std::fs::read_to_string(folder.path("x/metal.wgsl")).expect("the shader");
    assert!(text.replace("\n// ", " ").contains("without displacement"), "{text}");
}

#[test]
fn errors_that_make_no_sense_are_refused() {
    let folder = Folder::new();
    folder.write("metal.material.json", METAL);
    for wrong in ["0", "-1", "nan", "inf", "much"] {
        export(&folder, "x", &[&format!("--max-error={wrong}")]).ends(2).says("a number over 0");
    }
    let coded = ["--max-error", "1", "--method", "env_decode=report"];
    export(&folder, "x", &coded).ends(1).says("env_decode");
}

/// What is left out is told with its reason and what it saves.
#[test]
fn what_is_left_out_is_explained() {
    let folder = Folder::new();
    folder.write("metal.material.json", METAL);
    let explained = export(&folder, "x", &["--explain"]).ends(0).json();
    let dropped = explained["dropped"].as_array().expect("a list");
    for what in ["environment light", "diffuse lobe", "coat", "thin film"] {
        let one = dropped.iter().find(|one| one["what"] == what).unwrap_or_else(|| panic!("{what}: {explained}"));
        assert!(one["why"].is_string() && one["instructions"].as_u64() > Some(0), "{one}");
    }
    assert!(explained.get("budget").is_none());
    assert_eq!((&explained["dropped_nodes"], &explained["dropped_nodes_instructions"]), (&json!([]), &json!(0)));

    // All that stands behind a weight of 0.
    folder.write(
        "metal.material.json",
        r#"{"halfvector": 1, "name": "off", "nodes": {"surface": {"node": "surface/surface"},
            "grain": {"node": "procedural/value_noise_2d"}, "off": {"node": "math/multiply", "values": {"b": 0}}},
          "links": [{"from": "grain.out", "to": "off.a"}, {"from": "off.out", "to": "surface.coat_weight"}]}"#,
    );
    let explained = export(&folder, "x", &["--explain"]).ends(0).json();
    let nodes = explained["dropped_nodes"].as_array().expect("a list");
    let names: Vec<_> = nodes.iter().map(|one| one["node"].as_str().unwrap_or("")).collect();
    assert_eq!(names, ["grain", "off"], "{explained}");
    assert!(nodes.iter().all(|one| one["why"].is_string() && one["label"].is_string()), "{explained}");
    let sum: u64 = nodes.iter().filter_map(|one| one["instructions"].as_u64()).sum();
    assert_eq!(explained["dropped_nodes_instructions"].as_u64(), Some(sum));
}
