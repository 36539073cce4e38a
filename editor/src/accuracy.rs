//! How far the shader of a material is from the truth: measured on a small picture against the reference, term by term; and
//! the white furnace. It shows nothing.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;
use halfvector_graph::check::mixed_surfaces;
use halfvector_graph::document::{Document, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::method::TERMS;
use halfvector_graph::value::Value;
use halfvector_reference::metrics::{FlipOptions, difference, flip_hdr};
use halfvector_reference::{Reference, RenderOptions};
use halfvector_scene::{BuiltinMesh, Display, EnvironmentSource, MeshSource, Picture};

use crate::environments::{Light, light};
use crate::paint::{Easel, Gpu, Shot, coded};
use crate::stage::Stage;
use crate::work::{Outbox, Stale};

/// Pixels along an edge of the pictures.
const EDGE: u32 = 112;
/// Samples along each side of a pixel of the shader's pictures.
const SAMPLES: u32 = 4;
/// The reference is done when its standard error is this share of the light, or after so many paths for each pixel.
const QUIET: f64 = 0.004;
const ENOUGH: u64 = 512;

/// The terms whose methods approximate what the reference integrates; the others are part of the model, and the reference
/// follows them.
pub(crate) const APPROXIMATED: [&str; 6] =
    ["dfg", "level_map", "prefilter", "irradiance", "specular_occlusion", "horizon"];

/// What is measured.
#[derive(Clone, Debug)]
pub(crate) struct Job {
    pub(crate) document: Arc<Document>,
    pub(crate) directory: PathBuf,
    pub(crate) stage: Stage,
    pub(crate) light: Option<Arc<Light>>,
    pub(crate) what: What,
}

/// Which measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// The shader against the reference.
    Errors,
    /// The material in white light.
    Furnace,
}

/// What is found, as it is found.
pub(crate) enum Told {
    /// What is being done, and the share that is done.
    Progress(String, f32),
    /// How much noise the reference is left with, as a share of the light, and its paths for each pixel.
    Truth(f64, u64),
    /// What of the material is no finite number, in words: errors there are not the shader's.
    Faults(Vec<String>),
    /// One way of shading against the truth.
    Row(Row),
    /// The furnace's picture and figures.
    Furnace(Box<Furnace>),
    /// It cannot be measured.
    Failed(String),
    /// It is over.
    Done,
}

/// The error of one choice of methods.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// The term that is swapped; none for the material as it is.
    pub(crate) term: Option<&'static str>,
    /// The method in its place.
    pub(crate) method: &'static str,
    /// Mean FLIP against the reference.
    pub(crate) flip: f64,
    /// Root of the mean squared difference of radiance, the reference's noise taken off.
    pub(crate) rmse: f64,
    /// How much brighter than the reference.
    pub(crate) brighter: f64,
}

/// A material in radiance 1 from everywhere.
pub(crate) struct Furnace {
    pub(crate) image: egui::ColorImage,
    /// Smallest, mean and largest radiance of the picture, the brightest channel of each pixel.
    pub(crate) reflected: [f64; 3],
    /// (roughness, mean radiance) with the roughness set for the whole surface.
    pub(crate) by_roughness: Vec<[f64; 2]>,
}

/// What draws for the measurements.
pub(crate) struct Bench {
    easel: Easel,
    gpu: Gpu,
}

impl Bench {
    pub(crate) fn new(gpu: &Gpu) -> Bench {
        Bench { easel: Easel::default(), gpu: gpu.clone() }
    }

    /// Measures until it is done or nobody wants it.
    pub(crate) fn measure(&mut self, job: &Job, stale: &Stale, outbox: &Outbox<Told>) {
        let done = match job.what {
            What::Errors => self.errors(job, stale, outbox),
            What::Furnace => self.furnace(job, stale, outbox),
        };
        match done {
            Ok(()) => outbox.send(Told::Done),
            Err(why) => outbox.send(Told::Failed(why)),
        }
    }

    fn draw(&mut self, shot: &Shot, samples: u32) -> Result<Picture, String> {
        self.easel.set(shot).map_err(|fault| fault.text().to_owned())?;
        if let Some(device) = self.gpu.renderer() {
            match self.easel.draw_on(&device, shot.size, samples, |_| true) {
                Ok(Some(picture)) => return Ok(picture),
                Ok(None) => {}
                Err(error) if error.is_of_device() => {
                    self.easel.leave_device();
                    self.gpu.lose(error.to_string());
                }
                Err(error) => return Err(error.to_string()),
            }
        }
        let picture = self.easel.draw(shot.size, samples.min(2), |_| true).map_err(|fault| fault.text().to_owned())?;
        picture.ok_or_else(|| "the picture was not drawn".to_owned())
    }

