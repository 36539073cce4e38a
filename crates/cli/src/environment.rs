//! The environment of a scene, loaded and baked as its methods ask.

use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Layout, LevelMap, LoadedEnvironment, Prefilter, Source, StoredLobe,
    bake_with_progress,
};
use halfvector_scene::{EnvironmentSource, Scene};

use crate::failure::Failure;
use crate::output::{note, progress};

/// Reads an environment and tells what its owner may not expect of it; `None` when there is none.
pub(crate) fn load(source: &EnvironmentSource) -> Result<Option<LoadedEnvironment>, Failure> {
    let loaded = source.load().map_err(|error| {
        Failure::input("the environment could not be read").because(error).try_to(
            "a .hdr, .exr, .hdre, .ktx2, .png or .jpg file, six faces as a folder or as NAME_%s.EXT, or one of white, \
             studio, sky, none",
        )
    })?;
    if let (Some(loaded), EnvironmentSource::File(path)) = (&loaded, source) {
        let file = path.display();
        if !matches!(loaded.layout, Layout::Equirect | Layout::Faces) {
            note(format_args!("note: {file}: taken as {}", loaded.layout));
        }
        for text in &loaded.notes {
            note(format_args!("note: {file}: {text}"));
        }
        if !loaded.repairs.is_none() {
            note(format_args!("note: {file}: {}", loaded.repairs));
        }
    }
    Ok(loaded)
}

/// Bakes an environment for the scene.
pub(crate) fn bake(scene: &Scene, loaded: &LoadedEnvironment) -> BakedEnvironment {
    let options = bake_options(scene, loaded);
    let baked = bake_with_bar(loaded, &options);
    if let Some(stored) = ggx_roughness(loaded)
        && stored.len() > 1
        && stored != baked.roughness
        && let Source::Levels(levels) = &loaded.source
        && !levels.are_ggx_for(&baked.roughness)
    {
        note(
            "note: the environment's levels are for other roughness than the shader reads; its level 0 is filtered anew",
        );
    }
    baked
}

/// Bakes with a progress bar.
pub(crate) fn bake_with_bar(loaded: &LoadedEnvironment, options: &BakeOptions) -> BakedEnvironment {
    let bar = progress("prefiltering the environment");
    let baked = bake_with_progress(loaded, options, &mut |done| bar.set_position((done * 1000.0) as u64));
    bar.finish_and_clear();
    baked
}

/// The roughness of each level of an environment whose levels are GGX already.
pub(crate) fn ggx_roughness(loaded: &LoadedEnvironment) -> Option<&[f32]> {
    match &loaded.source {
        Source::Levels(stored) => match &stored.lobe {
            StoredLobe::Ggx(roughness) => Some(roughness),
            StoredLobe::Unknown | StoredLobe::Hdre { .. } => None,
        },
        Source::Equirect(_) => None,
    }
}

fn bake_options(scene: &Scene, loaded: &LoadedEnvironment) -> BakeOptions {
    let level_map = match scene.methods.get("level_map").name {
        "report" => LevelMap::Report,
        "linear" => LevelMap::Linear,
        _ => LevelMap::Geometric,
    };
    let prefilter = if scene.methods.is("prefilter", "hdre") { Prefilter::Hdre } else { Prefilter::Ggx };
    let decode_report = scene.methods.is("env_decode", "report");
    let mut options = BakeOptions { level_map, prefilter, decode_report, ..BakeOptions::default() };
    if scene.environment == EnvironmentSource::White {
        // The same from everywhere: a few texels say it.
        (options.size, options.irradiance_size) = (64, 1);
    }
    if let (Source::Levels(stored), Some(roughness)) = (&loaded.source, ggx_roughness(loaded))
        && roughness.len() > 1
    {
        // As many levels of that size are likely to be just those that the shader reads.
        (options.size, options.levels) = (stored.levels[0].size, Some(roughness.len()));
    }
    options
}
