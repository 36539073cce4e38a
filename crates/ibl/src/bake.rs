//! From a loaded environment to what a shader reads: prefiltered levels, irradiance, harmonics.

mod filtered;

pub use filtered::{FilterJob, Filtered, bake_filtered_by};

use crate::cube::{Cube, equirect_from_six_faces, texels_of_six};
use crate::equirect::Equirect;
use crate::harmonics::{Grid, MAX_BAND, MAX_ROWS, Spectrum};
use crate::kernel::Lobe;
use crate::load::{LoadedEnvironment, Source, StoredLevels, StoredLobe};
use crate::lobe::narrow_lobe;
use crate::resample::{cube_from_equirect, equirect_from_cube};
use crate::sh::{RADIANCE_SH, about_z, cosine_factor, harmonic_constants};
use std::borrow::Cow;
use std::convert::Infallible;
use std::f64::consts::{LN_2, SQRT_2};

/// The largest face of level 0.
pub const MAX_SIZE: usize = 8192;

/// The smallest face that the default number of levels ends with: at roughness 1 the light has a kink where a lamp sets,
/// and with fewer texels the linear mix between them is too dark or too bright there by a tenth.
const SMALLEST_FACE: usize = 16;

/// The fewest levels by default.
const FEWEST_LEVELS: usize = 5;

/// Perceptual roughness of level 1 of [`LevelMap::Geometric`].
const FIRST_ROUGHNESS: f64 = 0.1;

/// Which roughness each level is prefiltered for.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LevelMap {
    /// Level 0 is the environment, level 1 is prefiltered for perceptual roughness 0.1, the last for 1, and each between
    /// them for the same multiple of the one before; slopes for [`mix_levels`](crate::environment::mix_levels) are baked
    /// too. Read with `lod_geometric` and `environment_sample_hermite`.
    #[default]
    Geometric,
    /// Level i of n: perceptual roughness i / (n - 1); read with `lod_linear`.
    Linear,
    /// The report's six levels at roughness i / 5, read with `lod_report`. A file that stores six levels is used as it is.
    Report,
    /// The perceptual roughness of each level, 0..1. The first level is the environment itself, whatever its number.
    Listed(Vec<f32>),
}

/// The lobe that levels are filtered with, always with n = v = r.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Prefilter {
    /// Karis 2013, "Real Shading in Unreal Engine 4": D_GGX(h) n.l.
    #[default]
    Ggx,
    /// The sheen lobe, D_Charlie(h) n.l (Estevez and Kulla 2017), which sees a ring near the horizon. Level 0 is filtered
    /// too, and below perceptual roughness 0.1 the lobe stays as it is there.
    Charlie,
    /// What the writers of HDRE files use: n.l to the power 8 (1 - r) f / 2^(5 r), where f is the face size of level 0 and r
    /// the perceptual roughness, at most 0.98; level i of [`LevelMap::Report`] has r = (i + 1) / 6, though it is read as
    /// i / 5. Their sum over every fourth texel without solid angles is an integral here.
    Hdre,
}

/// How exact a bake is, and how long it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// To look at while choosing: from roughness 0.1 up within 1 % rms, three times as fast. Level 0 and the harmonics are
    /// as exact as at any quality.
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
    /// Number of levels of [`LevelMap::Geometric`] and [`LevelMap::Linear`], held in 1..=14. `None`: as many as leave 16
    /// texels in the last, but at least five where there are so many.
    pub levels: Option<usize>,
    /// Which roughness each level is prefiltered for.
    pub level_map: LevelMap,
    /// The report's decoding: L / (1 + L) on radiance of high dynamic range; ordinary images are left as they are.
    pub decode_report: bool,
    /// Texels along an edge of the irradiance cube, held in 1..=512; see [`Quality::irradiance_size`].
    pub irradiance_size: usize,
    /// How exact, and how long it takes.
    pub quality: Quality,
    /// The lobe of the levels. Stored levels are used as they are, whatever it says.
    pub prefilter: Prefilter,
}

