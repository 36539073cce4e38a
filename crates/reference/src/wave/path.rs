//! One sample on its way: what it does at a point that it has met.

use glam::DVec3;
use halfvector_brdf::vector::{mul, scale};
use halfvector_graph::document::AlphaMode;

use super::MOST_PASSED;
use super::awaited::{Awaited, CERTAIN};
use super::veil::{Place, Veil};
use crate::ReferenceError;
use crate::bsdf::{Bsdf, across};
use crate::geometry::{Hit, NOWHERE, Point, Ray};
use crate::material::{Material, Surface};
use crate::random::Random;
use crate::render::Reference;

/// How far apart derivatives are taken, in pixels: what is finer than a pixel is left to the samples.
const DERIVATIVE_STEP: f64 = 1.0 / 16.0;
/// Bounces after which dark paths begin to end by chance.
const SURE_BOUNCES: u32 = 3;

/// A sample that has met something.
pub(super) struct Path {
    pub(super) random: Random,
    /// Where in the picture the camera's ray went.
    place: [f64; 2],
    pub(super) ray: Ray,
    /// What the ray starts on.
    pub(super) from: u32,
    /// Number of the sample in the wave.
    pub(super) sample: u32,
    pub(super) throughput: [f64; 3],
    /// What the surface that the ray comes from lets in of the environment.
    pub(super) occlusion: f64,
    /// Density at which the ray was drawn; none for the camera's.
    pub(super) density: Option<f64>,
    /// Surfaces that it was reflected by.
    bounces: u32,
    passed: u32,
    /// Length of the way so far.
    length: f64,
}

/// A direction drawn by the environment's light, and its density [1/sr].
#[derive(Clone, Copy)]
pub(super) struct Drawn {
    pub(super) dir: [f64; 3],
    pub(super) density: f64,
}

impl Path {
    /// A camera's ray.
    pub(super) fn new(random: Random, place: [f64; 2], ray: Ray, sample: u32) -> Path {
        Path {
            random,
            place,
            ray,
            from: NOWHERE,
            sample,
            throughput: [1.0; 3],
            occlusion: 1.0,
            density: None,
            bounces: 0,
            passed: 0,
            length: 0.0,
        }
    }

    /// Where the ray a step to the right of this one, or below, meets the plane of the face; after a reflection, a pixel's
    /// width away.
    pub(super) fn beside(&self, reference: &Reference<'_>, hit: &Hit, point: &Point, axis: usize) -> DVec3 {
        let normal = point.geometric_normal;
        if self.density.is_none() && self.passed == 0 {
            let mut place = self.place;
            place[axis] += DERIVATIVE_STEP;
            let dir = DVec3::from(reference.camera.dir(place[0], place[1]));
            let t = normal.dot(point.position - self.ray.origin) / normal.dot(dir);
            // Beyond the horizon of the plane there is no meeting nearby.
            if t > 0.0 && t < 2.0 * hit.t {
                return self.ray.origin + t * dir;
            }
        }
        let width = reference.camera.pixel_angle() * DERIVATIVE_STEP * (self.length + hit.t);
        point.position + width * DVec3::from(across(normal.to_array())[axis])
    }

