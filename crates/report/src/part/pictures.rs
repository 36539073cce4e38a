//! Whole pictures: what every example looks like on the device and by `--backend cpu`, against the reference; the specialised
//! shader beside the unspecialised one; the report's own forms beside the defaults.
//!
//! *Specialised* is what a scene needs and no more: every number of the material is known when the shader is made. In the
//! *unspecialised* shader every input of its surfaces that has a number is a uniform, so that every lobe stays in. Both are made as shaders are
//! exported; the parameters that a document exposes are numbers in one and uniforms in the other.
//!
//! The examples are read from the folder `examples` of the project, where the program is run; elsewhere there are no rows, and the report
//! says so.

pub(super) mod variants;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use halfvector_codegen::Fold;
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ShaderOutput;
use halfvector_ibl::{BakedEnvironment, LoadedEnvironment, bake};
use halfvector_raster::{RasterOptions, draw};
use halfvector_reference::metrics::{FlipOptions, flip_hdr, noisy_error};
use halfvector_reference::{Reference, ReferenceError, RenderOptions as ReferenceOptions};
use halfvector_render::RenderOptions;
use halfvector_scene::{BuiltinMesh, MeshSource, Picture, Scene, bake_options, needs};

use self::variants::{specialised, unspecialised};
use super::shaders::instructions;
use super::stations::{NO_DEVICE, Station, shared, stations};
use crate::missing::DEVICE;
use crate::timing::median;
use crate::{Effort, Row, Run};

const FOLDER: &str = "examples";

/// The part's name.
const PART: &str = "pictures";

/// Samples along a side of a pixel: as many for every drawer.
const SAMPLES: u32 = 4;

/// Measures the part. What is not timed is made for several examples at once: truths, bakes, and first pictures, which wait for
/// compilers. Then each picture is timed while nothing else runs.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    match examples(Path::new(FOLDER)) {
        Ok(examples) => rows_of(&examples, run),
        Err(why) => {
            run.leave_out(PART, None, why);
            Vec::new()
        }
    }
}

