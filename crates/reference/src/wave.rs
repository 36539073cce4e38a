//! A wave of paths: all samples of a tile that are on their way, traced and shaded one step at a time. What is alike for all
//! of them is computed in blocks: the camera's rays, the directions drawn by the environment's light, and what they see of it.

mod awaited;
mod path;
mod veil;

use glam::DVec3;
use halfvector_scene::Background;
use pulp::{Arch, Simd, WithSimd};

use crate::ReferenceError;
use crate::camera::Pinhole;
use crate::directions::{BLOCK, Directions};
use crate::film::Pixel;
use crate::geometry::{Hit, Point, Ray};
use crate::material::{Evaluator, Material, Surface};
use crate::random::Random;
use crate::render::Reference;
use awaited::Awaited;
use path::{Drawn, Path};
use veil::Veil;

/// Samples in a wave.
const SAMPLES: usize = 2048;
/// Surfaces that a ray may pass through because they are cut out or blended, before it is taken as ended.
const MOST_PASSED: u32 = 256;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tile {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// The memory of one thread.
pub(crate) struct Wave<'r> {
    reference: &'r Reference<'r>,
    arch: Arch,
    evaluators: Vec<Option<Evaluator<'r>>>,
    /// What has been seen by each sample: radiance and alpha.
    seen: Vec<[f64; 4]>,
    starts: Starts,
    /// Samples that have met something.
    paths: Vec<Path>,
    /// Numbers of the paths that have a ray to trace.
    active: Vec<u32>,
    /// Hits of this step by material: the path's number, and what it has met.
    hits: Vec<Vec<(u32, Hit)>>,
    points: [Vec<Point>; 3],
    surfaces: Vec<Surface>,
    /// Surfaces on the way to the light.
    behind: Vec<Surface>,
    /// Two numbers for each hit, and the direction that they draw by the environment's light.
    numbers: [Vec<f64>; 2],
    drawn: Directions,
    densities: Vec<f64>,
    awaited: Awaited,
}

/// Where the samples of a wave begin.
#[derive(Default)]
struct Starts {
    /// Number of the pixel in the picture, its corner, and the sample's number.
    pixels: Vec<(u64, [f64; 2], u64)>,
    randoms: Vec<Random>,
    /// Places in the picture.
    places: Vec<[f64; 2]>,
    dirs: Directions,
    /// What each ray meets first, if its distance is finite.
    met: Vec<Hit>,
}

