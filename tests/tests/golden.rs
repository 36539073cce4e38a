//! Documents and the WGSL that comes of them, committed: a difference fails. `HALFVECTOR_BLESS=1` writes the new text, to
//! be read in the diff. Each golden passes naga and, where they are installed, glslangValidator, spirv-val and spirv-cross
//! (`HALFVECTOR_REQUIRE_JUDGES=1`: they must be), and holds nothing that it does not need.

use std::path::PathBuf;
use std::process::Command;

use halfvector_codegen::target::{self, TARGETS};
use halfvector_codegen::{Fold, Shader, shader, validate};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput, ToneMap};

use crate::support::{bless, required, root};

fn nothing() -> Needs {
    Needs {
        directional_lights: 0,
        point_lights: 0,
        spot_lights: 0,
        environment: None,
        output: ShaderOutput::Radiance,
        methods: Methods::default(),
    }
}

/// The scenes that goldens are made for: name and needs.
fn needs() -> Vec<(&'static str, Needs)> {
    let sun = Needs { directional_lights: 1, ..nothing() };
    let environment = Needs { environment: Some(EnvironmentNeeds { rotated: false }), ..nothing() };
    let everything = Needs {
        directional_lights: 2,
        point_lights: 1,
        spot_lights: 3,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Display(ToneMap::PbrNeutral),
        methods: Methods::default(),
    };
    let report = Needs { methods: Methods::report(), ..environment.clone() };
    let mut other = Methods::default();
    for (term, method) in [
        ("v", "separable"),
        ("fresnel", "exact"),
        ("diffuse", "burley"),
        ("dfg", "karis"),
        ("irradiance", "sh2"),
        ("normal", "rotation_fixed"),
    ] {
        other.set(term, method).expect("a method of the list");
    }
    let other = Needs { directional_lights: 1, methods: other, ..environment.clone() };
    vec![("sun", sun), ("environment", environment), ("everything", everything), ("report", report), ("methods", other)]
}

/// Which document is made for which scenes, and with which numbers left open.
const CASES: &[(&str, &[&str], Fold)] = &[
    ("examples/plain-dielectric.material.json", &["sun", "environment"], Fold::Export),
    ("examples/surface.material.json", &["sun", "everything", "report", "methods"], Fold::Export),
    ("tests/golden/maps.material.json", &["sun", "environment", "everything", "report", "methods"], Fold::Export),
    ("tests/golden/maps.material.json", &["environment"], Fold::Live),
    ("tests/golden/metal.material.json", &["environment"], Fold::Export),
    ("tests/golden/cutout.material.json", &["sun"], Fold::Export),
    ("tests/golden/names.material.json", &["sun"], Fold::Export),
    ("tests/golden/lobes.material.json", &["sun", "environment", "everything"], Fold::Export),
    ("tests/golden/relief.material.json", &["sun"], Fold::Export),
    ("tests/golden/sheet.material.json", &["sun", "environment"], Fold::Export),
];

/// One golden: its name and what codegen makes now.
pub(crate) struct Golden {
    pub(crate) name: String,
    pub(crate) document: Document,
    pub(crate) shader: Shader,
}

