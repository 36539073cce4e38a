//! The sizes that are promised: SPIR-V instructions of a fragment stage after `spirv-opt -O`.

use std::process::Command;

use halfvector_graph::document::Document;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput, ToneMap};

use super::{environment, exported, maps, material, sun, with_parameters};
use crate::Shader;
use crate::target::{export, target};

/// Lines of `spirv-dis` from OpFunction to OpFunctionEnd of the fragment stage after `spirv-opt -O`; none where the tools
/// are not installed.
fn instructions(shader: &Shader) -> Option<usize> {
    let target = target("spirv").expect("a target of the list");
    let files = export(shader, target, "m").expect("a valid shader");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (input, output) = (folder.path().join("in.spv"), folder.path().join("out.spv"));
    let spirv = files.iter().find(|f| f.name == "m.frag.spv").expect("a fragment stage");
    std::fs::write(&input, &spirv.bytes).expect("a file in the temporary folder");
    let optimised = Command::new("spirv-opt").arg("-O").arg(&input).arg("-o").arg(&output).output().ok()?;
    assert!(optimised.status.success(), "spirv-opt: {}", String::from_utf8_lossy(&optimised.stderr));
    let text = Command::new("spirv-dis").arg(&output).output().ok()?;
    assert!(text.status.success(), "spirv-dis: {}", String::from_utf8_lossy(&text.stderr));
    Some(count(&String::from_utf8_lossy(&text.stdout)))
}

fn count(assembly: &str) -> usize {
    let lines: Vec<&str> = assembly.lines().collect();
    let first = lines.iter().position(|line| line.contains("OpFunction ")).expect("a function");
    let last = lines.iter().rposition(|line| line.contains("OpFunctionEnd")).expect("its end");
    last - first + 1
}

fn check(name: &str, shader: &Shader, most: usize) {
    match instructions(shader) {
        Some(count) => {
            println!("{name}: {count} SPIR-V instructions, at most {most}");
            assert!(count <= most, "{name}: {count} SPIR-V instructions, {most} are promised\n{}", shader.wgsl);
        }
        None => {
            super::judge_may_miss("spirv-opt and spirv-dis");
            println!("skipped: {name} is not counted, spirv-opt and spirv-dis are not installed (Debian: spirv-tools)")
        }
    }
}

fn both() -> Needs {
    Needs { directional_lights: 1, ..environment() }
}

/// A material of the examples.
fn example(name: &str) -> Document {
    let path = format!("{}/../../examples/{name}.material.json", env!("CARGO_MANIFEST_DIR"));
    super::document(&std::fs::read_to_string(path).expect("an example"))
}

#[test]
fn plain_dielectric_under_one_directional_light() {
    check("plain dielectric, one directional light", &exported(&material("", "", ""), &sun()), 100);
    let exposed = exported(&example("plain-dielectric"), &sun());
    assert!(exposed.wgsl.contains("parameters.perceptual_roughness"), "it exposes its roughness: {}", exposed.wgsl);
    check("examples/plain-dielectric, parameters exposed, one directional light", &exposed, 100);
}

#[test]
fn four_maps() {
    check("four maps, one directional light", &exported(&maps(), &sun()), 220);
    check("four maps, environment", &exported(&maps(), &environment()), 320);
    check("four maps, one directional light and environment", &exported(&maps(), &both()), 320);
    let shipped = example("flight-helmet-leather");
    check("examples/flight-helmet-leather, one directional light", &exported(&shipped, &sun()), 220);
    check("examples/flight-helmet-leather, one directional light and environment", &exported(&shipped, &both()), 320);
}

/// What a height map costs: eight reads of texels where the sampler would do with one, and the slope.
#[test]
fn a_height_map() {
    let relief = |links: &str| {
        let nodes = r#""relief": {"node": "textures/image", "values": {"image": {"file": "h.png", "color_space": "linear"}}},
            "height": {"node": "textures/height"}"#;
        material("", nodes, links)
    };
    let raised = r#"{"from": "relief.r", "to": "height.value"}, {"from": "height.out", "to": "surface.height"}"#;
    check("a height map, one directional light", &exported(&relief(raised), &sun()), 220);
    check("the same without it", &exported(&relief(""), &sun()), 100);
    let old = super::methods(&[("height_normals", "report")]);
    check("the same with the old normals", &exported(&relief(raised), &Needs { methods: old, ..sun() }), 100);
}

/// Inputs of all lobes over a base of metal and roughness, as JSON and as names.
const LOBES: [(&str, &str); 14] = [
    ("ior", "1.5"),
    ("specular", "1"),
    ("coat_weight", "0.8"),
    ("coat_color", "[1, 0.9, 0.8]"),
    ("coat_roughness", "0.1"),
    ("coat_ior", "1.5"),
    ("sheen_color", "[0.2, 0.2, 0.3]"),
    ("sheen_roughness", "0.3"),
    ("transmission_weight", "0.4"),
    ("anisotropy", "0.7"),
    ("anisotropy_rotation", "0"),
    ("thin_film_weight", "1"),
    ("thin_film_thickness", "0.5"),
    ("thin_film_ior", "1.4"),
];

