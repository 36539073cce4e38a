//! The environment of a scene, loaded and baked as its methods ask.

use halfvector_ibl::{BakeOptions, BakedEnvironment, LevelMap, LoadedEnvironment};
use halfvector_scene::{EnvironmentSource, Scene};

use crate::failure::Failure;
use crate::output::progress;

/// Reads the scene's environment; `None` when it has none.
pub(crate) fn load(scene: &Scene) -> Result<Option<LoadedEnvironment>, Failure> {
    scene.environment.load().map_err(|error| {
        Failure::input("the environment could not be read")
            .because(error)
            .try_to("a .hdr, .exr or .hdre file, or one of white, studio, sky, none")
    })
}

/// Bakes an environment for the scene.
pub(crate) fn bake(scene: &Scene, loaded: &LoadedEnvironment) -> BakedEnvironment {
    let bar = progress("prefiltering the environment");
    let baked = halfvector_ibl::bake(loaded, &bake_options(scene));
    bar.finish_and_clear();
    baked
}

fn bake_options(scene: &Scene) -> BakeOptions {
    let level_map = if scene.methods.is("level_map", "report") { LevelMap::Report } else { LevelMap::Linear };
    let decode_report = scene.methods.is("env_decode", "report");
    let plain = BakeOptions { level_map, decode_report, ..BakeOptions::default() };
    match scene.environment {
        // The same from everywhere: a few texels say it.
        EnvironmentSource::White => BakeOptions { size: 64, irradiance_size: 1, ..plain },
        _ => plain,
    }
}
