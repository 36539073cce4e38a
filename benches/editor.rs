//! What the editor waits for: a picture after a number was dragged, after the camera moved, and after an edit that makes
//! another shader (code generator, program, pipeline and picture), of a material of 30 nodes; and all of it without what is
//! kept from picture to picture. Of the edit, what the processor does however fast the GPU is stands alone, too: the document changed and
//! checked, our code generator, and what wgpu has naga do with the text (read, validate, translate to SPIR-V). What is left of the edit then is the
//! driver's: its compiler and the picture. Who has a GPU runs `cargo bench -p halfvector-benches --bench editor -- edit`. Without a GPU, not even a software one, it says so and
//! measures that part alone.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use halfvector_codegen::{Fold, shader};
use halfvector_graph::check::check;
use halfvector_graph::document::{Document, Node};
use halfvector_graph::edit::{Edit, apply};
use halfvector_graph::library::Library;
use halfvector_graph::needs::ShaderOutput;
use halfvector_graph::value::Value;
use halfvector_ibl::{BakeOptions, bake};
use halfvector_render::{Cache, RenderOptions, Renderer};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

/// A chain of noises that weigh mixes; `scale` is a number of the last one, `edit` swaps one of its nodes.
fn thirty_nodes(scale: f32, edit: bool) -> Document {
    let link = |from: &str, to: &str| format!(r#"{{"from": "{from}", "to": "{to}"}}"#);
    let mut nodes = vec![
        r#""start": {"node": "input/color"}, "surface": {"node": "surface/surface"}"#.to_owned(),
        format!(r#""rough": {{"node": "math/{}", "values": {{"b": 0.4}}}}"#, if edit { "max" } else { "multiply" }),
    ];
    let mut links = vec![link("noise0.out", "rough.a"), link("rough.out", "surface.perceptual_roughness")];
    let mut from = "start.out".to_owned();
    for step in 0..9 {
        let frequency = if step == 8 { scale } else { step as f32 + 2.0 };
        nodes.push(format!(
            r#""noise{step}": {{"node": "procedural/value_noise_3d", "values": {{"scale": {frequency}}}}},
               "tint{step}": {{"node": "math/multiply", "values": {{"b": [0.9, 0.8, 0.7]}}}},
               "mix{step}": {{"node": "math/mix"}}"#
        ));
        links.push(link(&from, &format!("tint{step}.a")));
        links.push(link(&from, &format!("mix{step}.a")));
        links.push(link(&format!("tint{step}.out"), &format!("mix{step}.b")));
        links.push(link(&format!("noise{step}.out"), &format!("mix{step}.t")));
        from = format!("mix{step}.out");
    }
    links.push(link(&from, "surface.base_color"));
    let (nodes, links) = (nodes.join(","), links.join(","));
    let json = format!(r#"{{"halfvector": 1, "name": "Thirty nodes", "nodes": {{{nodes}}}, "links": [{links}]}}"#);
    halfvector_graph::file::from_json(&json).expect("a sound document")
}

/// Reads, validates and translates as wgpu does for Vulkan.
fn spirv(wgsl: &str) -> usize {
    let module = naga::front::wgsl::parse_str(wgsl).expect("sound WGSL");
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all()).validate(&module).expect("valid");
    let words = module.entry_points.iter().map(|entry| {
        let of = naga::back::spv::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone() };
        let options = naga::back::spv::Options::default();
        naga::back::spv::write_vec(&module, &info, &options, Some(&of)).expect("SPIR-V").len()
    });
    words.sum()
}

fn processor(criterion: &mut Criterion) {
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(thirty_nodes(10.0, true), "".as_ref(), &sphere).expect("a scene");
    let needs = halfvector_scene::needs(&scene, ShaderOutput::Radiance);
    let document = &scene.materials[0].document;
    let make = || shader(black_box(document), Library::standard(), &needs, Fold::Live).expect("a shader");
    let wgsl = make().wgsl;
    let mut group = criterion.benchmark_group("edit, on the processor");
    group.sample_size(20);
    // As the window's session does: another node in the place of one, and all problems of what is there then.
    let swap = |kind: &str| {
        let node = Node::new(kind).with("b", Value::Number(0.4));
        Edit::Many(vec![Edit::TakeNode { id: "rough".into() }, Edit::AddNode { id: "rough".into(), node }])
    };
    let (mut edited, mut kinds) = (document.clone(), [swap("math/max"), swap("math/multiply")].into_iter().cycle());
    group.bench_function("document", |bencher| {
        bencher.iter(|| {
            let edit = kinds.next().expect("one of two");
            apply(&mut edited, &edit).expect("an edit that can be made");
            check(&edited, Library::standard()).len()
        });
    });
    group.bench_function("code generator", |bencher| bencher.iter(make));
    group.bench_function("naga", |bencher| bencher.iter(|| spirv(black_box(&wgsl))));
    group.finish();
}

fn picture(criterion: &mut Criterion) {
    let gpu = match Renderer::new() {
        Ok(gpu) => gpu,
        Err(error) => return println!("skipped: {error}"),
    };
    println!("on {}", gpu.adapter());
    let light = Arc::new(bake(&halfvector_ibl::studio(), &BakeOptions { size: 64, ..BakeOptions::default() }));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let mut scene = Scene::from_material(thirty_nodes(10.0, false), "".as_ref(), &sphere).expect("a scene");
    let options =
        RenderOptions { width: 256, height: 256, samples_per_side: 1, fold: Fold::Live, ..Default::default() };
    let mut cache = Cache::default();
    let mut group = criterion.benchmark_group("picture");
    group.sample_size(20);
    let draw = |cache: &mut Cache, scene: &Scene| {
        gpu.render_live(cache, scene, Some(&light), &options, |_| true).expect("a picture")
    };
    draw(&mut cache, &scene);
    let mut count = 0_u32;
    group.bench_function("camera", |bencher| {
        bencher.iter(|| {
            count += 1;
            scene.camera.position.x = 0.001 * count as f32;
            draw(&mut cache, &scene)
        });
    });
    group.bench_function("number", |bencher| {
        bencher.iter(|| {
            count += 1;
            scene.materials[0].document = thirty_nodes(10.0 + 0.001 * count as f32, false);
            draw(&mut cache, &scene)
        });
    });
    let edited = thirty_nodes(10.0, true);
    group.bench_function("edit", |bencher| {
        // The program of the edit is new to a cache that knows only what was there before.
        let before = || {
            let mut cache = Cache::default();
            scene.materials[0].document = thirty_nodes(10.0, false);
            draw(&mut cache, &scene);
            let mut after = scene.clone();
            after.materials[0].document = edited.clone();
            (cache, after)
        };
        let edit = |(mut cache, after): (Cache, Scene)| draw(&mut cache, &after);
        bencher.iter_batched(before, edit, BatchSize::PerIteration);
    });
    group.bench_function("nothing kept", |bencher| {
        bencher.iter(|| gpu.render(&scene, Some(&light), &options, |_| {}).expect("a picture"));
    });
    group.finish();
}

criterion_group!(benches, processor, picture);
criterion_main!(benches);
