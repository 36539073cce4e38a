//! The CPU's picture against the GPU's, for every example, every node, and models: the same shader, so the same colours but for rounding, and the
//! same rules of coverage, so the same silhouettes.
//!
//! Differences are of display values, 0 to 1, after the scene's exposure and tone map and the sRGB curve.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use halfvector_codegen::Fold;
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake};
use halfvector_interp::Float;
use halfvector_maps::color::srgb_from_linear;
use halfvector_raster::RasterOptions;
use halfvector_render::RenderOptions;
use halfvector_scene::light::parse_light;
use halfvector_scene::tone_map::tone_mapped;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Picture, Scene, load_scene};

use crate::support::{data, renderer, root, with_models};

mod slopes;

/// Pixels on a side.
const SIZE: u32 = 48;

/// Samples along a side of a pixel.
const SIDE: u32 = 4;

/// The share of pixels that may be more than a code apart.
const MOST_APART: f64 = 0.001;

/// Others' models: many materials, and textures with all the ways to repeat and to filter them.
const MODELS: [&str; 2] = ["models/MetalRoughSpheresNoTextures.glb", "models/TextureSettingsTest.glb"];

/// One step of an 8-bit display.
const CODE: f32 = 1.0 / 255.0;

/// The examples with names that end so, in order.
fn examples(ending: &str) -> Vec<PathBuf> {
    examples_in("examples", ending)
}

fn examples_in(folder: &str, ending: &str) -> Vec<PathBuf> {
    let folder = std::fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    let mut files: Vec<PathBuf> = folder.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(ending));
    files.sort();
    files.into_iter().filter_map(with_models).collect()
}

fn material(path: &Path) -> Scene {
    let document = halfvector_graph::file::load(path).unwrap_or_else(|e| panic!("{e}"));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    Scene::from_material(document, path.parent().expect("a folder"), &sphere).unwrap_or_else(|e| panic!("{e}"))
}

fn baked(source: &EnvironmentSource) -> Option<BakedEnvironment> {
    let loaded = source.load().unwrap_or_else(|e| panic!("{e}"))?;
    Some(bake(&loaded, &BakeOptions { size: 64, irradiance_size: 16, ..BakeOptions::default() }))
}

fn on_cpu<F: Float>(scene: &Scene, environment: Option<&BakedEnvironment>) -> Picture {
    folded::<F>(scene, environment, Fold::Export)
}

fn folded<F: Float>(scene: &Scene, environment: Option<&BakedEnvironment>, fold: Fold) -> Picture {
    let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side: SIDE, fold };
    halfvector_raster::draw::<F>(scene, environment, &options, |_| {}).unwrap_or_else(|e| panic!("{e}"))
}

fn display(scene: &Scene, picture: &Picture) -> Vec<[f32; 3]> {
    let factor = scene.exposure.factor();
    let coded = scene.methods.is("encode", "report");
    let of = |&[r, g, b, _]: &[f32; 4]| {
        if coded {
            return [r, g, b].map(|c| c.clamp(0.0, 1.0));
        }
        srgb_from_linear(tone_mapped(scene.tone_map, [r, g, b].map(|c| c * factor)).map(|c| c.clamp(0.0, 1.0)))
    };
    picture.pixels.iter().map(of).collect()
}

/// The mean over each pixel's neighbourhood of 3 x 3, of a square picture.
fn boxed(pixels: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let size = pixels.len().isqrt();
    let near = |i: usize| i.saturating_sub(1)..(i + 2).min(size);
    let mean = |at: usize| {
        let (y, x) = (at / size, at % size);
        let around: Vec<[f32; 3]> = near(y).flat_map(|y| near(x).map(move |x| pixels[y * size + x])).collect();
        std::array::from_fn(|c| around.iter().map(|p| p[c]).sum::<f32>() / around.len() as f32)
    };
    (0..pixels.len()).map(mean).collect()
}