fn document(path: &str) -> Document {
    halfvector_graph::file::load(&root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

pub(crate) fn goldens() -> Vec<Golden> {
    let scenes = needs();
    let mut goldens = Vec::new();
    for (path, names, fold) in CASES {
        let document = document(path);
        let stem = path.rsplit('/').next().expect("a file name").trim_end_matches(".material.json");
        for name in *names {
            let (_, needs) = scenes.iter().find(|(n, _)| n == name).expect("a scene of the list");
            let shader = shader(&document, Library::standard(), needs, *fold)
                .unwrap_or_else(|e| panic!("{path} for {name}: {e}"));
            let live = if *fold == Fold::Live { ".live" } else { "" };
            goldens.push(Golden { name: format!("{stem}.{name}{live}"), document: document.clone(), shader });
        }
    }
    goldens
}

fn golden_path(name: &str) -> PathBuf {
    root().join("tests/golden").join(format!("{name}.wgsl"))
}

#[test]
fn goldens_are_what_codegen_makes() {
    let mut different = Vec::new();
    for golden in goldens() {
        let path = golden_path(&golden.name);
        if bless() {
            std::fs::write(&path, &golden.shader.wgsl).expect("a golden can be written");
        } else if std::fs::read_to_string(&path).ok().as_deref() != Some(&golden.shader.wgsl) {
            different.push(golden.name);
        }
    }
    assert!(different.is_empty(), "not as committed: {different:?}; HALFVECTOR_BLESS=1 writes them anew");
}

/// Each hash map of a process has its own order; text that followed one would differ between the two.
#[test]
fn the_same_document_gives_the_same_bytes() {
    for (first, second) in goldens().into_iter().zip(goldens()) {
        assert_eq!(first.shader, second.shader, "{}", first.name);
    }
}

#[test]
fn goldens_pass_naga() {
    for golden in goldens() {
        validate(&golden.shader).unwrap_or_else(|e| panic!("{}: {e}", golden.name));
    }
}

fn parses(source: &str) -> bool {
    let Ok(module) = naga::front::wgsl::parse_str(source) else { return false };
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
        .validate(&module)
        .is_ok()
}

/// Lines of a shader that declare a binding, a varying, an attribute or a uniform member: bindings, and members of the
/// structs that entry points and uniforms use.
fn declarations(shader: &Shader) -> Vec<usize> {
    let mut structs: Vec<String> = ["VertexInput", "Varyings"].map(String::from).to_vec();
    for binding in &shader.reflection.bindings {
        if let halfvector_codegen::reflection::Resource::Uniform(block) = &binding.resource {
            structs.push(block.struct_name.clone());
        }
    }
    let mut lines = Vec::new();
    let mut inside = false;
    for (number, line) in shader.wgsl.lines().enumerate() {
        if let Some(name) = line.strip_prefix("struct ") {
            inside = structs.iter().any(|s| name.split([' ', '{']).next() == Some(s));
        } else if line.starts_with('}') {
            inside = false;
        } else if (inside && line.contains(':') && !line.trim_start().starts_with("//")) || line.starts_with("@group(")
        {
            lines.push(number);
        }
    }
    lines
}

#[test]
fn goldens_hold_only_what_is_needed() {
    for golden in goldens() {
        let lines: Vec<_> = golden.shader.wgsl.lines().collect();
        let declared = declarations(&golden.shader);
        assert!(declared.len() >= 4, "{}: {} declarations found", golden.name, declared.len());
        for &number in &declared {
            let without: Vec<_> = lines.iter().enumerate().filter(|(n, _)| *n != number).map(|(_, l)| *l).collect();
            assert!(!parses(&without.join("\n")), "{}: not needed: {}", golden.name, lines[number]);
        }
    }
}

/// A program that judges files of targets, and whether it is there.
struct Judge {
    program: &'static str,
    /// Ends of the names of the files that it reads.
    suffixes: &'static [&'static str],
    arguments: &'static [&'static str],
}

const JUDGES: [Judge; 5] = [
    // glslangValidator knows the stage by the last suffix.
    Judge { program: "glslangValidator", suffixes: &[".vert", ".frag"], arguments: &[] },
    Judge {
        program: "glslangValidator",
        suffixes: &[".hlsl"],
        arguments: &["-D", "-V", "-S", "vert", "-e", "vs_main", "-o", "/dev/null"],
    },
    Judge {
        program: "glslangValidator",
        suffixes: &[".hlsl"],
        arguments: &["-D", "-V", "-S", "frag", "-e", "fs_main", "-o", "/dev/null"],
    },
    Judge { program: "spirv-val", suffixes: &[".vert.spv", ".frag.spv"], arguments: &["--target-env", "vulkan1.1"] },
    // Reads every instruction again to write GLSL of its own.
    Judge {
        program: "spirv-cross",
        suffixes: &[".vert.spv", ".frag.spv"],
        arguments: &["--vulkan-semantics", "--version", "450"],
    },
];

/// Holds all targets of shaders before the judges that are installed.
pub(crate) fn judge<'s>(shaders: impl Iterator<Item = (&'s str, &'s Shader)>) {
    let judges = JUDGES.iter().filter(|Judge { program, .. }| {
        let is_there = Command::new(program).arg("--version").output().is_ok();
        assert!(is_there || !required("HALFVECTOR_REQUIRE_JUDGES"), "{program} is not installed");
        if !is_there {
            println!("skipped: {program} is not installed");
        }
        is_there
    });
    let judges: Vec<&Judge> = judges.collect();
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, shader) in shaders {
        for kind in TARGETS.iter().filter(|kind| kind.name != "bevy") {
            let files = target::export(shader, kind, name).unwrap_or_else(|e| panic!("{name} as {}: {e}", kind.name));
            for file in files {
                let path = folder.path().join(format!("{}-{}", kind.name, file.name));
                std::fs::write(&path, &file.bytes).expect("a temporary file");
                for judge in judges.iter().filter(|judge| judge.suffixes.iter().any(|s| file.name.ends_with(s))) {
                    let Judge { program, arguments, .. } = judge;
                    let output = Command::new(program).args(*arguments).arg(&path).output().expect("the judge runs");
                    assert!(
                        output.status.success(),
                        "{program} refuses {}: {}{}",
                        path.display(),
                        String::from_utf8_lossy(&output.stdout),
                        String::from_utf8_lossy(&output.stderr)
                    );
                }
            }
        }
    }
}

#[test]
fn goldens_pass_the_judges() {
    let goldens = goldens();
    judge(goldens.iter().map(|golden| (golden.name.as_str(), &golden.shader)));
}
