//! A wave of paths: all samples of a tile that are on their way, traced and shaded one step at a time.

use glam::DVec3;
use halfvector_brdf::vector::{add, mul, scale};
use halfvector_graph::document::AlphaMode;

use crate::ReferenceError;
use crate::bsdf::{Bsdf, across};
use crate::film::Pixel;
use crate::geometry::{Hit, NOWHERE, Point, Ray};
use crate::material::{Evaluator, Material, Surface};
use crate::random::Random;
use crate::render::Reference;

/// Paths in a wave.
const PATHS: usize = 4096;
/// Surfaces that a ray may pass through because they are cut out or blended, before it is taken as ended.
const MOST_PASSED: u32 = 256;
/// How far apart derivatives are taken, in pixels: what is finer than a pixel is left to the samples.
const DERIVATIVE_STEP: f64 = 1.0 / 16.0;
/// Bounces after which dark paths begin to end by chance.
const SURE_BOUNCES: u32 = 3;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tile {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// One sample on its way.
struct Path {
    random: Random,
    ray: Ray,
    /// What the ray starts on.
    from: u32,
    throughput: [f64; 3],
    radiance: [f64; 3],
    alpha: f64,
    /// What the surface that the ray comes from lets in of the environment.
    occlusion: f64,
    /// Density at which the ray was drawn; none for the camera's.
    density: Option<f64>,
    /// Surfaces that it was reflected by.
    bounces: u32,
    passed: u32,
    /// Length of the way so far.
    length: f64,
    /// The camera's rays a step to the right and down.
    neighbours: [DVec3; 2],
}

/// The memory of one thread.
pub(crate) struct Wave<'r> {
    reference: &'r Reference<'r>,
    evaluators: Vec<Option<Evaluator<'r>>>,
    paths: Vec<Path>,
    /// Numbers of the paths that have a ray to trace.
    active: Vec<u32>,
    next: Vec<u32>,
    /// Hits of this step by material.
    hits: Vec<Vec<(u32, Hit)>>,
    points: [Vec<Point>; 3],
    surfaces: Vec<Surface>,
    /// Surfaces on the way to the light.
    behind: Vec<Surface>,
}

