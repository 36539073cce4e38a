//! Khronos' NormalTangentTest, when the data is there: in each of its fifteen pairs a flat quad with a normal map stands
//! 0.32 to the right of the real relief and has to shade like it. Shading normals are drawn as emission and compared.

use glam::Vec3;
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::value::Value;
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::{EnvironmentSource, Scene};

use crate::support::{data, renderer};

/// Pixels in a row.
const SIZE: u32 = 1400;
/// Half of the world's height in the picture.
const HALF_EXTENT: f32 = 1.25;
/// From a relief to its normal-mapped quad.
const OFFSET: f32 = 0.32;
/// Left and lower edge of the first relief, spacing of the pairs, edge of a quad.
const FIRST: [f32; 2] = [-1.11, -0.95];
const SPACING: [f32; 2] = [0.8, 0.4];
const EDGE: f32 = 0.30;

/// Emits (n + 1) / 2 and reflects nothing.
fn show_normals(document: &mut Document) {
    let (surface, _) = document.nodes.iter().find(|(_, n)| n.node == "surface/surface").expect("a surface");
    let surface = surface.clone();
    let normal = document.incoming(&SocketRef::new(&surface, "normal")).expect("a normal map").clone();
    document.links.retain(|l| l.to.node != surface || l.to.socket == "normal");
    let half = Node::new("math/multiply_add").with("b", Value::Number(0.5)).with("c", Value::Number(0.5));
    document.nodes.insert("half".into(), half);
    document.links.push(Link::new(normal, SocketRef::new("half", "a")));
    document.links.push(Link::new(SocketRef::new("half", "out"), SocketRef::new(&surface, "emission")));
}

fn normals(renderer: &Renderer, scene: &Scene) -> Vec<Option<Vec3>> {
    let options = RenderOptions { width: SIZE, height: SIZE, samples_per_side: 1, ..RenderOptions::default() };
    let picture = renderer.render(scene, None, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    let normal = |p: &[f32; 4]| (p[3] > 0.0).then(|| (Vec3::new(p[0], p[1], p[2]) * 2.0 - 1.0).normalize());
    picture.pixels.iter().map(normal).collect()
}

/// Mean and largest angle between the reliefs and their quads [deg], and the share of pixels above 3 degrees.
fn angles(normals: &[Option<Vec3>]) -> (f64, f64, f64) {
    let pixel = |x: f32, y: f32| {
        let column = ((x / HALF_EXTENT + 1.0) * 0.5 * SIZE as f32) as usize;
        let row = ((1.0 - y / HALF_EXTENT) * 0.5 * SIZE as f32) as usize;
        normals[row * SIZE as usize + column]
    };
    let (mut sum, mut largest, mut above, mut count) = (0.0f64, 0.0f64, 0.0, 0.0);
    let steps = 150;
    for pair in 0..15 {
        let left = FIRST[0] + SPACING[0] * (pair % 3) as f32;
        let low = FIRST[1] + SPACING[1] * (pair / 3) as f32;
        // The rim of a quad has half a texel of its neighbour in it.
        for i in 6..steps - 6 {
            for j in 6..steps - 6 {
                let x = left + EDGE * (i as f32 + 0.5) / steps as f32;
                let y = low + EDGE * (j as f32 + 0.5) / steps as f32;
                let (Some(relief), Some(quad)) = (pixel(x, y), pixel(x + OFFSET, y)) else {
                    panic!("nothing at {x} {y}")
                };
                let angle = f64::from(relief.dot(quad).clamp(-1.0, 1.0).acos().to_degrees());
                sum += angle;
                largest = largest.max(angle);
                above += f64::from(u8::from(angle > 3.0));
                count += 1.0;
            }
        }
    }
    (sum / count, largest, above / count)
}

#[test]
fn quads_shade_like_their_reliefs() {
    let Some(path) = data("models/NormalTangentTest.glb") else { return };
    let Some(renderer) = renderer() else { return };
    let mut scene = Scene::from_model(&path).unwrap_or_else(|e| panic!("{e}"));
    for material in &mut scene.materials {
        show_normals(&mut material.document);
    }
    scene.environment = EnvironmentSource::None;
    scene.lights.clear();
    // From so far that perspective shifts no relief against its quad by a pixel.
    let distance = 400.0;
    scene.camera.position = Vec3::new(0.0, 0.0, distance);
    scene.camera.target = Vec3::ZERO;
    scene.camera.vertical_fov = 2.0 * (HALF_EXTENT / distance).atan().to_degrees();

    println!("{:<16} {:>9} {:>9} {:>9}", "normal", "mean deg", "max deg", "above 3");
    for method in ["tbn", "rotation_report", "rotation_fixed"] {
        scene.methods.set("normal", method).expect("a method of the list");
        let (mean, largest, above) = angles(&normals(&renderer, &scene));
        println!("{method:<16} {mean:>9.3} {largest:>9.3} {:>8.2}%", above * 100.0);
        if method == "tbn" {
            assert!(mean <= 1.0, "mean angle {mean}");
        }
    }
}
