//! A scene becomes a picture: the whole way on one page.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use halfvector_codegen::uniforms::FrameValues;
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::library::Library;
use halfvector_graph::needs::ShaderOutput;
use halfvector_ibl::BakedEnvironment;
use halfvector_interp::Float;
use halfvector_scene::light::lights_by_kind;
use halfvector_scene::{Background, Picture, Scene, Tile, View, dfg_visibility, passes, tiles};
use rayon::prelude::*;

use crate::bind::{Blocks, Textures};
use crate::error::RasterError;
use crate::geometry::{SNAP, Triangle, Vertices};
use crate::program::{Stages, failed};
use crate::shade::Shading;
use crate::sky;
use crate::tile::{self, Draw, Frame, Machines, Rect};

/// Samples on a side of a tile, about: enough for whole batches of the interpreter, few enough for all cores.
const TILE_EDGE: u32 = 64;

/// Most samples in a row or column of a picture: corners within it fit the grid's numbers.
const MAX_SAMPLES: u64 = 1 << 21;

/// Most pixels of a picture.
const MAX_PIXELS: u64 = 1 << 28;

/// How a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterOptions {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Samples along each side of a pixel, on a regular grid: 4 is 16 samples per pixel.
    pub samples_per_side: u32,
    /// How the numbers of the materials reach the shader.
    pub fold: Fold,
}

impl Default for RasterOptions {
    /// 512 x 512 with 16 samples. Numbers are folded: there is less to run.
    fn default() -> Self {
        RasterOptions { width: 512, height: 512, samples_per_side: 4, fold: Fold::Export }
    }
}

/// A material of the scene with its shader, ready to run.
struct Material {
    shader: Shader,
    stages: Stages,
}

/// Draws a scene to linear radiance with premultiplied alpha, in f32 or f64. `environment` is the scene's environment,
/// baked; it may be absent when the scene has none. `progress` is told the share that is done, 0 to 1, from any thread.
/// The same bytes at any number of threads.
///
/// # Errors
/// When a material is wrong or does something that only a GPU does, or the picture has no or too many samples.
pub fn draw<F: Float>(
    scene: &Scene,
    environment: Option<&BakedEnvironment>,
    options: &RasterOptions,
    progress: impl Fn(f32) + Sync,
) -> Result<Picture, RasterError> {
    let go_on = |done| {
        progress(done);
        true
    };
    let picture = draw_while::<F>(scene, environment, options, go_on)?;
    Ok(picture.unwrap_or_else(|| Picture::clear(options.width, options.height)))
}

/// The same, given up when `go_on`, which is told the share that is done after each tile, returns false: then there is no
/// picture.
///
/// # Errors
/// As for [`draw`].
pub fn draw_while<F: Float>(
    scene: &Scene,
    environment: Option<&BakedEnvironment>,
    options: &RasterOptions,
    go_on: impl Fn(f32) -> bool + Sync,
) -> Result<Option<Picture>, RasterError> {
    let RasterOptions { width, height, samples_per_side: side, fold } = *options;
    let samples = |pixels: u32| u64::from(pixels) * u64::from(side);
    let sound = |pixels: u32| (1..=MAX_SAMPLES).contains(&samples(pixels));
    if !sound(width) || !sound(height) || u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(RasterError::PictureSize { width, height, side });
    }
    let grid = [width * side, height * side];

    let view = View::new(&scene.camera, scene.camera.near(scene.bounds()), width as f32 / height as f32);
    let whole = Tile { x: 0, y: 0, width, height };
    let values = frame_values(scene, environment, &view, whole);
    let passes = passes(scene, &view)?;
    let materials = materials(scene, fold)?;
    let mut textures = Textures::new(environment, dfg_visibility(&scene.methods));
    for (&index, material) in &materials {
        textures.prepare(scene, &scene.materials[index], &material.shader)?;
    }
    let sky_failed = |why: String| RasterError::Shader { material: "the background".to_owned(), why };
    let sky_program = match (scene.background, environment) {
        (Background::Environment, Some(_)) => {
            textures.prepare_radiance()?;
            Some(sky::compiled().map_err(sky_failed)?)
        }
        _ => None,
    };
    let coded = scene.methods.is("encode", "report");
    let numbers = view.background_numbers(width, height, whole, values.environment_rotation, coded);
    let sky_block: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();

    // Each object once, however often it is drawn.
    let mut objects: HashMap<usize, (Blocks, Vertices)> = HashMap::new();
    for &(index, _) in passes.solid.iter().chain(&passes.blended) {
        let Entry::Vacant(place) = objects.entry(index) else { continue };
        let object = &scene.objects[index];
        let of = &scene.materials[object.material];
        let Material { shader, stages } = &materials[&object.material];
        let blocks = Blocks::pack(shader, of, object, &values)?;
        let resources = blocks.resources(scene, of, shader, &textures);
        let mesh = &scene.meshes[object.mesh];
        let vertices = Vertices::run::<F>(&stages.vertex, &shader.reflection, mesh, &resources)
            .map_err(|error| failed(&of.document.name, Some(shader), &error))?;
        drop(resources);
        place.insert((blocks, vertices));
    }
    let draws: Vec<Draw<'_>> = passes
        .solid
        .iter()
        .chain(&passes.blended)
        .map(|&(index, pass)| {
            let object = &scene.objects[index];
            let of = &scene.materials[object.material];
            let Material { shader, stages } = &materials[&object.material];
            let (blocks, vertices) = &objects[&index];
            Draw {
                shading: Shading::new(&stages.fragment, blocks.resources(scene, of, shader, &textures)),
                vertices,
                triangles: vertices.triangles(&scene.meshes[object.mesh], pass, grid[0], grid[1]),
                material: &of.document.name,
                material_index: object.material,
                blend: pass.blend,
            }
        })
        .collect();
    let clear = match scene.background {
        Background::Color([r, g, b]) => [r, g, b, 1.0],
        Background::Environment | Background::None => [0.0; 4],
    };
    let sky = sky_program.as_ref().zip(textures.radiance());
    let sky = sky.map(|(program, radiance)| sky::shading(program, &sky_block, radiance));
    let frame = Frame { draws, sky, clear, grid };

    // Tiles begin at even samples: the blocks of two by two are those of the whole picture.
    let edge = (TILE_EDGE / side).max(1);
    let edge = if edge * side % 2 == 1 { edge + 1 } else { edge };
    let tiles = tiles(width, height, edge);
    let bins = bins(&frame.draws, grid, edge * side);
    let done = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let parts = tiles
        .par_iter()
        .zip(&bins)
        .map_init(
            || Machines::<F>::new(&frame),
            |machines, (&pixels, bin)| {
                if stopped.load(Ordering::Relaxed) {
                    return Ok(None);
                }
                let rect = Rect {
                    x: pixels.x * side,
                    y: pixels.y * side,
                    width: pixels.width * side,
                    height: pixels.height * side,
                };
                let samples = tile::draw(&frame, machines, rect, bin).map_err(|(number, error)| {
                    let draw = number.map(|number| &frame.draws[number]);
                    let shader = draw.and_then(|draw| materials.get(&draw.material_index)).map(|of| &of.shader);
                    failed(draw.map_or("the background", |draw| draw.material), shader, &error)
                })?;
                let mut part = Picture::clear(pixels.width, pixels.height);
                part.resolve(Tile { x: 0, y: 0, ..pixels }, side, &samples);
                if !go_on((done.fetch_add(1, Ordering::Relaxed) + 1) as f32 / tiles.len() as f32) {
                    stopped.store(true, Ordering::Relaxed);
                }
                Ok(Some(part))
            },
        )
        .collect::<Result<Vec<Option<Picture>>, RasterError>>()?;
    let mut picture = Picture::clear(width, height);
    for (&tile, part) in tiles.iter().zip(&parts) {
        let Some(part) = part else { return Ok(None) };
        picture.put(tile, part);
    }
    Ok(Some(picture))
}