impl<'r> Wave<'r> {
    pub(crate) fn new(reference: &'r Reference<'r>) -> Result<Wave<'r>, ReferenceError> {
        let evaluators = reference
            .materials
            .iter()
            .zip(&reference.names)
            .map(|(material, name)| material.as_ref().map(|m| m.evaluator(name)).transpose())
            .collect::<Result<_, _>>()?;
        Ok(Wave {
            reference,
            evaluators,
            paths: Vec::new(),
            active: Vec::new(),
            next: Vec::new(),
            hits: reference.materials.iter().map(|_| Vec::new()).collect(),
            points: Default::default(),
            surfaces: Vec::new(),
            behind: Vec::new(),
        })
    }

    /// Adds the samples `first..first + count` of each pixel of a tile.
    pub(crate) fn tile(
        &mut self,
        tile: Tile,
        first: u64,
        count: u64,
        pixels: &mut [Pixel],
    ) -> Result<(), ReferenceError> {
        let at_once = (PATHS / pixels.len().max(1)).max(1) as u64;
        let mut start = first;
        while start < first + count {
            let end = (start + at_once).min(first + count);
            self.paths.clear();
            for row in 0..tile.height {
                for column in 0..tile.width {
                    for sample in start..end {
                        let path = self.camera_path(tile.x + column, tile.y + row, sample);
                        self.paths.push(path);
                    }
                }
            }
            self.active.clear();
            self.active.extend(0..self.paths.len() as u32);
            while !self.active.is_empty() {
                self.step()?;
            }
            // Each pixel's samples in their order: sums do not depend on how many are taken at once.
            for (pixel, paths) in pixels.iter_mut().zip(self.paths.chunks((end - start) as usize)) {
                for path in paths {
                    let finite = path.radiance.iter().all(|x| x.is_finite());
                    pixel.add(if finite { path.radiance } else { [0.0; 3] }, path.alpha);
                }
            }
            start = end;
        }
        Ok(())
    }

    fn camera_path(&self, x: u32, y: u32, sample: u64) -> Path {
        let options = &self.reference.options;
        let pixel = u64::from(y) * u64::from(options.width) + u64::from(x);
        let mut random = Random::new(options.seed, pixel, sample);
        let [u, v] = random.pair();
        let (x, y) = (f64::from(x) + u, f64::from(y) + v);
        let camera = &self.reference.camera;
        Path {
            random,
            ray: camera.ray(x, y),
            from: NOWHERE,
            throughput: [1.0; 3],
            radiance: [0.0; 3],
            alpha: 0.0,
            occlusion: 1.0,
            density: None,
            bounces: 0,
            passed: 0,
            length: 0.0,
            neighbours: [camera.ray(x + DERIVATIVE_STEP, y).dir, camera.ray(x, y + DERIVATIVE_STEP).dir],
        }
    }

    /// Traces all rays and shades what they meet.
    fn step(&mut self) -> Result<(), ReferenceError> {
        let reference = self.reference;
        for number in self.active.drain(..) {
            let path = &mut self.paths[number as usize];
            match reference.geometry.first(&path.ray, path.from) {
                Some(hit) => {
                    self.hits[reference.geometry.bodies[reference.geometry.body(&hit)].material].push((number, hit))
                }
                None => path.miss(reference),
            }
        }
        for index in 0..self.hits.len() {
            let hits = std::mem::take(&mut self.hits[index]);
            if let (Some(material), Some(evaluator)) = (&reference.materials[index], &mut self.evaluators[index]) {
                place(reference, material, &self.paths, &hits, &mut self.points);
                let [points, right, down] = &self.points;
                let steps = material.derives.then_some([right.as_slice(), down.as_slice()]);
                evaluator.surfaces(points, steps, &mut self.surfaces)?;
                let mut veil = Veil { reference, evaluators: &mut self.evaluators, surfaces: &mut self.behind };
                for (((number, hit), point), surface) in hits.iter().zip(points).zip(&self.surfaces) {
                    let path = &mut self.paths[*number as usize];
                    if path.shade(&mut veil, material, hit, point, surface)? {
                        self.next.push(*number);
                    }
                }
            }
            self.hits[index] = hits;
            self.hits[index].clear();
        }
        std::mem::swap(&mut self.active, &mut self.next);
        Ok(())
    }
}

/// The points that rays have met and, where the material takes derivatives, the points beside them.
fn place(
    reference: &Reference<'_>,
    material: &Material,
    paths: &[Path],
    hits: &[(u32, Hit)],
    points: &mut [Vec<Point>; 3],
) {
    let geometry = &reference.geometry;
    let [middle, right, down] = points;
    middle.clear();
    middle.extend(hits.iter().map(|(number, hit)| geometry.point(&paths[*number as usize].ray, hit, material.precise)));
    for (axis, beside) in [right, down].into_iter().enumerate() {
        beside.clear();
        if !material.derives {
            continue;
        }
        beside.extend(hits.iter().zip(middle.iter()).map(|((number, hit), point)| {
            let path = &paths[*number as usize];
            let position = path.beside(reference, hit, point, axis);
            let view_dir = match path.density {
                None => (path.ray.origin - position).normalize_or(point.view_dir),
                Some(_) => point.view_dir,
            };
            geometry.point_at(position, view_dir, hit, material.precise)
        }));
    }
}

impl Path {
    /// Where the ray a step beside this one meets the plane of the face; after a reflection, a pixel's width away.
    fn beside(&self, reference: &Reference<'_>, hit: &Hit, point: &Point, axis: usize) -> DVec3 {
        let normal = point.geometric_normal;
        if self.density.is_none() && self.passed == 0 {
            let dir = self.neighbours[axis];
            let t = normal.dot(point.position - self.ray.origin) / normal.dot(dir);
            // Beyond the horizon of the plane there is no meeting nearby.
            if t > 0.0 && t < 2.0 * hit.t {
                return self.ray.origin + t * dir;
            }
        }
        let width = reference.camera.pixel_angle() * DERIVATIVE_STEP * (self.length + hit.t);
        point.position + width * DVec3::from(across(normal.to_array())[axis])
    }

