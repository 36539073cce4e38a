//! Who may depend on whom: the arrows of ARCHITECTURE.md, held against the manifests.

use super::{files, read};
use crate::support::root;

/// Package folder, and what of ours and of the restricted packages it may name.
const ARROWS: &[(&str, &[&str])] = &[
    ("shaders", &[]),
    ("crates/brdf", &[]),
    ("crates/maps", &[]),
    ("crates/ibl", &["brdf", "maps"]),
    ("crates/interp", &[]),
    ("crates/graph", &["shaders"]),
    ("crates/codegen", &["graph", "interp", "shaders"]),
    ("crates/scene", &["graph", "maps", "ibl"]),
    ("crates/raster", &["graph", "codegen", "interp", "scene", "ibl", "maps", "shaders"]),
    ("crates/reference", &["brdf", "maps", "ibl", "graph", "scene", "codegen", "interp", "raster"]),
    ("crates/render", &["graph", "codegen", "scene", "ibl", "maps", "shaders"]),
    ("crates/web", &["graph", "codegen", "scene", "ibl", "maps", "shaders"]),
    ("crates/report", &["brdf", "maps", "ibl", "graph", "codegen", "scene", "raster", "reference", "render"]),
    (
        "editor",
        &[
            "brdf",
            "maps",
            "ibl",
            "graph",
            "codegen",
            "scene",
            "raster",
            "reference",
            "render",
            "report",
            "shaders",
            "interp",
        ],
    ),
    (
        "crates/cli",
        &[
            "brdf",
            "maps",
            "ibl",
            "graph",
            "codegen",
            "scene",
            "raster",
            "reference",
            "render",
            "report",
            "shaders",
            "editor",
            "web",
        ],
    ),
];

/// Packages of others that only some of ours may name.
const RESTRICTED: &[(&str, &[&str])] =
    &[("wgpu", &["crates/render"]), ("egui", &["editor"]), ("eframe", &["editor"]), ("clap", &["crates/cli"])];

/// Names in the dependency tables of a manifest, dev-dependencies included: one upward is an arrow too.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut inside = false;
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            inside = line.trim_matches(['[', ']']).ends_with("dependencies");
        } else if inside && let Some((name, _)) = line.split_once(['.', '=', ' ']) {
            names.push(name.trim().to_string());
        }
    }
    names
}

#[test]
fn arrows_point_one_way() {
    for (folder, allowed) in ARROWS {
        for name in dependencies(&read(&root().join(folder).join("Cargo.toml"))) {
            if let Some(ours) = name.strip_prefix("halfvector-") {
                assert!(allowed.contains(&ours), "{folder} may not depend on {name}");
            }
            for (restricted, who) in RESTRICTED {
                assert!(name != *restricted || who.contains(folder), "{folder} may not depend on {name}");
            }
        }
    }
}

/// A dependency that no source of the package names is only compiled.
#[test]
fn every_dependency_is_named() {
    for folder in ARROWS.iter().map(|(folder, _)| *folder).chain(["tests", "benches"]) {
        let sources: Vec<String> = files(folder, ".rs").iter().map(|path| read(path)).collect();
        for name in dependencies(&read(&root().join(folder).join("Cargo.toml"))) {
            let name = name.replace('-', "_");
            let is_named = sources.iter().any(|text| {
                let is_part = |at: usize| text[..at].ends_with(|c: char| c == '_' || c.is_alphanumeric());
                text.match_indices(&name).any(|(at, _)| !is_part(at))
            });
            assert!(is_named, "{folder}: no source names {name}");
        }
    }
}

#[test]
fn every_package_stands_in_the_table() {
    let folders = std::fs::read_dir(root().join("crates")).expect("crates/");
    for folder in folders.map(|f| f.expect("an entry").path()).filter(|f| f.is_dir()) {
        let name = format!("crates/{}", folder.file_name().expect("a name").to_string_lossy());
        assert!(ARROWS.iter().any(|(folder, _)| *folder == name), "{name} has no row in the table of arrows");
    }
}