fn frame_values(scene: &Scene, environment: Option<&BakedEnvironment>, view: &View, whole: Tile) -> FrameValues {
    let (sin, cos) = scene.environment_rotation.to_radians().sin_cos();
    FrameValues {
        clip_from_world: view.clip_from_world(whole.width, whole.height, whole).to_cols_array(),
        view_from_world: view.view_from_world().to_cols_array(),
        camera_position: view.position.to_array(),
        time: 0.0,
        exposure: scene.exposure.factor(),
        environment_rotation: [cos, sin],
        environment_levels: environment.map_or(0, |baked| baked.radiance.len() as u32),
        irradiance_sh: environment.map_or([[0.0; 3]; 9], |baked| baked.irradiance_sh),
        lights: lights_by_kind(&scene.lights).numbers(),
    }
}

/// The shaders of the materials that objects use, by the material's index, compiled on all cores.
fn materials(scene: &Scene, fold: Fold) -> Result<BTreeMap<usize, Material>, RasterError> {
    let needs = halfvector_scene::needs(scene, ShaderOutput::Radiance);
    let used: BTreeSet<usize> = scene.objects.iter().map(|object| object.material).collect();
    used.into_par_iter()
        .map(|index| {
            let document = &scene.materials[index].document;
            let shader = halfvector_codegen::shader(document, Library::standard(), &needs, fold)
                .map_err(|error| RasterError::Shader { material: document.name.clone(), why: error.to_string() })?;
            let stages = Stages::of(&document.name, &shader)?;
            Ok((index, Material { shader, stages }))
        })
        .collect()
}

/// For each tile of `edge` samples, row by row, (draw, triangle) of the triangles that may touch it, in order.
fn bins(draws: &[Draw<'_>], grid: [u32; 2], edge: u32) -> Vec<Vec<(u32, u32)>> {
    let [columns, rows] = grid.map(|samples| samples.div_ceil(edge));
    let mut bins = vec![Vec::new(); columns as usize * rows as usize];
    for (number, draw) in draws.iter().enumerate() {
        for (index, triangle) in draw.triangles.iter().enumerate() {
            let Some([left, right]) = tiles_along(triangle, 0, columns, edge) else { continue };
            let Some([top, bottom]) = tiles_along(triangle, 1, rows, edge) else { continue };
            for y in top..=bottom {
                for x in left..=right {
                    bins[y * columns as usize + x].push((number as u32, index as u32));
                }
            }
        }
    }
    bins
}

/// The first and last tile along an axis that a triangle may touch.
fn tiles_along(triangle: &Triangle, axis: usize, count: u32, edge: u32) -> Option<[usize; 2]> {
    let places = triangle.corners.map(|corner| corner[axis]);
    let low = places.iter().min()?.div_euclid(SNAP * i64::from(edge)).max(0);
    let high = places.iter().max()?.div_euclid(SNAP * i64::from(edge)).min(i64::from(count) - 1);
    (low <= high).then_some([low as usize, high as usize])
}
