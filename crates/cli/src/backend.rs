//! Who draws a picture: the one place where the choice is made.

use halfvector_ibl::BakedEnvironment;
use halfvector_raster::RasterOptions;
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::{Picture, Scene};

use crate::failure::Failure;
use crate::output::{note, progress};

/// Who makes the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Backend {
    /// The exported shader, run by somebody.
    Shader(Runner),
    /// The Monte Carlo renderer.
    Reference,
}

/// Who runs the shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Runner {
    /// The best GPU, a software one included; the CPU where there is none.
    #[default]
    Auto,
    /// The best GPU, a software one included.
    Gpu,
    /// This program's own interpreter of shaders.
    Cpu,
}

/// Reads a backend by its name.
pub(crate) fn parse_backend(text: &str) -> Result<Backend, String> {
    match text {
        "auto" => Ok(Backend::Shader(Runner::Auto)),
        "gpu" => Ok(Backend::Shader(Runner::Gpu)),
        "cpu" => Ok(Backend::Shader(Runner::Cpu)),
        "reference" => Ok(Backend::Reference),
        _ => Err("the backends are auto, gpu, cpu and reference".to_owned()),
    }
}

/// A runner that is ready.
#[derive(Debug)]
pub(crate) enum Painter {
    /// wgpu.
    Gpu(Renderer),
    /// The interpreter.
    Cpu,
}

impl Painter {
    /// Opens what a runner means. `auto` says so when there is no GPU.
    pub(crate) fn open(runner: Runner) -> Result<Painter, Failure> {
        if runner == Runner::Cpu {
            return Ok(Painter::Cpu);
        }
        match Renderer::new() {
            Ok(renderer) => Ok(Painter::Gpu(renderer)),
            Err(error) if runner == Runner::Auto => {
                note(format_args!("note: {error}. The picture is drawn on the CPU, which takes longer."));
                Ok(Painter::Cpu)
            }
            Err(error) => Err(failed(error).try_to("--backend cpu")),
        }
    }

    /// Its name, for people.
    pub(crate) fn name(&self) -> String {
        match self {
            Painter::Gpu(renderer) => renderer.adapter().to_owned(),
            Painter::Cpu => "the CPU".to_owned(),
        }
    }

    /// Draws a scene, with a progress bar. `side`: samples along each side of a pixel.
    pub(crate) fn draw(
        &self,
        scene: &Scene,
        environment: Option<&BakedEnvironment>,
        [width, height]: [u32; 2],
        side: u32,
    ) -> Result<Picture, Failure> {
        let bar = progress("drawing");
        let tell = |done: f32| bar.set_position((done * 1000.0) as u64);
        let picture = match self {
            Painter::Gpu(renderer) => {
                let options = RenderOptions { width, height, samples_per_side: side, ..RenderOptions::default() };
                renderer.render(scene, environment, &options, tell).map_err(failed)
            }
            Painter::Cpu => {
                let options = RasterOptions { width, height, samples_per_side: side, ..RasterOptions::default() };
                halfvector_raster::draw::<f32>(scene, environment, &options, tell).map_err(failed)
            }
        };
        bar.finish_and_clear();
        picture
    }
}

fn failed(error: impl std::fmt::Display) -> Failure {
    Failure::input("the picture could not be drawn").because(error)
}
