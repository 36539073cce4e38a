//! `halfvector render`: a picture of a material or scene.

use std::path::{Path, PathBuf};

use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_reference::{Conductor, EnvironmentFilter};
use halfvector_scene::{Background, Display, EnvironmentSource, Exposure, Light, MeshSource, Scene};

use crate::backend::{Backend, Painter, Runner, parse_backend};
use crate::environment::{bake, load};
use crate::failure::Failure;
use crate::input;
use crate::output::{check_place, note};
use crate::picture_file::{PictureFile, PictureFormat, parse_picture_file, write};
use crate::reference::{self, ReferenceOptions};
use crate::set_value::{Assignment, numbers, parse_assignment, set, whole_number};

/// Draws a material or scene to a picture.
///
/// A bare material is drawn on a unit sphere under the environment `studio`, without punctual lights; each option replaces
/// only its own part.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:
  halfvector render examples/surface.material.json --set metallic=1 --set base_color=1,0.766,0.336 -o gold.png
  halfvector render examples/surface.material.json --env none --light directional:1,1,1:3 --background none -o lit.png
  halfvector render examples/report-1-mirror.scene.json --size 800x600 --samples 64 -o mirror.exr
  halfvector render examples/surface.material.json --backend reference --set metallic=1 --conductor 0.143,0.375,1.442:3.983,2.386,1.603 \
    --method v=separable --method compensation=none --env map.exr --env-filter vertex-rows --samples 256 -o as-mitsuba.exr")]
pub(crate) struct RenderArgs {
    /// A material (*.material.json), scene (*.scene.json) or model (.glb, .gltf)
    #[arg(value_name = "DOC|SCENE")]
    input: PathBuf,
    /// The picture: .png (sRGB, tone-mapped), .exr or .hdr (linear radiance, no exposure, no tone map)
    #[arg(short, long, value_name = "OUT", value_parser = parse_picture_file)]
    output: PictureFile,
    /// What wears the material: sphere, plane, cube, torus, shaderball, or a .glb or .gltf file
    #[arg(long, value_name = "MESH", value_parser = parse_mesh)]
    mesh: Option<MeshSource>,
    /// The environment: white, studio, sky, none, a .hdr, .exr, .hdre, .ktx2, .png or .jpg file, or six faces (see bake)
    #[arg(long, value_name = "ENV", value_parser = parse_environment)]
    env: Option<EnvironmentSource>,
    /// Turns the environment counter-clockwise seen from above, in degrees
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = parse_finite)]
    env_rotation: Option<f32>,
    /// What stands behind: env, none (alpha 0), or linear radiance R,G,B
    #[arg(long, value_name = "env|none|R,G,B", value_parser = parse_background)]
    background: Option<Background>,
    /// A punctual light; may be given several times and replaces the scene's lights
    #[arg(long, value_name = "SPEC", value_parser = halfvector_scene::light::parse_light, long_help = light_help())]
    light: Vec<Light>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples per pixel: a square number, as they stand on a regular grid, of 4096 at most; with --backend reference paths
    /// per pixel
    #[arg(long, value_name = "N", default_value_t = 16, allow_negative_numbers = true,
        value_parser = |text: &str| whole_number::<u32>(text, 1..=1 << 20))]
    samples: u32,
    /// Brightens a PNG by so many stops
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true, value_parser = parse_finite)]
    exposure: Option<f32>,
    /// How a PNG's radiance is brought into the display's range: none, reinhard, aces, agx, pbr-neutral
    #[arg(long, value_name = "NAME", value_parser = halfvector_scene::tone_map::tone_map_from_name)]
    tone_map: Option<ToneMap>,
    /// Sets a parameter that the material exposes; may be given several times
    #[arg(long, value_name = "PARAMETER=VALUE", value_parser = parse_assignment)]
    set: Vec<Assignment>,
    #[command(flatten)]
    methods: super::methods::MethodChoice,
    /// Who draws: gpu (a software GPU where there is no other), cpu, auto: gpu, else cpu; or reference (Monte Carlo in f64,
    /// with shadows: slow and true)
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = parse_backend)]
    backend: Backend,
    /// Of --backend reference: another seed is another noise, the same one the same picture
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true,
        value_parser = |text: &str| whole_number::<u64>(text, 0..=u64::MAX))]
    seed: u64,
    /// Of --backend reference: how often light may go from surface to surface; paths end by themselves, so a large number is all of it
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true,
        value_parser = |text: &str| whole_number::<u32>(text, 0..=u64::from(u32::MAX)))]
    bounces: u32,
    /// Of --backend reference: what an equirectangular environment is between its texels: bilinear (default), box (constant within
    /// each texel), or vertex-rows (bilinear, the first and the last row at the poles: as Mitsuba 3 reads maps)
    #[arg(long, value_name = "NAME", value_parser = parse_filter)]
    env_filter: Option<EnvironmentFilter>,
    /// Of --backend reference: a measured metal's index of refraction and extinction for red, green and blue, whose exact Fresnel
    /// reflectance stands for that of every material: gold is 0.143,0.375,1.442:3.983,2.386,1.603
    #[arg(long, value_name = "N_R,N_G,N_B:K_R,K_G,K_B", value_parser = parse_conductor)]
    conductor: Option<Conductor>,
}

