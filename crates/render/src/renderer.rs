//! A scene becomes a picture: the whole way on one page.

use std::sync::Arc;

use halfvector_codegen::Fold;
use halfvector_codegen::reflection::SamplerSource;
use halfvector_codegen::uniforms::FrameValues;
use halfvector_graph::document::AlphaMode;
use halfvector_graph::needs::ShaderOutput;
use halfvector_ibl::{BakeOptions, BakedEnvironment, FilterJob, LoadedEnvironment, bake_filtered_by};
use halfvector_scene::light::lights_by_kind;
use halfvector_scene::{Background, Picture, Scene, View, tiles};

use crate::bake::Filter;
use crate::cache::{Cache, Lit};
use crate::device::Gpu;
use crate::draws::{Wanted, prepare};
use crate::error::RenderError;
use crate::stopwatch::Stopwatch;
use crate::target::TILE_EDGE;

/// Draws scenes on one GPU.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
}

/// How a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderOptions {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Samples along each side of a pixel, on a regular grid: 4 is 16 samples per pixel.
    pub samples_per_side: u32,
    /// How the numbers of the materials reach the shader.
    pub fold: Fold,
    /// Samples on a side of the tiles that the picture is drawn in; less memory, more passes. The picture is the same.
    pub tile_edge: u32,
}

impl Default for RenderOptions {
    fn default() -> Self {
        RenderOptions { width: 512, height: 512, samples_per_side: 4, fold: Fold::Live, tile_edge: TILE_EDGE }
    }
}

impl Renderer {
    /// Opens the best GPU there is; a software GPU is taken when there is no other.
    ///
    /// # Errors
    /// When there is none, or it does not open.
    pub fn new() -> Result<Renderer, RenderError> {
        Ok(Renderer { gpu: Gpu::open()? })
    }

    /// The GPU's name with its interface, for people.
    pub fn adapter(&self) -> &str {
        &self.gpu.name
    }

    /// Gives the GPU and its memory back at once, whoever draws with it: what is being drawn ends with an error of the device
    /// ([`RenderError::is_of_device`]), and so does what is asked for later. Dropping the renderer waits for what is being drawn.
    pub fn close(&self) {
        self.gpu.close();
    }

    /// Whether the GPU is a program on the CPU.
    pub fn is_software(&self) -> bool {
        self.gpu.software
    }

    /// Bakes an environment as [`halfvector_ibl::bake`] does, with the filtering done on the GPU. `quality` does not
    /// count: the GPU's filter has one, 0.35 % rms from perceptual roughness 0.2 up.
    ///
    /// # Errors
    /// When the environment does not fit the device, or the device gives up.
    pub fn bake(
        &self,
        environment: &LoadedEnvironment,
        options: &BakeOptions,
        mut progress: impl FnMut(f32),
    ) -> Result<BakedEnvironment, RenderError> {
        bake_filtered_by(environment, options, |map, jobs| {
            let filter = Filter::new(&self.gpu, map)?;
            let texels = |jobs: &[FilterJob]| jobs.iter().map(|job| job.size * job.size).sum::<usize>() as f32;
            let mut filtered = Vec::new();
            for (i, &job) in jobs.iter().enumerate() {
                progress(texels(&jobs[..i]) / texels(jobs));
                filtered.push(filter.cube(job)?);
            }
            Ok(filtered)
        })
    }

    /// Draws a scene to linear radiance with premultiplied alpha. `environment` is the scene's environment, baked; it may be
    /// absent when the scene has none. `progress` is told the share that is done, 0 to 1.
    ///
    /// # Errors
    /// When a material is wrong, something does not fit the device, or the device gives up.
    pub fn render(
        &self,
        scene: &Scene,
        environment: Option<&BakedEnvironment>,
        options: &RenderOptions,
        mut progress: impl FnMut(f32),
    ) -> Result<Picture, RenderError> {
        let lit = environment.map(|baked| Lit { baked, keeper: None });
        let go_on = |done| {
            progress(done);
            true
        };
        let picture = self.draw(&mut Cache::default(), scene, lit, options, go_on, None)?;
        Ok(picture.unwrap_or_else(|| Picture::clear(options.width, options.height)))
    }

    /// The same with what a cache holds of earlier pictures, for pictures that follow each other: under [`Fold::Live`] other
    /// numbers, another camera or light compile nothing. `go_on` is told the share that is done after each tile; when it
    /// returns false the rest is left and there is no picture.
    ///
    /// # Errors
    /// As for [`Renderer::render`]. After an error of the device the cache is empty.
    pub fn render_live(
        &self,
        cache: &mut Cache,
        scene: &Scene,
        environment: Option<&Arc<BakedEnvironment>>,
        options: &RenderOptions,
        go_on: impl FnMut(f32) -> bool,
    ) -> Result<Option<Picture>, RenderError> {
        let lit = environment.map(|baked| Lit { baked, keeper: Some(baked) });
        let drawn = self.draw(cache, scene, lit, options, go_on, None);
        match &drawn {
            Err(error) if error.is_of_device() => cache.clear(),
            _ => cache.end(),
        }
        drawn
    }

