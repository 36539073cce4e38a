//! Pictures of the material, drawn on a thread of its own: by the GPU, or by the CPU where there is none.
//!
//! The thread owns the GPU that it draws with; the window's own is another, so that neither waits for the other and a lost one
//! takes nothing with it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui;
use halfvector_graph::document::Document;
use halfvector_ibl::BakedEnvironment;
use halfvector_raster::RasterOptions;
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::scene::{Exposure, SceneMaterial};
use halfvector_scene::{Background, Picture, Scene};

use crate::stage::Stage;
use crate::work::Worker;

/// A picture that is wanted.
#[derive(Clone, Debug)]
pub(crate) struct Shot {
    /// The material.
    pub(crate) document: Arc<Document>,
    /// Where its relative paths start.
    pub(crate) directory: PathBuf,
    /// What it is seen on.
    pub(crate) stage: Stage,
    /// The stage's environment, baked; absent while it is not.
    pub(crate) environment: Option<Arc<BakedEnvironment>>,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// Samples along each side of a pixel.
    pub(crate) samples_per_side: u32,
}

/// A picture that was drawn, or why it was not.
#[derive(Debug)]
pub(crate) struct Drawn {
    /// Linear radiance.
    pub(crate) picture: Result<Picture, String>,
    /// Who drew it, for people.
    pub(crate) by: String,
    /// How long that took, the shader's compilation included.
    pub(crate) took: Duration,
}

/// The thread that draws.
pub(crate) type Painter = Worker<Shot, Drawn>;

/// Starts the thread that draws.
pub(crate) fn start(context: &egui::Context) -> std::io::Result<Painter> {
    let mut easel = Easel::default();
    Worker::start("painter", context, move |shot: Shot, stale| {
        // A newer picture is wanted already.
        (!stale.is_stale()).then(|| easel.draw(&shot))
    })
}

/// What is kept from picture to picture.
#[derive(Default)]
struct Easel {
    renderer: Option<Result<Renderer, String>>,
    scene: Scene,
    stage: Option<Stage>,
}

impl Easel {
    fn draw(&mut self, shot: &Shot) -> Drawn {
        let start = Instant::now();
        let renderer = self.renderer.get_or_insert_with(|| Renderer::new().map_err(|error| error.to_string()));
        let by = match &renderer {
            Ok(renderer) => renderer.adapter().to_owned(),
            Err(_) => "the CPU".to_owned(),
        };
        let picture = self.set(shot).and_then(|()| self.paint(shot));
        Drawn { picture, by, took: start.elapsed() }
    }

    /// Brings the scene to what the shot wants; meshes and images that are there stay.
    fn set(&mut self, shot: &Shot) -> Result<(), String> {
        let stage = &shot.stage;
        let material = SceneMaterial { document: (*shot.document).clone(), directory: shot.directory.clone() };
        match self.scene.materials.first_mut() {
            Some(first) => *first = material,
            None => self.scene.materials.push(material),
        }
        if self.stage.as_ref().is_none_or(|before| before.mesh != stage.mesh) {
            self.stage = None;
            self.scene.set_mesh(&stage.mesh).map_err(|error| error.to_string())?;
        }
        self.stage = Some(stage.clone());
        self.scene.lights.clone_from(&stage.lights);
        self.scene.camera = stage.orbit.camera();
        self.scene.environment = stage.environment.clone();
        self.scene.environment_rotation = stage.environment_rotation;
        self.scene.background = if stage.shows_environment { Background::Environment } else { Background::None };
        self.scene.exposure = Exposure::Stops(stage.exposure_stops);
        self.scene.tone_map = stage.tone_map;
        self.scene.methods = stage.methods.clone();
        self.scene.load_images().map_err(|error| error.to_string())
    }

    fn paint(&mut self, shot: &Shot) -> Result<Picture, String> {
        let ([width, height], side) = (shot.size, shot.samples_per_side);
        let environment = shot.environment.as_deref();
        match &self.renderer {
            Some(Ok(renderer)) => {
                let options = RenderOptions { width, height, samples_per_side: side, ..RenderOptions::default() };
                renderer.render(&self.scene, environment, &options, |_| {}).map_err(|error| error.to_string())
            }
            _ => {
                let options = RasterOptions { width, height, samples_per_side: side, ..RasterOptions::default() };
                halfvector_raster::draw::<f32>(&self.scene, environment, &options, |_| {})
                    .map_err(|error| error.to_string())
            }
        }
    }
}