    fn errors(&mut self, job: &Job, stale: &Stale, outbox: &Outbox<Told>) -> Result<(), String> {
        let mut shot = shot(job, job.stage.clone(), job.light.clone());
        self.easel.set(&shot).map_err(|fault| fault.text().to_owned())?;
        outbox.send(Told::Progress("The reference".to_owned(), 0.0));
        let options = RenderOptions { width: EDGE, height: EDGE, shadows: false, ..RenderOptions::default() };
        let loaded = job.light.as_ref().map(|light| &light.loaded);
        let mut reference = Reference::new(self.easel.scene(), loaded, options).map_err(|error| error.to_string())?;
        let truth = loop {
            reference.add_samples(16, &|_| {}).map_err(|error| error.to_string())?;
            let truth = reference.picture();
            let share = truth.noise().unwrap_or(0.0);
            outbox.send(Told::Truth(share, truth.samples));
            outbox.send(Told::Faults(reference.faults()));
            outbox.send(Told::Progress("The reference".to_owned(), truth.samples as f32 / ENOUGH as f32));
            if stale.is_stale() {
                return Ok(());
            }
            if share < QUIET || truth.samples >= ENOUGH {
                break truth;
            }
        };
        drop(reference);
        let radiance = truth.radiance();
        let mut choices: Vec<(Option<&'static str>, &'static str)> = vec![(None, "as it is")];
        for term in TERMS.iter().filter(|term| APPROXIMATED.contains(&term.name)) {
            let current = job.stage.methods.get(term.name).name;
            let others = term.methods.iter().map(|method| method.name).filter(|name| *name != current);
            choices.extend(others.map(|name| (Some(term.name), name)));
        }
        let count = choices.len() as f32;
        for (number, (term, method)) in choices.into_iter().enumerate() {
            if stale.is_stale() {
                return Ok(());
            }
            let doing = term.map_or_else(|| "As it is".to_owned(), |term| format!("{term} = {method}"));
            outbox.send(Told::Progress(doing, number as f32 / count));
            let mut methods = job.stage.methods.clone();
            if let Some(term) = term {
                methods.set(term, method).map_err(|error| error.to_string())?;
            }
            shot.light = match &job.light {
                Some(known) if needs_bake(term) => Some(light(&known.source, &methods)?),
                known => known.clone(),
            };
            shot.stage.methods = methods;
            let picture = self.draw(&shot, SAMPLES)?;
            let drawn: Vec<[f64; 3]> = picture.pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect();
            let flip = flip_hdr(&radiance, &drawn, EDGE as usize, FlipOptions::default());
            let plain = difference(&drawn, &radiance, truth.standard_error.as_deref());
            outbox.send(Told::Row(Row {
                term,
                method,
                flip: flip.iter().sum::<f64>() / flip.len().max(1) as f64,
                rmse: plain.rmse,
                brighter: plain.mean_relative,
            }));
        }
        Ok(())
    }

    fn furnace(&mut self, job: &Job, stale: &Stale, outbox: &Outbox<Told>) -> Result<(), String> {
        outbox.send(Told::Progress("The furnace".to_owned(), 0.0));
        let white = light(&EnvironmentSource::White, &job.stage.methods)?;
        let stage = Stage {
            mesh: MeshSource::Builtin(BuiltinMesh::Sphere),
            environment: EnvironmentSource::White,
            methods: job.stage.methods.clone(),
            ..Stage::default()
        };
        let mut shot = shot(job, stage, Some(white));
        let picture = self.draw(&shot, SAMPLES)?;
        let display = Display::ToneMapped { exposure: 1.0, tone_map: halfvector_graph::needs::ToneMap::None };
        let mut furnace =
            Furnace { image: coded(&picture, display), reflected: reflected(&picture), by_roughness: Vec::new() };
        let library = Library::standard();
        let surfaces = mixed_surfaces(&job.document, library);
        const STEPS: u8 = 8;
        for step in 0..STEPS {
            if surfaces.is_empty() || stale.is_stale() {
                break;
            }
            outbox.send(Told::Progress("Over the roughness".to_owned(), f32::from(step) / f32::from(STEPS)));
            let roughness = f32::from(step) / f32::from(STEPS - 1);
            shot.document = Arc::new(with_roughness(&job.document, &surfaces, roughness));
            let mean = reflected(&self.draw(&shot, 2)?)[1];
            furnace.by_roughness.push([f64::from(roughness), mean]);
        }
        outbox.send(Told::Furnace(Box::new(furnace)));
        Ok(())
    }
}

/// Whether another method of the term reads other levels.
fn needs_bake(term: Option<&str>) -> bool {
    matches!(term, Some("level_map" | "prefilter"))
}

fn shot(job: &Job, stage: Stage, light: Option<Arc<Light>>) -> Shot {
    let stage = Stage { shows_environment: false, ..stage };
    let (document, directory) = (job.document.clone(), job.directory.clone());
    Shot { document, directory, stage, light, size: [EDGE; 2], is_moving: false }
}

/// Smallest, mean and largest radiance of the pixels that are covered, the brightest channel of each.
fn reflected(picture: &Picture) -> [f64; 3] {
    let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.999);
    let (mut least, mut sum, mut most, mut count) = (f64::INFINITY, 0.0, 0.0_f64, 0);
    for &[r, g, b, _] in covered {
        let brightest = f64::from(r.max(g).max(b));
        (least, most) = (least.min(brightest), most.max(brightest));
        sum += brightest;
        count += 1;
    }
    if count == 0 { [0.0; 3] } else { [least, sum / f64::from(count), most] }
}

/// The document with one roughness all over.
fn with_roughness(document: &Document, surfaces: &[&str], roughness: f32) -> Document {
    let mut document = document.clone();
    for surface in surfaces {
        let socket = SocketRef::new(surface, "perceptual_roughness");
        document.graph.links.retain(|link| link.to != socket);
        if let Some(node) = document.graph.nodes.get_mut(*surface) {
            node.values.insert(socket.socket, Value::Number(roughness));
        }
    }
    document
}
