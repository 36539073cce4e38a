//! `halfvector bake`: an environment, prefiltered for real-time light, as files.

use std::path::{Path, PathBuf};

use halfvector_graph::needs::ToneMap;
use halfvector_ibl::save::{CubeLevels, HDRE_LEVELS, SaveError, TexelFormat, hdre_face};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Cube, LevelMap, LoadedEnvironment, MAX_SIZE, Quality, Source, StoredLevels,
    StoredLobe, save,
};
use halfvector_render::Renderer;
use halfvector_scene::{Display, EnvironmentSource, Picture, ggx_roughness};

use crate::environment::{bake_with_bar, load};
use crate::failure::Failure;
use crate::harmonics_file;
use crate::output::{check_place, note, progress, write_files};
use crate::picture_file::png;
use crate::set_value::{numbers, whole_number};

/// Prefilters an environment for real-time light: a cube map whose levels are filtered for a rising roughness.
///
/// The environment is an equirectangular map, a cross or strip of cube faces, six faces, or a file of cube levels; its
/// shape and first bytes tell which. Levels that are already what is asked for are kept as they are.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:
  halfvector bake room.hdr -o room.ktx2 --irradiance room-diffuse.ktx2 --sh room-sh.json
  halfvector bake studio -o studio.ktx2 --size 256 --roughness 0,0.2,0.4,0.6,0.8,1
  halfvector bake faces/room_%s.png -o room.hdre

Six faces: a folder, or a name with %s in place of px nx py ny pz nz or of posx negx posy negy posz negz.")]
pub(crate) struct BakeArgs {
    /// The environment: a .hdr, .exr, .hdre, .ktx2, .png or .jpg file, six faces, or white, studio or sky
    #[arg(value_name = "ENV", value_parser = parse_environment)]
    environment: EnvironmentSource,
    /// The prefiltered levels: .ktx2 for engines, .hdre (2.0, six levels), or .exr or .png (tone-mapped, to look at), a
    /// strip of faces for each level
    #[arg(short, long, value_name = "OUT", value_parser = parse_cube_file)]
    output: CubeFile,
    /// Texels along an edge of a face of level 0; each further level has half as many
    /// [default: 512, or as many as cube faces in ENV have]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
        value_parser = |text: &str| whole_number::<u32>(text, 1..=MAX_SIZE as u64))]
    size: Option<u32>,
    /// Number of levels
    #[arg(long, value_name = "N", allow_negative_numbers = true,
        value_parser = |text: &str| whole_number::<u32>(text, 1..=14), conflicts_with = "roughness")]
    levels: Option<u32>,
    /// The perceptual roughness of each level, rising, 0 to 1
    #[arg(long, value_name = "R0,R1,...", value_parser = parse_roughness)]
    roughness: Option<Roughness>,
    /// How exact, and how long it takes: preview, default, best
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_quality)]
    quality: Quality,
    /// How a KTX2 file stores a texel: rgba16f, rgba32f, or rgb9e5, the smallest
    #[arg(long, value_name = "NAME", default_value = "rgba16f", value_parser = parse_texels)]
    texels: TexelFormat,
    /// Also writes diffuse irradiance over pi as a cube of 448 texels along an edge, or 64 for a preview: .ktx2, .exr
    /// or .png
    #[arg(long, value_name = "OUT2", value_parser = parse_cube_file)]
    irradiance: Option<CubeFile>,
    /// Also writes the spherical harmonics of the light and of its irradiance
    #[arg(long, value_name = "FILE.json")]
    sh: Option<PathBuf>,
    /// Who computes: auto, cpu or gpu; auto takes a GPU that is no program on the CPU
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = parse_backend)]
    backend: Backend,
}

/// Who computes.
#[derive(Clone, Copy, Debug)]
enum Backend {
    /// A GPU of silicon where there is one, or the CPU.
    Auto,
    Cpu,
    /// Any GPU, a software one included.
    Gpu,
}

/// A file of cube levels to write.
#[derive(Clone, Debug, PartialEq, Eq)]
struct CubeFile {
    path: PathBuf,
    format: CubeFormat,
}

/// What the extension of a [`CubeFile`] says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CubeFormat {
    Ktx2,
    Hdre,
    Exr,
    Png,
}

/// The values of `--roughness`.
#[derive(Clone, Debug, PartialEq)]
struct Roughness(Vec<f32>);

/// Texels along an edge of level 0 when neither the user nor the file says.
const DEFAULT_SIZE: usize = 512;

/// Bytes that readers of HDRE refuse.
const HDRE_MAX_BYTES: usize = 60_000_000;

