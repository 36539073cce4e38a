//! The environment of a scene, loaded and baked as its methods ask.

use halfvector_ibl::{BakeOptions, BakedEnvironment, Layout, LoadedEnvironment, Source, bake_with_progress};
use halfvector_scene::{EnvironmentSource, Scene, bake_options, ggx_roughness};

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
    let options = bake_options(&scene.environment, &scene.methods, loaded);
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