fn difference(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Share of the fully covered pixels that are more than a code apart, and the largest difference after the box.
fn compare(scene: &Scene, cpu: &Picture, gpu: &Picture) -> (f64, f32) {
    let (a, b) = (display(scene, cpu), display(scene, gpu));
    let covered = cpu.pixels.iter().zip(&gpu.pixels).map(|(a, b)| a[3] == 1.0 && b[3] == 1.0);
    let inner: Vec<f32> =
        a.iter().zip(&b).zip(covered).filter(|(_, covered)| *covered).map(|((&a, &b), _)| difference(a, b)).collect();
    let apart = inner.iter().filter(|&&d| d > CODE).count() as f64 / inner.len().max(1) as f64;
    let edges = boxed(&a).into_iter().zip(boxed(&b)).map(|(a, b)| difference(a, b)).fold(0.0, f32::max);
    (apart, edges)
}

/// Every example with the shader that has its numbers folded in and all it does not need left out, and with the one that
/// keeps every number open: nowhere more than a code apart.
#[test]
fn every_example_looks_the_same_unspecialised() {
    let studio = baked(&EnvironmentSource::Studio);
    let mut nodes = examples_in("examples/nodes", ".material.json");
    nodes.extend(examples(".material.json"));
    for path in nodes {
        let mut scene = material(&path);
        scene.background = Background::None;
        scene.environment = EnvironmentSource::Studio;
        let [closed, open] = [Fold::Export, Fold::Live].map(|fold| folded::<f32>(&scene, studio.as_ref(), fold));
        let (a, b) = (display(&scene, &closed), display(&scene, &open));
        let most = a.into_iter().zip(b).map(|(a, b)| difference(a, b)).fold(0.0, f32::max);
        println!("{}: {:.3} codes apart", path.display(), most / CODE);
        assert!(most <= CODE, "{}: {} codes apart", path.display(), most / CODE);
    }
}

/// What is left out because its numbers are fixed is seen nowhere: a black dielectric, which is nothing but its specular lobe,
/// with fixed numbers and with all of them exposed, under a sun of 3.
#[test]
fn a_fixed_black_dielectric_looks_like_one_that_is_exposed() {
    let names = ["base_color", "metallic", "perceptual_roughness", "ior", "specular"];
    for roughness in [0.05, 0.15, 0.3, 0.4, 0.5, 0.8, 1.0] {
        let black = |parameters: &str| {
            let document = format!(
                r#"{{"halfvector": 1, "name": "black", "nodes": {{"surface": {{"node": "surface/surface", "values":
                {{"base_color": [0, 0, 0], "metallic": 0, "perceptual_roughness": {roughness}}}}}}}, "links": [], "parameters": [{parameters}]}}"#
            );
            let document = halfvector_graph::file::from_json(&document).unwrap_or_else(|e| panic!("{e}"));
            let mesh = MeshSource::Builtin(BuiltinMesh::Sphere);
            let mut scene = Scene::from_material(document, Path::new("."), &mesh).unwrap_or_else(|e| panic!("{e}"));
            scene.environment = EnvironmentSource::None;
            scene.background = Background::None;
            scene.lights = vec![parse_light("directional:1,1,1:3").unwrap_or_else(|e| panic!("{e}"))];
            let picture = on_cpu::<f32>(&scene, None);
            display(&scene, &picture)
        };
        let exposed = names.map(|name| format!(r#"{{"name": "{name}", "socket": "surface.{name}"}}"#)).join(", ");
        let most = black("").into_iter().zip(black(&exposed)).map(|(a, b)| difference(a, b)).fold(0.0, f32::max);
        println!("roughness {roughness}: {:.3} codes apart", most / CODE);
        assert!(most <= CODE, "roughness {roughness}: {} codes apart", most / CODE);
    }
}

/// What tells llvmpipe to choose mip levels and to filter as the specification says, not by its faster approximations,
/// whose levels are off by up to a half. Read when the driver is loaded: hence a process of its own. Other drivers ignore it.
const EXACT_SAMPLING: (&str, &str) = ("GALLIVM_PERF", "no_rho_approx,no_brilinear,no_quad_lod,no_aos_sampling");