    /// The same picture with the device's own time for it [s], from the first vertex to the last pixel, without what the CPU
    /// does; none where the device has no clock.
    ///
    /// # Errors
    /// As for [`Renderer::render`].
    pub fn render_timed(
        &self,
        cache: &mut Cache,
        scene: &Scene,
        environment: Option<&Arc<BakedEnvironment>>,
        options: &RenderOptions,
    ) -> Result<(Picture, Option<f64>), RenderError> {
        let lit = environment.map(|baked| Lit { baked, keeper: Some(baked) });
        let mut watch = Stopwatch::new(&self.gpu);
        let picture = self.draw(cache, scene, lit, options, |_| true, watch.as_mut())?;
        cache.end();
        let picture = picture.unwrap_or_else(|| Picture::clear(options.width, options.height));
        Ok((picture, watch.map(|watch| watch.total)))
    }

    fn draw(
        &self,
        cache: &mut Cache,
        scene: &Scene,
        environment: Option<Lit<'_>>,
        options: &RenderOptions,
        mut go_on: impl FnMut(f32) -> bool,
        mut watch: Option<&mut Stopwatch>,
    ) -> Result<Option<Picture>, RenderError> {
        cache.begin();
        let gpu = &self.gpu;
        let RenderOptions { width, height, samples_per_side: side, .. } = *options;
        let wrong_size = || RenderError::PictureSize { width, height, side };
        if width == 0 || height == 0 || side == 0 || u64::from(width) * u64::from(height) > 1 << 28 {
            return Err(wrong_size());
        }
        let edge = options.tile_edge.min(TILE_EDGE).min(gpu.device.limits().max_texture_dimension_2d) / side;
        // Tiles begin at even samples, so that the 2 x 2 blocks that derivatives come from are the same ones in any tile.
        let edge = if edge > 1 { edge - edge % 2 } else { edge };
        let tiles = if edge == 0 { return Err(wrong_size()) } else { tiles(width, height, edge) };

        let needs = halfvector_scene::needs(scene, ShaderOutput::Radiance);
        let near = scene.camera.near(scene.bounds());
        let view = View::new(&scene.camera, near, width as f32 / height as f32);
        let (sin, cos) = scene.environment_rotation.to_radians().sin_cos();
        let mut frame = FrameValues {
            clip_from_world: glam::Mat4::IDENTITY.to_cols_array(),
            view_from_world: view.view_from_world().to_cols_array(),
            camera_position: view.position.to_array(),
            time: 0.0,
            exposure: scene.exposure.factor(),
            environment_rotation: [cos, sin],
            environment_levels: environment.map_or(0, |lit| lit.baked.radiance.len() as u32),
            irradiance_sh: environment.map_or([[0.0; 3]; 9], |lit| lit.baked.irradiance_sh),
            lights: lights_by_kind(&scene.lights).numbers(),
        };
        let blends = scene.materials.iter().any(|material| material.document.surface.alpha_mode == AlphaMode::Blend);
        let format = gpu.radiance_format(blends)?;

        let (draws, sky) = gpu.guarded("preparing the scene", || {
            let wanted = Wanted { scene, needs: &needs, fold: options.fold, view: &view, target: format, environment };
            let draws = prepare(gpu, cache, &wanted)?;
            let sky = match scene.background {
                Background::Environment if environment.is_some() => {
                    let sampler = cache.sampler(gpu, &SamplerSource::LinearClamp);
                    let gamma_coded = needs.methods.is("encode", "report");
                    let radiance = cache.radiance(gpu, environment)?;
                    let rotation = frame.environment_rotation;
                    Some(cache.sky(gpu, format).sky(gpu, &radiance, &sampler, rotation, gamma_coded))
                }
                _ => None,
            };
            cache.target(gpu, format, edge.min(width) * side, edge.min(height) * side);
            Ok((draws, sky))
        })?;
        let target = cache.target(gpu, format, edge.min(width) * side, edge.min(height) * side);
        let clear = match scene.background {
            Background::Color(color) => [color[0], color[1], color[2], 1.0],
            Background::Environment | Background::None => [0.0; 4],
        };

        let mut picture = Picture::clear(width, height);
        for (number, &tile) in tiles.iter().enumerate() {
            let samples = gpu.guarded("drawing", || {
                frame.clip_from_world = view.clip_from_world(width, height, tile).to_cols_array();
                draws.set_frame(gpu, &frame)?;
                if let Some(sky) = &sky {
                    sky.set_tile(gpu, &view, width, height, tile);
                }
                let (columns, rows) = (tile.width * side, tile.height * side);
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                let mut pass = target.pass(&mut encoder, clear, watch.as_deref().map(Stopwatch::writes));
                pass.set_viewport(0.0, 0.0, columns as f32, rows as f32, 0.0, 1.0);
                draws.draw_solid(&mut pass);
                if let Some(sky) = &sky {
                    sky.draw(&mut pass);
                }
                draws.draw_blended(&mut pass);
                drop(pass);
                if let Some(watch) = watch.as_deref() {
                    watch.resolve(&mut encoder);
                }
                let samples = target.read(gpu, encoder, columns, rows)?;
                if let Some(watch) = watch.as_deref_mut() {
                    watch.add(gpu)?;
                }
                Ok(samples)
            })?;
            picture.resolve(tile, side, &samples);
            let is_last = number + 1 == tiles.len();
            if !go_on((number + 1) as f32 / tiles.len() as f32) && !is_last {
                return Ok(None);
            }
        }
        Ok(Some(picture))
    }
}
