//! Roughness for the smaller levels of a normal map: what averaging takes from the normals' length, or their spread, goes
//! into the width of the lobe, so that a bumpy metal seen from afar stays dull.
//!
//! Widths are GGX's alpha, the square of perceptual roughness. The three rules are told apart by [`lobe_error`], the
//! distance of the one widened lobe from the mean of the lobes that it stands for; the README has the table.
//! Lobes stay round: grooves that all run one way would need an anisotropic one.

use rayon::prelude::*;

use crate::coding::{code_u8, code_u16};
use crate::image::{Channels, Image, Texels};
use crate::levels::{Block, LANES, Level, Plain, filled, levels};
use crate::mip::{unit_u8, unit_u16};
use crate::normal::normal_from_texel;
use crate::pack::channel;
use crate::real::{Real, normalize_or, real};

/// A rule for how much wider a lobe becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rule {
    /// From the length of the mean normal, by Toksvig's rule for Blinn-Phong: [`alpha_toksvig`].
    Toksvig,
    /// From the length of the mean normal, taken as a von Mises-Fisher lobe: [`alpha_von_mises_fisher`]. The default: its
    /// error is the least.
    #[default]
    VonMisesFisher,
    /// From the variance of the slopes, as LEAN mapping has it, for a round lobe: [`alpha_lean`].
    Lean,
}

impl Rule {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Toksvig, Self::VonMisesFisher, Self::Lean];

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Toksvig => "toksvig",
            Self::VonMisesFisher => "von_mises_fisher",
            Self::Lean => "lean",
        }
    }

    /// The widened alpha of a footprint, at most 1.
    pub fn alpha(self, alpha: f64, spread: Spread) -> f64 {
        match self {
            Self::Toksvig => alpha_toksvig(alpha, spread.mean_length),
            Self::VonMisesFisher => alpha_von_mises_fisher(alpha, spread.mean_length),
            Self::Lean => alpha_lean(alpha, spread.slope_variance),
        }
    }
}

/// How far the normals of a footprint are spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Length of the mean of the unit normals, 0..1; 1 where all are the same.
    pub mean_length: f64,
    /// Variance of the slope x/z plus that of y/z.
    pub slope_variance: f64,
}

/// The steepest slope that counts, so that a normal on the horizon does not make all else rough (87 degrees).
const STEEPEST: f64 = 20.0;

impl Spread {
    /// Of unit normals in tangent space, equally weighted. No normals have no spread.
    pub fn of(normals: &[[f64; 3]]) -> Self {
        let mut sums = [0.0; 6];
        for &normal in normals {
            sums.iter_mut().zip(moments(normal)).for_each(|(sum, t)| *sum += t / normals.len() as f64);
        }
        if normals.is_empty() { Self { mean_length: 1.0, slope_variance: 0.0 } } else { Self::from_moments(sums) }
    }

    fn from_moments([x, y, z, sx, sy, squares]: [f64; 6]) -> Self {
        Self {
            mean_length: (x * x + y * y + z * z).sqrt().min(1.0),
            slope_variance: (squares - sx * sx - sy * sy).max(0.0),
        }
    }

    /// The same from sums in f32: what their rounding may be is none.
    fn from_moments_f32(moments: [f32; 6]) -> Self {
        const ROUNDING: f64 = 5e-7;
        let Self { mean_length, slope_variance } = Self::from_moments(moments.map(f64::from));
        Self {
            mean_length: if mean_length > 1.0 - ROUNDING { 1.0 } else { mean_length },
            slope_variance: (slope_variance - ROUNDING * f64::from(moments[5])).max(0.0),
        }
    }
}

/// Toksvig 2005, "Mipmapping Normal Maps", for a Blinn-Phong exponent s = 2 / alpha^2 - 2 (Walter et al. 2007) and a mean
/// normal of length l: s' = f s with f = l / (l + s (1 - l)).
pub fn alpha_toksvig(alpha: f64, mean_length: f64) -> f64 {
    let alpha_squared = (alpha * alpha).max(1e-12);
    let s = (2.0 / alpha_squared - 2.0).max(0.0);
    let length = mean_length.clamp(0.0, 1.0);
    let under = length + s * (1.0 - length);
    let widened = if under > 0.0 { s * length / under } else { 0.0 };
    (2.0 / (widened + 2.0)).sqrt()
}

