//! The sizes that are promised: SPIR-V instructions of a fragment stage after `spirv-opt -O`.

use std::process::Command;

use halfvector_graph::document::Document;
use halfvector_graph::needs::Needs;

use super::{environment, exported, maps, material, sun, with_parameters};
use crate::Shader;
use crate::target::{export, target};

/// Lines of `spirv-dis` from OpFunction to OpFunctionEnd of the fragment stage after `spirv-opt -O`; none where the tools
/// are not installed.
fn instructions(shader: &Shader) -> Option<usize> {
    let target = target("spirv").expect("a target of the list");
    let files = export(shader, target, "m").expect("a valid shader");
    let folder = tempfile();
    let (input, output) = (folder.join("in.spv"), folder.join("out.spv"));
    let spirv = files.iter().find(|f| f.name == "m.frag.spv").expect("a fragment stage");
    std::fs::write(&input, &spirv.bytes).expect("a file in the temporary folder");
    let optimised = Command::new("spirv-opt").arg("-O").arg(&input).arg("-o").arg(&output).status();
    let text =
        optimised.ok().filter(|s| s.success()).and_then(|_| Command::new("spirv-dis").arg(&output).output().ok());
    let count = text.map(|text| count(&String::from_utf8_lossy(&text.stdout)));
    let _ = std::fs::remove_dir_all(&folder);
    count
}

fn count(assembly: &str) -> usize {
    let lines: Vec<&str> = assembly.lines().collect();
    let position = |word: &str| lines.iter().position(|line| line.contains(word));
    let (Some(first), Some(last)) = (position("OpFunction "), lines.iter().rposition(|l| l.contains("OpFunctionEnd")))
    else {
        return 0;
    };
    last - first + 1
}

fn tempfile() -> std::path::PathBuf {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let folder = std::env::temp_dir().join(format!("halfvector-codegen-{}-{number}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    folder
}

fn check(name: &str, shader: &Shader, most: usize) {
    match instructions(shader) {
        Some(count) => {
            println!("{name}: {count} SPIR-V instructions, at most {most}");
            assert!(count <= most, "{name}: {count} SPIR-V instructions, {most} are promised\n{}", shader.wgsl);
        }
        None => {
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

/// Coat, sheen, transmission, anisotropy and thin film over a base of four maps; the lobes' numbers fixed or all exposed.
fn all_lobes(exposed: bool) -> Document {
    let mut document = maps();
    let values = LOBES.map(|(name, value)| format!(r#""{name}": {value}"#)).join(", ");
    let parameters = LOBES.map(|(name, _)| format!(r#"{{"name": "{name}", "socket": "surface.{name}"}}"#)).join(", ");
    let lobes = with_parameters(&values, "", "", if exposed { &parameters } else { "" });
    document.graph.nodes.insert("surface".into(), lobes.graph.nodes["surface"].clone());
    document.parameters = lobes.parameters;
    document
}

#[test]
fn all_lobes_with_four_maps() {
    let fixed = all_lobes(false);
    check("all lobes, four maps, environment", &exported(&fixed, &environment()), 800);
    check("all lobes, four maps, one directional light and environment", &exported(&fixed, &both()), 800);
}

/// With all fourteen numbers of the lobes exposed nothing of them is known beforehand. In an environment the promise is
/// kept; with a directional light beside it the figure is told, and may not grow.
#[test]
fn all_lobes_with_four_maps_and_their_numbers_exposed() {
    let exposed = all_lobes(true);
    check("all lobes, four maps, environment, parameters exposed", &exported(&exposed, &environment()), 800);
    check(
        "all lobes, four maps, one directional light and environment, parameters exposed",
        &exported(&exposed, &both()),
        990,
    );
}