    /// Adds what the point sends to the viewer, or awaits it; true where the path goes on.
    pub(super) fn shade(
        &mut self,
        veil: &mut Veil<'_, '_>,
        seen: &mut [f64; 4],
        awaited: &mut Awaited,
        material: &Material,
        hit: &Hit,
        point: &Point,
        surface: &Surface,
        drawn: Option<Drawn>,
    ) -> Result<bool, ReferenceError> {
        let reference = veil.reference;
        let passes = match material.settings.alpha_mode {
            AlphaMode::Opaque => false,
            AlphaMode::Mask => surface.opacity < f64::from(material.settings.alpha_cutoff),
            AlphaMode::Blend => self.random.number() >= surface.opacity,
        };
        self.length += hit.t;
        if passes {
            self.passed += 1;
            self.ray.origin = point.position;
            self.from = hit.primitive;
            return Ok(self.passed < MOST_PASSED);
        }
        if self.density.is_none() {
            seen[3] = 1.0;
        }
        let turned;
        let (mut surface, mut geometric_normal) = (surface, point.geometric_normal);
        if material.settings.double_sided && geometric_normal.dot(self.ray.dir) > 0.0 {
            geometric_normal = -geometric_normal;
            turned = Surface {
                normal: surface.normal.map(|x| -x),
                coat_normal: surface.coat_normal.map(|x| -x),
                ..*surface
            };
            surface = &turned;
        }
        let sheet = material.settings.thin_walled;
        let bsdf = Bsdf::new(&reference.model, surface, point.view_dir.to_array(), point.tangent.to_array(), sheet);
        add_light(seen, mul(self.throughput, bsdf.emission));
        if !bsdf.reflects() {
            return Ok(false);
        }
        let place = Place { bsdf: &bsdf, position: point.position, geometric_normal, primitive: hit.primitive };
        for (light, distance) in reference.lights.at(place.position.to_array()) {
            let reflected = bsdf.eval(light.dir);
            if reflected != [0.0; 3] {
                let light = scale(light.illuminance, veil.sees(&place, light.dir, distance)?);
                add_light(seen, mul(self.throughput, mul(reflected, light)));
            }
        }
        if let Some(Drawn { dir, density }) = drawn {
            let (reflected, by_lobes) = bsdf.eval_with_density(dir);
            if reflected != [0.0; 3] {
                let arrives = veil.sees(&place, dir, f64::INFINITY)?;
                if arrives > 0.0 {
                    let weight = arrives * surface.occlusion / (density + by_lobes);
                    awaited.push(self.sample, dir, mul(self.throughput, scale(reflected, weight)), CERTAIN);
                }
            }
        }
        self.go_on(&place, veil, awaited, surface.occlusion)
    }

    /// A direction drawn by the lobes: to the environment, and to other surfaces as often as light may bounce.
    fn go_on(
        &mut self,
        place: &Place<'_>,
        veil: &mut Veil<'_, '_>,
        awaited: &mut Awaited,
        occlusion: f64,
    ) -> Result<bool, ReferenceError> {
        let reference = veil.reference;
        let choice = self.random.number();
        let dir = place.bsdf.sample(choice, self.random.pair());
        let (reflected, density) = place.bsdf.eval_with_density(dir);
        if density.is_nan() || density <= 0.0 || reflected == [0.0; 3] {
            return Ok(false);
        }
        self.throughput = mul(self.throughput, scale(reflected, 1.0 / density));
        if self.bounces >= reference.options.bounces || !reference.options.shadows || place.is_behind(dir) {
            if reference.environment.is_some() {
                let arrives = veil.sees(place, dir, f64::INFINITY)?;
                if arrives > 0.0 {
                    awaited.push(self.sample, dir, scale(self.throughput, arrives * occlusion), density);
                }
            }
            return Ok(false);
        }
        if DVec3::from(dir).dot(place.geometric_normal) <= 0.0 {
            return Ok(false);
        }
        (self.density, self.occlusion) = (Some(density), occlusion);
        self.ray = Ray { origin: place.position, dir: DVec3::from(dir) };
        self.from = place.primitive;
        self.bounces += 1;
        if self.bounces > SURE_BOUNCES {
            let [r, g, b] = self.throughput;
            let chance = r.max(g).max(b).min(0.95);
            if self.random.number() >= chance {
                return Ok(false);
            }
            self.throughput = self.throughput.map(|x| x / chance);
        }
        Ok(true)
    }
}

fn add_light(seen: &mut [f64; 4], light: [f64; 3]) {
    for i in 0..3 {
        seen[i] += light[i];
    }
}
