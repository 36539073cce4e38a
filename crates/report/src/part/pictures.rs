//! Whole pictures: what every example looks like on the device and by `--backend cpu`, against the reference; the specialised
//! shader beside the unspecialised one; the report's own forms beside the defaults.
//!
//! The examples are read from the folder `examples` of the project, where the program is run; elsewhere there are no rows.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use halfvector_codegen::Fold;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ShaderOutput;
use halfvector_ibl::{BakedEnvironment, LoadedEnvironment, bake};
use halfvector_raster::{RasterOptions, draw};
use halfvector_reference::metrics::{FlipOptions, difference, flip_hdr};
use halfvector_reference::{Reference, RenderOptions as ReferenceOptions};
use halfvector_render::{Cache, RenderOptions, Renderer};
use halfvector_scene::{BuiltinMesh, MeshSource, Picture, Scene, bake_options, needs};

use super::shaders::instructions;
use crate::timing::median;
use crate::{Effort, Row};

const FOLDER: &str = "examples";

/// Samples along a side of a pixel: as many for every drawer.
const SAMPLES: u32 = 4;

/// Measures the part.
pub fn rows(effort: Effort) -> Vec<Row> {
    let renderer = Renderer::new().ok();
    let kept = Kept::default();
    examples().iter().flat_map(|path| example(path, renderer.as_ref(), &kept, effort).unwrap_or_default()).collect()
}

/// The documents of the folder itself, in order of name; those of folders within it are for other ends.
fn examples() -> Vec<PathBuf> {
    let Ok(folder) = std::fs::read_dir(FOLDER) else { return Vec::new() };
    let is_document = |path: &PathBuf| {
        path.to_str().is_some_and(|path| path.ends_with(".material.json") || path.ends_with(".scene.json"))
    };
    let mut paths: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).filter(is_document).collect();
    paths.sort();
    paths
}

/// A scene; none when it or what it refers to cannot be read: examples of others' models want files that are not ours.
fn load(path: &Path) -> Option<Scene> {
    if path.to_str()?.ends_with(".scene.json") {
        return halfvector_scene::load_scene(path).ok();
    }
    let document = halfvector_graph::file::load(path).ok()?;
    Scene::from_material(document, path.parent()?, &MeshSource::Builtin(BuiltinMesh::Sphere)).ok()
}

/// A drawn picture as radiance.
fn radiance(picture: &Picture) -> Vec<[f64; 3]> {
    picture.pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect()
}

/// What one example has in common with the next, and one picture of it with another.
#[derive(Default)]
struct Kept {
    /// Environments that are baked already, by what they are and how: most examples are lit by the same one.
    bakes: RefCell<HashMap<String, Arc<BakedEnvironment>>>,
    /// Programs and textures on the device.
    cache: RefCell<Cache>,
}

/// An example's scene with what it is lit by.
struct Example<'k> {
    scene: Scene,
    kept: &'k Kept,
    loaded: Option<LoadedEnvironment>,
    name: String,
    size: u32,
}

impl Example<'_> {
    fn baked(&self, scene: &Scene) -> Option<Arc<BakedEnvironment>> {
        let loaded = self.loaded.as_ref()?;
        let options = bake_options(&scene.environment, &scene.methods, loaded);
        let mut bakes = self.kept.bakes.borrow_mut();
        let key = format!("{:?}, {options:?}", scene.environment);
        Some(bakes.entry(key).or_insert_with(|| Arc::new(bake(loaded, &options))).clone())
    }

    fn row(&self, method: &str, against: &str) -> Row {
        let domain = format!(
            "{}: the whole picture, {1} x {1} pixels; rms error relative to the mean radiance of {against}",
            self.name, self.size
        );
        Row::new("picture", method, &domain)
    }

    /// Draws on the device and puts time and instructions into the row: the median of several pictures without what is made
    /// only once.
    fn on_device(
        &self,
        renderer: &Renderer,
        scene: &Scene,
        (fold, effort): (Fold, Effort),
        row: &mut Row,
    ) -> Option<Picture> {
        let size = self.size;
        let options =
            RenderOptions { width: size, height: size, samples_per_side: SAMPLES, fold, ..RenderOptions::default() };
        let baked = self.baked(scene);
        let mut cache = self.kept.cache.borrow_mut();
        let mut draw = || renderer.render_timed(&mut cache, scene, baked.as_ref(), &options).ok();
        let (picture, _) = draw()?;
        let (mut seconds, mut device): (Vec<f64>, Option<f64>) = (Vec::new(), None);
        for _ in 0..effort.pick(3, 9) {
            let start = Instant::now();
            let (_, time) = draw()?;
            seconds.push(start.elapsed().as_secs_f64());
            device = time.map(|time| device.map_or(time, |known| known.min(time)));
        }
        let samples = f64::from(size * size * SAMPLES * SAMPLES);
        row.cost_ns = Some(median(seconds) * 1e9);
        row.gpu_ns = device.map(|time| time * 1e9 / samples);
        row.gpu = Some(renderer.adapter().to_owned());
        row.instructions = fragment_instructions(scene, fold);
        Some(picture)
    }
}

