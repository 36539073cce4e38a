//! Mip chains: every level of an image down to one texel, averaged in linear light.
//!
//! Any size works. A level has half the width and height, rounded down, and each of its texels is the mean over the area
//! that it covers of the level above: two texels a side where the size is even, parts of three where it is odd. So every
//! level has the mean of the first. Averages go from level to level in f32 and are rounded only when they are stored.
//! Does not filter wider than a box, and does not wrap.

use rayon::prelude::*;

use crate::coding::{code_u8, code_u16, srgb8};
use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::image::{Image, Texels};
use crate::real::normalize_or;

/// How the red, green and blue of an image are encoded. Alpha is linear always.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// IEC 61966-2-1, as colours are stored.
    Srgb,
    /// Values as they are, as everything else is stored.
    Linear,
}

/// What the texels are, which decides what their average is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapKind {
    /// A colour with coverage in alpha: the mean is weighted by alpha, so that what cannot be seen does not bleed. Where
    /// nothing can be seen it is the plain mean.
    Color,
    /// A tangent-space normal, 2 c - 1: vectors are averaged and their mean is made unit. Alpha is averaged beside it.
    Normal,
    /// Independent channels (roughness, metalness, occlusion, height, packed maps): each has its own mean.
    Data,
}

/// The image and all its smaller levels: the first is a copy of `image`, the last has one texel. The levels keep its
/// format (8-bit, 16-bit, float) and channels. NaN counts as 0. [`smaller_levels`] saves the copy.
pub fn mip_chain(image: &Image, color_space: ColorSpace, kind: MapKind) -> Vec<Image> {
    let mut levels = smaller_levels(image, color_space, kind);
    levels.insert(0, image.clone());
    levels
}

/// The levels of [`mip_chain`] below the first; none for one texel.
pub fn smaller_levels(image: &Image, color_space: ColorSpace, kind: MapKind) -> Vec<Image> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width == 1 && height == 1 {
        return Vec::new();
    }
    let weighted = kind == MapKind::Color && image.channels().has_alpha();
    let size = (width, height, weighted);
    // One loop for each coding, so that no texel asks which it is. Normals have no colour space: 2 c - 1 is of the codes.
    let levels = match (image.texels(), kind, color_space) {
        (Texels::U8(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(unit_u8(t)), |v| normal_codes(v).map(code_u8), Texels::U8)
        }
        (Texels::U8(texels), _, ColorSpace::Srgb) => {
            let table = srgb8();
            let read = |[r, g, b, a]: [u8; 4]| {
                let [r, g, b] = [r, g, b].map(|c| table.linear[usize::from(c)]);
                [r, g, b, f32::from(a) * (1.0 / 255.0)]
            };
            let store = |[r, g, b, a]: [f32; 4]| [table.code(r), table.code(g), table.code(b), code_u8(a)];
            all_levels(size, texels, read, store, Texels::U8)
        }
        (Texels::U8(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, unit_u8, |v| v.map(code_u8), Texels::U8)
        }
        (Texels::U16(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(unit_u16(t)), |v| normal_codes(v).map(code_u16), Texels::U16)
        }
        (Texels::U16(texels), _, ColorSpace::Srgb) => {
            all_levels(size, texels, |t| linear(unit_u16(t)), |v| encoded(v).map(code_u16), Texels::U16)
        }
        (Texels::U16(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, unit_u16, |v| v.map(code_u16), Texels::U16)
        }
        (Texels::F32(texels), MapKind::Normal, _) => {
            all_levels(size, texels, |t| vector(without_nan(t, kind)), normal_codes, Texels::F32)
        }
        (Texels::F32(texels), _, ColorSpace::Srgb) => {
            all_levels(size, texels, |t| linear(without_nan(t, kind)), encoded, Texels::F32)
        }
        (Texels::F32(texels), _, ColorSpace::Linear) => {
            all_levels(size, texels, |t| without_nan(t, kind), |v| v, Texels::F32)
        }
    };
    levels
        .into_iter()
        .map(|(width, height, texels)| Image::from_parts(width as u32, height as u32, image.channels(), texels))
        .collect()
}

#[inline]
fn unit_u8(texel: [u8; 4]) -> [f32; 4] {
    texel.map(|c| f32::from(c) * (1.0 / 255.0))
}

#[inline]
fn unit_u16(texel: [u16; 4]) -> [f32; 4] {
    texel.map(|c| f32::from(c) * (1.0 / 65_535.0))
}

/// NaN is 0; the alpha of a colour is a weight and must be one.
#[inline]
fn without_nan(texel: [f32; 4], kind: MapKind) -> [f32; 4] {
    let [r, g, b, a] = texel.map(|c| if c.is_nan() { 0.0 } else { c });
    [r, g, b, if kind == MapKind::Color { a.clamp(0.0, 1.0) } else { a }]
}