impl<'r> Wave<'r> {
    pub(crate) fn new(reference: &'r Reference<'r>) -> Result<Wave<'r>, ReferenceError> {
        let evaluators = reference
            .materials
            .iter()
            .map(|material| material.as_ref().map(Material::evaluator).transpose())
            .collect::<Result<_, _>>()?;
        Ok(Wave {
            reference,
            arch: Arch::new(),
            evaluators,
            seen: Vec::new(),
            starts: Starts::default(),
            paths: Vec::new(),
            active: Vec::new(),
            hits: reference.materials.iter().map(|_| Vec::new()).collect(),
            points: Default::default(),
            surfaces: Vec::new(),
            behind: Vec::new(),
            numbers: Default::default(),
            drawn: Directions::default(),
            densities: Vec::new(),
            awaited: Awaited::default(),
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
        let at_once = (SAMPLES / pixels.len().max(1)).max(1) as u64;
        let mut start = first;
        while start < first + count {
            let end = (start + at_once).min(first + count);
            self.start(tile, start..end);
            while self.hits.iter().any(|hits| !hits.is_empty()) {
                self.shade()?;
                self.trace();
                self.awaited.arrive(self.reference, &mut self.seen);
            }
            self.awaited.arrive(self.reference, &mut self.seen);
            // Each pixel's samples in their order: sums do not depend on how many are taken at once.
            for (pixel, seen) in pixels.iter_mut().zip(self.seen.chunks((end - start) as usize)) {
                for &[r, g, b, alpha] in seen {
                    let finite = (r + g + b).is_finite();
                    pixel.add(if finite { [r, g, b] } else { [0.0; 3] }, alpha);
                }
            }
            start = end;
        }
        Ok(())
    }

    /// Sends off the camera's rays.
    fn start(&mut self, tile: Tile, samples: std::ops::Range<u64>) {
        let reference = self.reference;
        let Starts { pixels, randoms, places, dirs, met } = &mut self.starts;
        pixels.clear();
        for y in tile.y..tile.y + tile.height {
            for x in tile.x..tile.x + tile.width {
                let pixel = u64::from(y) * u64::from(reference.options.width) + u64::from(x);
                pixels.extend(samples.clone().map(|sample| (pixel, [f64::from(x), f64::from(y)], sample)));
            }
        }
        self.arch.dispatch(Aim {
            camera: &reference.camera,
            seed: reference.options.seed,
            pixels,
            randoms,
            places,
            dirs,
        });
        self.seen.clear();
        self.seen.resize(pixels.len(), [0.0; 4]);
        self.paths.clear();
        let origin = reference.camera.position();
        reference.geometry.first_from(origin, dirs, met);
        for (number, hit) in met.iter().enumerate() {
            let dir = dirs.at(number);
            if hit.t.is_finite() {
                let ray = Ray { origin, dir: DVec3::from(dir) };
                self.hits[reference.material_of(hit)].push((self.paths.len() as u32, *hit));
                self.paths.push(Path::new(randoms[number], places[number], ray, number as u32));
            } else {
                see_behind(reference, &mut self.awaited, &mut self.seen, number as u32, dir, [1.0; 3]);
            }
        }
    }

    /// Shades what the rays have met; those that go on are active afterwards.
    fn shade(&mut self) -> Result<(), ReferenceError> {
        let reference = self.reference;
        for index in 0..self.hits.len() {
            if self.hits[index].is_empty() {
                continue;
            }
            let hits = std::mem::take(&mut self.hits[index]);
            if let (Some(material), Some(evaluator)) = (&reference.materials[index], &mut self.evaluators[index]) {
                place(reference, material, &self.paths, &hits, &mut self.points);
                let [points, right, down] = &mut self.points;
                let steps = material.wants_steps().then_some([right.as_slice(), down.as_slice()]);
                evaluator.surfaces(points, steps, &mut self.surfaces)?;
                self.draw(&hits);
                let mut veil = Veil { reference, evaluators: &mut self.evaluators, surfaces: &mut self.behind };
                for (i, (number, hit)) in hits.iter().enumerate() {
                    let path = &mut self.paths[*number as usize];
                    let drawn = self.densities.get(i).map(|density| Drawn { dir: self.drawn.at(i), density: *density });
                    let seen = &mut self.seen[path.sample as usize];
                    let (point, surface) = (&self.points[0][i], &self.surfaces[i]);
                    if path.shade(&mut veil, seen, &mut self.awaited, material, hit, point, surface, drawn)? {
                        self.active.push(*number);
                    }
                }
            }
            self.hits[index] = hits;
            self.hits[index].clear();
        }
        Ok(())
    }

    /// Draws a direction for each hit where the environment's light is.
    fn draw(&mut self, hits: &[(u32, Hit)]) {
        self.densities.clear();
        let Some(environment) = self.reference.environment.as_ref().filter(|environment| environment.draws()) else {
            return;
        };
        self.numbers.iter_mut().for_each(Vec::clear);
        for (number, _) in hits {
            let [u, v] = self.paths[*number as usize].random.pair();
            self.numbers[0].push(u);
            self.numbers[1].push(v);
        }
        environment.draw(&self.numbers, &mut self.drawn, &mut self.densities);
    }

    /// Traces the rays that go on.
    fn trace(&mut self) {
        let reference = self.reference;
        for number in self.active.drain(..) {
            let path = &self.paths[number as usize];
            match reference.geometry.first(&path.ray, path.from) {
                Some(hit) => self.hits[reference.material_of(&hit)].push((number, hit)),
                None => {
                    let dir = path.ray.dir.to_array();
                    match path.density {
                        None => {
                            let seen = &mut self.seen;
                            see_behind(reference, &mut self.awaited, seen, path.sample, dir, path.throughput);
                        }
                        Some(density) if reference.environment.is_some() => {
                            let weight = path.throughput.map(|x| x * path.occlusion);
                            self.awaited.push(path.sample, dir, weight, density);
                        }
                        Some(_) => {}
                    }
                }
            }
        }
    }
}

/// A ray of the camera that has met nothing, or only what lets it pass.
fn see_behind(
    reference: &Reference<'_>,
    awaited: &mut Awaited,
    seen: &mut [[f64; 4]],
    sample: u32,
    dir: [f64; 3],
    throughput: [f64; 3],
) {
    let seen = &mut seen[sample as usize];
    match (reference.background, &reference.environment) {
        (Background::Environment, Some(_)) => {
            seen[3] = 1.0;
            awaited.push(sample, dir, throughput, awaited::CERTAIN);
        }
        (Background::Color(color), _) => {
            for i in 0..3 {
                seen[i] += throughput[i] * f64::from(color[i]);
            }
            seen[3] = 1.0;
        }
        (Background::Environment | Background::None, _) => seen[3] = 0.0,
    }
}

/// The points that rays have met and, where the material wants them, the points beside them.
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
    middle.extend(hits.iter().map(|(number, hit)| geometry.point(&paths[*number as usize].ray, hit, material.detail)));
    for (axis, beside) in [&mut *right, &mut *down].into_iter().enumerate() {
        beside.clear();
        if !material.wants_steps() {
            continue;
        }
        beside.extend(hits.iter().zip(middle.iter()).map(|((number, hit), point)| {
            let path = &paths[*number as usize];
            let position = path.beside(reference, hit, point, axis);
            let view_dir = match path.density {
                None => (path.ray.origin - position).normalize_or(point.view_dir),
                Some(_) => point.view_dir,
            };
            geometry.point_at(position, view_dir, hit, material.detail)
        }));
    }
    if material.detail.places {
        [middle, right, down].into_iter().for_each(|points| geometry.wrap(points));
    }
}

