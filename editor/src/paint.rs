//! Pictures of the material, drawn on other threads: by the GPU, by the same shader on the CPU, or by the reference. Each
//! comes first coarse, then finer; a newer wish ends what is not done.

mod coded;
mod easel;
mod gpu;
mod reference;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui;
use halfvector_graph::document::Document;
use halfvector_scene::Picture;
use halfvector_scene::mesh::Bounds;

use crate::environments::Light;
use crate::stage::Stage;
use crate::work::{Outbox, Stale, Worker};

pub(crate) use coded::coded;
pub(crate) use easel::Easel;
pub(crate) use gpu::Gpu;

/// Who draws a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) enum Engine {
    /// The shader on the GPU; on the CPU where there is none.
    #[default]
    Gpu,
    /// The same shader, interpreted on the CPU.
    Cpu,
    /// The Monte Carlo renderer in f64.
    Reference,
}

impl Engine {
    /// All, in the order shown.
    pub(crate) const ALL: [Engine; 3] = [Engine::Gpu, Engine::Cpu, Engine::Reference];

    /// For people.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Engine::Gpu => "GPU shader",
            Engine::Cpu => "CPU shader",
            Engine::Reference => "Reference",
        }
    }

    /// What it is, for people.
    pub(crate) fn help(self) -> &'static str {
        match self {
            Engine::Gpu => "The shader that is exported, on the GPU",
            Engine::Cpu => "The same shader, interpreted on the CPU: slower, the same picture",
            Engine::Reference => {
                "Paths in double precision, without any approximation and without shadows, as the shaders draw; it \
                 becomes less noisy the longer it runs"
            }
        }
    }
}

/// A picture that is wanted.
#[derive(Clone, Debug)]
pub(crate) struct Shot {
    /// The material.
    pub(crate) document: Arc<Document>,
    /// Where its relative paths start.
    pub(crate) directory: PathBuf,
    /// What it is seen on.
    pub(crate) stage: Stage,
    /// What surrounds it, baked; absent while it is not, or when there is none.
    pub(crate) light: Option<Arc<Light>>,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// Whether another one follows at once: then it is not refined.
    pub(crate) is_moving: bool,
}

/// A wish, told apart by its side of the window and its number.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// 0 or 1.
    pub(crate) side: usize,
    /// Comes back with the picture.
    pub(crate) key: u64,
    /// What is wanted.
    pub(crate) shot: Shot,
}

/// A picture that was drawn, or why it was not.
#[derive(Debug)]
pub(crate) struct Drawn {
    /// Of the request.
    pub(crate) side: usize,
    /// Of the request.
    pub(crate) key: u64,
    /// The picture.
    pub(crate) result: Result<Painting, Fault>,
    /// Who drew it, for people.
    pub(crate) by: String,
    /// How long that took, the shader's compilation included.
    pub(crate) took: Duration,
    /// Whether no finer one follows.
    pub(crate) is_final: bool,
}

/// A picture as it came.
#[derive(Debug)]
pub(crate) struct Painting {
    /// Linear radiance.
    pub(crate) picture: Arc<Picture>,
    /// The same for the window.
    pub(crate) image: egui::ColorImage,
    /// The box round what is drawn.
    pub(crate) bounds: Option<Bounds>,
    /// Programs that were compiled for it.
    pub(crate) compiled: u64,
    /// Of the reference.
    pub(crate) noise: Option<Noise>,
}

/// What is known of a picture's noise.
#[derive(Clone, Debug)]
pub(crate) struct Noise {
    /// Paths for each pixel.
    pub(crate) samples: u64,
    /// Standard error as a share of the light, on average; none of a single path, or where there is no light.
    pub(crate) share: Option<f64>,
    /// Standard error of each channel of each pixel; none of a single path.
    pub(crate) of_pixels: Option<Arc<[[f64; 3]]>>,
    /// What of the material is no finite number, in words.
    pub(crate) faults: Arc<[String]>,
}

