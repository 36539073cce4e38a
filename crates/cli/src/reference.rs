//! `--backend reference`: the picture by the Monte Carlo renderer in f64.

use std::sync::Mutex;

use halfvector_reference::{Conductor, EnvironmentFilter, Reference, RenderOptions};
use halfvector_scene::{Display, Picture, Scene};

use crate::environment::load;
use crate::failure::Failure;
use crate::output::{note, progress};
use crate::picture_file::{OwnNoise, PictureFile, write};

/// How it is rendered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReferenceOptions {
    /// Pixels in a row, and rows.
    pub(crate) size: [u32; 2],
    /// Paths for each pixel.
    pub(crate) samples: u32,
    /// Another seed is another noise.
    pub(crate) seed: u64,
    /// How often light goes from surface to surface.
    pub(crate) bounces: u32,
    /// What the environment is between its texels.
    pub(crate) filter: EnvironmentFilter,
    /// A metal in the place of every material's Fresnel term.
    pub(crate) conductor: Option<Conductor>,
}

/// Renders a scene to a file, with a progress bar, and tells of the noise that is left.
pub(crate) fn draw(scene: &Scene, options: ReferenceOptions, output: &PictureFile) -> Result<(), Failure> {
    let failed = |error: halfvector_reference::ReferenceError| {
        Failure::input("the picture could not be rendered").because(error)
    };
    let [width, height] = options.size;
    let ReferenceOptions { seed, bounces, filter: environment_filter, conductor, .. } = options;
    let render =
        RenderOptions { width, height, seed, bounces, environment_filter, conductor, ..RenderOptions::default() };
    let environment = load(&scene.environment)?;
    let mut reference = Reference::new(scene, environment.as_ref(), render).map_err(failed)?;
    let bar = Mutex::new((progress("rendering"), 0.0_f32));
    let told = |done: f32| {
        // A thread that panicked while it held the bar has ended the program anyway.
        if let Ok(mut bar) = bar.lock()
            && done > bar.1
        {
            bar.1 = done;
            bar.0.set_position((done * 1000.0) as u64);
        }
    };
    reference.add_samples(u64::from(options.samples), &told).map_err(failed)?;
    if let Ok(bar) = bar.lock() {
        bar.0.finish_and_clear();
    }
    reference.faults().iter().for_each(|text| note(format_args!("warning: {text}")));
    let picture = reference.picture();
    if picture.standard_error.is_none() {
        note(
            "note: one path for each pixel: its noise is not known, and no standard error is written; --samples 16 or more measure it",
        );
    }
    if let Some(noise) = picture.noise() {
        note(format_args!(
            "note: {} paths for each pixel; standard error {:.2} % of the light on average; four times as many halve it",
            picture.samples,
            100.0 * noise
        ));
        if let Some(rough) = roughness(picture.samples) {
            note(format_args!("note: {rough}"));
        }
    }
    let pixels = picture.pixels.iter().map(|pixel| pixel.map(|x| x as f32)).collect();
    let display = Display::ToneMapped { exposure: scene.exposure.factor(), tone_map: scene.tone_map };
    let narrow = |errors: Vec<[f64; 3]>| errors.into_iter().map(|error| error.map(|x| x as f32)).collect();
    let noise = OwnNoise { errors: picture.standard_error.map(narrow), seed, samples: picture.samples };
    write(output, &Picture { width, height, pixels }, Some(&noise), display)?;
    note(format_args!("{}: {width} x {height}, drawn by the reference", output.path.display()));
    Ok(())
}

/// Fewest paths of a pixel whose spread says well enough what its standard error is: to 18 %.
const ENOUGH: u64 = 16;

/// What is said of standard errors of few paths for each pixel.
pub(crate) fn roughness(samples: u64) -> Option<String> {
    let share = 1.0 / (2.0 * samples as f64 - 2.0).sqrt();
    (2..ENOUGH).contains(&samples).then(|| {
        format!(
            "the standard error of a pixel of {samples} paths is itself known to about {:.0} % only; --samples {ENOUGH} or more tell it better",
            100.0 * share
        )
    })
}