    /// The ray has met nothing.
    fn miss(&mut self, reference: &Reference<'_>) {
        let dir = self.ray.dir.to_array();
        let Some(density) = self.density else {
            let (radiance, alpha) = reference.behind(self.ray.dir);
            self.radiance = add(self.radiance, mul(self.throughput, radiance));
            self.alpha = alpha;
            return;
        };
        if let Some(environment) = &reference.environment {
            let (radiance, drawn) = environment.light(dir);
            let light = scale(radiance, self.occlusion * density / (density + drawn));
            self.radiance = add(self.radiance, mul(self.throughput, light));
        }
    }

    /// Adds what the point sends to the viewer; true where the path goes on.
    fn shade(
        &mut self,
        veil: &mut Veil<'_, '_>,
        material: &Material,
        hit: &Hit,
        point: &Point,
        surface: &Surface,
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
            self.alpha = 1.0;
        }
        let (mut surface, mut geometric_normal) = (*surface, point.geometric_normal);
        if material.settings.double_sided && geometric_normal.dot(self.ray.dir) > 0.0 {
            geometric_normal = -geometric_normal;
            surface.normal = surface.normal.map(|x| -x);
            surface.coat_normal = surface.coat_normal.map(|x| -x);
        }
        let sheet = material.settings.thin_walled;
        let bsdf = Bsdf::new(&reference.model, &surface, point.view_dir.to_array(), point.tangent.to_array(), sheet);
        self.radiance = add(self.radiance, mul(self.throughput, bsdf.emission));
        if !bsdf.reflects() {
            return Ok(false);
        }
        let place = Place { bsdf: &bsdf, position: point.position, geometric_normal, primitive: hit.primitive };
        self.add_lights(&place, veil)?;
        self.add_drawn_light(&place, veil, surface.occlusion)?;
        self.go_on(&place, veil, surface.occlusion)
    }

    fn add_lights(&mut self, place: &Place<'_>, veil: &mut Veil<'_, '_>) -> Result<(), ReferenceError> {
        for (light, distance) in veil.reference.lights.at(place.position.to_array()) {
            let reflected = place.bsdf.eval(light.dir);
            if reflected == [0.0; 3] {
                continue;
            }
            let seen = veil.sees(place, light.dir, distance)?;
            let light = scale(light.illuminance, seen);
            self.radiance = add(self.radiance, mul(self.throughput, mul(reflected, light)));
        }
        Ok(())
    }

    /// The environment drawn where its light is.
    fn add_drawn_light(
        &mut self,
        place: &Place<'_>,
        veil: &mut Veil<'_, '_>,
        occlusion: f64,
    ) -> Result<(), ReferenceError> {
        let Some(environment) = &veil.reference.environment else { return Ok(()) };
        let Some((dir, density)) = environment.sample(self.random.pair()) else { return Ok(()) };
        let reflected = place.bsdf.eval(dir);
        if reflected == [0.0; 3] {
            return Ok(());
        }
        let seen = veil.sees(place, dir, f64::INFINITY)?;
        if seen > 0.0 {
            let weight = seen * occlusion / (density + place.bsdf.density(dir));
            let light = scale(environment.radiance(dir), weight);
            self.radiance = add(self.radiance, mul(self.throughput, mul(reflected, light)));
        }
        Ok(())
    }

    /// A direction drawn by the lobes: to the environment, and to other surfaces as often as light may bounce.
    fn go_on(&mut self, place: &Place<'_>, veil: &mut Veil<'_, '_>, occlusion: f64) -> Result<bool, ReferenceError> {
        let reference = veil.reference;
        let choice = self.random.number();
        let dir = place.bsdf.sample(choice, self.random.pair());
        let density = place.bsdf.density(dir);
        if density.is_nan() || density <= 0.0 {
            return Ok(false);
        }
        let reflected = place.bsdf.eval(dir);
        if reflected == [0.0; 3] {
            return Ok(false);
        }
        self.throughput = mul(self.throughput, scale(reflected, 1.0 / density));
        (self.density, self.occlusion) = (Some(density), occlusion);
        self.ray = Ray { origin: place.position, dir: DVec3::from(dir) };
        self.from = place.primitive;
        if self.bounces >= reference.options.bounces || !reference.options.shadows || place.is_behind(dir) {
            if reference.environment.is_some() {
                let seen = veil.sees(place, dir, f64::INFINITY)?;
                if seen > 0.0 {
                    self.throughput = scale(self.throughput, seen);
                    self.miss(reference);
                }
            }
            return Ok(false);
        }
        if DVec3::from(dir).dot(place.geometric_normal) <= 0.0 {
            return Ok(false);
        }
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

/// A point that is shaded.
struct Place<'p> {
    bsdf: &'p Bsdf<'p>,
    position: DVec3,
    geometric_normal: DVec3,
    primitive: u32,
}