impl Noise {
    /// Paths and what noise they leave, for people.
    pub(crate) fn words(&self) -> String {
        match (self.share, self.samples) {
            (Some(share), samples) => format!("{samples} paths, ±{:.1} %", 100.0 * share),
            (None, 1) => "1 path".to_owned(),
            (None, samples) => format!("{samples} paths"),
        }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fault {
    /// The mesh could not be loaded.
    Mesh(String),
    /// The material cannot be drawn.
    Material(String),
}

impl Fault {
    /// In the user's words.
    pub(crate) fn text(&self) -> &str {
        match self {
            Fault::Mesh(why) | Fault::Material(why) => why,
        }
    }
}

impl Drawn {
    fn failed(request: &Request, by: &str, fault: Fault) -> Drawn {
        let Request { side, key, .. } = *request;
        Drawn { side, key, result: Err(fault), by: by.to_owned(), took: Duration::ZERO, is_final: true }
    }
}

/// A thread that draws.
pub(crate) type Painter = Worker<Vec<Request>, Drawn>;

/// Starts the thread of an engine.
pub(crate) fn start(engine: Engine, context: &egui::Context, gpu: &Gpu) -> std::io::Result<Painter> {
    let mut easels = [Easel::default(), Easel::default()];
    let gpu = gpu.clone();
    Worker::start_telling(engine.label(), context, move |requests: Vec<Request>, stale, outbox| match engine {
        Engine::Reference => reference::render(&mut easels, &requests, stale, outbox),
        Engine::Gpu | Engine::Cpu => {
            for request in &requests {
                if let Some(easel) = easels.get_mut(request.side) {
                    draw(easel, (engine == Engine::Gpu).then_some(&gpu), request, stale, outbox);
                }
            }
        }
    })
}

/// One step from coarse to fine: the size's divisor and the samples along each side of a pixel.
type Step = (u32, u32);
const ON_GPU: &[Step] = &[(1, 1), (1, 4)];
const ON_SOFTWARE_GPU: &[Step] = &[(2, 1), (1, 1), (1, 3)];
const ON_CPU: &[Step] = &[(6, 1), (3, 1), (1, 1), (1, 2)];

/// Draws one request, coarse and then finer, until a newer one comes. A device that gives up is given up.
fn draw(easel: &mut Easel, gpu: Option<&Gpu>, request: &Request, stale: &Stale, outbox: &Outbox<Drawn>) {
    if let Err(fault) = easel.set(&request.shot) {
        outbox.send(Drawn::failed(request, "", fault));
        return;
    }
    let device = gpu.and_then(Gpu::renderer);
    if let Some(device) = &device {
        let steps = if device.is_software() { ON_SOFTWARE_GPU } else { ON_GPU };
        let compiled = easel.compiled();
        let done = in_steps(steps, request, stale, outbox, device.adapter(), |size, samples, go_on| {
            let picture = easel.draw_on(device, size, samples, |_| go_on());
            picture.map(|picture| picture.map(|picture| (picture, easel.bounds(), easel.compiled() - compiled)))
        });
        match done {
            Ok(()) => return,
            Err(error) if error.is_of_device() => {
                easel.leave_device();
                gpu.inspect(|gpu| gpu.lose(error.to_string()));
            }
            Err(error) => {
                outbox.send(Drawn::failed(request, device.adapter(), Fault::Material(error.to_string())));
                return;
            }
        }
    }
    let done = in_steps(ON_CPU, request, stale, outbox, "CPU", |size, samples, go_on| {
        let picture = easel.draw(size, samples, |_| go_on())?;
        Ok(picture.map(|picture| (picture, easel.bounds(), 0)))
    });
    if let Err(fault) = done {
        outbox.send(Drawn::failed(request, "CPU", fault));
    }
}

/// Draws step by step. The first step is always finished, so that there is something to see however fast wishes follow.
fn in_steps<E>(
    steps: &[Step],
    request: &Request,
    stale: &Stale,
    outbox: &Outbox<Drawn>,
    by: &str,
    mut draw: impl FnMut([u32; 2], u32, &(dyn Fn() -> bool + Sync)) -> Result<Option<(Picture, Option<Bounds>, u64)>, E>,
) -> Result<(), E> {
    let shot = &request.shot;
    let steps = if shot.is_moving { &steps[..1] } else { steps };
    for (number, &(divisor, samples)) in steps.iter().enumerate() {
        let start = Instant::now();
        let size = shot.size.map(|length| length.div_ceil(divisor).max(1));
        let go_on = || number == 0 || !stale.is_stale();
        let Some((picture, bounds, compiled)) = draw(size, samples, &go_on)? else { return Ok(()) };
        outbox.send(Drawn {
            side: request.side,
            key: request.key,
            by: by.to_owned(),
            took: start.elapsed(),
            is_final: number + 1 == steps.len(),
            result: Ok(Painting {
                image: coded(&picture, shot.stage.display()),
                picture: picture.into(),
                bounds,
                compiled,
                noise: None,
            }),
        });
        if stale.is_stale() {
            return Ok(());
        }
    }
    Ok(())
}
