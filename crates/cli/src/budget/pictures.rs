//! The pictures that a budget of error is held against: the material on the sphere by its own shader, beside what is true.
//!
//! Under `studio` true is the Monte Carlo reference. Under a lamp shaders compute the lobes themselves, without filtered or
//! tabled light; true is there the same shader with the most exact method of each term, at the same points: so neither noise
//! nor the steps of the pixels are in the difference.

use halfvector_graph::document::{SURFACE_NODE, SocketRef};
use halfvector_graph::method::Methods;
use halfvector_ibl::{BakedEnvironment, LoadedEnvironment};
use halfvector_raster::{RasterOptions, draw};
use halfvector_reference::metrics::CleanSquares;
use halfvector_reference::{Reference, RenderOptions};
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, EnvironmentSource, Picture, Scene};

use crate::environment::{bake, load};
use crate::failure::Failure;

/// Pixels along a side.
pub(crate) const SIZE: u32 = 64;
/// Samples along a side of a pixel.
const SIDE: u32 = 4;
/// The light of the second picture.
pub(crate) const LAMP: &str = "directional:1,1,1:3";
/// Radius of the sphere's outline over half the picture: tan(asin(1 / 5)) / tan(15 degrees) = 0.7618, less what the flat
/// sides of its mesh cut off.
const OUTLINE: f64 = 0.76;

/// The root mean square of differences over the mean of what is true, in the pixels that the sphere covers whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measured {
    /// With what noise adds taken off.
    pub(crate) error: f64,
    /// Two standard errors less, at least 0: a material is worse than this, or chance is to blame.
    pub(crate) least: f64,
    /// Two standard errors more.
    pub(crate) most: f64,
}

/// The material under `studio`.
pub(crate) struct Studio<'s> {
    scene: &'s Scene,
    reference: Reference<'s>,
    environment: BakedEnvironment,
    truth: Option<halfvector_reference::Picture>,
}

impl<'s> Studio<'s> {
    /// `scene` has the methods that are true.
    pub(crate) fn new(scene: &'s Scene) -> Result<Studio<'s>, Failure> {
        let loaded: LoadedEnvironment =
            load(&scene.environment)?.ok_or_else(|| Failure::input("there is no environment to measure under"))?;
        let options = RenderOptions { width: SIZE, height: SIZE, shadows: false, ..RenderOptions::default() };
        let reference = Reference::new(scene, Some(&loaded), options)
            .map_err(|error| Failure::input("the reference cannot render the material").because(error))?;
        Ok(Studio { scene, reference, environment: bake(scene, &loaded), truth: None })
    }

    /// What of the material is no finite number.
    pub(crate) fn faults(&self) -> Vec<String> {
        self.reference.faults()
    }

    /// Brings the reference to so many paths for each pixel.
    pub(crate) fn sample(&mut self, paths: u64) -> Result<(), Failure> {
        let before = self.truth.as_ref().map_or(0, |truth| truth.samples);
        self.reference
            .add_samples(paths.saturating_sub(before), &|_| ())
            .map_err(|error| Failure::input("the reference cannot render the material").because(error))?;
        self.truth = Some(self.reference.picture());
        Ok(())
    }

    /// The material's shader with these methods.
    pub(crate) fn draw(&self, methods: &Methods) -> Result<Picture, Failure> {
        let scene = Scene { methods: methods.clone(), ..self.scene.clone() };
        drawn(&scene, Some(&self.environment))
    }

    /// How far a picture is from the reference.
    pub(crate) fn measure(&self, picture: &Picture) -> Measured {
        match &self.truth {
            Some(truth) => measure(&radiance(picture), &truth.radiance(), truth.standard_error.as_deref()),
            None => Measured { error: f64::INFINITY, least: 0.0, most: f64::INFINITY },
        }
    }
}

/// The material under one directional light.
pub(crate) struct Lamp {
    scene: Scene,
    truth: Vec<[f64; 3]>,
}

impl Lamp {
    /// `scene` has the methods that are true.
    pub(crate) fn new(scene: &Scene) -> Result<Lamp, Failure> {
        let lights = parse_light(LAMP).into_iter().collect();
        let scene = Scene { environment: EnvironmentSource::None, lights, ..scene.clone() };
        let truth = radiance(&drawn(&scene, None)?);
        Ok(Lamp { scene, truth })
    }