impl Place<'_> {
    /// Whether a direction lies behind the shading normal: into the body.
    fn is_behind(&self, dir: [f64; 3]) -> bool {
        DVec3::from(dir).dot(DVec3::from(self.bsdf.normal())) <= 0.0
    }
}

/// What stands between a point and its light.
struct Veil<'w, 'r> {
    reference: &'r Reference<'r>,
    evaluators: &'w mut [Option<Evaluator<'r>>],
    surfaces: &'w mut Vec<Surface>,
}

impl Veil<'_, '_> {
    /// The share of the light from a direction that arrives. What enters a body is taken to leave it again on the other
    /// side.
    fn sees(&mut self, place: &Place<'_>, dir: [f64; 3], distance: f64) -> Result<f64, ReferenceError> {
        if !self.reference.options.shadows || place.is_behind(dir) {
            return Ok(1.0);
        }
        let ray = Ray { origin: place.position, dir: DVec3::from(dir) };
        if ray.dir.dot(place.geometric_normal) <= 0.0 {
            return Ok(0.0);
        }
        if self.reference.is_opaque {
            let blocked = self.reference.geometry.is_blocked(&ray, place.primitive, distance);
            return Ok(if blocked { 0.0 } else { 1.0 });
        }
        self.passed(ray, place.primitive, distance)
    }

    /// The same where surfaces are cut out or blended: each one on the way is evaluated.
    fn passed(&mut self, mut ray: Ray, mut from: u32, mut distance: f64) -> Result<f64, ReferenceError> {
        let geometry = &self.reference.geometry;
        let mut share = 1.0;
        for _ in 0..MOST_PASSED {
            let Some(hit) = geometry.first(&ray, from).filter(|hit| hit.t < distance) else { return Ok(share) };
            let index = geometry.bodies[geometry.body(&hit)].material;
            let (Some(material), Some(evaluator)) = (&self.reference.materials[index], &mut self.evaluators[index])
            else {
                return Ok(0.0);
            };
            if material.settings.alpha_mode == AlphaMode::Opaque {
                return Ok(0.0);
            }
            let point = [geometry.point(&ray, &hit, material.precise)];
            let steps = material.derives.then_some([point.as_slice(), point.as_slice()]);
            evaluator.surfaces(&point, steps, self.surfaces)?;
            let opacity = self.surfaces.first().map_or(1.0, |surface| surface.opacity.clamp(0.0, 1.0));
            share *= match material.settings.alpha_mode {
                AlphaMode::Mask if opacity < f64::from(material.settings.alpha_cutoff) => 1.0,
                AlphaMode::Mask | AlphaMode::Opaque => 0.0,
                AlphaMode::Blend => 1.0 - opacity,
            };
            if share == 0.0 {
                return Ok(0.0);
            }
            distance -= hit.t;
            ray.origin += hit.t * ray.dir;
            from = hit.primitive;
        }
        Ok(0.0)
    }
}
