//! A scene that follows what is wanted, and what was made of it: from picture to picture only what changed is loaded.

use std::sync::Arc;

use halfvector_codegen::Fold;
use halfvector_ibl::BakedEnvironment;
use halfvector_raster::{RasterOptions, draw_while};
use halfvector_render::{Cache, RenderError, RenderOptions, Renderer};
use halfvector_scene::mesh::Bounds;
use halfvector_scene::scene::{Exposure, MeshSource, SceneMaterial};
use halfvector_scene::{Background, EnvironmentSource, Picture, Scene};

use super::{Fault, Shot};

/// A scene with what is kept of it.
#[derive(Debug, Default)]
pub(crate) struct Easel {
    scene: Scene,
    mesh: Option<MeshSource>,
    bounds: Option<Bounds>,
    light: Option<Arc<BakedEnvironment>>,
    /// The device that the cache belongs to.
    device: Option<Arc<Renderer>>,
    cache: Cache,
}

impl Easel {
    /// Brings the scene to what the shot wants. Meshes and images that are there stay; a mesh that cannot be
    /// loaded leaves the scene's as they were, and a checker stands in for an image that cannot.
    pub(crate) fn set(&mut self, shot: &Shot) -> Result<(), Fault> {
        let stage = &shot.stage;
        if self.mesh.as_ref() != Some(&stage.mesh) {
            let mut fresh = Scene::default();
            fresh
                .materials
                .push(SceneMaterial { document: (*shot.document).clone(), directory: shot.directory.clone() });
            fresh.set_mesh(&stage.mesh).map_err(|error| Fault::Mesh(error.to_string()))?;
            self.bounds = fresh.bounds();
            self.mesh = Some(stage.mesh.clone());
            (self.scene.meshes, self.scene.objects) = (fresh.meshes, fresh.objects);
            self.scene.materials = fresh.materials;
        } else if let Some(first) = self.scene.materials.first_mut() {
            first.document.clone_from(&shot.document);
            first.directory.clone_from(&shot.directory);
        }
        self.scene.lights = stage.lights();
        self.scene.camera = stage.orbit.camera();
        self.light = shot.light.as_ref().map(|light| light.baked.clone());
        self.scene.environment = match &shot.light {
            Some(light) => light.source.clone(),
            None => EnvironmentSource::None,
        };
        self.scene.environment_rotation = stage.environment_rotation;
        self.scene.background = if stage.shows_environment { Background::Environment } else { Background::None };
        self.scene.exposure = Exposure::Stops(stage.exposure_stops);
        self.scene.tone_map = stage.tone_map;
        self.scene.methods = stage.methods.clone();
        // What is wrong with them is told among the problems.
        self.scene.load_images_or_stand_ins();
        Ok(())
    }

    /// The scene as it was set last.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The box round everything that is drawn.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// Draws on a GPU; none when `go_on` said to stop.
    pub(crate) fn draw_on(
        &mut self,
        device: &Arc<Renderer>,
        size: [u32; 2],
        samples_per_side: u32,
        go_on: impl FnMut(f32) -> bool,
    ) -> Result<Option<Picture>, RenderError> {
        if self.device.as_ref().is_none_or(|before| !Arc::ptr_eq(before, device)) {
            (self.device, self.cache) = (Some(device.clone()), Cache::default());
        }
        let options = RenderOptions {
            width: size[0],
            height: size[1],
            samples_per_side,
            fold: Fold::Live,
            // Small tiles on a slow device, so that it can stop.
            tile_edge: if device.is_software() { 512 } else { 2048 },
        };
        device.render_live(&mut self.cache, &self.scene, self.light.as_ref(), &options, go_on)
    }

    /// Forgets what belongs to a device.
    pub(crate) fn leave_device(&mut self) {
        (self.device, self.cache) = (None, Cache::default());
    }

    /// How many programs were compiled so far.
    pub(crate) fn compiled(&self) -> u64 {
        self.cache.made().programs
    }

    /// Draws on the CPU; none when `go_on` said to stop.
    pub(crate) fn draw(
        &self,
        size: [u32; 2],
        samples_per_side: u32,
        go_on: impl Fn(f32) -> bool + Sync,
    ) -> Result<Option<Picture>, Fault> {
        let [width, height] = size;
        let options = RasterOptions { width, height, samples_per_side, ..RasterOptions::default() };
        draw_while::<f32>(&self.scene, self.light.as_deref(), &options, go_on)
            .map_err(|error| Fault::Material(error.to_string()))
    }
}
