//! From a loaded environment to what a shader reads: prefiltered levels, irradiance, harmonics.

use crate::cube::Cube;
use crate::equirect::Equirect;
use crate::harmonics::{MAX_BAND, Spectrum};
use crate::kernel::{cosine_kernel, ggx_band, ggx_grid_rows, ggx_kernel};
use crate::load::{LoadedEnvironment, Source, StoredLevels, StoredLobe};
use crate::lobe::narrow_lobe;
use crate::resample::{cube_from_equirect, equirect_from_cube};
use halfvector_brdf::ggx::alpha_from_perceptual_roughness;
use std::borrow::Cow;

/// The largest face of level 0.
pub const MAX_SIZE: usize = 8192;

/// Texels along an edge of the irradiance cube by default: linear interpolation between them is within 0.1 %.
const IRRADIANCE_SIZE: usize = 64;

/// The smallest face that the default number of levels ends with.
const SMALLEST_FACE: usize = 8;

/// Which roughness each level is prefiltered for.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LevelMap {
    /// Level i of n: perceptual roughness i / (n - 1); read with `lod_linear`.
    #[default]
    Linear,
    /// The report's six levels at roughness i / 5, read with `lod_report`. A file that stores six levels is used as it is.
    Report,
    /// The perceptual roughness of each level, 0..1. The first level is the environment itself, whatever its number.
    Listed(Vec<f32>),
}

/// How exact a bake is, and how long it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// To look at while choosing: from roughness 0.2 up within 3 % rms, several times as fast.
    Preview,
    /// Within 0.2 % rms from roughness 0.2 up.
    #[default]
    Default,
    /// As far as the harmonic series goes: ten times as exact again where lobes are narrow.
    Best,
}

/// How to bake.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeOptions {
    /// Texels along an edge of level 0, held in 1..=[`MAX_SIZE`]; each further level has half as many, at least 1.
    pub size: usize,
    /// Number of levels of [`LevelMap::Linear`], held in 1..=14. `None`: as many as leave 8 texels in the last.
    pub levels: Option<usize>,
    /// Which roughness each level is prefiltered for.
    pub level_map: LevelMap,
    /// The report's decoding: L / (1 + L) on radiance of high dynamic range; ordinary images are left as they are.
    pub decode_report: bool,
    /// Texels along an edge of the irradiance cube, held in 1..=512.
    pub irradiance_size: usize,
    /// How exact, and how long it takes.
    pub quality: Quality,
}

impl Default for BakeOptions {
    fn default() -> Self {
        BakeOptions {
            size: 512,
            levels: None,
            level_map: LevelMap::Linear,
            decode_report: false,
            irradiance_size: IRRADIANCE_SIZE,
            quality: Quality::Default,
        }
    }
}

/// An environment ready to be looked up.
#[derive(Clone, Debug, PartialEq)]
pub struct BakedEnvironment {
    /// Prefiltered radiance, level by level; level i has faces of `size >> i` texels, at least 1.
    pub radiance: Vec<Cube>,
    /// The perceptual roughness that each level is prefiltered for.
    pub roughness: Vec<f32>,
    /// Diffuse irradiance over pi: the radiance that a white Lambert surface facing each direction sends out.
    pub irradiance_over_pi: Cube,
    /// The same as nine coefficients of [`irradiance_sh2`](crate::environment::irradiance_sh2), constants folded in.
    pub irradiance_sh: [[f32; 3]; 9],
}

/// Bakes an environment.
///
/// Level 0 is the environment resampled, and the others are exact GGX convolutions of the map taken as constant within
/// each texel (n = v = r), to about 1e-3, through spherical harmonics. The time does not depend on what the picture shows.
pub fn bake(environment: &LoadedEnvironment, options: &BakeOptions) -> BakedEnvironment {
    bake_with_progress(environment, options, &mut |_| ())
}

