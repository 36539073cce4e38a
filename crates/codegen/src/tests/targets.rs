//! Every target, before the judges that are installed.

use std::path::Path;
use std::process::Command;

use halfvector_graph::document::{AlphaMode, Document};
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput, ToneMap};

use super::{environment, exported, maps, material, nothing, sun, with_parameters};
use crate::target::{OutputFile, TARGETS, export};

fn cases() -> Vec<(&'static str, Document, Needs)> {
    let everything = Needs {
        directional_lights: 2,
        point_lights: 1,
        spot_lights: 3,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Display(ToneMap::Agx),
        ..nothing()
    };
    let mut cutout = maps();
    cutout.surface.alpha_mode = AlphaMode::Mask;
    cutout.surface.double_sided = true;
    // The same picture, wrapped in two ways: GLSL needs two joined samplers.
    let twice = material(
        "",
        r#""one": {"node": "textures/image", "values": {"image": {"file": "a.png", "color_space": "linear"}}},
           "two": {"node": "textures/image", "values": {"image": {"file": "a.png", "color_space": "linear", "wrap_u": "clamp"}}}"#,
        r#"{"from": "one.color", "to": "surface.base_color"}, {"from": "two.r", "to": "surface.perceptual_roughness"},
           {"from": "two.g", "to": "surface.height"}"#,
    );
    let twenty = Needs { directional_lights: 6, point_lights: 7, spot_lights: 7, ..environment() };
    let parameters = ["metallic", "base_color", "coat_weight", "coat_color", "emission", "ior"]
        .map(|name| format!(r#"{{"name": "{name}", "socket": "surface.{name}"}}"#));
    let exposed = with_parameters("", "", "", &parameters.join(", "));
    // Packing of f16 is part of every WGSL.
    let mut packs =
        material("", r#""n": {"node": "custom/f"}"#, r#"{"from": "n.out", "to": "surface.perceptual_roughness"}"#);
    let text = "/// F\n///\n/// Packs.\n/// @node custom/f\n/// - uv: where [context uv0]\nfn f(uv: vec2f) -> f32 {\n    return unpack2x16float(pack2x16float(uv)).x + quantizeToF16(uv.y);\n}\n";
    packs.functions.insert("f".into(), text.into());
    // Arrays of zeros, which HLSL has no expression for that every compiler takes.
    let mut arrays =
        material("", r#""n": {"node": "custom/f"}"#, r#"{"from": "n.out", "to": "surface.perceptual_roughness"}"#);
    let text = "/// F\n///\n/// Looks things up.\n/// @node custom/f\n/// - uv: where [context uv0]\nfn f(uv: vec2f) -> f32 {\n    let none = array<vec2f, 3>();\n    var sums = array<f32, 4>(uv.x, uv.y, 0.5, 1.0);\n    var flags = array<bool, 2>();\n    for (var i = 0; i < 3; i++) { sums[i] += sums[i + 1]; flags[i % 2] = sums[i] > 0.5; }\n    return select(sums[0] + none[i32(3.0 * fract(uv.x))].x, sums[2], flags[1]);\n}\n";
    arrays.functions.insert("f".into(), text.into());
    vec![
        ("packs", packs, sun()),
        ("arrays", arrays, sun()),
        ("exposed", exposed.clone(), sun()),
        ("twenty", exposed, twenty),
        ("plain", material("", "", ""), sun()),
        ("maps", maps(), environment()),
        ("cutout", cutout, everything),
        ("twice", twice, sun()),
    ]
}

/// Runs a judge on a file; `None` when it is not installed.
fn accepts(judge: &str, arguments: &[&str], file: &Path) -> Option<Result<(), String>> {
    let output = Command::new(judge).args(arguments).arg(file).output().ok()?;
    let words = || format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Some(if output.status.success() { Ok(()) } else { Err(words()) })
}

fn judge(file: &OutputFile, folder: &Path) {
    let path = folder.join(&file.name);
    std::fs::write(&path, &file.bytes).expect("a file in the temporary folder");
    let verdicts = match file.name.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "spv" => vec![
            accepts("spirv-val", &["--target-env", "vulkan1.0"], &path),
            // Engines of other languages read it by this: it also judges whether blocks are laid out as HLSL lays them out.
            accepts("spirv-cross", &["--hlsl", "--shader-model", "50"], &path),
            accepts("spirv-cross", &["--version", "450"], &path),
        ],
        "vert" | "frag" => vec![accepts("glslangValidator", &[], &path)],
        "hlsl" => [("vert", "vs_main"), ("frag", "fs_main")]
            .iter()
            .map(|(stage, entry)| {
                let output = path.with_extension("out");
                let output = output.to_string_lossy();
                accepts("glslangValidator", &["-D", "-V", "-S", stage, "-e", entry, "-o", &output], &path)
            })
            .collect(),
        _ => vec![],
    };
    for verdict in verdicts {
        match verdict {
            None => {
                super::judge_may_miss("a judge");
                println!("skipped: no judge for {} (Debian: glslang-tools, spirv-tools, spirv-cross)", file.name);
            }
            Some(Ok(())) => {}
            Some(Err(words)) => panic!("{}: {words}\n{}", file.name, String::from_utf8_lossy(&file.bytes)),
        }
    }
}

#[test]
fn every_target_is_accepted() {
    for (name, document, needs) in cases() {
        for target in TARGETS {
            let shader = exported(&document, &target.needs(needs.clone()));
            let folder = tempfile::tempdir().expect("a temporary folder");
            let files = export(&shader, target, name).unwrap_or_else(|e| panic!("{name} as {}: {e}", target.name));
            for file in &files {
                judge(file, folder.path());
            }
            if target.name == "bevy" {
                continue;
            }
            let json = files.iter().find(|f| f.name == format!("{name}.json")).expect("a reflection");
            let value: serde_json::Value = serde_json::from_slice(&json.bytes).expect("JSON");
            assert_eq!(value["bindings"].as_array().map(Vec::len), Some(shader.reflection.bindings.len()));
        }
    }
}

/// What GLSL ES lacks is told by name, where naga would write it all the same.
#[test]
fn what_es_lacks_is_refused() {
    for (call, what) in [("countOneBits(u32(x))", "countOneBits"), ("pack4x8unorm(vec4f(x))", "pack4x8unorm")] {
        let mut document =
            material("", r#""n": {"node": "custom/f"}"#, r#"{"from": "n.out", "to": "surface.perceptual_roughness"}"#);
        let text = format!(
            "/// F\n///\n/// Bits.\n/// @node custom/f\n/// - uv: where [context uv0]\nfn f(uv: vec2f) -> f32 {{\n    let x = uv.x;\n    return f32({call});\n}}\n"
        );
        document.functions.insert("f".into(), text);
        for target in TARGETS {
            let shader = exported(&document, &target.needs(sun()));
            match (target.name, export(&shader, target, "bits")) {
                ("glsl-es", Err(error)) => {
                    let error = error.to_string();
                    assert!(error.contains(&format!("no `{what}`")) && error.contains("node_custom_f"), "{error}");
                }
                (name, outcome) => assert!(outcome.is_ok() && name != "glsl-es", "{name}: {call}"),
            }
        }
    }
}

#[test]
fn file_names_are_the_contracts() {
    let shader = exported(&material("", "", ""), &sun());
    let names = |target: &str| -> Vec<String> {
        let target = crate::target::target(target).expect("a target of the list");
        export(&shader, target, "m").expect("files").into_iter().map(|f| f.name).collect()
    };
    assert_eq!(names("wgsl"), ["m.wgsl", "m.json"]);
    assert_eq!(names("glsl"), ["m.vert", "m.frag", "m.json"]);
    assert_eq!(names("glsl-es"), ["m.vert", "m.frag", "m.json"]);
    assert_eq!(names("hlsl"), ["m.hlsl", "m.json"]);
    assert_eq!(names("msl"), ["m.metal", "m.json"]);
    assert_eq!(names("spirv"), ["m.vert.spv", "m.frag.spv", "m.json"]);
    let bevy = crate::target::target("bevy").expect("a target of the list");
    let shader = exported(&material("", "", ""), &bevy.needs(sun()));
    let files = export(&shader, bevy, "car-paint").expect("files");
    assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["car_paint.rs", "car_paint.wgsl"]);
    let words = export(&exported(&maps(), &sun()), bevy, "m").expect_err("lights of its own").to_string();
    assert!(words.contains("Target::needs"), "{words}");
}

/// A stage holds only its own: the vertex stage of a lit material knows no lights.
#[test]
fn stages_hold_only_their_own() {
    let shader = exported(&maps(), &environment());
    let target = crate::target::target("glsl").expect("a target of the list");
    let files = export(&shader, target, "m").expect("files");
    let vertex = String::from_utf8_lossy(&files[0].bytes).into_owned();
    assert!(!vertex.contains("d_ggx") && !vertex.contains("sampler"), "{vertex}");
}