/// Runs the command.
pub(crate) fn run(args: &RenderArgs) -> Result<u8, Failure> {
    check_place(&args.output.path)?;
    let mut scene = input::scene(&args.input, args.mesh.as_ref())?;
    replace_parts(&mut scene, args)?;
    refuse_coded_radiance(&scene.methods, &args.output)?;
    if (args.tone_map.is_some() || args.exposure.is_some()) && is_coded_or_linear(&scene.methods, &args.output) {
        note(
            "note: --tone-map and --exposure do nothing here: .exr and .hdr hold radiance, encode=report display values",
        );
    }
    if args.background == Some(Background::None) && args.output.format == PictureFormat::Hdr {
        note("note: .hdr has no alpha: what is behind the object is black; .png and .exr keep it apart");
    }
    for text in &scene.notes {
        note(format_args!("note: {text}"));
    }
    let runner = match args.backend {
        Backend::Shader(runner) => runner,
        Backend::Reference => {
            let RenderArgs { size, samples, seed, bounces, env_filter, conductor, .. } = *args;
            let filter = env_filter.unwrap_or_default();
            reference::draw(
                &scene,
                ReferenceOptions { size, samples, seed, bounces, filter, conductor },
                &args.output,
            )?;
            return Ok(0);
        }
    };
    let of_reference = [
        ("--seed", args.seed != 0),
        ("--bounces", args.bounces != 0),
        ("--env-filter", args.env_filter.is_some()),
        ("--conductor", args.conductor.is_some()),
    ];
    for (option, _) in of_reference.iter().filter(|(_, is_given)| *is_given) {
        note(format_args!("note: {option} does nothing here: it is for --backend reference"));
    }
    if args.samples > MAX_SAMPLES {
        let why = format!("--samples {} is more than {MAX_SAMPLES}", args.samples);
        return Err(Failure::usage(why).try_to("fewer, or --backend reference"));
    }
    let side = samples_per_side(args.samples);
    if side * side != args.samples {
        note(format_args!(
            "note: samples stand on a square grid; {} are taken instead of {}",
            side * side,
            args.samples
        ));
    }
    draw(&scene, args.size, side, runner, &args.output)?;
    Ok(0)
}

/// Draws a scene to a file.
pub(crate) fn draw(
    scene: &Scene,
    size: [u32; 2],
    side: u32,
    runner: Runner,
    output: &PictureFile,
) -> Result<(), Failure> {
    let loaded = load(&scene.environment)?;
    let painter = Painter::open(runner)?;
    let environment = loaded.map(|loaded| bake(scene, &loaded));
    let picture = painter.draw(scene, environment.as_ref(), size, side)?;
    let display = if scene.methods.is("encode", "report") {
        Display::AsIs
    } else {
        Display::ToneMapped { exposure: scene.exposure.factor(), tone_map: scene.tone_map }
    };
    write(output, &picture, None, display)?;
    let [width, height] = size;
    note(format_args!("{}: {width} x {height}, drawn by {}", output.path.display(), painter.name()));
    Ok(())
}

fn replace_parts(scene: &mut Scene, args: &RenderArgs) -> Result<(), Failure> {
    if let Some(environment) = &args.env {
        scene.environment = environment.clone();
    }
    if let Some(rotation) = args.env_rotation {
        scene.environment_rotation = rotation;
    }
    if let Some(background) = args.background {
        scene.background = background;
    }
    if !args.light.is_empty() {
        scene.lights.clone_from(&args.light);
    }
    if let Some(stops) = args.exposure {
        scene.exposure = Exposure::Stops(stops);
    }
    if let Some(tone_map) = args.tone_map {
        scene.tone_map = tone_map;
    }
    args.methods.apply(&mut scene.methods);
    set_parameters(scene, &args.set, &args.input)
}

/// Sets each parameter in every material that exposes it; one that no material exposes is an error.
fn set_parameters(scene: &mut Scene, assignments: &[Assignment], path: &Path) -> Result<(), Failure> {
    for assignment in assignments {
        let failed = |why: String| {
            Failure::input("a parameter could not be set").at(path).because(why).try_to("a name and value as listed")
        };
        let mut reasons = Vec::new();
        let mut done = false;
        for material in &mut scene.materials {
            match set(&mut material.document, Library::standard(), assignment) {
                Ok(()) => done = true,
                Err(why) => reasons.push(why),
            }
        }
        if !done {
            return Err(failed(reasons.first().cloned().unwrap_or_else(|| "the scene has no material".to_owned())));
        }
    }
    if !assignments.is_empty() {
        for material in &scene.materials {
            input::refuse_errors(path, &material.document)?;
            // An opaque material would swallow `--set opacity=0.5` without a word.
            let problems = halfvector_graph::check::check(&material.document, Library::standard());
            problems.iter().filter(|problem| problem.socket.as_deref() == Some("opacity")).for_each(note);
        }
        scene.load_images().map_err(|error| Failure::input("an image could not be loaded").at(path).because(error))?;
    }
    Ok(())
}

