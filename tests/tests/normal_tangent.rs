//! Normal-mapped surfaces against the relief that they stand for, as pictures of the shading normal.
//!
//! Khronos' NormalTangentTest, when the data is there: in each of its fifteen pairs a flat quad with a normal map stands
//! 0.32 to the right of the real relief and has to shade like it. And surfaces made here, with mirrored and turned texture
//! coordinates, against the height field that their map was made from.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3};
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value};
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::mesh::MeshData;
use halfvector_scene::{Background, EnvironmentSource, Mesh, Object, Scene, SceneMaterial};

use crate::support::{data, renderer};

/// Half of the world's height in the pictures.
const HALF_EXTENT: f32 = 1.25;

/// A source of emission (n + 1) / 2 in place of all that a material does.
fn show_normals(document: &mut Document) {
    let (surface, _) = document.graph.nodes.iter().find(|(_, n)| n.node == "surface/surface").expect("a surface");
    let surface = surface.clone();
    let normal = document.graph.incoming(&SocketRef::new(&surface, "normal")).expect("a normal map").clone();
    document.graph.links.retain(|l| l.to.node != surface || l.to.socket == "normal");
    let half = Node::new("math/multiply_add").with("b", Value::Number(0.5)).with("c", Value::Number(0.5));
    document.graph.nodes.insert("half".into(), half);
    document.graph.links.push(Link::new(normal, SocketRef::new("half", "a")));
    document.graph.links.push(Link::new(SocketRef::new("half", "out"), SocketRef::new(&surface, "emission")));
}

/// Draws the scene's shading normals as seen along -Z, from so far that perspective moves nothing by a tenth of a pixel.
fn normals(renderer: &Renderer, scene: &mut Scene, size: u32) -> Vec<Option<Vec3>> {
    for material in &mut scene.materials {
        if !material.document.graph.nodes.contains_key("half") {
            show_normals(&mut material.document);
        }
    }
    let distance = 2000.0;
    scene.environment = EnvironmentSource::None;
    scene.background = Background::None;
    scene.lights.clear();
    scene.camera.position = Vec3::new(0.0, 0.0, distance);
    scene.camera.target = Vec3::ZERO;
    scene.camera.vertical_fov = 2.0 * (HALF_EXTENT / distance).atan().to_degrees();
    let options = RenderOptions { width: size, height: size, samples_per_side: 1, ..RenderOptions::default() };
    let picture = renderer.render(scene, None, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    let normal = |p: &[f32; 4]| (p[3] > 0.0).then(|| (Vec3::new(p[0], p[1], p[2]) * 2.0 - 1.0).normalize());
    picture.pixels.iter().map(normal).collect()
}

fn degrees(a: Vec3, b: Vec3) -> f64 {
    f64::from(a.cross(b).length().atan2(a.dot(b)).to_degrees())
}

/// Pixels in a row of the picture of NormalTangentTest. A pixel is 1 mm, so that the distance of relief and quad, 0.32,
/// is a whole number of them; a texel of the normal map is 1.29 mm, so that its finest level is read.
const SIZE: usize = 2500;
/// From a relief to its normal-mapped quad, in pixels.
const OFFSET: usize = 320;
/// Left and upper edge of the first relief, spacing of the pairs, edge of a quad, in pixels.
const FIRST: [usize; 2] = [140, 300];
const SPACING: [usize; 2] = [800, 400];
const EDGE: usize = 300;
/// The outermost pixels of a quad that are left out: its texels have some of the neighbour in them.
const RIM: usize = 12;

/// What the pairs of NormalTangentTest differ by.
#[derive(Default)]
struct Differences {
    mean: f64,
    max: f64,
    /// The share of pixels above 3 degrees.
    above: f64,
    /// The largest angle, and the share of pixels, where the relief turns by less than 6 degrees within a texel.
    smooth_max: f64,
    smooth: f64,
    /// Mean and largest angle between the means over squares of each of [`BLOCKS`] pixels a side: pictures of fewer pixels
    /// with that many samples in each.
    averaged: [[f64; 2]; BLOCKS.len()],
}

/// 1.6, 3.1 and 4.7 texels a side.
const BLOCKS: [usize; 3] = [2, 4, 6];

/// A map of texels cannot say how a normal turns between two of them: where the relief's turns by an angle within a texel,
/// the map is right to half of it. The foot of each relief turns by 35 degrees within 1.5 texels, and by 33 within 4.4.
/// And at the very centres of its texels, where nothing is filtered, this map is as far as 3.95 degrees off the relief
/// (`normal_tangent_texels`).
fn differences(normals: &[Option<Vec3>]) -> Differences {
    let at = |x: usize, y: usize| normals[y * SIZE + x].unwrap_or_else(|| panic!("nothing at {x} {y}"));
    let mut d = Differences::default();
    let (mut count, mut blocks) = (0.0, [0.0; BLOCKS.len()]);
    for pair in 0..15 {
        let [left, top] = [FIRST[0] + SPACING[0] * (pair % 3), FIRST[1] + SPACING[1] * (pair / 3)];
        for y in top + RIM..top + EDGE - RIM {
            for x in left + RIM..left + EDGE - RIM {
                let relief = at(x, y);
                let angle = degrees(relief, at(x + OFFSET, y));
                let neighbours = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| at(x, y)));
                let turn = neighbours.map(|n| degrees(relief, n)).fold(0.0, f64::max);
                d.mean += angle;
                d.max = d.max.max(angle);
                d.above += f64::from(u8::from(angle > 3.0));
                if turn < 6.0 {
                    d.smooth_max = d.smooth_max.max(angle);
                    d.smooth += 1.0;
                }
                count += 1.0;
            }
        }
        for (k, size) in BLOCKS.into_iter().enumerate() {
            for y in (top + RIM..top + EDGE - RIM).step_by(size) {
                for x in (left + RIM..left + EDGE - RIM).step_by(size) {
                    let mean = |x: usize| -> Vec3 { (0..size * size).map(|i| at(x + i % size, y + i / size)).sum() };
                    let angle = degrees(mean(x), mean(x + OFFSET));
                    let [sum, max] = &mut d.averaged[k];
                    (*sum, *max) = (*sum + angle, max.max(angle));
                    blocks[k] += 1.0;
                }
            }
        }
    }
    d.mean /= count;
    d.averaged.iter_mut().zip(blocks).for_each(|([mean, _], count)| *mean /= count);
    d.above /= count;
    d.smooth /= count;
    d
}