fn linear([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = linear_from_srgb([r, g, b]);
    [r, g, b, a]
}

fn encoded([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = srgb_from_linear([r, g, b]);
    [r, g, b, a]
}

#[inline]
fn vector([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [x, y, z] = crate::normal::normal_from_texel([r, g, b], 1.0, false);
    [x, y, z, a]
}

/// (n + 1) / 2 of the vector made unit.
#[inline]
fn normal_codes([x, y, z, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = normalize_or([x, y, z], [0.0, 0.0, 1.0]).map(|x| 0.5 * x + 0.5);
    [r, g, b, a]
}

/// Width, height and stored texels of all levels below `first`; `read` brings a texel to what is averaged, `store` back.
fn all_levels<T: Copy + Default + Send + Sync>(
    (width, height, weighted): (usize, usize, bool),
    first: &[[T; 4]],
    read: impl Fn([T; 4]) -> [f32; 4] + Sync,
    store: impl Fn([f32; 4]) -> [T; 4] + Sync,
    texels: impl Fn(Vec<[T; 4]>) -> Texels,
) -> Vec<(usize, usize, Texels)> {
    let (mut levels, mut level) = even_levels((width, height, weighted), first, &read, &store);
    while level.as_ref().is_none_or(|level| level.width > 1 || level.height > 1) {
        let next = match &level {
            Some(level) => halved(level.width, level.height, weighted, |i| level.texels[i]),
            None => halved(width, height, weighted, |i| read(first[i])),
        };
        let texels = next.texels.par_iter().with_min_len(1 << 12).map(|&texel| store(texel)).collect();
        levels.push(Stored { width: next.width, height: next.height, texels });
        level = Some(next);
    }
    levels.into_iter().map(|level| (level.width, level.height, texels(level.texels))).collect()
}

/// A level in the image's format.
struct Stored<T> {
    width: usize,
    height: usize,
    texels: Vec<[T; 4]>,
}

/// How many levels are made in one pass over the first at most: bands of 32 rows.
const FUSED: u32 = 5;

/// The levels down to where a side is odd, but at most [`FUSED`], made in one pass: as soon as two rows of a level are
/// there they become one of the next, while they are in the cache. Also the last of them as it is before it is rounded;
/// none where the first level has an odd side.
fn even_levels<T: Copy + Default + Send + Sync>(
    (width, height, weighted): (usize, usize, bool),
    first: &[[T; 4]],
    read: &(impl Fn([T; 4]) -> [f32; 4] + Sync),
    store: &(impl Fn([f32; 4]) -> [T; 4] + Sync),
) -> (Vec<Stored<T>>, Option<Level>) {
    let count = width.trailing_zeros().min(height.trailing_zeros()).min(FUSED);
    if count == 0 {
        return (Vec::new(), None);
    }
    let size = |level: u32| (width >> level, height >> level);
    let mut stored: Vec<Vec<[T; 4]>> =
        (1..=count).map(|level| vec![[T::default(); 4]; size(level).0 * size(level).1]).collect();
    let (last_width, bands) = size(count);
    let mut last = Level { width: last_width, height: bands, texels: vec![[0.0; 4]; last_width * bands] };
    // Band i makes row i of the last level, and 2, 4, 8 .. rows of those above.
    let mut parts: Vec<_> = last.texels.chunks_mut(last_width).map(|row| (row, Vec::new())).collect();
    for (level, texels) in (1..=count).zip(&mut stored) {
        let rows = texels.chunks_mut(size(level).0 << (count - level));
        parts.iter_mut().zip(rows).for_each(|((_, outs), rows)| outs.push(rows));
    }
    parts.into_par_iter().enumerate().for_each(|(band, (last_row, mut outs))| {
        // Two rows of each level but the last, whose one row is the result.
        let mut rows: Vec<[Vec<[f32; 4]>; 2]> =
            (1..=count).map(|level| [(); 2].map(|()| vec![[0.0; 4]; size(level).0])).collect();
        for y in 0..1_usize << (count - 1) {
            let (top, bottom) = first[((band << (count - 1)) + y) * 2 * width..][..2 * width].split_at(width);
            halve_rows(&mut rows[0][y % 2], weighted, top, bottom, read);
            let (mut level, mut row) = (0, y);
            loop {
                let done = &rows[level][row % 2];
                let out = &mut outs[level][row * done.len()..][..done.len()];
                out.iter_mut().zip(done).for_each(|(out, &texel)| *out = store(texel));
                if row.is_multiple_of(2) || level + 1 == rows.len() {
                    break;
                }
                let (above, below) = rows.split_at_mut(level + 1);
                let [a, b] = &above[level];
                halve_rows(&mut below[0][row / 2 % 2], weighted, a, b, &|texel| texel);
                (level, row) = (level + 1, row / 2);
            }
        }
        last_row.copy_from_slice(&rows[count as usize - 1][0]);
    });
    let stored = (1..=count).zip(stored).map(|(level, texels)| {
        let (width, height) = size(level);
        Stored { width, height, texels }
    });
    (stored.collect(), Some(last))
}

/// One row from two of twice its length.
#[inline]
fn halve_rows<S: Copy>(row: &mut [[f32; 4]], weighted: bool, top: &[S], bottom: &[S], read: &impl Fn(S) -> [f32; 4]) {
    let quads = top.chunks_exact(2).zip(bottom.chunks_exact(2));
    let quads = quads.map(|(top, bottom)| [read(top[0]), read(top[1]), read(bottom[0]), read(bottom[1])]);
    if weighted {
        row.iter_mut().zip(quads).for_each(|(out, quad)| *out = Mean::of(quad).by_alpha());
    } else {
        let mean = |[a, b, c, d]: [[f32; 4]; 4]| {
            std::array::from_fn(|k| (0.25 * a[k] + 0.25 * b[k]) + (0.25 * c[k] + 0.25 * d[k]))
        };
        row.iter_mut().zip(quads).for_each(|(out, quad)| *out = mean(quad));
    }
}

/// A level in linear light, or for normals in vectors that are not made unit.
struct Level {
    width: usize,
    height: usize,
    texels: Vec<[f32; 4]>,
}

/// The level below one of `width` x `height` texels.
fn halved(width: usize, height: usize, weighted: bool, texel: impl Fn(usize) -> [f32; 4] + Sync) -> Level {
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut texels = vec![[0.0; 4]; half_width * half_height];
    let rows = texels.par_chunks_mut(half_width).with_min_len(4096_usize.div_ceil(half_width)).enumerate();
    rows.for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let mut mean = Mean::default();
            for (j, row_weight) in footprint(height, y).weights() {
                for (i, weight) in footprint(width, x).weights() {
                    mean.add(weight * row_weight, texel(j * width + i));
                }
            }
            *out = if weighted { mean.by_alpha() } else { mean.sum };
        }
    });
    Level { width: half_width, height: half_height, texels }
}

/// A sum of texels whose weights sum to 1.
#[derive(Default)]
struct Mean {
    sum: [f32; 4],
    /// The colours times their alphas.
    visible: [f32; 3],
}

impl Mean {
    /// Of four alike.
    #[inline]
    fn of([a, b, c, d]: [[f32; 4]; 4]) -> Self {
        let weights = [a[3], b[3], c[3], d[3]].map(|alpha| 0.25 * alpha);
        let sum = |k: usize| (0.25 * a[k] + 0.25 * b[k]) + (0.25 * c[k] + 0.25 * d[k]);
        let visible = |k: usize| (weights[0] * a[k] + weights[1] * b[k]) + (weights[2] * c[k] + weights[3] * d[k]);
        Self { sum: [sum(0), sum(1), sum(2), sum(3)], visible: [visible(0), visible(1), visible(2)] }
    }

    fn add(&mut self, weight: f32, texel: [f32; 4]) {
        for (sum, c) in self.sum.iter_mut().zip(texel) {
            *sum += weight * c;
        }
        for (sum, c) in self.visible.iter_mut().zip(texel) {
            *sum += weight * texel[3] * c;
        }
    }

    /// The colour weighted by alpha, or the plain one where there is no alpha; and the mean alpha.
    #[inline]
    fn by_alpha(self) -> [f32; 4] {
        let [.., alpha] = self.sum;
        if alpha > 0.0 {
            let [r, g, b] = self.visible.map(|c| c / alpha);
            [r, g, b, alpha]
        } else {
            self.sum
        }
    }
}

/// What texel `i` of a level covers along one axis of the level above.
#[derive(Clone, Copy)]
pub(crate) struct Footprint {
    first: usize,
    count: usize,
    weights: [f32; 3],
}

impl Footprint {
    pub(crate) fn weights(&self) -> impl Iterator<Item = (usize, f32)> {
        (0..self.count).map(|tap| (self.first + tap, self.weights[tap]))
    }
}

/// With n texels above and m = max(1, floor(n / 2)) here, texel i covers [i n / m, (i + 1) n / m). For n = 2 m that is two
/// whole texels; for n = 2 m + 1 it is the parts 1 - i / m, 1 and (i + 1) / m of three; all over n / m.
pub(crate) fn footprint(n: usize, i: usize) -> Footprint {
    let m = n / 2;
    if n == 1 {
        Footprint { first: 0, count: 1, weights: [1.0, 0.0, 0.0] }
    } else if n.is_multiple_of(2) {
        Footprint { first: 2 * i, count: 2, weights: [0.5, 0.5, 0.0] }
    } else {
        let part = |p: usize| p as f32 / n as f32;
        Footprint { first: 2 * i, count: 3, weights: [part(m - i), part(m), part(i + 1)] }
    }
}