/// With `encode=report` the shader's output is no radiance.
fn refuse_coded_radiance(methods: &Methods, output: &PictureFile) -> Result<(), Failure> {
    if methods.is("encode", "report") && output.format != PictureFormat::Png {
        return Err(Failure::usage("with encode=report there is no radiance to write")
            .at(&output.path)
            .because("the report codes the reflection for the display before it is multiplied by the albedo")
            .try_to("a .png file, or --method encode=srgb"));
    }
    Ok(())
}

/// Whether the file's numbers are written as the shader gives them.
fn is_coded_or_linear(methods: &Methods, output: &PictureFile) -> bool {
    output.format != PictureFormat::Png || methods.is("encode", "report")
}

fn samples_per_side(samples: u32) -> u32 {
    let root = samples.isqrt();
    if root * root == samples { root } else { root + 1 }
}

fn parse_mesh(text: &str) -> Result<MeshSource, String> {
    MeshSource::parse(text, Path::new(""))
}

fn parse_environment(text: &str) -> Result<EnvironmentSource, String> {
    Ok(EnvironmentSource::parse(text, Path::new("")))
}

fn parse_finite(text: &str) -> Result<f32, String> {
    match numbers(text)?[..] {
        [number] => Ok(number),
        _ => Err("one number is needed".to_owned()),
    }
}

fn parse_background(text: &str) -> Result<Background, String> {
    match text {
        "env" => Ok(Background::Environment),
        "none" => Ok(Background::None),
        color => match numbers(color).as_deref() {
            Ok(&[r, g, b]) if r >= 0.0 && g >= 0.0 && b >= 0.0 => Ok(Background::Color([r, g, b])),
            _ => Err("write env, none, or a linear colour R,G,B of numbers from 0".to_owned()),
        },
    }
}

fn parse_filter(text: &str) -> Result<EnvironmentFilter, String> {
    match text {
        "bilinear" => Ok(EnvironmentFilter::Bilinear),
        "box" => Ok(EnvironmentFilter::Box),
        "vertex-rows" => Ok(EnvironmentFilter::VertexRows),
        _ => Err("write bilinear, box or vertex-rows".to_owned()),
    }
}

fn parse_conductor(text: &str) -> Result<Conductor, String> {
    /// Larger ones are mirrors, and their squares no numbers.
    const MOST: f64 = 1e6;
    let three = |text: &str, least: f64| -> Option<[f64; 3]> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        numbers?.try_into().ok().filter(|all: &[f64; 3]| all.iter().all(|x| (least..=MOST).contains(x)))
    };
    let parsed = || {
        let (eta, k) = text.split_once(':')?;
        Some(Conductor { eta: three(eta, 1.0 / MOST)?, k: three(k, 0.0)? })
    };
    parsed().ok_or_else(|| {
        "write N_R,N_G,N_B:K_R,K_G,K_B: three indices of refraction above 0 and three extinctions from 0, such as 0.143,0.375,1.442:3.983,2.386,1.603"
            .to_owned()
    })
}

/// Most samples of a pixel by the backends that take them on a grid.
const MAX_SAMPLES: u32 = 4096;

/// Most pixels of a picture: 4 GiB of samples' means.
const MAX_PIXELS: u64 = 1 << 28;

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let wanted = || "write WIDTHxHEIGHT in pixels, such as 800x600".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wanted)?;
    let side = |text: &str| text.parse::<u32>().ok().filter(|&side| side > 0).ok_or_else(wanted);
    let (width, height) = (side(width)?, side(height)?);
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!("that is more than {MAX_PIXELS} pixels; choose a smaller size"));
    }
    Ok([width, height])
}

fn light_help() -> String {
    format!(
        "A punctual light; may be given several times and replaces the scene's lights.\n{}",
        halfvector_scene::light::LIGHT_SYNTAX
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_rounded_up_to_squares() {
        assert_eq!([1, 2, 4, 5, 16, 17, 4096].map(samples_per_side), [1, 2, 2, 3, 4, 5, 64]);
    }

    #[test]
    fn sizes_and_backgrounds_as_written() {
        assert_eq!(parse_size("800x600"), Ok([800, 600]));
        for wrong in ["800", "0x5", "-1x5", "axb", "800x600x3", "4294967295x4294967295", ""] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(parse_background("0.5,0,1"), Ok(Background::Color([0.5, 0.0, 1.0])));
        for wrong in ["0.5", "1,2", "-1,0,0", "inf,0,0", "red"] {
            assert!(parse_background(wrong).is_err(), "{wrong}");
        }
    }
}
