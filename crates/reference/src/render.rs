//! The renderer: paths from the camera, a wave of them at a time, so that materials are evaluated for many points at once.
//!
//! At each point the environment is drawn where its light is and where the lobes reflect, both weighed by the balance
//! heuristic (Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2); punctual lights are
//! looked at one by one. Nothing is clamped.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use halfvector_graph::document::AlphaMode;
use halfvector_ibl::LoadedEnvironment;
use halfvector_scene::{Background, BuiltinMesh, Mesh, Scene};
use rayon::prelude::*;

use crate::ReferenceError;
use crate::camera::Pinhole;
use crate::displacement;
use crate::environment::{Environment, EnvironmentFilter};
use crate::film::{Picture, Pixel};
use crate::function::Frames;
use crate::geometry::{Body, Geometry, Hit};
use crate::light::Lights;
use crate::material::Material;
use crate::model::{Conductor, Model};
use crate::texture::Textures;
use crate::wave::{Tile, Wave};

/// What is rendered, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderOptions {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Another seed is another noise; the same one gives the same bytes, at any number of threads.
    pub seed: u64,
    /// How often light may go from surface to surface on its way: 0 is direct light alone.
    pub bounces: u32,
    /// Whether surfaces cast shadows. Off is what a rasteriser without shadows draws, for comparisons; light then goes
    /// through everything, and nothing is reflected a second time.
    pub shadows: bool,
    /// What the environment is between its texels.
    pub environment_filter: EnvironmentFilter,
    /// A measured metal in the place of every material's Fresnel term.
    pub conductor: Option<Conductor>,
}

impl Default for RenderOptions {
    fn default() -> Self {
        RenderOptions {
            width: 512,
            height: 512,
            seed: 0,
            bounces: 0,
            shadows: true,
            environment_filter: EnvironmentFilter::default(),
            conductor: None,
        }
    }
}

/// Most pixels of a picture: some 6 GiB of sums.
const MAX_PIXELS: u64 = 1 << 25;
/// Pixels along an edge of a tile: what one thread takes at a time.
const TILE: u32 = 16;

/// A scene ready to be rendered, and what has been seen of it so far.
pub struct Reference<'a> {
    pub(crate) geometry: Geometry<'a>,
    pub(crate) materials: Vec<Option<Material>>,
    pub(crate) names: Vec<&'a str>,
    pub(crate) model: Model,
    pub(crate) environment: Option<Environment>,
    pub(crate) lights: Lights,
    pub(crate) camera: Pinhole,
    pub(crate) background: Background,
    pub(crate) options: RenderOptions,
    /// Whether no surface lets anything through.
    pub(crate) is_opaque: bool,
    film: Vec<Pixel>,
    samples: u64,
}

impl std::fmt::Debug for Reference<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reference")
            .field("options", &self.options)
            .field("samples", &self.samples)
            .finish_non_exhaustive()
    }
}