/// The rows of some examples: their files.
pub fn rows_of(examples: &[PathBuf], run: &Run<'_>) -> Vec<Row> {
    let (stations, kept) = (stations(), Kept::default());
    if stations.iter().all(Option::is_none) {
        run.leave_out(PART, Some(DEVICE), NO_DEVICE.to_owned());
    }
    let done = AtomicUsize::new(0);
    let one_done = || (done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / (2 * examples.len()) as f64;
    let mut rows = Vec::new();
    // As many at a time as keep every core busy, so that what is finished by then can be kept; the first ones soon.
    let (soon, later) = examples.split_at(stations.len().min(examples.len()));
    for some in std::iter::once(soon).chain(later.chunks(3 * stations.len())) {
        let prepared = shared(&stations, some, |station, path| {
            let example = Example::prepared(path, station, &kept, run.effort());
            run.at(one_done());
            example
        });
        for (path, (station, example)) in some.iter().zip(prepared) {
            let station = stations[station].as_ref();
            match example {
                Ok(example) => rows.extend(example.rows(station, run)),
                Err(why) => run.leave_out(PART, Some(&name(path)), why),
            }
            run.keep(&rows, one_done());
        }
    }
    rows
}

/// The documents of a folder itself, in order of name; those of folders within it are for other ends. Else why there are none.
fn examples(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let place = folder.display();
    let remedy = "start the program in the project's folder";
    let entries = std::fs::read_dir(folder).map_err(|error| {
        format!("the folder {place} cannot be read where the program was started: {error}; {remedy}")
    })?;
    let is_document = |path: &PathBuf| {
        path.to_str().is_some_and(|path| path.ends_with(".material.json") || path.ends_with(".scene.json"))
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(is_document).collect();
    paths.sort();
    if paths.is_empty() {
        return Err(format!("the folder {place} has no .material.json and no .scene.json; {remedy}"));
    }
    Ok(paths)
}

/// An example's name.
fn name(path: &Path) -> String {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    file.trim_end_matches(".json").to_owned()
}

/// A scene, or why it or what it refers to cannot be read: examples of others' models want files that are not ours.
fn load(path: &Path) -> Result<Scene, String> {
    if path.to_string_lossy().ends_with(".scene.json") {
        return halfvector_scene::load_scene(path).map_err(|error| error.to_string());
    }
    let document = halfvector_graph::file::load(path).map_err(|error| error.to_string())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    Scene::from_material(document, folder, &MeshSource::Builtin(BuiltinMesh::Sphere)).map_err(|error| error.to_string())
}

/// A drawn picture as radiance.
fn radiance(picture: &Picture) -> Vec<[f64; 3]> {
    picture.pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect()
}

/// An environment, none where a scene has none, or why it cannot be read.
type Loaded = Result<Option<Arc<LoadedEnvironment>>, String>;

/// Environments that are loaded and baked already, by what they are and how: most examples are lit by the same one.
#[derive(Default)]
struct Kept {
    loaded: Mutex<HashMap<String, Loaded>>,
    bakes: Mutex<HashMap<String, Arc<BakedEnvironment>>>,
}

impl Kept {
    /// The environment of a scene.
    fn loaded(&self, scene: &Scene) -> Loaded {
        let mut loaded = self.loaded.lock().unwrap_or_else(PoisonError::into_inner);
        let read = || {
            let found = scene.environment.load().map_err(|error| error.to_string());
            found.map(|environment| environment.map(Arc::new))
        };
        loaded.entry(format!("{:?}", scene.environment)).or_insert_with(read).clone()
    }

    fn baked(&self, scene: &Scene) -> Option<Arc<BakedEnvironment>> {
        let loaded = self.loaded(scene).ok().flatten()?;
        let options = bake_options(&scene.environment, &scene.methods, &loaded);
        let key = format!("{:?}, {options:?}", scene.environment);
        let mut bakes = self.bakes.lock().unwrap_or_else(PoisonError::into_inner);
        Some(bakes.entry(key).or_insert_with(|| Arc::new(bake(&loaded, &options))).clone())
    }
}

/// A scene as one row draws it, and the first picture of it on the device, or why there is none; neither where there is no device.
struct View {
    scene: Scene,
    baked: Option<Arc<BakedEnvironment>>,
    picture: Option<Result<Picture, String>>,
}

impl View {
    fn new(scene: Scene, kept: &Kept, station: Option<&Station>, size: u32) -> View {
        // Without a device nothing is drawn of it.
        let baked = station.and_then(|_| kept.baked(&scene));
        let drawn = station.map(|station| station.draw(&scene, baked.as_ref(), &options(size)));
        View { scene, baked, picture: drawn.map(|drawn| drawn.map(|(picture, _)| picture)) }
    }
}

/// Times of a picture [s]: of all that is waited for, and of the device.
#[derive(Default)]
struct Times {
    seconds: Vec<f64>,
    device: Vec<f64>,
}

impl Times {
    /// Puts the fastest picture's times into the row, and how much longer the one in the middle took.
    fn fill(self, size: u32, row: &mut Row) {
        let fastest = |times: &[f64]| {
            let least = times.iter().copied().fold(f64::INFINITY, f64::min);
            (least.is_finite() && least > 0.0).then_some(least)
        };
        let spread = |times: Vec<f64>, least: f64| (times.len() > 2).then(|| median(times) / least - 1.0);
        if let Some(least) = fastest(&self.seconds) {
            (row.cost_ns, row.cost_spread) = (Some(least * 1e9), spread(self.seconds, least));
        }
        if let Some(least) = fastest(&self.device) {
            row.gpu_ns = Some(least * 1e9 / f64::from(size * size * SAMPLES * SAMPLES));
            row.gpu_spread = spread(self.device, least);
        }
    }
}

fn options(size: u32) -> RenderOptions {
    RenderOptions {
        width: size,
        height: size,
        samples_per_side: SAMPLES,
        fold: Fold::Export,
        ..RenderOptions::default()
    }
}

/// An example, its truth, and what is drawn of it.
struct Example {
    name: String,
    size: u32,
    truth: Vec<[f64; 3]>,
    noise: Option<Vec<[f64; 3]>>,
    baked: Option<Arc<BakedEnvironment>>,
    specialised: View,
    unspecialised: View,
    /// With the default methods, where the example has others; and with the report's.
    defaults: Option<View>,
    report: View,
}

/// A view, its row, and what it is held against, with that one's noise.
type Held<'a> = (&'a View, Row, &'a [[f64; 3]], Option<&'a [[f64; 3]]>);

impl Example {
    /// Else why the example cannot be read or has no truth.
    fn prepared(path: &Path, station: Option<&Station>, kept: &Kept, effort: Effort) -> Result<Example, String> {
        let linear =
            |methods: &mut Methods| set_linear(methods).ok_or("its methods have no default of encode or env_decode");
        let mut scene = load(path)?;
        // What the reference has no truth for.
        linear(&mut scene.methods)?;
        let size = effort.pick(32, 128) as u32;
        // Shaders have no shadows.
        let options = ReferenceOptions { width: size, height: size, shadows: false, ..ReferenceOptions::default() };
        let loaded = kept.loaded(&scene)?;
        let no_truth = |error: ReferenceError| format!("the reference cannot draw it: {error}");
        let mut reference = Reference::new(&scene, loaded.as_deref(), options).map_err(no_truth)?;
        reference.add_samples(effort.pick(64, 256) as u64, &|_| ()).map_err(no_truth)?;
        let picture = reference.picture();
        drop(reference);

        let view = |scene: Scene| View::new(scene, kept, station, size);
        let with = |methods: Methods| view(Scene { methods, ..specialised(&scene) });
        let mut report = Methods::report();
        linear(&mut report)?;
        Ok(Example {
            name: name(path),
            size,
            truth: picture.radiance(),
            noise: picture.standard_error,
            baked: kept.baked(&scene),
            specialised: view(specialised(&scene)),
            unspecialised: view(unspecialised(&scene)),
            defaults: (scene.methods != Methods::default()).then(|| with(Methods::default())),
            report: with(report),
        })
    }

    fn row(&self, method: &str, what: &str, against: &str) -> Row {
        let domain = format!(
            "{}: the whole picture, {1} x {1} pixels{what}; rms error relative to the mean radiance of {against}",
            self.name, self.size
        );
        Row::new("picture", method, &domain)
    }

    /// Draws the example again and again, each view and the processor in turns, and holds the pictures against the truth and each other.
    fn rows(&self, station: Option<&Station>, run: &Run<'_>) -> Vec<Row> {
        let against = "the reference";
        let noise = self.noise.as_deref();
        let drawn = |view: &View| match &view.picture {
            Some(Ok(picture)) => radiance(picture),
            _ => Vec::new(),
        };
        let what = ", every number that its surfaces take a uniform";
        let unspecialised = self.row("gpu, unspecialised", what, "the specialised shader's picture");
        let preset = self.row("preset report", "", "the picture with the default methods");
        let default = drawn(self.defaults.as_ref().unwrap_or(&self.specialised));
        let specialised = drawn(&self.specialised);
        let views: [Held<'_>; 3] = [
            (&self.specialised, self.row("gpu", "", against), &self.truth, noise),
            (&self.unspecialised, unspecialised, &specialised, None),
            (&self.report, preset, &default, None),
        ];
        let mut shown = Vec::new();
        for (view, row, truth, noise) in views {
            match &view.picture {
                Some(Ok(picture)) if truth.len() == picture.pixels.len() => {
                    shown.push((view, row, radiance(picture), truth, noise, Times::default()));
                }
                Some(Ok(_)) => self.leave_out(run, &row.method, "what it is held against could not be drawn"),
                Some(Err(why)) => self.leave_out(run, &row.method, why),
                None => {}
            }
        }
        let (mut by_cpu, mut cpu) = (Times::default(), None);
        let (on_device, on_cpu) = (run.effort().pick(3, 9), run.effort().pick(3, 5));
        for round in 0..on_device.max(on_cpu) {
            for (view, .., times) in shown.iter_mut().filter(|_| round < on_device) {
                let start = Instant::now();
                let pass = station.map(|station| station.draw(&view.scene, view.baked.as_ref(), &options(self.size)));
                if let Some(Ok((_, device))) = pass {
                    times.seconds.push(start.elapsed().as_secs_f64());
                    times.device.extend(device);
                }
            }
            if round < on_cpu && !matches!(cpu, Some(Err(_))) {
                let start = Instant::now();
                let picture = self.on_cpu();
                by_cpu.seconds.push(start.elapsed().as_secs_f64());
                cpu = Some(picture);
            }
        }
        let mut rows = Vec::new();
        for (view, mut row, picture, truth, noise, times) in shown {
            fill(&mut row, &picture, truth, noise);
            times.fill(self.size, &mut row);
            row.gpu = station.map(|station| station.name().to_owned());
            row.instructions = fragment_instructions(&view.scene);
            rows.push(row);
        }
        match cpu {
            Some(Ok(picture)) => {
                let mut row = self.row("cpu", "", against);
                by_cpu.fill(self.size, &mut row);
                row.instructions = fragment_instructions(&self.specialised.scene);
                fill(&mut row, &radiance(&picture), &self.truth, noise);
                rows.push(row);
            }
            Some(Err(why)) => self.leave_out(run, "cpu", &why),
            None => {}
        }
        rows
    }

    /// This drawer of the example has no row.
    fn leave_out(&self, run: &Run<'_>, method: &str, why: &str) {
        run.leave_out(PART, Some(&format!("{}, {method}", self.name)), why.to_owned());
    }

    fn on_cpu(&self) -> Result<Picture, String> {
        let (width, height) = (self.size, self.size);
        let options = RasterOptions { width, height, samples_per_side: SAMPLES, fold: Fold::Export };
        let picture = draw::<f32>(&self.specialised.scene, self.baked.as_deref(), &options, |_| ());
        picture.map_err(|error| error.to_string())
    }
}

/// The default methods of what a picture of radiance has no part of.
fn set_linear(methods: &mut Methods) -> Option<()> {
    for term in ["encode", "env_decode"] {
        methods.set(term, halfvector_graph::method::term(term)?.methods[0].name).ok()?;
    }
    Some(())
}

/// The errors of a picture: rms and largest, over the mean radiance of what it is held against, and FLIP.
fn fill(row: &mut Row, test: &[[f64; 3]], truth: &[[f64; 3]], noise: Option<&[[f64; 3]]>) {
    let width = truth.len().isqrt().max(1);
    let mean = truth.iter().flatten().sum::<f64>() / (3 * truth.len().max(1)) as f64;
    let scale = |x: f64| x / mean.max(f64::MIN_POSITIVE);
    let error = noisy_error(test, truth, noise);
    row.error_rms = error.rms.map(scale);
    row.error_bound = error.bound.map(scale);
    row.error_max = error.largest.map(scale);
    row.at = error.at.map(|i| format!("column = {}, row = {}", i % width, i / width));
    if error.largest == Some(0.0) {
        (row.at, row.note) = (None, Some("the pictures are the same".to_owned()));
    }
    if error.rms.is_some() && error.largest == error.rms && error.largest > Some(0.0) {
        row.note = Some("of no pixel alone the error is sure to be larger than the rms error, so that this is the bound of the largest".to_owned());
    }
    if error.rms.is_none() {
        row.note = Some("the noise of the reference hides the error".to_owned());
    }
    let flip = flip_hdr(truth, test, width, FlipOptions::default());
    row.flip = Some(flip.iter().sum::<f64>() / flip.len().max(1) as f64);
}

/// Instructions of the longest of a scene's fragment stages, as exported.
fn fragment_instructions(scene: &Scene) -> Option<u64> {
    let needs = needs(scene, ShaderOutput::Radiance);
    let count =
        |document| instructions(&halfvector_codegen::shader(document, Library::standard(), &needs, Fold::Export).ok()?);
    scene.materials.iter().filter_map(|material| count(&material.document)).max()
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfvector_graph::document::Document;

    pub(super) fn scene(document: Document) -> Scene {
        Scene::from_material(document, Path::new(""), &MeshSource::Builtin(BuiltinMesh::Sphere)).expect("a scene")
    }

    /// A folder that is not there and a document that cannot be read are told with the reason.
    #[test]
    fn what_cannot_be_read_is_named() {
        let nowhere = examples(Path::new("no/such/folder")).expect_err("no folder");
        assert!(nowhere.contains("no/such/folder") && nowhere.contains("start the program in"), "{nowhere}");

        let run = Run::alone(Effort::Quick);
        assert_eq!(rows_of(&[PathBuf::from("no/such/helmet.scene.json")], &run), []);
        let left_out = run.left_out();
        let found = left_out.iter().find(|left| left.what.as_deref() == Some("helmet.scene")).expect("it is named");
        assert!(found.part == PART && found.to_string().contains("helmet.scene.json"), "{found}");
    }

    /// What the processor cannot draw is named, with the reason, and times have a spread.
    #[test]
    fn a_drawing_that_fails_is_named() {
        let scene = scene(Document::with_surface("plain"));
        let kept = Kept::default();
        let view = |scene: &Scene| View::new(scene.clone(), &kept, None, 4);
        let mut example = Example {
            name: "ball.material".into(),
            size: 4,
            truth: vec![[1.0; 3]; 16],
            noise: Some(vec![[0.0; 3]; 16]),
            baked: kept.baked(&scene),
            specialised: view(&scene),
            unspecialised: view(&scene),
            defaults: None,
            report: view(&scene),
        };
        let run = Run::alone(Effort::Quick);
        let rows = example.rows(None, &run);
        assert_eq!(rows.iter().map(|row| row.method.as_str()).collect::<Vec<_>>(), ["cpu"]);
        assert!(rows[0].cost_spread.is_some() && run.left_out().is_empty(), "{rows:?}");

        example.specialised.scene.materials[0].document.graph.nodes.clear();
        example.specialised.picture = Some(Err("the device is lost".into()));
        assert_eq!(example.rows(None, &run), []);
        let left_out: Vec<String> = run.left_out().iter().map(ToString::to_string).collect();
        assert_eq!(left_out[0], "pictures: ball.material, gpu: the device is lost");
        assert!(left_out[1].starts_with("pictures: ball.material, cpu: "), "{left_out:?}");
    }

    /// An error that the reference's noise hides is no error of 0.
    #[test]
    fn a_hidden_error_is_bounded() {
        let (truth, noise) = (vec![[1.0; 3]; 64], vec![[0.3; 3]; 64]);
        let mut row = Row::default();
        fill(&mut row, &vec![[1.1; 3]; 64], &truth, Some(&noise));
        assert_eq!((row.error_rms, row.error_max), (None, None));
        assert!(row.error_bound.is_some_and(|bound| bound > 0.05) && row.note.is_some(), "{row:?}");
        fill(&mut row, &truth, &truth, None);
        assert_eq!((row.error_rms, row.error_max, row.error_bound), (Some(0.0), Some(0.0), None));
    }
}
