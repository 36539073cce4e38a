//! How the environment of a scene is baked: what its methods ask for. The baking is `halfvector_ibl`'s.

use halfvector_graph::method::Methods;
use halfvector_ibl::{BakeOptions, LevelMap, LoadedEnvironment, Prefilter, Source, StoredLobe};

use crate::environment::EnvironmentSource;

/// The bake that shaders of these methods read.
pub fn bake_options(source: &EnvironmentSource, methods: &Methods, loaded: &LoadedEnvironment) -> BakeOptions {
    let level_map = match methods.get("level_map").name {
        "report" => LevelMap::Report,
        "linear" => LevelMap::Linear,
        _ => LevelMap::Geometric,
    };
    let prefilter = if methods.is("prefilter", "hdre") { Prefilter::Hdre } else { Prefilter::Ggx };
    let decode_report = methods.is("env_decode", "report");
    let mut options = BakeOptions { level_map, prefilter, decode_report, ..BakeOptions::default() };
    if *source == EnvironmentSource::White {
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

/// The roughness of each level of an environment whose levels are GGX already.
pub fn ggx_roughness(loaded: &LoadedEnvironment) -> Option<&[f32]> {
    match &loaded.source {
        Source::Levels(stored) => match &stored.lobe {
            StoredLobe::Ggx(roughness) => Some(roughness),
            StoredLobe::Unknown | StoredLobe::Hdre { .. } => None,
        },
        Source::Equirect(_) => None,
    }
}