#[test]
fn quads_shade_like_their_reliefs() {
    let Some(path) = data("models/NormalTangentTest.glb") else { return };
    let Some(renderer) = renderer() else { return };
    let mut scene = Scene::from_model(&path).unwrap_or_else(|e| panic!("{e}"));
    println!(
        "degrees      {:>9} {:>9} {:>9} | relief turns < 6 a texel: share, max | mean, max of n x n pixels, n = {BLOCKS:?}",
        "mean", "max", "above 3"
    );
    for method in ["tbn", "tbn_derivative", "rotation_report", "rotation_fixed"] {
        scene.methods.set("normal", method).expect("a method of the list");
        let d = differences(&normals(&renderer, &mut scene, SIZE as u32));
        let [above, smooth] = [d.above, d.smooth].map(|share| share * 100.0);
        print!("{method:<16} {:>6.3} {:>9.3} {above:>8.2}% | {smooth:.2}%, {:.3}", d.mean, d.max, d.smooth_max);
        println!("{}", d.averaged.map(|[mean, max]| format!(" | {mean:.3}, {max:.3}")).concat());
        if method.starts_with("tbn") {
            assert!(d.mean <= 0.5 && d.smooth_max <= 3.0, "mean {}, max of smooth pixels {}", d.mean, d.smooth_max);
            // As a picture shows it whose pixels are three texels or more: the map and its relief are one surface.
            let [_, four, six] = d.averaged;
            assert!([four, six].iter().all(|[mean, max]| *mean <= 0.5 && *max <= 3.0), "{:?}", d.averaged);
            assert!(d.smooth > 0.9 && d.max < 8.0 && d.above < 0.02, "{smooth} {} {above}", d.max);
        }
    }
}

/// Texels in a row of the made normal map.
const TEXELS: u32 = 512;

/// The made height field, in units of the picture's edge, over s to the right and t up the picture; it repeats.
fn height(p: DVec2) -> f64 {
    let [a, b] = [TAU * (2.0 * p.x + p.y), TAU * (3.0 * p.y - p.x) + 1.0];
    0.025 * a.sin() + 0.02 * b.cos() * (TAU * p.x).sin()
}

/// Its slopes by s and t.
fn slopes(p: DVec2) -> DVec2 {
    const STEP: f64 = 1e-5;
    let along = |d: DVec2| (height(p + d) - height(p - d)) / (2.0 * STEP);
    DVec2::new(along(DVec2::X * STEP), along(DVec2::Y * STEP))
}