/// [`bake`], which calls `progress` on this thread with the share of the work that is done, rising from 0 to 1.
pub fn bake_with_progress(
    environment: &LoadedEnvironment,
    options: &BakeOptions,
    progress: &mut dyn FnMut(f32),
) -> BakedEnvironment {
    progress(0.0);
    let size = options.size.clamp(1, MAX_SIZE);
    let source = decoded(environment, options.decode_report);
    let roughness = level_roughness(options, size);
    let face = |level: usize| (size >> level).max(1);

    let stored = match &*source {
        Source::Levels(stored) if serves(stored, options, &roughness, size) => Some(stored),
        _ => None,
    };
    let (map, level_0) = match &*source {
        Source::Equirect(map) => (Cow::Borrowed(map), cube_from_equirect(map, size)),
        Source::Levels(stored) => (Cow::Owned(equirect_from_cube(&stored.levels[0])), stored.levels[0].resized(size)),
    };

    let alphas: Vec<f64> = roughness.iter().map(|&r| alpha_from_perceptual_roughness(f64::from(r))).collect();
    // As many degrees as the narrowest lobe needs that is to be computed.
    let needed = if stored.is_some() { &[] } else { &alphas[1..] };
    let narrowest = needed.iter().copied().filter(|&alpha| alpha > 0.0).fold(1.0, f64::min);
    let series_end = options.quality.series_end();
    let spectrum = Spectrum::from_equirect(&map, ggx_band(narrowest, series_end).min(MAX_BAND));
    // The analysis is about half of the work, each level and the irradiance an equal part of the rest.
    let share_done = |level: usize| 0.5 + 0.5 * level as f32 / (alphas.len() + 1) as f32;
    progress(share_done(0));

    let radiance = match stored {
        Some(stored) => stored.levels.iter().enumerate().map(|(i, level)| level.resized(face(i))).collect(),
        None => {
            let mut levels = vec![level_0];
            for (i, &alpha) in alphas.iter().enumerate().skip(1) {
                progress(share_done(i));
                levels.push(prefiltered(&spectrum, &levels[0], alpha, face(i), series_end));
            }
            levels
        }
    };
    progress(share_done(alphas.len()));
    let irradiance = spectrum.synthesized(&cosine_kernel(ggx_band(1.0, series_end)), ggx_grid_rows(1.0));
    let baked = BakedEnvironment {
        radiance,
        roughness,
        irradiance_over_pi: Cube::from_fn(options.irradiance_size.clamp(1, 512), |dir| irradiance.sample(dir)),
        irradiance_sh: irradiance_coefficients(&spectrum),
    };
    progress(1.0);
    baked
}

impl Quality {
    /// alpha times the degree at which the series of a GGX lobe ends: there k_l is about exp(-2 series_end).
    fn series_end(self) -> f64 {
        match self {
            Quality::Preview => 4.0,
            Quality::Default => 7.0,
            Quality::Best => 10.0,
        }
    }
}

fn prefiltered(spectrum: &Spectrum, level_0: &Cube, alpha: f64, size: usize, series_end: f64) -> Cube {
    // The narrowest lobe whose series ends within the spectrum.
    let resolved = alpha.max(series_end / MAX_BAND as f64);
    let band = ggx_band(resolved, series_end).min(MAX_BAND);
    let grid = || spectrum.synthesized(&ggx_kernel(resolved, band), ggx_grid_rows(resolved));
    if alpha <= 0.0 {
        level_0.resized(size)
    } else if alpha < resolved {
        narrow_lobe(level_0, &grid(), alpha, resolved, size)
    } else {
        let grid = grid();
        Cube::from_fn(size, |dir| grid.sample(dir))
    }
}

/// Whether the levels of a file are what is asked for, so that they are taken as they are.
fn serves(stored: &StoredLevels, options: &BakeOptions, roughness: &[f32], size: usize) -> bool {
    let report = options.level_map == LevelMap::Report && matches!(stored.lobe, StoredLobe::Hdre { .. });
    report || stored.levels[0].size == size && stored.are_ggx_for(roughness)
}

