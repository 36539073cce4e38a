//! The sizes that are promised: SPIR-V instructions of a fragment stage after `spirv-opt -O`.

use std::process::Command;

use halfvector_graph::needs::Needs;
use halfvector_graph::value::Value;

use super::{environment, exported, maps, material, sun};
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

#[test]
fn plain_dielectric_under_one_directional_light() {
    check("plain dielectric, one directional light", &exported(&material("", "", ""), &sun()), 100);
}

#[test]
fn four_maps() {
    check("four maps, one directional light", &exported(&maps(), &sun()), 220);
    check("four maps, environment", &exported(&maps(), &environment()), 320);
    check("four maps, one directional light and environment", &exported(&maps(), &both()), 320);
}

#[test]
fn all_lobes_with_four_maps_in_an_environment() {
    let mut document = maps();
    let values = &mut document.graph.nodes.get_mut("surface").expect("the surface").values;
    values.insert("coat_weight".into(), Value::Number(0.8));
    values.insert("coat_roughness".into(), Value::Number(0.1));
    values.insert("coat_color".into(), Value::Vec3([1.0, 0.9, 0.8]));
    values.insert("sheen_color".into(), Value::Vec3([0.2, 0.2, 0.3]));
    values.insert("transmission_weight".into(), Value::Number(0.4));
    values.insert("anisotropy".into(), Value::Number(0.7));
    values.insert("thin_film_weight".into(), Value::Number(1.0));
    check("all lobes, four maps, environment", &exported(&document, &environment()), 800);
}

fn both() -> Needs {
    Needs { directional_lights: 1, ..environment() }
}