/// The height field as a +Y normal map of 16 bits.
fn save_map(path: &std::path::Path) {
    let map = image::ImageBuffer::from_fn(TEXELS, TEXELS, |i, j| {
        let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(TEXELS));
        let slope = slopes(DVec2::new(u, 1.0 - v));
        let n = DVec3::new(-slope.x, -slope.y, 1.0).normalize();
        image::Rgb([n.x, n.y, n.z].map(|c| ((c * 0.5 + 0.5) * 65535.0).round() as u16))
    });
    map.save(path).expect("the map is saved");
}

/// A surface over a part of the plane as the camera sees it, and its truth there.
struct Made {
    name: &'static str,
    mesh: Mesh,
    /// Which pixels it covers [m].
    low: DVec2,
    high: DVec2,
    /// Position on the picture of the surface point over (x, y), the unit directions along which s and t grow there, and
    /// the surface's normal.
    truth: fn(DVec2) -> (DVec2, DVec3, DVec3, DVec3),
}

fn mesh(positions: Vec<[f32; 3]>, normals: Vec<[f32; 3]>, st: &[DVec2], indices: Vec<u32>) -> Mesh {
    let uv0 = st.iter().map(|p| [p.x as f32, 1.0 - p.y as f32]).collect();
    let data = MeshData { positions, normals: Some(normals), uv0: Some(uv0), indices, ..MeshData::default() };
    Mesh::build(data).expect("a sound mesh")
}

/// A flat quad with its texture from `truth`, which is linear.
fn flat(name: &'static str, low: [f64; 2], truth: fn(DVec2) -> (DVec2, DVec3, DVec3, DVec3)) -> Made {
    let low = DVec2::from(low);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|c| low + DVec2::from(c));
    let st = corners.map(|c| truth(c).0);
    let positions = corners.map(|c| [c.x as f32, c.y as f32, 0.0]).to_vec();
    let mesh = mesh(positions, vec![[0.0, 0.0, 1.0]; 4], &st, vec![0, 1, 2, 0, 2, 3]);
    Made { name, mesh, low, high: low + 1.0, truth }
}

/// Two quads that share an edge at x = 0.6, at which the texture is mirrored.
fn seam(p: DVec2) -> (DVec2, DVec3, DVec3, DVec3) {
    let side = if p.x < 0.6 { -1.0 } else { 1.0 };
    (DVec2::new((p.x - 0.6).abs(), p.y), DVec3::X * side, DVec3::Y, DVec3::Z)
}

fn welded_seam() -> Made {
    let grid: Vec<DVec2> = [0.1, 0.6, 1.1].iter().flat_map(|&x| [-1.2, -0.2].map(|y| DVec2::new(x, y))).collect();
    let positions = grid.iter().map(|p| [p.x as f32, p.y as f32, 0.0]).collect();
    let st: Vec<DVec2> = grid.iter().map(|&p| seam(p).0).collect();
    let mesh = mesh(positions, vec![[0.0, 0.0, 1.0]; 6], &st, vec![0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3]);
    Made { name: "welded mirror seam", mesh, low: DVec2::new(0.1, -1.2), high: DVec2::new(1.1, -0.2), truth: seam }
}

/// A cylinder about an upright axis through x = -0.6, of radius 0.6, with the texture mirrored along its middle.
const RADIUS: f64 = 0.6;

fn barrel(p: DVec2) -> (DVec2, DVec3, DVec3, DVec3) {
    let angle = ((p.x + 0.6) / RADIUS).asin();
    let (sin, cos) = angle.sin_cos();
    let side = if angle < 0.0 { -1.0 } else { 1.0 };
    (DVec2::new(RADIUS * angle.abs(), p.y), DVec3::new(cos, 0.0, -sin) * side, DVec3::Y, DVec3::new(sin, 0.0, cos))
}