/// The mean normal's length l as a von Mises-Fisher lobe of concentration k = (3 l - l^3) / (1 - l^2) (Banerjee et al. 2005,
/// "Clustering on the Unit Hypersphere using von Mises-Fisher Distributions"), whose width in alpha^2 is 2 / k:
/// alpha'^2 = alpha^2 + 2 / k.
pub fn alpha_von_mises_fisher(alpha: f64, mean_length: f64) -> f64 {
    let length = mean_length.clamp(1e-6, 1.0);
    let width = 2.0 * (1.0 - length * length) / (3.0 * length - length.powi(3));
    (alpha * alpha + width).sqrt().min(1.0)
}

/// Olano and Baker 2010, "LEAN Mapping": the slopes of microfacets have the variance alpha^2 / 2 along each axis (exactly
/// so for Beckmann), and variances add up: alpha'^2 = alpha^2 + the variance of both slopes.
pub fn alpha_lean(alpha: f64, slope_variance: f64) -> f64 {
    (alpha * alpha + slope_variance).sqrt().min(1.0)
}

/// The normal map and the roughness map differ in size, and the latter is more than one texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the roughness map has {} x {} texels and the normal map {} x {}; give maps of one size, or one texel of roughness",
    roughness[0], roughness[1], normal[0], normal[1]
)]
pub struct SizesDiffer {
    /// Size of the roughness map.
    pub roughness: [u32; 2],
    /// Size of the normal map.
    pub normal: [u32; 2],
}

/// The mip chain of a roughness map that goes with a normal map: the red channel is perceptual roughness, the normals are
/// 2 c - 1. The first level says what the map says; every other has the mean of alpha^2 over its footprint, widened by the
/// spread of the normals there. Grey, of the roughness map's depth. A roughness map of one texel stands for all.
///
/// # Errors
/// When the sizes differ.
pub fn adjusted_roughness(roughness: &Image, normal: &Image, rule: Rule) -> Result<Vec<Image>, SizesDiffer> {
    let size = |image: &Image| [image.width(), image.height()];
    let is_constant = size(roughness) == [1, 1];
    if !is_constant && size(roughness) != size(normal) {
        return Err(SizesDiffer { roughness: size(roughness), normal: size(normal) });
    }
    let [width, height] = size(normal).map(|n| n as usize);
    // The first level has no footprint to widen by.
    let mut stored = vec![if is_constant {
        grey(&vec![roughness.texel(0, 0)[0]; width * height], width, height, roughness)
    } else {
        channel(roughness, 0, false)
    }];
    // The plane of alpha^2, or one row of it for all.
    let alpha_squared = |perceptual: f32| if perceptual > 0.0 { perceptual.min(1.0).powi(4) } else { 0.0 };
    let (alphas, stride): (Vec<f32>, usize) = if is_constant {
        (vec![alpha_squared(roughness.texel(0, 0)[0]); width], 0)
    } else {
        let at = |i: usize| alpha_squared(roughness.texel((i % width) as u32, (i / width) as u32)[0]);
        ((0..width * height).into_par_iter().with_min_len(1 << 14).map(at).collect(), width)
    };
    let perceptual = |[x, y, z, sx, sy, squares, alpha_squared]: [f32; 7]| {
        let spread = Spread::from_moments_f32([x, y, z, sx, sy, squares]);
        rule.alpha(f64::from(alpha_squared).sqrt(), spread).sqrt() as f32
    };
    let alphas = |x: usize, y: usize| &alphas[y * stride..][x..width];
    let smaller = match normal.texels() {
        Texels::U8(texels) => all_levels([width, height], texels, alphas, unit_u8, perceptual),
        Texels::U16(texels) => all_levels([width, height], texels, alphas, unit_u16, perceptual),
        Texels::F32(texels) => all_levels([width, height], texels, alphas, |t| t, perceptual),
    };
    stored.extend(smaller.iter().map(|level| grey(&level.texels, level.width, level.height, roughness)));
    Ok(stored)
}