/// Runs the command.
pub(crate) fn run(args: &BakeArgs) -> Result<u8, Failure> {
    check_files(args)?;
    let loaded = load(&args.environment)?.ok_or_else(|| {
        Failure::usage("`none` is no environment: there is nothing to bake").try_to("a file, or white, studio or sky")
    })?;
    let file = |file: &CubeFile, bytes: Result<Vec<u8>, SaveError>| {
        let failed = |error| Failure::input("the levels could not be written").at(&file.path).because(error);
        bytes.map(|bytes| (file.path.clone(), bytes)).map_err(failed)
    };

    let plan = Plan::new(args, &loaded)?;
    let kept = hdre_to_hdre(args, &loaded);
    let mut files = Vec::new();
    let mut said = "the file's own six levels, kept as they are; --roughness filters them anew".to_owned();
    if let Some(stored) = kept {
        files.push(file(&args.output, save::hdre(&stored.levels, stored.irradiance_sh.as_ref()))?);
    }
    if kept.is_none() || args.irradiance.is_some() || args.sh.is_some() {
        let baked = match renderer(args.backend)? {
            Some(renderer) => bake_on_gpu(&renderer, &loaded, &plan.options)?,
            None => bake_with_bar(&loaded, &plan.options),
        };
        if kept.is_none() {
            let (levels, roughness) = plan.levels(&baked);
            // A bake that has slopes has the file's levels, none skipped or resized.
            let cube = CubeLevels { slope: &baked.slope, ..CubeLevels::radiance(&levels, roughness) };
            files.push(file(&args.output, coded(args.output.format, cube, args.texels, &baked))?);
            let numbers: Vec<String> = roughness.iter().map(|r| format!("{r:.3}")).collect();
            if args.texels == TexelFormat::Rgb9E5 && !baked.slope.is_empty() && args.output.format == CubeFormat::Ktx2 {
                note(
                    "note: rgb9e5 has no room for the slopes by which two levels are mixed; mixed linearly they err far more",
                );
            }
            said = format!("{} texels, {} levels for roughness {}", levels[0].size, levels.len(), numbers.join(" "));
        }
        if let Some(output) = &args.irradiance {
            let cube = CubeLevels::irradiance_over_pi(&baked.irradiance_over_pi);
            files.push(file(output, coded(output.format, cube, args.texels, &baked))?);
        }
        if let Some(path) = &args.sh {
            files.push((path.clone(), harmonics_file::text(&baked).into_bytes()));
        }
    }
    if args.output.format == CubeFormat::Hdre && files[0].1.len() > HDRE_MAX_BYTES {
        note("note: readers of HDRE refuse files of more than 60 MB, and this one is larger; choose a smaller --size");
    }
    let together: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (path.as_path(), bytes.as_slice())).collect();
    write_files(&together)?;
    note(format_args!("{}: {said}", args.output.path.display()));
    for (path, _) in &files[1..] {
        note(format_args!("{}", path.display()));
    }
    Ok(0)
}

/// The GPU to bake on, if any.
fn renderer(backend: Backend) -> Result<Option<Renderer>, Failure> {
    match backend {
        Backend::Cpu => Ok(None),
        Backend::Auto => Ok(Renderer::new().ok().filter(|renderer| !renderer.is_software())),
        Backend::Gpu => {
            let renderer = Renderer::new().map_err(|error| {
                Failure::input("the environment could not be baked on the GPU").because(error).try_to("--backend cpu")
            })?;
            if renderer.is_software() {
                note(format_args!("note: {} is a program on the CPU; --backend cpu is faster", renderer.adapter()));
            }
            Ok(Some(renderer))
        }
    }
}

fn bake_on_gpu(
    renderer: &Renderer,
    loaded: &LoadedEnvironment,
    options: &BakeOptions,
) -> Result<BakedEnvironment, Failure> {
    let bar = progress("prefiltering the environment");
    let baked = renderer.bake(loaded, options, |done| bar.set_position((done * 1000.0) as u64));
    bar.finish_and_clear();
    baked.map_err(|error| {
        Failure::input("the environment could not be baked on the GPU").because(error).try_to("--backend cpu")
    })
}

/// Refuses places that cannot be written to, and one place for two files.
fn check_files(args: &BakeArgs) -> Result<(), Failure> {
    let mut paths = vec![&args.output.path];
    paths.extend(args.irradiance.as_ref().map(|file| &file.path));
    paths.extend(&args.sh);
    for (k, path) in paths.iter().enumerate() {
        check_place(path)?;
        if paths[..k].contains(path) {
            return Err(Failure::usage("two results cannot be one file").at(path).try_to("a name for each"));
        }
    }
    if let Some(file) = args.irradiance.as_ref().filter(|file| file.format == CubeFormat::Hdre) {
        return Err(Failure::usage("irradiance cannot be an .hdre file")
            .at(&file.path)
            .because("the format has six levels, and irradiance is one")
            .try_to("a .ktx2, .exr or .png file"));
    }
    Ok(())
}