/// 32 strips over 2 x 56 degrees; the vertices at the mirror are shared.
fn mirrored_barrel() -> Made {
    let angles: Vec<f64> = (0..=32).map(|k| (f64::from(k) / 16.0 - 1.0) * 56f64.to_radians()).collect();
    let (mut positions, mut normals, mut st, mut indices) = (vec![], vec![], vec![], vec![]);
    for (k, angle) in angles.iter().enumerate() {
        let (sin, cos) = angle.sin_cos();
        for y in [-1.2, -0.2] {
            positions.push([(RADIUS * sin - 0.6) as f32, y as f32, (RADIUS * cos - RADIUS) as f32]);
            normals.push([sin as f32, 0.0, cos as f32]);
            st.push(DVec2::new(RADIUS * angle.abs(), y));
        }
        if k > 0 {
            let a = 2 * k as u32 - 2;
            indices.extend([a, a + 2, a + 3, a, a + 3, a + 1]);
        }
    }
    let half = RADIUS * 56f64.to_radians().sin();
    let mesh = mesh(positions, normals, &st, indices);
    let (low, high) = (DVec2::new(-0.6 - half, -1.2), DVec2::new(-0.6 + half, -0.2));
    Made { name: "mirrored barrel", mesh, low, high, truth: barrel }
}

/// Mirrored, turned and welded textures shade like the height field that their normal map was made from.
#[test]
fn mirrored_textures_shade_like_their_relief() {
    let Some(renderer) = renderer() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    save_map(&folder.path().join("normal.png"));
    let mut document = Document::with_surface("made");
    let image = ImageRef {
        file: "normal.png".into(),
        color_space: ColorSpace::Linear,
        wrap_u: Default::default(),
        wrap_v: Default::default(),
        filter: Filter::Linear,
    };
    document.graph.nodes.insert("image".into(), Node::new("textures/image").with("image", Value::Image(image)));
    document.graph.nodes.insert("map".into(), Node::new("textures/normal_map"));
    document.graph.links.push(Link::new(SocketRef::new("image", "color"), SocketRef::new("map", "color")));
    document.graph.links.push(Link::new(SocketRef::new("map", "out"), SocketRef::new("surface", "normal")));

    let made = [
        flat("upright and mirrored in u", [-1.2, 0.0], |p| (DVec2::new(-p.x, p.y), -DVec3::X, DVec3::Y, DVec3::Z)),
        // Turned by the angle of 3-4-5 and mirrored.
        flat("turned and mirrored", [0.1, 0.0], |p| {
            let (s, t) = (DVec2::new(0.6, 0.8), DVec2::new(0.8, -0.6));
            (DVec2::new(s.dot(p), t.dot(p)), s.extend(0.0), t.extend(0.0), DVec3::Z)
        }),
        welded_seam(),
        mirrored_barrel(),
    ];
    let mut scene = Scene::default();
    for made in &made {
        let world_from_object = glam::Mat4::IDENTITY;
        scene.objects.push(Object { name: made.name.into(), mesh: scene.meshes.len(), material: 0, world_from_object });
        scene.meshes.push(made.mesh.clone().into());
    }
    scene.materials.push(SceneMaterial { document, directory: folder.path().into() });
    scene.load_images().expect("the map");
    let size = 1250;
    for (method, drawn) in ["tbn", "tbn_derivative"].map(|method| {
        scene.methods.set("normal", method).expect("a method of the list");
        (method, normals(&renderer, &mut scene, size))
    }) {
        for made in &made {
            compare_with_truth(method, made, &drawn, size);
        }
    }
}

fn compare_with_truth(method: &str, made: &Made, drawn: &[Option<Vec3>], size: u32) {
    let (mut sum, mut max, mut count) = (0.0, 0.0_f64, 0.0);
    for (i, normal) in drawn.iter().enumerate() {
        let [column, row] = [i as u32 % size, i as u32 / size].map(|k| (f64::from(k) + 0.5) / f64::from(size));
        let p = DVec2::new(2.0 * column - 1.0, 1.0 - 2.0 * row) * f64::from(HALF_EXTENT);
        if (p - made.low).min_element() < 0.004 || (made.high - p).min_element() < 0.004 {
            continue;
        }
        let (st, along_s, along_t, n) = (made.truth)(p);
        let slope = slopes(st);
        let truth = (n - along_s * slope.x - along_t * slope.y).normalize();
        let normal = normal.unwrap_or_else(|| panic!("{}: nothing at {p}", made.name));
        let angle = degrees(truth.as_vec3(), normal);
        (sum, max, count) = (sum + angle, max.max(angle), count + 1.0);
    }
    println!("{method:<14} {:<26} mean {:.3} max {max:.3} degrees, {count} pixels", made.name, sum / count);
    assert!(count > 2e5 && sum / count <= 0.3 && max <= 3.0, "{method}, {}: {} {max}", made.name, sum / count);
}