/// The levels below `normals`, whose texels `read` brings to 0..1; `alphas` are the plane of alpha^2 from a column and row on.
fn all_levels<'a, T: Copy + Default + Sync>(
    [width, height]: [usize; 2],
    normals: &[[T; 4]],
    alphas: impl Fn(usize, usize) -> &'a [f32] + Sync,
    read: impl Fn([T; 4]) -> [f32; 4] + Sync,
    perceptual: impl Fn([f32; 7]) -> f32 + Sync,
) -> Vec<Level<f32>> {
    let fill = |x: usize, y: usize, block: &mut Block<7>| {
        let mut alpha_squared = [0.0; LANES];
        let row = alphas(x, y);
        let count = row.len().min(LANES);
        alpha_squared[..count].copy_from_slice(&row[..count]);
        filled(&normals[y * width..][x..width], block, |i, t| texel_moments(read(t), alpha_squared[i]));
    };
    levels(&Plain, [width, height], fill, perceptual)
}

/// The numbers whose means the rules need, of a unit normal: the normal, its slopes, and the sum of their squares.
#[inline(always)]
fn moments<R: Real>([x, y, z]: [R; 3]) -> [R; 6] {
    let (least, steepest) = (real::<R>(1e-6), real::<R>(STEEPEST));
    let inverse = real::<R>(1.0) / if z > least { z } else { least };
    let slope = |t: R| {
        let slope = t * inverse;
        let slope = if slope > steepest { steepest } else { slope };
        if slope < -steepest { -steepest } else { slope }
    };
    let (sx, sy) = (slope(x), slope(y));
    [x, y, z, sx, sy, sx * sx + sy * sy]
}

/// The moments of a texel, and its alpha^2.
#[inline(always)]
fn texel_moments([r, g, b, _]: [f32; 4], alpha_squared: f32) -> [f32; 7] {
    let [x, y, z, sx, sy, squares] = moments(normal_from_texel([r, g, b], 1.0, false));
    [x, y, z, sx, sy, squares, alpha_squared]
}

/// Values as a grey image of the depth of `like`.
fn grey(values: &[f32], width: usize, height: usize, like: &Image) -> Image {
    let texels = match like.texels() {
        Texels::U8(_) => Texels::U8(values.iter().map(|&v| [code_u8(v), code_u8(v), code_u8(v), 255]).collect()),
        Texels::U16(_) => {
            Texels::U16(values.iter().map(|&v| [code_u16(v), code_u16(v), code_u16(v), 65_535]).collect())
        }
        Texels::F32(_) => Texels::F32(values.iter().map(|&v| [v, v, v, 1.0]).collect()),
    };
    Image::from_parts(width as u32, height as u32, Channels::Grey, texels)
}

/// How far one GGX lobe of width `widened` about the mean of `normals` is from the mean of GGX lobes of width `alpha` about
/// each of them: half the integral of the difference of the two projected distributions, each scaled to integrate to 1 over
/// the hemisphere. 0 is the same lobe, 1 no overlap. By the midpoint rule on `n` x `n` cells of equal solid angle; good for
/// widths from about 4 / n.
pub fn lobe_error(normals: &[[f64; 3]], alpha: f64, widened: f64, n: usize) -> f64 {
    let mean = normals.iter().fold([0.0; 3], |sum, normal| [0, 1, 2].map(|k| sum[k] + normal[k]));
    let mean = normalize_or(mean, [0.0, 0.0, 1.0]);
    // Trowbridge and Reitz 1975, without the factor that scaling takes out.
    let d = |m: &[f64; 3], h: [f64; 3], alpha: f64| {
        let cosine = m[0] * h[0] + m[1] * h[1] + m[2] * h[2];
        let under = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
        if cosine > 0.0 { alpha * alpha / (under * under) } else { 0.0 }
    };
    // Lambert's equal-area projection of the hemisphere onto the disk.
    let cell = |i: usize| 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
    let pairs: Vec<[f64; 2]> = (0..n * n)
        .into_par_iter()
        .with_min_len(1 << 8)
        .filter_map(|i| {
            let (u, v) = (cell(i % n), cell(i / n));
            let r2 = u * u + v * v;
            let s = (2.0 - r2).sqrt();
            let h = [u * s, v * s, 1.0 - r2];
            (r2 < 1.0).then(|| {
                let truth = normals.iter().map(|normal| d(normal, h, alpha)).sum::<f64>();
                [truth * h[2], d(&mean, h, widened) * h[2]]
            })
        })
        .collect();
    let sums = pairs.iter().fold([0.0; 2], |sum, pair| [sum[0] + pair[0], sum[1] + pair[1]]);
    0.5 * pairs.iter().map(|pair| (pair[0] / sums[0] - pair[1] / sums[1]).abs()).sum::<f64>()
}
