//! Pictures that follow each other: what a renderer keeps, and that what it keeps changes no picture.

use std::path::Path;
use std::sync::Arc;

use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::value::Value;
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake};
use halfvector_render::{Cache, Made, RenderOptions, Renderer};
use halfvector_scene::{Background, BuiltinMesh, Light, MeshSource, Scene};

use crate::support::{renderer, root};

const OPTIONS: RenderOptions =
    RenderOptions { width: 12, height: 12, samples_per_side: 1, fold: halfvector_codegen::Fold::Live, tile_edge: 2048 };

fn example(name: &str) -> Scene {
    let folder = root().join("examples");
    let document = halfvector_graph::file::load(&folder.join(name)).expect("an example");
    let mut scene = Scene::from_material(document, &folder, &MeshSource::Builtin(BuiltinMesh::Cube)).expect("a scene");
    scene.background = Background::None;
    scene
}

fn studio() -> Arc<BakedEnvironment> {
    let options = BakeOptions { size: 16, irradiance_size: 4, ..BakeOptions::default() };
    Arc::new(bake(&halfvector_ibl::studio(), &options))
}

/// Draws and tells what had to be made for it.
fn draw(gpu: &Renderer, cache: &mut Cache, scene: &Scene, light: &Arc<BakedEnvironment>) -> Made {
    let before = cache.made();
    gpu.render_live(cache, scene, Some(light), &OPTIONS, |_| true).expect("a picture").expect("all of it");
    let after = cache.made();
    Made {
        shaders: after.shaders - before.shaders,
        programs: after.programs - before.programs,
        pipelines: after.pipelines - before.pipelines,
        textures: after.textures - before.textures,
        meshes: after.meshes - before.meshes,
    }
}

/// Each number of each value of a document, a little larger.
fn nudged(document: &Document) -> Vec<(String, Document)> {
    let mut all = Vec::new();
    for (id, node) in &document.graph.nodes {
        for (socket, value) in &node.values {
            let nudge = |x: f32| x * 1.03 + 0.004;
            let value = match value {
                // Whole numbers go by whole steps.
                Value::Number(x) if x.fract() == 0.0 => Value::Number(x + 1.0),
                Value::Number(x) | Value::Decimal { nearest: x, .. } => Value::Number(nudge(*x)),
                Value::Vec2(v) => Value::Vec2(v.map(nudge)),
                Value::Vec3(v) => Value::Vec3(v.map(nudge)),
                Value::Vec4(v) => Value::Vec4(v.map(nudge)),
                Value::Integer(x) => Value::whole(x ^ 1),
                Value::Bool(_) | Value::Image(_) => continue,
            };
            let mut changed = document.clone();
            changed.graph.nodes.get_mut(id).expect("itself").values.insert(socket.clone(), value);
            all.push((format!("{id}.{socket}"), changed));
        }
    }
    all
}

