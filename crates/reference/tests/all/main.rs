//! Tests of the crate as its users see it, in one binary. Those that need the data folder (`HALFVECTOR_DATA`, default
//! `../shared/data` from the root) are passed over, with a line that says so, where it is absent.
//!
//! They compare few and coarse pixels; with `HALFVECTOR_FULL=1` all of them, with many samples.

mod displacement;
mod furnace;
mod ibl_tables;
mod mitsuba;
#[path = "../../../../tests/tests/models.rs"]
mod models;
mod picture;
mod stability;

use std::path::PathBuf;

use halfvector_graph::document::Document;
use halfvector_graph::value::Value;
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

/// A folder or file of the data, when it is there.
fn data(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("HALFVECTOR_DATA")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")), PathBuf::from);
    let path = root.join(name);
    if !path.exists() {
        println!("passed over: {} is not there", path.display());
        return None;
    }
    Some(path)
}

/// Whether everything is to be compared.
fn is_full() -> bool {
    std::env::var_os("HALFVECTOR_FULL").is_some_and(|value| value == "1")
}

/// A plain material on a built-in shape, single scattering, without an interface over the diffuse base.
fn scene(shape: BuiltinMesh, values: &[(&str, Value)], methods: &[(&str, &str)]) -> Scene {
    let mut document = Document::with_surface("test");
    let node = document.graph.nodes.get_mut("surface").expect("the surface");
    node.values.extend(values.iter().map(|(name, value)| ((*name).to_owned(), value.clone())));
    let mut scene =
        Scene::from_material(document, std::path::Path::new(""), &MeshSource::Builtin(shape)).expect("sound");
    for (term, method) in [("compensation", "none"), ("coupling", "none")].iter().chain(methods) {
        scene.methods.set(term, method).expect("a method");
    }
    scene
}

fn number(x: f64) -> Value {
    Value::Number(x as f32)
}

fn color(rgb: [f64; 3]) -> Value {
    Value::Vec3(rgb.map(|x| x as f32))
}
