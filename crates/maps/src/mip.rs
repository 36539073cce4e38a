//! Mip chains: every level of an image down to one texel, averaged in linear light.
//!
//! Any size works. A level has half the width and height, rounded down, and each of its texels is the mean over the area
//! that it covers of the level above: two texels a side where the size is even, parts of three where it is odd. So every
//! level has the mean of the first. Averages go from level to level in f32 and are rounded only when they are stored.
//! Does not filter wider than a box, and does not wrap.

use pulp::{Arch, NullaryFnOnce};
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

#[inline(always)]
fn unit_u8(texel: [u8; 4]) -> [f32; 4] {
    texel.map(|c| f32::from(c) * (1.0 / 255.0))
}

#[inline(always)]
fn unit_u16(texel: [u16; 4]) -> [f32; 4] {
    texel.map(|c| f32::from(c) * (1.0 / 65_535.0))
}

/// NaN is 0; the alpha of a colour is a weight and must be one.
#[inline(always)]
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

#[inline(always)]
fn vector([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [x, y, z] = crate::normal::normal_from_texel([r, g, b], 1.0, false);
    [x, y, z, a]
}

/// (n + 1) / 2 of the vector made unit.
#[inline(always)]
fn normal_codes([x, y, z, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = normalize_or([x, y, z], [0.0, 0.0, 1.0]).map(|x| 0.5 * x + 0.5);
    [r, g, b, a]
}

/// What texels of a level become in the next.
pub(crate) trait Average: Copy + Send + Sync {
    /// What buffers hold before they are filled.
    const ZERO: Self;
    /// Of four alike.
    fn of_four(quad: [Self; 4]) -> Self;
    /// Of parts whose weights sum to 1.
    fn of_parts(parts: impl Iterator<Item = (f32, Self)>) -> Self;
}

/// Each number has its own mean.
impl<const N: usize> Average for [f32; N] {
    const ZERO: Self = [0.0; N];

    #[inline(always)]
    fn of_four([a, b, c, d]: [Self; 4]) -> Self {
        std::array::from_fn(|k| (0.25 * a[k] + 0.25 * b[k]) + (0.25 * c[k] + 0.25 * d[k]))
    }

    fn of_parts(parts: impl Iterator<Item = (f32, Self)>) -> Self {
        parts.fold(Self::ZERO, |sum, (weight, part)| std::array::from_fn(|k| sum[k] + weight * part[k]))
    }
}

/// Red, green and blue are weighted by alpha; where there is none, the mean is plain.
#[derive(Clone, Copy)]
struct Weighted([f32; 4]);

impl Weighted {
    /// The plain mean, or the sum of the colours times their alphas over the mean alpha.
    #[inline(always)]
    fn chosen(mean: [f32; 4], visible: [f32; 3]) -> Self {
        let alpha = mean[3];
        if alpha > 0.0 {
            let [r, g, b] = visible.map(|c| c / alpha);
            Self([r, g, b, alpha])
        } else {
            Self(mean)
        }
    }
}

impl Average for Weighted {
    const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    fn of_four(quad: [Self; 4]) -> Self {
        let [a, b, c, d] = quad.map(|Self(texel)| texel);
        let weights = [a[3], b[3], c[3], d[3]].map(|alpha| 0.25 * alpha);
        let visible = |k: usize| (weights[0] * a[k] + weights[1] * b[k]) + (weights[2] * c[k] + weights[3] * d[k]);
        Self::chosen(<[f32; 4]>::of_four([a, b, c, d]), [visible(0), visible(1), visible(2)])
    }

    fn of_parts(parts: impl Iterator<Item = (f32, Self)>) -> Self {
        let (mut mean, mut visible) = ([0.0; 4], [0.0; 3]);
        for (weight, Self(part)) in parts {
            mean.iter_mut().zip(part).for_each(|(sum, c)| *sum += weight * c);
            visible.iter_mut().zip(part).for_each(|(sum, c)| *sum += weight * part[3] * c);
        }
        Self::chosen(mean, visible)
    }
}

/// All levels below `first`: `read` brings a texel to what is averaged, `store` back.
fn all_levels<T: Copy + Default + Send + Sync>(
    (width, height, weighted): (usize, usize, bool),
    first: &[[T; 4]],
    read: impl Fn([T; 4]) -> [f32; 4] + Sync,
    store: impl Fn([f32; 4]) -> [T; 4] + Sync,
    texels: impl Fn(Vec<[T; 4]>) -> Texels,
) -> Vec<(usize, usize, Texels)> {
    let row = |y: usize| first[y * width..][..width].iter();
    let levels = if weighted {
        levels(width, height, |y| row(y).map(|&t| Weighted(read(t))), |Weighted(texel)| store(texel))
    } else {
        levels(width, height, |y| row(y).map(|&t| read(t)), &store)
    };
    levels.into_iter().map(|level| (level.width, level.height, texels(level.texels))).collect()
}

/// The levels below one of `width` x `height` texels, down to one texel: `row` gives the texels of one of its rows, `store`
/// rounds.
pub(crate) fn levels<A: Average, S: Copy + Default + Send + Sync, I: Iterator<Item = A>>(
    width: usize,
    height: usize,
    row: impl Fn(usize) -> I + Sync,
    store: impl Fn(A) -> S + Sync,
) -> Vec<Level<S>> {
    let (mut levels, mut last) = even_levels(width, height, &row, &store);
    while last.as_ref().map_or(width > 1 || height > 1, |last| last.width > 1 || last.height > 1) {
        let next = match &last {
            Some(last) => {
                halved(last.width, last.height, |y| last.texels[y * last.width..][..last.width].iter().copied())
            }
            None => halved(width, height, &row),
        };
        let texels = next.texels.par_iter().with_min_len(1 << 12).map(|&texel| store(texel)).collect();
        levels.push(Level { width: next.width, height: next.height, texels });
        last = Some(next);
    }
    levels
}

/// A level: of what is averaged, or stored.
pub(crate) struct Level<T> {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: Vec<T>,
}

/// How many levels are made in one pass over the first at most: bands of 32 rows.
const FUSED: u32 = 5;

/// The levels down to where a side is odd, but at most [`FUSED`], made in one pass: as soon as two rows of a level are
/// there they become one of the next, while they are in the cache. Also the last of them as it is before it is rounded;
/// none where the first level has an odd side.
fn even_levels<A: Average, S: Copy + Default + Send + Sync, I: Iterator<Item = A>>(
    width: usize,
    height: usize,
    row: &(impl Fn(usize) -> I + Sync),
    store: &(impl Fn(A) -> S + Sync),
) -> (Vec<Level<S>>, Option<Level<A>>) {
    let count = width.trailing_zeros().min(height.trailing_zeros()).min(FUSED);
    if count == 0 {
        return (Vec::new(), None);
    }
    let size = |level: u32| (width >> level, height >> level);
    let mut stored: Vec<Vec<S>> = (1..=count).map(|level| vec![S::default(); size(level).0 * size(level).1]).collect();
    let (last_width, bands) = size(count);
    let mut last = Level { width: last_width, height: bands, texels: vec![A::ZERO; last_width * bands] };
    // Band i makes row i of the last level, and 2, 4, 8 .. rows of those above.
    let mut parts: Vec<_> = last.texels.chunks_mut(last_width).map(|row| (row, Vec::new())).collect();
    for (level, texels) in (1..=count).zip(&mut stored) {
        let rows = texels.chunks_mut(size(level).0 << (count - level));
        parts.iter_mut().zip(rows).for_each(|((_, outs), rows)| outs.push(rows));
    }
    // Two rows of each level but the last, whose one row is the result.
    let buffers =
        || -> Vec<[Vec<A>; 2]> { (1..=count).map(|level| [(); 2].map(|()| vec![A::ZERO; size(level).0])).collect() };
    parts.into_par_iter().enumerate().for_each_init(buffers, |rows, (band, (last_row, outs))| {
        Arch::new().dispatch(Band { first: band << (count - 1), rows, outs, row, store });
        last_row.copy_from_slice(&rows[count as usize - 1][0]);
    });
    let stored = (1..=count).zip(stored).map(|(level, texels)| {
        let (width, height) = size(level);
        Level { width, height, texels }
    });
    (stored.collect(), Some(last))
}

/// The work of one band, which `pulp` compiles for several instruction sets.
struct Band<'a, A, S, R, F> {
    /// The first row of the first level that is made.
    first: usize,
    rows: &'a mut [[Vec<A>; 2]],
    outs: Vec<&'a mut [S]>,
    row: &'a R,
    store: &'a F,
}

impl<A: Average, S, I: Iterator<Item = A>, R: Fn(usize) -> I, F: Fn(A) -> S> NullaryFnOnce for Band<'_, A, S, R, F> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { first, rows, mut outs, row, store } = self;
        for y in 0..1_usize << (rows.len() - 1) {
            let above = 2 * (first + y);
            halve_rows(&mut rows[0][y % 2], row(above), row(above + 1));
            let (mut level, mut y) = (0, y);
            loop {
                let done = &rows[level][y % 2];
                let out = &mut outs[level][y * done.len()..][..done.len()];
                out.iter_mut().zip(done).for_each(|(out, &texel)| *out = store(texel));
                if y.is_multiple_of(2) || level + 1 == rows.len() {
                    break;
                }
                let (above, below) = rows.split_at_mut(level + 1);
                let [top, bottom] = &above[level];
                halve_rows(&mut below[0][y / 2 % 2], top.iter().copied(), bottom.iter().copied());
                (level, y) = (level + 1, y / 2);
            }
        }
    }
}