#[test]
fn dragging_a_number_compiles_nothing_and_an_edit_one_program() {
    let Some(gpu) = renderer() else { return };
    let (mut cache, light) = (Cache::default(), studio());
    let mut scene = example("rusted-iron.material.json");
    let first = draw(&gpu, &mut cache, &scene, &light);
    assert_eq!((first.programs, first.meshes), (1, 1));
    assert_eq!(draw(&gpu, &mut cache, &scene, &light), Made::default(), "the same again");

    let document = scene.materials[0].document.clone();
    let dragged = nudged(&document);
    assert!(dragged.len() > 10, "only {} numbers", dragged.len());
    for (name, changed) in dragged {
        scene.materials[0].document = changed;
        let made = draw(&gpu, &mut cache, &scene, &light);
        assert_eq!(made, Made { shaders: 1, ..Made::default() }, "{name}");
    }

    // Another camera, another light's brightness: not even the shader's text is made anew.
    scene.materials[0].document = document.clone();
    scene.lights = vec![Light::Point { position: [1.0, 2.0, 3.0].into(), intensity: [5.0; 3].into() }];
    draw(&gpu, &mut cache, &scene, &light);
    scene.lights = vec![Light::Point { position: [2.0, 2.0, 3.0].into(), intensity: [9.0; 3].into() }];
    scene.camera.position.x += 1.0;
    assert_eq!(draw(&gpu, &mut cache, &scene, &light), Made::default());

    // A wire more is one program more, and taking it back none.
    let mut wired = document.clone();
    wired.graph.nodes.insert("more".into(), Node::new("math/multiply").with("b", Value::Number(0.7)));
    let surface = SocketRef::new("surface", "occlusion");
    wired.graph.links.retain(|link| link.to != surface);
    wired.graph.links.push(Link::new(SocketRef::new("patches", "out"), SocketRef::new("more", "a")));
    wired.graph.links.push(Link::new(SocketRef::new("more", "out"), surface));
    scene.materials[0].document = wired;
    let made = draw(&gpu, &mut cache, &scene, &light);
    assert_eq!((made.programs, made.pipelines, made.meshes, made.textures), (1, 1, 0, 0));
    scene.materials[0].document = document;
    assert_eq!(draw(&gpu, &mut cache, &scene, &light).programs, 0);
}

#[test]
fn what_is_kept_draws_the_same_picture() {
    let Some(gpu) = renderer() else { return };
    let (mut cache, light) = (Cache::default(), studio());
    for name in ["painted-panel.material.json", "rusted-iron.material.json", "painted-panel.material.json"] {
        let scene = example(name);
        let fresh = gpu.render(&scene, Some(&light), &OPTIONS, |_| {}).expect("a picture");
        for _ in 0..2 {
            let kept = gpu.render_live(&mut cache, &scene, Some(&light), &OPTIONS, |_| true).expect("a picture");
            assert_eq!(kept.as_ref(), Some(&fresh), "{name}");
        }
    }
    // Another environment is another picture, though all else is kept.
    let scene = example("rusted-iron.material.json");
    let white = Arc::new(bake(&halfvector_ibl::white(), &BakeOptions { size: 16, ..BakeOptions::default() }));
    let fresh = gpu.render(&scene, Some(&white), &OPTIONS, |_| {}).expect("a picture");
    let kept = gpu.render_live(&mut cache, &scene, Some(&white), &OPTIONS, |_| true).expect("a picture");
    assert_eq!(kept, Some(fresh));
}

#[test]
fn a_picture_that_nobody_wants_any_more_is_left() {
    let Some(gpu) = renderer() else { return };
    let (mut cache, light) = (Cache::default(), studio());
    let scene = example("rusted-iron.material.json");
    let options = RenderOptions { tile_edge: 4, ..OPTIONS };
    let mut tiles = 0;
    let stopped = gpu.render_live(&mut cache, &scene, Some(&light), &options, |_| {
        tiles += 1;
        tiles < 2
    });
    assert_eq!((stopped.expect("no error"), tiles), (None, 2));
    let raster = halfvector_raster::RasterOptions { width: 256, height: 256, ..Default::default() };
    let stopped = halfvector_raster::draw_while::<f32>(&scene, Some(&light), &raster, |_| false);
    assert_eq!(stopped.expect("no error"), None);
}

#[test]
fn a_material_with_problems_leaves_what_is_kept() {
    let Some(gpu) = renderer() else { return };
    let (mut cache, light) = (Cache::default(), studio());
    let mut scene = example("rusted-iron.material.json");
    draw(&gpu, &mut cache, &scene, &light);
    let sound = std::mem::replace(&mut scene.materials[0].document, Document::new("nothing"));
    assert!(gpu.render_live(&mut cache, &scene, Some(&light), &OPTIONS, |_| true).is_err());
    scene.materials[0].document = sound;
    assert_eq!(draw(&gpu, &mut cache, &scene, &light), Made::default());
    // Where the scene lies does not matter.
    scene.materials[0].directory = Path::new("elsewhere").into();
    assert_eq!(draw(&gpu, &mut cache, &scene, &light), Made::default());
}