/// The levels of an HDRE file when an HDRE file is wanted and nothing asks for others.
fn hdre_to_hdre<'a>(args: &BakeArgs, loaded: &'a LoadedEnvironment) -> Option<&'a StoredLevels> {
    let Source::Levels(stored) = &loaded.source else { return None };
    let same_size = args.size.is_none_or(|size| size as usize == stored.levels[0].size);
    let six = args.levels.is_none_or(|levels| levels as usize == HDRE_LEVELS) && args.roughness.is_none();
    let plain = matches!(stored.lobe, StoredLobe::Hdre { version } if version <= 2.0);
    (args.output.format == CubeFormat::Hdre && plain && same_size && six).then_some(stored)
}

/// What is baked, and how the levels of the file come from it.
struct Plan {
    options: BakeOptions,
    /// Texels along an edge of each level of the file.
    faces: Vec<usize>,
    /// Levels of the bake before the file's first.
    skipped: usize,
}

impl Plan {
    fn new(args: &BakeArgs, loaded: &LoadedEnvironment) -> Result<Plan, Failure> {
        let stored = ggx_roughness(loaded).filter(|roughness| roughness.len() > 1);
        let stored_size = match &loaded.source {
            Source::Levels(stored) => Some(stored.levels[0].size),
            Source::Equirect(_) => None,
        };
        let size = args.size.map(|size| size as usize).or(stored_size).unwrap_or(DEFAULT_SIZE).min(MAX_SIZE);
        let irradiance_size = args.irradiance.as_ref().map_or(1, |_| args.quality.irradiance_size());
        let plain = BakeOptions { size, irradiance_size, quality: args.quality, ..BakeOptions::default() };
        if args.output.format == CubeFormat::Hdre {
            return Plan::hdre(args, plain);
        }
        let most = size.ilog2() as usize + 1;
        let asked = match (&args.roughness, args.levels, stored) {
            (Some(Roughness(list)), ..) => Some(list.clone()),
            // The file's own, when nothing else is asked for; with slopes they are those of a plain bake.
            (None, None, Some(_)) if has_slopes(loaded) => None,
            (None, None, Some(stored)) if stored.len() <= most => Some(stored.to_vec()),
            (None, ..) => None,
        };
        let count = asked.as_ref().map_or(args.levels.unwrap_or(1) as usize, Vec::len);
        if count > most {
            return Err(Failure::usage(format!("{count} levels are more than faces of {size} texels have"))
                .because(format!("each level has half of the texels along an edge, so that there are {most} at most"))
                .try_to("fewer levels, or a larger --size"));
        }
        let faces = (0..most).map(|level| size >> level).collect();
        let Some(mut list) = asked else {
            let own = stored.filter(|_| has_slopes(loaded)).map(|stored| stored.len().min(most));
            let options = BakeOptions { levels: args.levels.map(|levels| levels as usize).or(own), ..plain };
            return Ok(Plan { options, faces, skipped: 0 });
        };
        // The first level of a bake is the environment itself: one that is not comes second, of a cube twice as large.
        let skipped = usize::from(list[0] > 0.0);
        if skipped == 1 {
            list.insert(0, 0.0);
        }
        let options = BakeOptions { size: size << skipped, level_map: LevelMap::Listed(list), ..plain };
        Ok(Plan { options, faces, skipped })
    }

    /// Six levels for the roughness at which its readers look each up, made larger where the format's smallest are.
    fn hdre(args: &BakeArgs, plain: BakeOptions) -> Result<Plan, Failure> {
        let wrong = |what: String| {
            Err(Failure::usage(what)
                .at(&args.output.path)
                .because("an HDRE file always has six levels")
                .try_to("--roughness with six values, or a .ktx2 file"))
        };
        let list = match &args.roughness {
            Some(Roughness(list)) => list.clone(),
            None => (0..HDRE_LEVELS).map(|level| level as f32 / (HDRE_LEVELS - 1) as f32).collect(),
        };
        let count = args.levels.map_or(list.len(), |levels| levels as usize);
        if count != HDRE_LEVELS {
            return wrong(format!("{count} levels cannot be an .hdre file"));
        }
        if list[0] > 0.0 {
            return wrong("level 0 of an .hdre file is the environment itself, of roughness 0".to_owned());
        }
        let size = plain.size;
        if size < hdre_face(size, 0) {
            return wrong(format!("faces of {size} texels are smaller than the 8 that the format begins with"));
        }
        let faces = (0..HDRE_LEVELS).map(|level| hdre_face(size, level)).collect();
        let options =
            BakeOptions { size: size.max(8 << (HDRE_LEVELS - 1)), level_map: LevelMap::Listed(list), ..plain };
        Ok(Plan { options, faces, skipped: 0 })
    }