    /// The error of these methods.
    pub(crate) fn error(&self, methods: &Methods) -> Result<f64, Failure> {
        let scene = Scene { methods: methods.clone(), ..self.scene.clone() };
        Ok(measure(&radiance(&drawn(&scene, None)?), &self.truth, None).error)
    }
}

/// The scene of both: nothing stands behind the sphere, and nothing is displaced. The edges of a displaced mesh fall between other
/// samples here and there, which is no error of shading, and would hide what is.
pub(crate) fn scene(mut scene: Scene, truth: &Methods) -> Scene {
    for material in &mut scene.materials {
        let graph = &mut material.document.graph;
        let is_surface = |node: &String| graph.nodes.get(node).is_some_and(|node| node.node == SURFACE_NODE);
        let is_height = |socket: &SocketRef| socket.socket == "height" && is_surface(&socket.node);
        graph.links.retain(|link| !is_height(&link.to));
        for node in graph.nodes.values_mut().filter(|node| node.node == SURFACE_NODE) {
            node.values.remove("height");
        }
    }
    scene.background = Background::None;
    scene.lights.clear();
    scene.methods = truth.clone();
    scene
}

fn drawn(scene: &Scene, environment: Option<&BakedEnvironment>) -> Result<Picture, Failure> {
    let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side: SIDE, ..RasterOptions::default() };
    draw::<f32>(scene, environment, &options, |_| ())
        .map_err(|error| Failure::input("the material could not be drawn").because(error))
}

fn radiance(picture: &Picture) -> Vec<[f64; 3]> {
    picture.pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect()
}

/// Whether the sphere covers a pixel whole: whether it covers its farthest corner.
fn is_covered(pixel: usize) -> bool {
    let from_middle = |at: usize| ((at as f64 + 0.5) - f64::from(SIZE) / 2.0).abs() + 0.5;
    let (x, y) = (from_middle(pixel % SIZE as usize), from_middle(pixel / SIZE as usize));
    x.hypot(y) <= OUTLINE * f64::from(SIZE) / 2.0
}

/// The error of a picture; `noise` is the standard error of each channel of the truth, none where it is exact.
fn measure(test: &[[f64; 3]], truth: &[[f64; 3]], noise: Option<&[[f64; 3]]>) -> Measured {
    let (mut squares, mut sum, mut count) = (CleanSquares::default(), 0.0, 0.0_f64);
    for pixel in (0..truth.len().min(test.len())).filter(|&pixel| is_covered(pixel)) {
        squares.add(test[pixel], truth[pixel], noise.map_or([0.0; 3], |noise| noise[pixel]));
        sum += truth[pixel].iter().sum::<f64>();
        count += 3.0;
    }
    let mean = sum / count.max(1.0);
    let over_mean = |rms: f64| if rms == 0.0 { 0.0 } else { rms / mean.max(0.0) };
    let [least, most] = squares.rms_between().map(over_mean);
    Measured { error: over_mean(squares.rms()), least, most }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = (SIZE * SIZE) as usize;

    #[test]
    fn errors_are_over_the_mean_of_what_is_covered() {
        let mut truth = vec![[2.0; 3]; COUNT];
        let mut test: Vec<[f64; 3]> = truth.iter().map(|pixel| pixel.map(|x| x + 0.1)).collect();
        // Beside the sphere nothing counts.
        (truth[0], test[1]) = ([1e6; 3], [1e6; 3]);
        let plain = measure(&test, &truth, None);
        assert!((plain.error - 0.05).abs() < 1e-12 && plain.least == plain.error && plain.most == plain.error);
        assert_eq!(measure(&truth, &truth, None).error, 0.0);
        let covered = (0..COUNT).filter(|&pixel| is_covered(pixel)).count();
        let disc = std::f64::consts::FRAC_PI_4 * (OUTLINE * f64::from(SIZE)).powi(2);
        assert!((covered as f64) < disc && covered as f64 > 0.92 * disc, "{covered} of {disc}");
        // A black material is exact or infinitely wrong.
        let black = vec![[0.0; 3]; COUNT];
        assert_eq!([measure(&black, &black, None).error, measure(&truth, &black, None).error], [0.0, f64::INFINITY]);
    }

    /// A bias of 5 % under noise of 40 %: the interval holds it, and is narrow enough to say that there is one.
    #[test]
    fn noise_is_taken_off_and_told() {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let noise = vec![[0.4; 3]; COUNT];
        let truth: Vec<[f64; 3]> = (0..COUNT).map(|_| [1.0 + 0.4 * normal(); 3]).collect();
        for (bias, found) in [(0.2, true), (0.0, false)] {
            let Measured { error, least, most } = measure(&vec![[1.0 + bias; 3]; COUNT], &truth, Some(&noise));
            assert!(least <= error && error <= most, "{least} {error} {most}");
            assert!(least <= bias && bias <= most && most < bias + 0.15, "{bias}: {least} {error} {most}");
            assert_eq!(least > 0.05, found, "{bias}: {least}");
        }
    }
}