fn example(path: &Path, renderer: Option<&Renderer>, kept: &Kept, effort: Effort) -> Option<Vec<Row>> {
    let mut scene = load(path)?;
    // What the reference has no truth for.
    for term in ["encode", "env_decode"] {
        let linear = halfvector_graph::method::term(term)?.methods[0].name;
        scene.methods.set(term, linear).ok()?;
    }
    let loaded = scene.environment.load().ok()?;
    let name = path.file_name()?.to_str()?.trim_end_matches(".json").to_owned();
    let example = Example { scene, kept, loaded, name, size: effort.pick(32, 128) as u32 };
    let Example { scene, size, .. } = &example;
    let baked = example.baked(scene);

    let options = ReferenceOptions { width: *size, height: *size, shadows: false, ..ReferenceOptions::default() };
    let mut reference = Reference::new(scene, example.loaded.as_ref(), options).ok()?;
    reference.add_samples(effort.pick(64, 256) as u64, &|_| ()).ok()?;
    let picture = reference.picture();
    let (truth, noise) = (picture.radiance(), picture.standard_error);
    let errors = |row: &mut Row, picture: &Picture| fill(row, &radiance(picture), &truth, Some(&noise));

    let mut rows = Vec::new();
    let against = "the reference, whose noise is taken off";
    if let Some(renderer) = renderer {
        for (method, fold) in [("gpu", Fold::Export), ("gpu, unspecialised", Fold::Live)] {
            let mut row = example.row(method, against);
            let picture = example.on_device(renderer, scene, (fold, effort), &mut row);
            let Some(picture) = picture else { continue };
            errors(&mut row, &picture);
            rows.push(row);
        }
    }
    let mut row = example.row("cpu", against);
    let options = RasterOptions { width: *size, height: *size, samples_per_side: SAMPLES, fold: Fold::Export };
    let start = Instant::now();
    if let Ok(picture) = draw::<f32>(scene, baked.as_deref(), &options, |_| ()) {
        row.cost_ns = Some(start.elapsed().as_secs_f64() * 1e9);
        row.instructions = fragment_instructions(scene, Fold::Export);
        errors(&mut row, &picture);
        rows.push(row);
    }
    if let Some(renderer) = renderer {
        rows.extend(preset(&example, renderer, effort));
    }
    Some(rows)
}

/// The report's own forms, as far as a shader shows them in radiance, against the same shader with the defaults.
fn preset(example: &Example<'_>, renderer: &Renderer, effort: Effort) -> Option<Row> {
    let draw = |methods: Methods, row: &mut Row| {
        let scene = Scene { methods, ..example.scene.clone() };
        example.on_device(renderer, &scene, (Fold::Export, effort), row)
    };
    let mut report = Methods::report();
    for term in ["encode", "env_decode"] {
        report.set(term, halfvector_graph::method::term(term)?.methods[0].name).ok()?;
    }
    let mut row = example.row("preset report", "the picture with the default methods");
    let (default, report) = (draw(Methods::default(), &mut Row::default())?, draw(report, &mut row)?);
    fill(&mut row, &radiance(&report), &radiance(&default), None);
    Some(row)
}

/// The errors of a picture: rms and largest, over the mean radiance of what it is held against, and FLIP.
fn fill(row: &mut Row, test: &[[f64; 3]], truth: &[[f64; 3]], noise: Option<&[[f64; 3]]>) {
    let width = truth.len().isqrt();
    let mean = truth.iter().flatten().sum::<f64>() / (3 * truth.len().max(1)) as f64;
    let difference = difference(test, truth, noise);
    let scale = 1.0 / mean.max(f64::MIN_POSITIVE);
    (row.error_rms, row.error_max) = (Some(difference.rmse * scale), Some(difference.largest * scale));
    let worst = |i: usize| (0..3).map(|c| (test[i][c] - truth[i][c]).abs()).fold(0.0, f64::max);
    let at = (0..truth.len().min(test.len())).max_by(|&a, &b| worst(a).total_cmp(&worst(b)));
    row.at = at.map(|i| format!("column {}, row {}", i % width.max(1), i / width.max(1)));
    let flip = flip_hdr(truth, test, width, FlipOptions::default());
    row.flip = Some(flip.iter().sum::<f64>() / flip.len().max(1) as f64);
}

/// Instructions of the longest of a scene's fragment stages.
fn fragment_instructions(scene: &Scene, fold: Fold) -> Option<u64> {
    let needs = needs(scene, ShaderOutput::Radiance);
    let count = |document| instructions(&halfvector_codegen::shader(document, Library::standard(), &needs, fold).ok()?);
    scene.materials.iter().filter_map(|material| count(&material.document)).max()
}