impl<'a> Reference<'a> {
    /// Makes a scene ready. `environment` is the scene's, loaded; it may be absent when the scene has none.
    ///
    /// The built-in sphere is rendered as the sphere that its triangles stand for, if no height moves them.
    ///
    /// # Errors
    /// When a material is wrong or asks for a method that has no truth here, or the size is.
    pub fn new(
        scene: &'a Scene,
        environment: Option<&LoadedEnvironment>,
        options: RenderOptions,
    ) -> Result<Reference<'a>, ReferenceError> {
        let RenderOptions { width, height, .. } = options;
        if width == 0 || height == 0 || u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(ReferenceError::PictureSize { width, height });
        }
        check_methods(scene)?;
        let frames = Arc::new(Frames::new(scene));
        let camera = scene.camera.position.as_dvec3();
        let mut textures = Textures::default();
        let mut materials: Vec<Option<Material>> = scene.materials.iter().map(|_| None).collect();
        let mut bodies = Vec::new();
        let sphere = BuiltinMesh::Sphere.parts();
        let is_sphere = |mesh: &Mesh| sphere.iter().any(|part| part.mesh == *mesh);
        for (number, object) in scene.objects.iter().enumerate() {
            let ranges = [("mesh", object.mesh, scene.meshes.len()), ("material", object.material, materials.len())];
            for (what, index, count) in ranges {
                if index >= count {
                    return Err(ReferenceError::Missing { object: number, what, index, count });
                }
            }
            let wanted = &scene.materials[object.material];
            let material = match &mut materials[object.material] {
                Some(material) => material,
                none => none.insert(Material::new(scene, wanted, &frames, &mut textures)?),
            };
            let mesh: &Mesh = &scene.meshes[object.mesh];
            let mut moved = None;
            if let Some(height) = &material.height {
                let found = displacement::moved(height, number as u32, object, mesh, camera)?;
                material.moved[0] += mesh.positions.len() as u64;
                material.moved[1] += found.not_finite;
                moved = found.positions;
            }
            bodies.push(Body {
                material: object.material,
                mesh: (moved.is_some() || !is_sphere(mesh)).then_some(Cow::Borrowed(mesh)),
                moved,
                culled: !wanted.document.surface.double_sided,
                object: object.clone(),
            });
        }
        let is_opaque = materials.iter().flatten().all(|material| material.settings.alpha_mode == AlphaMode::Opaque);
        let reach = camera.abs().max_element();
        let count = width as usize * height as usize;
        Ok(Reference {
            geometry: Geometry::new(bodies, reach),
            materials,
            names: scene.materials.iter().map(|material| material.document.name.as_str()).collect(),
            model: Model::new(&scene.methods, options.conductor),
            environment: environment
                .map(|loaded| Environment::new(loaded, options.environment_filter, scene.environment_rotation)),
            lights: Lights::new(&scene.lights),
            camera: Pinhole::new(&scene.camera, width, height),
            background: scene.background,
            options,
            is_opaque,
            film: vec![Pixel::default(); count],
            samples: 0,
        })
    }

    /// What of the scene is no finite number, in the user's words: heights of vertices, which stay where they are, and what the
    /// paths so far have met. Such paths count as black.
    pub fn faults(&self) -> Vec<String> {
        let shares = self.materials.iter().zip(&self.names).filter_map(|(m, name)| Some((m.as_ref()?, name)));
        let strange = shares.map(|(m, name)| (m.share_not_finite(), name)).filter(|(share, _)| *share > 0.0);
        let told = strange.map(|(share, name)| {
            format!(
                "the material `{name}` is NaN or infinite at {:.2} % of the points: they are black here, and anything elsewhere; \
                 `halfvector check --stability` finds the node",
                (100.0 * share).max(0.01)
            )
        });
        let unmoved = self.materials.iter().zip(&self.names).filter_map(|(m, name)| Some((m.as_ref()?.moved, name)));
        let stay = unmoved.filter(|([_, strange], _)| *strange > 0).map(|([all, strange], name)| {
            format!(
                "the height of the material `{name}` is NaN, infinite or beyond all measure at {:.2} % of the vertices: they \
                 stay where they are here, and are anywhere elsewhere; `halfvector check --stability` finds the node",
                (100.0 * strange as f64 / all as f64).max(0.01)
            )
        });
        stay.chain(told).collect()
    }

    /// Traces so many more paths for each pixel, on all cores. `progress` is told the share that is done, 0 to 1, by
    /// whichever thread has done it. In one step or in several: the picture is the same.
    ///
    /// # Errors
    /// When a material's program fails; the picture is then as it was.
    pub fn add_samples(&mut self, samples: u64, progress: &(dyn Fn(f32) + Sync)) -> Result<(), ReferenceError> {
        let RenderOptions { width, height, .. } = self.options;
        let starts = |length: u32| (0..length).step_by(TILE as usize);
        let tiles: Vec<Tile> = starts(height)
            .flat_map(|y| {
                starts(width).map(move |x| Tile { x, y, width: TILE.min(width - x), height: TILE.min(height - y) })
            })
            .collect();
        let done = AtomicU64::new(0);
        let first = self.samples;
        let finished: Vec<Vec<Pixel>> = tiles
            .par_iter()
            .map_init(
                || Wave::new(self),
                |wave, tile| {
                    let wave = wave.as_mut().map_err(|error| error.clone())?;
                    let mut pixels = Vec::with_capacity((tile.width * tile.height) as usize);
                    for y in tile.y..tile.y + tile.height {
                        let row = y as usize * width as usize + tile.x as usize;
                        pixels.extend_from_slice(&self.film[row..row + tile.width as usize]);
                    }
                    wave.tile(*tile, first, samples, &mut pixels)?;
                    let count = done.fetch_add(1, Ordering::Relaxed) + 1;
                    progress(count as f32 / tiles.len() as f32);
                    Ok(pixels)
                },
            )
            .collect::<Result<_, ReferenceError>>()?;
        for (tile, pixels) in tiles.iter().zip(finished) {
            for (row, line) in pixels.chunks(tile.width as usize).enumerate() {
                let start = (tile.y as usize + row) * width as usize + tile.x as usize;
                self.film[start..start + line.len()].copy_from_slice(line);
            }
        }
        self.samples += samples;
        Ok(())
    }

    /// The picture so far.
    pub fn picture(&self) -> Picture {
        Picture::new(self.options.width, self.options.height, self.samples, &self.film)
    }

    /// Index of the material that a hit is on.
    pub(crate) fn material_of(&self, hit: &Hit) -> usize {
        self.geometry.bodies[self.geometry.body(hit)].material
    }
}

/// Refuses methods by which a picture is no radiance, or which change what the environment is.
fn check_methods(scene: &Scene) -> Result<(), ReferenceError> {
    let refuse = |term, remedy| {
        let method = scene.methods.get(term).name;
        Err(ReferenceError::Method { term, method, remedy })
    };
    if scene.methods.is("encode", "report") {
        return refuse("encode", "choose encode=srgb");
    }
    if scene.methods.is("env_decode", "report") {
        return refuse("env_decode", "choose env_decode=linear");
    }
    Ok(())
}