#[test]
fn every_example_looks_the_same_on_the_cpu() {
    let (variable, value) = EXACT_SAMPLING;
    if std::env::var(variable).is_err() {
        let this = std::env::current_exe().expect("this program");
        let test = "raster::every_example_looks_the_same_on_the_cpu";
        let output = Command::new(this).args([test, "--exact", "--nocapture"]).env(variable, value).output();
        let output = output.expect("the test starts");
        let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        println!("{said}");
        assert!(output.status.success() && said.contains("1 passed"), "see above");
        return;
    }
    let Some(renderer) = renderer() else { return };
    let studio = baked(&EnvironmentSource::Studio);
    let mut scenes: Vec<(String, Scene)> = Vec::new();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for path in examples(".material.json") {
        scenes.push((name(&path), material(&path)));
    }
    for path in examples(".scene.json") {
        scenes.push((name(&path), load_scene(&path).unwrap_or_else(|e| panic!("{e}"))));
    }
    for path in examples_in("examples/nodes", ".material.json") {
        scenes.push((format!("nodes/{}", name(&path)), material(&path)));
    }
    for model in MODELS {
        if let Some(path) = data(model) {
            scenes.push((name(&path), Scene::from_model(&path).unwrap_or_else(|e| panic!("{e}"))));
        }
    }
    let mut failed = Vec::new();
    println!("{:<40} {:>10} {:>10} {:>8} {:>8}", "example", "apart", "boxed/255", "gpu s", "cpu s");
    for (name, mut scene) in scenes {
        scene.background = Background::None;
        let own = if scene.environment == EnvironmentSource::Studio { None } else { baked(&scene.environment) };
        let environment = match scene.environment {
            EnvironmentSource::Studio => studio.as_ref(),
            _ => own.as_ref(),
        };
        let begin = Instant::now();
        let options = RenderOptions { width: SIZE, height: SIZE, samples_per_side: SIDE, ..RenderOptions::default() };
        let gpu = renderer.render(&scene, environment, &options, |_| {}).unwrap_or_else(|e| panic!("{name}: {e}"));
        let middle = Instant::now();
        let cpu = on_cpu::<f32>(&scene, environment);
        let (apart, edges) = compare(&scene, &cpu, &gpu);
        let times = [(middle - begin).as_secs_f64(), middle.elapsed().as_secs_f64()];
        println!("{name:<40} {:>9.3}% {:>10.3} {:>8.2} {:>8.2}", apart * 100.0, edges / CODE, times[0], times[1]);
        if apart > MOST_APART || edges > 4.0 * CODE {
            failed.push(name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// A preview of a material of more than thirty nodes, all of which count, with four textures and an environment. The time is
/// printed, not judged; `halfvector render benches/thirty-nodes.material.json --backend cpu --samples 1 --size 512x512` is the
/// whole of it, with the bake.
#[test]
fn a_preview_of_thirty_nodes() {
    let path = root().join("benches/thirty-nodes.material.json");
    let document = halfvector_graph::file::load(&path).unwrap_or_else(|e| panic!("{e}"));
    let problems = halfvector_graph::check::check(&document, halfvector_graph::library::Library::standard());
    assert!(problems.is_empty(), "{problems:?}");
    assert!(document.graph.nodes.len() >= 30);
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, &root().join("benches"), &sphere).unwrap_or_else(|e| panic!("{e}"));
    let studio = baked(&EnvironmentSource::Studio);
    let options = RasterOptions { width: 512, height: 512, samples_per_side: 1, fold: Fold::Export };
    let begin = Instant::now();
    let picture =
        halfvector_raster::draw::<f32>(&scene, studio.as_ref(), &options, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    println!("512 x 512 in {:.2} s", begin.elapsed().as_secs_f64());
    assert!(picture.pixels.as_flattened().iter().all(|x| x.is_finite()));
}

#[test]
fn the_same_bytes_at_any_number_of_threads() {
    let mut scene = material(&root().join("examples/plain-dielectric.material.json"));
    scene.environment = EnvironmentSource::White;
    let environment = baked(&scene.environment);
    let draw = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| on_cpu::<f32>(&scene, environment.as_ref()))
    };
    let one = draw(1);
    assert_eq!(one, draw(3));
    let exact = on_cpu::<f64>(&scene, environment.as_ref());
    let far = one.pixels.as_flattened().iter().zip(exact.pixels.as_flattened()).map(|(a, b)| (a - b).abs());
    assert!(far.fold(0.0, f32::max) < 1e-4, "f32 and f64 draw the same");
}

/// A node whose function need not end is refused by its name, the line and what to write instead.
#[test]
fn a_loop_without_end_is_told_by_its_function() {
    let draw = |head: &str| {
        let text = format!(
            r#"{{"halfvector": 1, "name": "Slow", "nodes": {{"slow": {{"node": "custom/slow"}}, "surface":
            {{"node": "surface/surface"}}}}, "links": [{{"from": "slow.out", "to": "surface.metallic"}}],
            "functions": {{"slow": ["/// Slow", "///", "/// Counts.", "/// @node custom/slow", "/// - x: start [0]",
            "/// - return: end", "fn slow(x: f32) -> f32 {{", "    var sum = x;",
            "    {head} {{ sum = fract(sum * 1.5 + 0.1); }}", "    return sum;", "}}"]}}}}"#
        );
        let document = halfvector_graph::file::from_json(&text).unwrap_or_else(|e| panic!("{e}"));
        let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
        let mut scene = Scene::from_material(document, &root(), &sphere).unwrap_or_else(|e| panic!("{e}"));
        (scene.environment, scene.background) = (EnvironmentSource::None, Background::None);
        let options = RasterOptions { width: 8, height: 8, samples_per_side: 1, ..RasterOptions::default() };
        halfvector_raster::draw::<f32>(&scene, None, &options, |_| {}).map_or_else(|e| e.to_string(), |_| String::new())
    };
    assert_eq!(draw("for (var i = 0; i < 8; i++)"), "");
    for endless in ["loop", "while true", "for (var i = 0; ; i++)", "for (var i = 0; i < 8; i += 0)"] {
        let told = draw(endless);
        assert!(told.contains("`slow`") && told.contains("line 9"), "{endless}: {told}");
    }
}
