//! Plug-ins for Bevy: their Rust is Rust and their WGSL is WGSL, with Bevy's names as its sources have them; and, where
//! `HALFVECTOR_BEVY=1` asks for it, they compile against the current Bevy (some hundred crates: many minutes).

use std::path::Path;
use std::process::Command;

use halfvector_codegen::target::{OutputFile, export, target};
use halfvector_codegen::{Fold, shader};
use halfvector_graph::document::{AlphaMode, Document};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};

use crate::support::{required, root};

const ENGINE: &str = include_str!("bevy/engine.wgsl");

fn example(name: &str) -> Document {
    halfvector_graph::file::load(&root().join("examples").join(name)).unwrap_or_else(|e| panic!("{e}"))
}

/// Names and files of plug-ins that have everything between them: parameters, images, both sides, blending, an environment,
/// object space, displacement, and no light at all.
fn plugins() -> Vec<(String, Vec<OutputFile>)> {
    let nothing = Needs {
        directional_lights: 1,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    };
    let turned = Needs { environment: Some(EnvironmentNeeds { rotated: true }), ..nothing.clone() };
    let mut sh = turned.clone();
    sh.methods.set("irradiance", "sh2").expect("a method of the list");
    let mut glass = example("glass.material.json");
    (glass.surface.alpha_mode, glass.surface.double_sided) = (AlphaMode::Blend, true);
    let mut dark = Document::with_surface("*/ dark \"\\\n");
    let surface = dark.graph.nodes.get_mut("surface").expect("the surface");
    surface.values.insert("base_color".into(), halfvector_graph::value::Value::Vec3([0.0; 3]));
    let cases = [
        ("plain", example("surface.material.json"), nothing.clone()),
        ("painted-panel", example("painted-panel.material.json"), nothing.clone()),
        ("cobbles", example("cobbles.material.json"), turned),
        ("9 glasses", glass, sh),
        ("marble", example("marble.material.json"), nothing.clone()),
        ("dark", dark, nothing),
    ];
    let bevy = target("bevy").expect("a target of the list");
    cases
        .into_iter()
        .map(|(name, document, needs)| {
            let made = shader(&document, Library::standard(), &bevy.needs(needs), Fold::Export)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            (name.to_owned(), export(&made, bevy, name).unwrap_or_else(|e| panic!("{name}: {e}")))
        })
        .collect()
}

fn text(file: &OutputFile) -> &str {
    std::str::from_utf8(&file.bytes).expect("text")
}

/// The shader as Bevy's preprocessor leaves it when everything is defined, with the names above.
fn plain(wgsl: &str) -> String {
    let mut plain = ENGINE.to_owned();
    let mut in_import = false;
    for line in wgsl.lines() {
        in_import |= line.starts_with("#import") && line.ends_with('{');
        if !in_import && !line.starts_with('#') {
            plain += &line.replace("#{MATERIAL_BIND_GROUP}", "3").replace("::", "_");
            plain.push('\n');
        }
        in_import &= line != "}";
    }
    plain
}

#[test]
fn plugins_are_rust_and_wgsl() {
    for (name, files) in plugins() {
        let [rust, wgsl] = files.as_slice() else { panic!("{name}: two files were expected") };
        let parsed = syn::parse_file(text(rust)).unwrap_or_else(|e| panic!("{name}: {e}\n{}", text(rust)));
        let types = parsed.items.iter().filter(|item| matches!(item, syn::Item::Struct(_))).count();
        assert!(types >= 2, "{name}: {types} types");
        assert!(text(rust).contains(&format!("\"{}\"", wgsl.name)), "{name}: the Rust names the WGSL");
        let plain = plain(text(wgsl));
        let module = naga::front::wgsl::parse_str(&plain)
            .unwrap_or_else(|e| panic!("{name}: {}\n{plain}", e.emit_to_string(&plain)));
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{name}: {}\n{plain}", e.emit_to_string(&plain)));
        let bound = module.global_variables.iter().filter(|(_, v)| v.binding.is_some_and(|b| b.group == 3)).count();
        let attributes = ["#[uniform(", "#[texture(", "#[sampler("];
        let fields: usize = attributes.iter().map(|attribute| text(rust).matches(attribute).count()).sum();
        assert_eq!(bound, fields, "{name}: each binding is a field of the material\n{}", text(rust));
        assert!(!text(wgsl).contains("directional_light_sample"), "{name}: our own lights stayed behind");
    }
}

#[test]
fn plugins_compile_against_bevy() {
    if !required("HALFVECTOR_BEVY") {
        println!("skipped: HALFVECTOR_BEVY is not 1");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let source = folder.path().join("src");
    std::fs::create_dir(&source).expect("a folder");
    let manifest = "[package]\nname = \"plugins\"\nversion = \"0.0.0\"\nedition = \"2024\"\n[workspace]\n[dependencies.bevy]\n\
                    version = \"0.19\"\ndefault-features = false\nfeatures = [\"bevy_pbr\", \"bevy_render\", \"png\"]\n";
    let mut library = String::from("//! Exported materials.\n#![deny(warnings)]\n");
    for (_, files) in plugins() {
        for file in &files {
            std::fs::write(source.join(&file.name), &file.bytes).expect("written");
        }
        library += &format!("pub mod {};\n", files[0].name.strip_suffix(".rs").expect("a Rust file"));
    }
    std::fs::write(folder.path().join("Cargo.toml"), manifest).expect("written");
    std::fs::write(source.join("lib.rs"), library).expect("written");
    // A folder that is kept makes the next time short.
    let kept = std::env::var_os("HALFVECTOR_BEVY_TARGET");
    let output = kept.as_deref().map_or_else(|| folder.path().join("target"), |path| Path::new(path).to_owned());
    let done = Command::new("cargo").arg("check").current_dir(folder.path()).env("CARGO_TARGET_DIR", output).output();
    let done = done.expect("cargo runs");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}