impl Default for BakeOptions {
    fn default() -> Self {
        BakeOptions {
            size: 512,
            levels: None,
            level_map: LevelMap::Geometric,
            decode_report: false,
            irradiance_size: Quality::Default.irradiance_size(),
            quality: Quality::Default,
            prefilter: Prefilter::Ggx,
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
    /// For each level and texel, what [`mix_levels`](crate::environment::mix_levels) wants in the fourth channel: the
    /// change of log2(red + green + blue) from level to level, as a derivative. Empty but for [`LevelMap::Geometric`].
    pub slope: Vec<Vec<f32>>,
    /// Diffuse irradiance over pi: the radiance that a white Lambert surface facing each direction sends out.
    pub irradiance_over_pi: Cube,
    /// The light's own coefficients of [`real_harmonics`](crate::sh::real_harmonics), degrees 0 to 3.
    pub radiance_sh: [[f32; 3]; RADIANCE_SH],
    /// Irradiance as nine coefficients of [`irradiance_sh2`](crate::environment::irradiance_sh2), constants folded in.
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
    let mut go_on = |done| {
        progress(done);
        Ok::<(), Infallible>(())
    };
    let Ok(baked) = bake_or_stop(environment, options, &mut go_on);
    baked
}

/// [`bake`], which asks `go_on` on this thread between its steps whether to, with the share of the work that is done, rising
/// from 0 to 1; none when it said no. The first step, the analysis of the map, is half of the work.
pub fn bake_while(
    environment: &LoadedEnvironment,
    options: &BakeOptions,
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Option<BakedEnvironment> {
    let mut go_on = |done| if go_on(done) { Ok(()) } else { Err(()) };
    bake_or_stop(environment, options, &mut go_on).ok()
}

/// Bakes, and stops with the error that `progress` gives.
fn bake_or_stop<E>(
    environment: &LoadedEnvironment,
    options: &BakeOptions,
    progress: &mut dyn FnMut(f32) -> Result<(), E>,
) -> Result<BakedEnvironment, E> {
    progress(0.0)?;
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

    let series_end = options.quality.series_end();
    let lobes: Vec<Option<Lobe>> =
        (0..roughness.len()).map(|level| options.lobe(level, f64::from(roughness[level]), size)).collect();
    // As many degrees as the narrowest lobe needs that is to be computed.
    let needed = if stored.is_some() { &[] } else { &lobes[..] };
    let band = needed.iter().flatten().map(|lobe| lobe.band(series_end)).max().unwrap_or(0);
    let band = band.max(options.quality.diffuse_band()).min(MAX_BAND);
    let spectrum = Spectrum::from_equirect(&map, band, options.quality.map_rows(), options.quality.more_nodes());
    // The analysis is about half of the work, each level and the irradiance an equal part of the rest.
    let share_done = |level: usize| 0.5 + 0.5 * level as f32 / (roughness.len() + 1) as f32;
    progress(share_done(0))?;

    let geometric = options.level_map == LevelMap::Geometric;
    let mut slope = Vec::new();
    let radiance = match stored {
        Some(stored) if geometric => {
            slope = stored.slope.clone();
            stored.levels.clone()
        }
        Some(stored) => stored.levels.iter().enumerate().map(|(i, level)| level.resized(face(i))).collect(),
        None => {
            let mut levels = Vec::new();
            for (i, &lobe) in lobes.iter().enumerate() {
                progress(share_done(i))?;
                let level = Level { lobe, size: face(i), quality: options.quality };
                if geometric {
                    // log2 of the roughness rises by as much from each level to the next.
                    let per_level = (1.0 / FIRST_ROUGHNESS).log2() / (lobes.len().max(3) - 2) as f64;
                    let at = |steps: f64| options.lobe(i, f64::from(roughness[i]) * (per_level * steps).exp2(), size);
                    let (cube, slopes) = level.with_slopes(&spectrum, &level_0, at);
                    levels.push(cube);
                    slope.push(slopes);
                } else {
                    levels.push(level.prefiltered(&spectrum, &level_0));
                }
            }
            levels
        }
    };
    progress(share_done(roughness.len()))?;
    let diffuse_band = options.quality.diffuse_band();
    let irradiance = spectrum.synthesized(&DIFFUSE.kernel(diffuse_band), diffuse_band);
    let diffuse_size = options.irradiance_size.clamp(1, 512);
    let diffuse = texels_of_grid(&irradiance, diffuse_size).into_iter().map(|[r, g, b, _]| [r, g, b]).collect();
    let radiance_sh = radiance_coefficients(&spectrum);
    let baked = BakedEnvironment {
        radiance,
        roughness,
        slope,
        irradiance_over_pi: Cube { size: diffuse_size, texels: diffuse },
        irradiance_sh: irradiance_coefficients(&radiance_sh),
        radiance_sh: radiance_sh.map(|c| c.map(|x| x as f32)),
    };
    progress(1.0)?;
    Ok(baked)
}

impl Quality {
    /// Texels along an edge of the irradiance cube that goes with this quality: 64 for a preview, 448 else.
    ///
    /// Where a lamp sets, the light has a kink that a linear mix of texels rounds off, most where all else is black. Of four
    /// pictures a night with street lamps needs the most: at the worst of 20,000 directions it is off by 8 % with 64 texels,
    /// 0.9 % with 256, 0.54 % with 384 and 0.28 % with 512; at texel centres by 0.1 % with any (a test prints the table).
    pub fn irradiance_size(self) -> usize {
        if self == Quality::Preview { 64 } else { 448 }
    }

    /// Rows of the map that are analysed at most; larger maps are averaged down, which moves small lamps: with 256 rows for a
    /// map of 512 a preview at roughness 0.1 is off by 5 % rms beside street lamps, with 512 by less than 1 %.
    fn map_rows(self) -> usize {
        if self == Quality::Preview { 512 } else { MAX_ROWS }
    }

    /// See [`Spectrum::from_equirect`].
    fn more_nodes(self) -> usize {
        if self == Quality::Preview { 0 } else { 2 }
    }

    /// The degree at which the series of diffuse light ends. Its numbers fall only like l^(-5/2), for the cosine has a kink at
    /// the horizon: beside a small lamp that sets, 192 degrees are off by 1 % and 512 by 0.1 %.
    fn diffuse_band(self) -> usize {
        if self == Quality::Preview { 128 } else { 512 }
    }

    /// Rows of a grid for a lobe.
    fn grid_rows(self, lobe: Lobe) -> usize {
        if self == Quality::Preview { (lobe.grid_rows() / 2).max(128) } else { lobe.grid_rows() }
    }

    /// alpha times the degree at which the series of a GGX lobe ends: there k_l is about exp(-2 series_end).
    fn series_end(self) -> f64 {
        match self {
            Quality::Preview => 5.0,
            Quality::Default => 7.0,
            Quality::Best => 10.0,
        }
    }
}

/// Largest slope. Beyond what a lamp does between levels as far apart as they may be there is only noise of black places.
pub(crate) const STEEPEST: f32 = 16.0;

/// GGX at roughness 1 is the cosine.
const DIFFUSE: Lobe = Lobe::Ggx(1.0);

impl BakeOptions {
    /// The lobe of a level; `None` for a mirror. A roughness above 1 goes on smoothly.
    fn lobe(&self, level: usize, perceptual_roughness: f64, size: usize) -> Option<Lobe> {
        let alpha = perceptual_roughness * perceptual_roughness;
        match self.prefilter {
            Prefilter::Ggx => (alpha > 0.0).then_some(Lobe::Ggx(alpha)),
            Prefilter::Charlie => Some(Lobe::Charlie(alpha.max(0.01))),
            Prefilter::Hdre if level == 0 => None,
            Prefilter::Hdre => {
                let written = (level + 1) as f64 / 6.0;
                let r = if self.level_map == LevelMap::Report { written } else { perceptual_roughness };
                let r = r.clamp(0.0045, 0.98);
                Some(Lobe::CosinePower(8.0 * (1.0 - r) * size as f64 / (5.0 * r).exp2()))
            }
        }
    }
}

/// A level to be computed.
struct Level {
    lobe: Option<Lobe>,
    size: usize,
    quality: Quality,
}

impl Level {
    /// The level by the harmonic series; narrower GGX lobes than it resolves go on from there around each direction, and a
    /// mirror shows `level_0`.
    fn prefiltered(&self, spectrum: &Spectrum, level_0: &Cube) -> Cube {
        let Some(lobe) = self.lobe else { return level_0.resized(self.size) };
        let narrowest = self.quality.series_end() / MAX_BAND as f64;
        match lobe {
            Lobe::Ggx(alpha) if alpha < narrowest => {
                let wide = self.grid(spectrum, Lobe::Ggx(narrowest));
                narrow_lobe(level_0, &wide, alpha, narrowest, self.size)
            }
            _ => {
                let texels = texels_of_grid(&self.grid(spectrum, lobe), self.size);
                Cube { size: self.size, texels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect() }
            }
        }
    }

    fn grid(&self, spectrum: &Spectrum, lobe: Lobe) -> Grid {
        let band = lobe.band(self.quality.series_end()).min(MAX_BAND);
        spectrum.synthesized(&lobe.kernel(band), self.quality.grid_rows(lobe))
    }

    /// The level, whose lobe the harmonic series resolves, and its slopes; `at` gives the lobe a few levels further. A
    /// mirror's slopes are 0.
    ///
    /// The slope is d log2(L) = dL / (L ln 2), and convolution is linear: dL is the light convolved with the derivative of
    /// the kernel.
    fn with_slopes(&self, spectrum: &Spectrum, level_0: &Cube, at: impl Fn(f64) -> Option<Lobe>) -> (Cube, Vec<f32>) {
        const STEP: f64 = 1e-3;
        let (Some(lobe), Some(before), Some(after)) = (self.lobe, at(-STEP), at(STEP)) else {
            let cube = self.prefiltered(spectrum, level_0);
            let slopes = vec![0.0; cube.texels.len()];
            return (cube, slopes);
        };
        let band = lobe.band(self.quality.series_end()).min(MAX_BAND);
        let [before, kernel, after] = [before, lobe, after].map(|lobe| lobe.kernel(band));
        let derivative: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (b - a) / (2.0 * STEP)).collect();
        let grid = spectrum.synthesized_with_grey(&kernel, &derivative, self.quality.grid_rows(lobe));
        let texels = texels_of_grid(&grid, self.size);
        let slope = |&[r, g, b, change]: &[f32; 4]| {
            let slope = f64::from(change) / (f64::from(r + g + b) * LN_2).max(f64::MIN_POSITIVE);
            (slope as f32).clamp(-STEEPEST, STEEPEST)
        };
        let slopes = texels.iter().map(slope).collect();
        (Cube { size: self.size, texels: texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect() }, slopes)
    }
}

/// A cube of a grid's values: red, green, blue and the grey channel.
fn texels_of_grid(grid: &Grid, size: usize) -> Vec<[f32; 4]> {
    let place = |i: usize| (2.0 * i as f64 + 1.0) / size as f64 - 1.0;
    texels_of_six(size, |i, j| equirect_from_six_faces(place(i), place(j)).map(|at| grid.at(at)))
}

/// Whether the levels of a file are what is asked for, so that they are taken as they are.
fn serves(stored: &StoredLevels, options: &BakeOptions, roughness: &[f32], size: usize) -> bool {
    let report = options.level_map == LevelMap::Report && matches!(stored.lobe, StoredLobe::Hdre { .. });
    let mixed = options.level_map != LevelMap::Geometric || stored.slope.len() == stored.levels.len();
    let ggx = options.prefilter == Prefilter::Ggx && stored.are_ggx_for(roughness);
    report || ggx && mixed && stored.levels[0].size == size
}

/// The roughness of each level.
fn level_roughness(options: &BakeOptions, size: usize) -> Vec<f32> {
    let even = |levels: usize| (0..levels).map(|i| i as f32 / (levels.max(2) - 1) as f32).collect();
    let halvings = (size / SMALLEST_FACE).max(1).ilog2() as usize;
    let default = (halvings + 1).max(FEWEST_LEVELS.min(size.ilog2() as usize + 1));
    let levels = options.levels.unwrap_or(default).clamp(1, 14);
    match &options.level_map {
        LevelMap::Linear => even(levels),
        LevelMap::Geometric => {
            let share = |i: usize| (levels - 1 - i) as f64 / (levels.max(3) - 2) as f64;
            let rising = |i: usize| FIRST_ROUGHNESS.powf(share(i)) as f32;
            (0..levels).map(|i| if i == 0 { 0.0 } else { rising(i) }).collect()
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

/// The coefficients of [`real_harmonics`](crate::sh::real_harmonics) up to degree 3, for red, green and blue.
///
/// With c_lm = integral of L P_lm exp(-i m phi), theta from +Y and phi from +X towards +Z, the light is the sum of
/// re c_l0 P_l0 + 2 re c_lm P_lm cos(m phi) - 2 im c_lm P_lm sin(m phi): real harmonics about +Y of sqrt(2) re c_lm for
/// cos(m phi) and -sqrt(2) im c_lm for sin(m phi).
fn radiance_coefficients(spectrum: &Spectrum) -> [[f64; 3]; RADIANCE_SH] {
    let of_channel = |channel: usize| {
        let mut about_y = [0.0; RADIANCE_SH];
        for l in 0..=3usize {
            for m in 0..=l {
                let [re, im] = spectrum.coefficient(l, m)[channel];
                let middle = l * l + l;
                if m == 0 {
                    about_y[middle] = re;
                } else {
                    (about_y[middle + m], about_y[middle - m]) = (SQRT_2 * re, -SQRT_2 * im);
                }
            }
        }
        about_z(about_y)
    };
    let [r, g, b] = [0, 1, 2].map(of_channel);
    std::array::from_fn(|k| [r[k], g[k], b[k]])
}

/// Nine of them as the polynomials of `irradiance_sh2`.
fn irradiance_coefficients(radiance: &[[f64; 3]; RADIANCE_SH]) -> [[f32; 3]; 9] {
    let constants = harmonic_constants();
    let degree = |k: usize| usize::from(k > 0) + usize::from(k > 3);
    std::array::from_fn(|k| radiance[k].map(|x| (x * constants[k] * cosine_factor(degree(k))) as f32))
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