    /// The levels of the file and the roughness of each.
    fn levels<'a>(&self, baked: &'a BakedEnvironment) -> (Vec<Cube>, &'a [f32]) {
        let levels = baked.radiance[self.skipped..].iter().zip(&self.faces).map(|(level, &size)| level.resized(size));
        (levels.collect(), &baked.roughness[self.skipped..])
    }
}

/// Whether the environment is levels with slopes between them.
fn has_slopes(loaded: &LoadedEnvironment) -> bool {
    matches!(&loaded.source, Source::Levels(stored) if !stored.slope.is_empty())
}

fn coded(
    format: CubeFormat,
    cube: CubeLevels<'_>,
    texels: TexelFormat,
    baked: &BakedEnvironment,
) -> Result<Vec<u8>, SaveError> {
    match format {
        CubeFormat::Ktx2 => save::ktx2(cube, texels),
        CubeFormat::Hdre => save::hdre(cube.levels, Some(&baked.irradiance_sh)),
        CubeFormat::Exr => save::exr(cube),
        CubeFormat::Png => png_strip(cube),
    }
}

/// The strip of an .exr file as a viewer shows it: the default tone map, sRGB.
fn png_strip(cube: CubeLevels<'_>) -> Result<Vec<u8>, SaveError> {
    let (width, height, texels) = save::strip(cube.levels);
    let pixels = texels.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect();
    let picture = Picture { width: width as u32, height: height as u32, pixels };
    let display = Display::ToneMapped { exposure: 1.0, tone_map: ToneMap::default() };
    png(&picture, display).map_err(|error| SaveError::Encoder(error.to_string()))
}

fn parse_environment(text: &str) -> Result<EnvironmentSource, String> {
    Ok(EnvironmentSource::parse(text, std::path::Path::new("")))
}

fn parse_cube_file(text: &str) -> Result<CubeFile, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    let format = match extension.as_deref() {
        Some("ktx2") => CubeFormat::Ktx2,
        Some("hdre") => CubeFormat::Hdre,
        Some("exr") => CubeFormat::Exr,
        Some("png") => CubeFormat::Png,
        _ => return Err("the file name must end in .ktx2, .hdre, .exr or .png".to_owned()),
    };
    Ok(CubeFile { path, format })
}

fn parse_roughness(text: &str) -> Result<Roughness, String> {
    let list = numbers(text)?;
    let rising = list.windows(2).all(|pair| pair[0] < pair[1]);
    if list.is_empty() || list.len() > 14 || !rising || !list.iter().all(|r| (0.0..=1.0).contains(r)) {
        return Err("write 1 to 14 numbers that rise within 0 to 1, such as 0,0.25,0.5,1".to_owned());
    }
    Ok(Roughness(list))
}

fn parse_quality(text: &str) -> Result<Quality, String> {
    match text {
        "preview" => Ok(Quality::Preview),
        "default" => Ok(Quality::Default),
        "best" => Ok(Quality::Best),
        _ => Err("the qualities are preview, default and best".to_owned()),
    }
}

fn parse_texels(text: &str) -> Result<TexelFormat, String> {
    match text {
        "rgba16f" => Ok(TexelFormat::Rgba16F),
        "rgba32f" => Ok(TexelFormat::Rgba32F),
        "rgb9e5" => Ok(TexelFormat::Rgb9E5),
        _ => Err("the formats of texels are rgba16f, rgba32f and rgb9e5".to_owned()),
    }
}

fn parse_backend(text: &str) -> Result<Backend, String> {
    match text {
        "auto" => Ok(Backend::Auto),
        "cpu" => Ok(Backend::Cpu),
        "gpu" => Ok(Backend::Gpu),
        _ => Err("the backends are auto, cpu and gpu".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roughness_rises_within_its_range() {
        assert_eq!(parse_roughness("0,0.5,1"), Ok(Roughness(vec![0.0, 0.5, 1.0])));
        assert_eq!(parse_roughness("0.4"), Ok(Roughness(vec![0.4])));
        for wrong in ["", "0,0", "1,0", "-0.1,1", "0,2", "0,nan", "a", "0,.1,.15,.2,.3,.35,.4,.45,.5,.6,.65,.7,.8,.9,1"]
        {
            assert!(parse_roughness(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn formats_are_told_by_the_extension() {
        assert_eq!(parse_cube_file("a.b/c.KTX2").map(|file| file.format), Ok(CubeFormat::Ktx2));
        assert!(parse_cube_file("a.jpg").is_err() && parse_cube_file("ktx2").is_err());
    }
}