/// Coat, sheen, transmission, anisotropy and thin film over a base of four maps: some of the lobes' numbers others than
/// those of the list, some exposed.
fn all_lobes(others: &[(&str, &str)], exposed: &[&str]) -> Document {
    let mut document = maps();
    let value = |name: &str, value| others.iter().find(|(other, _)| *other == name).map_or(value, |(_, other)| *other);
    let values = LOBES.map(|(name, usual)| format!(r#""{name}": {}"#, value(name, usual))).join(", ");
    let parameter = |name: &&str| format!(r#"{{"name": "{name}", "socket": "surface.{name}"}}"#);
    let parameters = exposed.iter().map(parameter).collect::<Vec<_>>().join(", ");
    let lobes = with_parameters(&values, "", "", &parameters);
    document.graph.nodes.insert("surface".into(), lobes.graph.nodes["surface"].clone());
    document.parameters = lobes.parameters;
    document
}

/// Numbers of the lobes at which nothing of them folds away.
const NO_NUMBER_FOLDS: [(&str, &str); 14] = [
    ("ior", "1.4"),
    ("specular", "0.9"),
    ("coat_weight", "0.7"),
    ("coat_color", "[0.9, 0.8, 0.7]"),
    ("coat_roughness", "0.35"),
    ("coat_ior", "1.6"),
    ("sheen_color", "[0.3, 0.2, 0.1]"),
    ("sheen_roughness", "0.45"),
    ("transmission_weight", "0.3"),
    ("anisotropy", "0.6"),
    ("anisotropy_rotation", "0.3"),
    ("thin_film_weight", "0.6"),
    ("thin_film_thickness", "0.4"),
    ("thin_film_ior", "1.3"),
];

#[test]
fn all_lobes_with_four_maps() {
    let combinations: [(&str, &[(&str, &str)]); 7] = [
        ("plain numbers", &[]),
        ("a weaker specular", &[("specular", "0.9")]),
        ("turned brushing", &[("anisotropy_rotation", "0.3")]),
        ("a film in part", &[("thin_film_weight", "0.6")]),
        ("a rough coat", &[("coat_roughness", "0.35")]),
        ("a dark tinted coat, strong sheen", &[("coat_color", "[0, 0.1, 1]"), ("sheen_color", "[1, 1, 1]")]),
        ("numbers of which none folds", &NO_NUMBER_FOLDS),
    ];
    for (name, numbers) in combinations {
        let document = all_lobes(numbers, &[]);
        check(&format!("all lobes ({name}), four maps, environment"), &exported(&document, &environment()), 800);
        let lit = format!("all lobes ({name}), four maps, one directional light and environment");
        check(&lit, &exported(&document, &both()), 760);
    }
}

/// With numbers of the lobes exposed less of them is known beforehand. In an environment the promise is kept; with a
/// directional light beside it the figure is told, and may not grow.
#[test]
fn all_lobes_with_four_maps_and_their_numbers_exposed() {
    let weights = ["coat_weight", "sheen_color", "transmission_weight", "anisotropy", "thin_film_weight"];
    let all = LOBES.map(|(name, _)| name);
    for (name, exposed, most) in [("five weights", &weights[..], 800), ("all fourteen numbers", &all[..], 880)] {
        let document = all_lobes(&NO_NUMBER_FOLDS, exposed);
        check(&format!("all lobes, four maps, environment, {name} exposed"), &exported(&document, &environment()), 800);
        let lit = format!("all lobes, four maps, one directional light and environment, {name} exposed");
        check(&lit, &exported(&document, &both()), most);
    }
}

/// What a scene adds to the shader that is promised: its display, a turned environment, lights; and what a document adds by
/// rasterisation and occlusion. Each alone keeps to the promise; of more lights, all of them at once, and all numbers exposed the figure
/// is told, and may not grow.
#[test]
fn all_lobes_with_four_maps_in_a_scene() {
    let shown = Needs { output: ShaderOutput::Display(ToneMap::PbrNeutral), ..both() };
    let turned = Needs { environment: Some(EnvironmentNeeds { rotated: true }), ..shown.clone() };
    let suns = Needs { directional_lights: 2, ..shown.clone() };
    let plain = all_lobes(&[], &[]);
    let mut two_sided = plain.clone();
    two_sided.surface.double_sided = true;
    let occlusion = r#"{"from": "roughness.g", "to": "surface.occlusion"}"#;
    let mut occluded = plain.clone();
    occluded.graph.links.extend(with_parameters("", "", occlusion, "").graph.links);
    let mut all_three = occluded.clone();
    all_three.surface.double_sided = true;
    let weights = ["coat_weight", "sheen_color", "transmission_weight", "anisotropy", "thin_film_weight"];
    let (five, fourteen) = (all_lobes(&[], &weights), all_lobes(&[], &LOBES.map(|(name, _)| name)));
    let unfolded = all_lobes(&NO_NUMBER_FOLDS, &LOBES.map(|(name, _)| name));
    let cases: [(&str, &Document, &Needs, usize); 9] = [
        ("shown", &plain, &shown, 800),
        ("shown, two-sided", &two_sided, &shown, 800),
        ("shown, occlusion map", &occluded, &shown, 800),
        ("shown, turned environment", &plain, &turned, 800),
        ("shown, two suns", &plain, &suns, 830),
        ("shown, five weights exposed", &five, &shown, 800),
        ("shown, all fourteen numbers exposed", &fourteen, &shown, 900),
        ("shown, turned environment, two-sided, occlusion map", &all_three, &turned, 880),
        ("shown, all fourteen exposed, none of which folds", &unfolded, &shown, 900),
    ];
    for (name, document, needs, most) in cases {
        check(
            &format!("all lobes, four maps, one directional light and environment, {name}"),
            &exported(document, needs),
            most,
        );
    }
}