/// One row from two of twice its length.
#[inline(always)]
fn halve_rows<A: Average>(row: &mut [A], mut top: impl Iterator<Item = A>, mut bottom: impl Iterator<Item = A>) {
    for out in row {
        if let (Some(a), Some(b), Some(c), Some(d)) = (top.next(), top.next(), bottom.next(), bottom.next()) {
            *out = A::of_four([a, b, c, d]);
        }
    }
}

/// The level below one of `width` x `height` texels with an odd side.
fn halved<A: Average, I: Iterator<Item = A>>(width: usize, height: usize, row: impl Fn(usize) -> I + Sync) -> Level<A> {
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut texels = vec![A::ZERO; half_width * half_height];
    let rows = texels.par_chunks_mut(half_width).with_min_len(4096_usize.div_ceil(half_width)).enumerate();
    rows.for_each_init(
        || [(); 3].map(|()| Vec::with_capacity(width)),
        |above, (y, out)| {
            let down = footprint(height, y);
            for (buffer, (j, _)) in above.iter_mut().zip(down.weights()) {
                buffer.clear();
                buffer.extend(row(j));
            }
            for (x, out) in out.iter_mut().enumerate() {
                let across = footprint(width, x);
                let parts = above.iter().zip(down.weights()).flat_map(|(row, (_, row_weight))| {
                    across.weights().map(move |(i, weight)| (weight * row_weight, row[i]))
                });
                *out = A::of_parts(parts);
            }
        },
    );
    Level { width: half_width, height: half_height, texels }
}

/// What texel `i` of a level covers along one axis of the level above.
#[derive(Clone, Copy)]
struct Footprint {
    first: usize,
    count: usize,
    weights: [f32; 3],
}

impl Footprint {
    fn weights(&self) -> impl Iterator<Item = (usize, f32)> {
        (0..self.count).map(|tap| (self.first + tap, self.weights[tap]))
    }
}

/// With n texels above and m = max(1, floor(n / 2)) here, texel i covers [i n / m, (i + 1) n / m). For n = 2 m that is two
/// whole texels; for n = 2 m + 1 it is the parts 1 - i / m, 1 and (i + 1) / m of three; all over n / m.
fn footprint(n: usize, i: usize) -> Footprint {
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