/// Makes the random numbers of some samples and, with the first two, their rays.
struct Aim<'a> {
    camera: &'a Pinhole,
    seed: u64,
    pixels: &'a [(u64, [f64; 2], u64)],
    randoms: &'a mut Vec<Random>,
    places: &'a mut Vec<[f64; 2]>,
    dirs: &'a mut Directions,
}

impl WithSimd for Aim<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.randoms.clear();
        self.places.clear();
        self.dirs.clear();
        for pixels in self.pixels.chunks(BLOCK) {
            let mut random = [Random::default(); BLOCK];
            let (mut number, mut sample) = ([0; BLOCK], [0; BLOCK]);
            let (mut x, mut y, mut dir) = ([0.0; BLOCK], [0.0; BLOCK], [[0.0; BLOCK]; 3]);
            for (i, pixel) in pixels.iter().enumerate() {
                (number[i], [x[i], y[i]], sample[i]) = *pixel;
            }
            for i in 0..BLOCK {
                random[i] = Random::new(self.seed, number[i], sample[i]);
                let [u, v] = random[i].pair();
                x[i] += u;
                y[i] += v;
                [dir[0][i], dir[1][i], dir[2][i]] = self.camera.dir(x[i], y[i]);
            }
            let count = pixels.len();
            self.randoms.extend_from_slice(&random[..count]);
            self.places.extend((0..count).map(|i| [x[i], y[i]]));
            self.dirs.extend(&dir, count);
        }
    }
}
