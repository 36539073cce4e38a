//! Paths per second on a textured metal sphere under an environment, here and, where Python has it, by Mitsuba 3
//! (`scalar_rgb`) on the same scene, in turns.
//!
//! `cargo run --release -p halfvector-reference --example paths_per_second`; the scene's files are those of
//! `HALFVECTOR_DATA`, default `../shared/data`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::value::{ColorSpace, ImageRef, Value};
use halfvector_reference::{EnvironmentFilter, Reference, RenderOptions};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

const SIZE: u32 = 256;
const SAMPLES: u64 = 64;
const TEXTURE: &str = "textures/Metal_Mesh_008/basecolor.jpg";
const ENVIRONMENT: &str = "mitsuba/venice.exr";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let data = std::env::var_os("HALFVECTOR_DATA").map_or_else(|| PathBuf::from("../shared/data"), PathBuf::from);
    let scene = scene(&data)?;
    let light = halfvector_ibl::load(&std::fs::read(data.join(ENVIRONMENT))?, ENVIRONMENT)?;
    let options = RenderOptions {
        width: SIZE,
        height: SIZE,
        environment_filter: EnvironmentFilter::VertexRows,
        ..RenderOptions::default()
    };
    let paths = f64::from(SIZE * SIZE) * SAMPLES as f64;
    let (mut best, mut peer) = (0.0_f64, 0.0_f64);
    for turn in 0..3 {
        let mut reference = Reference::new(&scene, Some(&light), options)?;
        let start = Instant::now();
        reference.add_samples(SAMPLES, &|_| {})?;
        let ours = paths / start.elapsed().as_secs_f64();
        best = best.max(ours);
        let picture = reference.picture();
        let mean = |c: usize| picture.pixels.iter().map(|p| p[c]).sum::<f64>() / f64::from(SIZE * SIZE);
        println!("turn {turn}: here {:.3} M paths/s, mean {:.4} {:.4} {:.4}", ours / 1e6, mean(0), mean(1), mean(2));
        if let Some((theirs, text)) = mitsuba(&data) {
            peer = peer.max(theirs);
            println!("turn {turn}: {text}");
        }
    }
    if peer > 0.0 {
        println!("best of three: {:.3} M paths/s, Mitsuba {:.3} M, ratio {:.2}", best / 1e6, peer / 1e6, best / peer);
    } else {
        println!("best of three: {:.3} M paths/s; Mitsuba is not there to compare with", best / 1e6);
    }
    Ok(())
}

/// A metal whose colour is a picture.
fn scene(data: &Path) -> Result<Scene, Box<dyn std::error::Error>> {
    let mut document = Document::with_surface("textured metal");
    let surface = document.graph.nodes.get_mut("surface").ok_or("a surface")?;
    surface.values.insert("metallic".into(), Value::Number(1.0));
    surface.values.insert("perceptual_roughness".into(), Value::Number(0.4));
    let mut picture = Node::new("textures/image");
    let image = ImageRef {
        file: TEXTURE.into(),
        color_space: ColorSpace::Srgb,
        wrap_u: Default::default(),
        wrap_v: Default::default(),
        filter: Default::default(),
    };
    picture.values.insert("image".into(), Value::Image(image));
    document.graph.nodes.insert("picture".into(), picture);
    document.graph.links.push(Link::new(SocketRef::new("picture", "color"), SocketRef::new("surface", "base_color")));
    let mut scene = Scene::from_material(document, data, &MeshSource::Builtin(BuiltinMesh::Sphere))?;
    scene.methods.set("v", "separable")?;
    scene.methods.set("compensation", "none")?;
    scene.environment_rotation = -90.0;
    Ok(scene)
}

/// Paths per second of the same scene in Mitsuba, and what it prints.
fn mitsuba(data: &Path) -> Option<(f64, String)> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/peers/mitsuba_paths.py");
    let arguments = [data.join(TEXTURE), data.join(ENVIRONMENT)];
    let output = Command::new("python3")
        .arg(script)
        .args(arguments)
        .args([SIZE.to_string(), SAMPLES.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    let rate = text.split_whitespace().find_map(|word| word.strip_prefix("paths_per_second="))?.parse().ok()?;
    Some((rate, text))
}