/// The roughness of each level.
fn level_roughness(options: &BakeOptions, size: usize) -> Vec<f32> {
    let even = |levels: usize| (0..levels).map(|i| i as f32 / (levels.max(2) - 1) as f32).collect();
    match &options.level_map {
        LevelMap::Linear => {
            let halvings = (size / SMALLEST_FACE).max(1).ilog2() as usize;
            even(options.levels.unwrap_or(halvings + 1).clamp(1, 14))
        }
        LevelMap::Report => even(6),
        LevelMap::Listed(list) if list.is_empty() => vec![0.0],
        LevelMap::Listed(list) => list.iter().take(14).map(|r| if *r > 0.0 { r.min(1.0) } else { 0.0 }).collect(),
    }
}

/// The source as the report decodes it, or as it is.
fn decoded(environment: &LoadedEnvironment, report: bool) -> Cow<'_, Source> {
    if !report || environment.low_dynamic_range {
        return Cow::Borrowed(&environment.source);
    }
    let compress = |texels: &mut Vec<[f32; 3]>| {
        for x in texels.iter_mut().flatten() {
            *x /= 1.0 + *x;
        }
    };
    let mut source = environment.source.clone();
    match &mut source {
        Source::Equirect(map) => compress(&mut map.pixels),
        Source::Levels(stored) => stored.levels.iter_mut().for_each(|level| compress(&mut level.texels)),
    }
    Cow::Owned(source)
}

/// Degree 0 to 2, from polar angles about +Y to the polynomials of `irradiance_sh2`.
///
/// With c_lm = integral of L P_lm exp(-i m phi), phi from +X towards +Z, the real harmonics are
/// re c_l0 P_l0 + 2 re c_lm P_lm cos(m phi) - 2 im c_lm P_lm sin(m phi), and
/// 3y^2 - 1 = -(3z^2 - 1) / 2 - 3 (x^2 - y^2) / 2, x^2 - z^2 = -(3z^2 - 1) / 2 + (x^2 - y^2) / 2 on the unit sphere.
fn irradiance_coefficients(spectrum: &Spectrum) -> [[f32; 3]; 9] {
    use std::f64::consts::PI;
    // P_00, P_10 / y, P_11 / sin, P_20 / (3y^2 - 1), P_21 / (y sin), P_22 / sin^2.
    let [n00, n10, n11] = [1.0, 3.0, 1.5].map(|x: f64| (x / (4.0 * PI)).sqrt());
    let [n20, n21, n22] = [1.25, 7.5, 1.875].map(|x: f64| (x / (4.0 * PI)).sqrt());
    let [a1, a2] = [2.0 / 3.0, 0.25];
    let of_channel = |channel: usize| {
        let c = |l: usize, m: usize| spectrum.coefficient(l, m)[channel];
        let about_y = a2 * n20 * c(2, 0)[0];
        let x2_z2 = 2.0 * a2 * n22 * c(2, 2)[0];
        [
            n00 * c(0, 0)[0],
            a1 * n10 * c(1, 0)[0],
            -2.0 * a1 * n11 * c(1, 1)[1],
            2.0 * a1 * n11 * c(1, 1)[0],
            2.0 * a2 * n21 * c(2, 1)[0],
            -2.0 * a2 * n21 * c(2, 1)[1],
            -0.5 * about_y - 0.5 * x2_z2,
            // sin^2 sin(2 phi) = 2 x z.
            -4.0 * a2 * n22 * c(2, 2)[1],
            -1.5 * about_y + 0.5 * x2_z2,
        ]
    };
    let [r, g, b] = [0, 1, 2].map(of_channel);
    std::array::from_fn(|k| [r[k] as f32, g[k] as f32, b[k] as f32])
}

impl BakedEnvironment {
    /// [`Self::irradiance_sh`] as a shader's uniform holds it: four numbers each, the fourth 0.
    pub fn irradiance_sh_padded(&self) -> [[f32; 4]; 9] {
        self.irradiance_sh.map(|[r, g, b]| [r, g, b, 0.0])
    }
}

impl From<Equirect> for LoadedEnvironment {
    /// An environment that was computed rather than read: repaired like one that was read.
    fn from(map: Equirect) -> Self {
        LoadedEnvironment::new(Source::Equirect(map), false)
    }
}
