//! The same bake with the filtering done elsewhere, such as on a GPU: which levels there are and how they are read is
//! decided here, the convolutions come from a function.

use super::*;

/// A lobe to filter a map with, and what is wanted of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterJob {
    /// Square of the perceptual roughness of the GGX lobe with n = v = r, above 0; 1 is the cosine lobe.
    pub alpha: f64,
    /// Texels along an edge of the cube.
    pub size: usize,
}

/// A filtered map, and for each texel how ln(red + green + blue) changes with ln(alpha^2).
pub type Filtered = (Cube, Vec<f32>);

/// [`bake`](super::bake) with levels and irradiance filtered by `filter`, in the order of its jobs. Level 0 and the
/// harmonics are made here. Levels that the file has already are used as they are, and lobes other than GGX are filtered
/// here as well.
///
/// # Errors
/// Those of `filter`.
pub fn bake_filtered_by<E>(
    environment: &LoadedEnvironment,
    options: &BakeOptions,
    filter: impl FnOnce(&Equirect, &[FilterJob]) -> Result<Vec<Filtered>, E>,
) -> Result<BakedEnvironment, E> {
    let size = options.size.clamp(1, MAX_SIZE);
    let roughness = level_roughness(options, size);
    let source = decoded(environment, options.decode_report);
    let (map, level_0) = match &*source {
        Source::Equirect(map) => (Cow::Borrowed(map), cube_from_equirect(map, size)),
        Source::Levels(stored) if serves(stored, options, &roughness, size) => return Ok(bake(environment, options)),
        Source::Levels(stored) => (Cow::Owned(equirect_from_cube(&stored.levels[0])), stored.levels[0].resized(size)),
    };
    if options.prefilter != Prefilter::Ggx {
        return Ok(bake(environment, options));
    }

    let face = |level: usize| (size >> level).max(1);
    let alphas: Vec<f64> = roughness.iter().map(|&r| f64::from(r) * f64::from(r)).collect();
    let is_mirror = |level: usize| alphas[level] <= 0.0;
    let mut jobs: Vec<FilterJob> = (0..alphas.len())
        .filter(|&level| !is_mirror(level))
        .map(|level| FilterJob { alpha: alphas[level], size: face(level) })
        .collect();
    jobs.push(FilterJob { alpha: 1.0, size: options.irradiance_size.clamp(1, 512) });
    let mut filtered = filter(&map, &jobs)?.into_iter();

    let radiance_sh = radiance_coefficients(&Spectrum::low(&map));
    let mut baked = BakedEnvironment {
        radiance: Vec::new(),
        slope: Vec::new(),
        irradiance_over_pi: Cube { size: 1, texels: vec![[0.0; 3]; 6] },
        irradiance_sh: irradiance_coefficients(&radiance_sh),
        radiance_sh: radiance_sh.map(|c| c.map(|x| x as f32)),
        roughness,
    };
    // alpha^2 is the roughness to the power 4, and log2 of that rises by as much from each level to the next.
    let per_level = 4.0 * (1.0 / FIRST_ROUGHNESS).log2() / (alphas.len().max(3) - 2) as f64;
    for level in 0..alphas.len() {
        let mirror = || {
            let cube = level_0.resized(face(level));
            let flat = vec![0.0; cube.texels.len()];
            (cube, flat)
        };
        let (cube, change) = if is_mirror(level) { mirror() } else { filtered.next().unwrap_or_else(mirror) };
        if options.level_map == LevelMap::Geometric {
            let slope = |change: f32| ((f64::from(change) * per_level) as f32).clamp(-STEEPEST, STEEPEST);
            baked.slope.push(change.into_iter().map(slope).collect());
        }
        baked.radiance.push(cube);
    }
    if let Some((cube, _)) = filtered.next() {
        baked.irradiance_over_pi = cube;
    }
    Ok(baked)
}
