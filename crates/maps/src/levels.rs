//! The levels below an image, of any numbers that have a mean: fast for even sizes, right for odd ones.
//!
//! A row is worked on in blocks, each an array for every number of a texel, so that the loops over them become vectors.
//! Averages go from level to level in f32 and are rounded only when they are stored. Does not know what the numbers are.

use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;

/// Texels of a block: enough to fill vectors several times over, few enough for all blocks at work to stay in the first
/// cache.
pub(crate) const LANES: usize = 64;

/// N numbers of each of [`LANES`] texels.
pub(crate) type Block<const N: usize> = [[f32; LANES]; N];

/// What texels of a level become in the next.
pub(crate) trait Mean<const N: usize>: Sync {
    /// Of four alike.
    fn of_four(quad: [[f32; N]; 4]) -> [f32; N];
    /// Of parts whose weights sum to 1.
    fn of_parts(parts: impl Iterator<Item = (f32, [f32; N])>) -> [f32; N];
}

/// Each number has its own mean.
pub(crate) struct Plain;

impl<const N: usize> Mean<N> for Plain {
    #[inline(always)]
    fn of_four([a, b, c, d]: [[f32; N]; 4]) -> [f32; N] {
        std::array::from_fn(|k| (0.25 * a[k] + 0.25 * b[k]) + (0.25 * c[k] + 0.25 * d[k]))
    }

    fn of_parts(parts: impl Iterator<Item = (f32, [f32; N])>) -> [f32; N] {
        parts.fold([0.0; N], |sum, (weight, part)| std::array::from_fn(|k| sum[k] + weight * part[k]))
    }
}

/// Red, green and blue are weighted by alpha; where there is none, the mean is plain.
pub(crate) struct ByAlpha;

impl ByAlpha {
    /// The plain mean, or the sum of the colours times their alphas over the mean alpha.
    #[inline(always)]
    fn chosen(mean: [f32; 4], visible: [f32; 3]) -> [f32; 4] {
        let alpha = mean[3];
        let [r, g, b] = [0, 1, 2].map(|k| if alpha > 0.0 { visible[k] / alpha } else { mean[k] });
        [r, g, b, alpha]
    }
}

impl Mean<4> for ByAlpha {
    #[inline(always)]
    fn of_four([a, b, c, d]: [[f32; 4]; 4]) -> [f32; 4] {
        let weights = [a[3], b[3], c[3], d[3]].map(|alpha| 0.25 * alpha);
        let visible = |k: usize| (weights[0] * a[k] + weights[1] * b[k]) + (weights[2] * c[k] + weights[3] * d[k]);
        Self::chosen(Plain::of_four([a, b, c, d]), [visible(0), visible(1), visible(2)])
    }

    fn of_parts(parts: impl Iterator<Item = (f32, [f32; 4])>) -> [f32; 4] {
        let (mut mean, mut visible) = ([0.0; 4], [0.0; 3]);
        for (weight, part) in parts {
            mean.iter_mut().zip(part).for_each(|(sum, c)| *sum += weight * c);
            visible.iter_mut().zip(part).for_each(|(sum, c)| *sum += weight * part[3] * c);
        }
        Self::chosen(mean, visible)
    }
}

/// A level, row by row from the top left.
pub(crate) struct Level<T> {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: Vec<T>,
}

/// Brings at most [`LANES`] texels to numbers. What is past them in the block means nothing.
#[inline(always)]
pub(crate) fn filled<const N: usize, T: Copy + Default>(
    texels: &[T],
    block: &mut Block<N>,
    read: impl Fn(usize, T) -> [f32; N],
) {
    let mut lanes = [T::default(); LANES];
    let count = texels.len().min(LANES);
    lanes[..count].copy_from_slice(&texels[..count]);
    for i in 0..LANES {
        let numbers = read(i, lanes[i]);
        for k in 0..N {
            block[k][i] = numbers[k];
        }
    }
}

/// The levels below one of `width` x `height` texels, down to one texel: `fill(x, y, block)` gives the texels from column x
/// of row y on, `store` rounds.
pub(crate) fn levels<const N: usize, M: Mean<N>, S: Copy + Default + Send + Sync>(
    mean: &M,
    [width, height]: [usize; 2],
    fill: impl Fn(usize, usize, &mut Block<N>) + Sync,
    store: impl Fn([f32; N]) -> S + Sync,
) -> Vec<Level<S>> {
    let (mut levels, mut last) = even_levels(mean, [width, height], &fill, &store);
    while last.as_ref().map_or(width > 1 || height > 1, |last| last.width > 1 || last.height > 1) {
        let next = match &last {
            Some(last) => halved(mean, [last.width, last.height], |y, row| {
                row.extend_from_slice(&last.texels[y * last.width..][..last.width]);
            }),
            None => halved(mean, [width, height], |y, row| {
                let mut block = [[0.0; LANES]; N];
                for x in (0..width).step_by(LANES) {
                    fill(x, y, &mut block);
                    row.extend((0..LANES.min(width - x)).map(|i| texel(&block, i)));
                }
            }),
        };
        let texels = next.texels.par_iter().with_min_len(1 << 12).map(|&texel| store(texel)).collect();
        levels.push(Level { width: next.width, height: next.height, texels });
        last = Some(next);
    }
    levels
}

/// The numbers of one texel of a block.
#[inline(always)]
fn texel<const N: usize>(block: &Block<N>, i: usize) -> [f32; N] {
    std::array::from_fn(|k| block[k][i])
}

/// How many levels are made in one pass over the first at most: bands of 32 rows.
const FUSED: u32 = 5;

/// The levels down to where a side is odd, but at most [`FUSED`], made in one pass: as soon as two rows of a level are
/// there they become one of the next, while they are in the cache. Also the last of them as it is before it is rounded;
/// none where the first level has an odd side.
fn even_levels<const N: usize, M: Mean<N>, S: Copy + Default + Send + Sync>(
    mean: &M,
    [width, height]: [usize; 2],
    fill: &(impl Fn(usize, usize, &mut Block<N>) + Sync),
    store: &(impl Fn([f32; N]) -> S + Sync),
) -> (Vec<Level<S>>, Option<Level<[f32; N]>>) {
    let count = width.trailing_zeros().min(height.trailing_zeros()).min(FUSED);
    if count == 0 {
        return (Vec::new(), None);
    }
    let size = |level: u32| (width >> level, height >> level);
    let mut stored: Vec<Vec<S>> = (1..=count).map(|level| vec![S::default(); size(level).0 * size(level).1]).collect();
    let (last_width, bands) = size(count);
    let mut last = Level { width: last_width, height: bands, texels: vec![[0.0; N]; last_width * bands] };
    // Band i makes row i of the last level, and 2, 4, 8 .. rows of those above.
    let mut parts: Vec<_> = last.texels.chunks_mut(last_width).map(|row| (row, Vec::new())).collect();
    for (level, texels) in (1..=count).zip(&mut stored) {
        let rows = texels.chunks_mut(size(level).0 << (count - level));
        parts.iter_mut().zip(rows).for_each(|((_, outs), rows)| outs.push(rows));
    }
    // Two rows of each level but the last, whose one row is the result.
    let buffers = || -> Vec<[Vec<Block<N>>; 2]> {
        (1..=count).map(|level| [(); 2].map(|()| vec![[[0.0; LANES]; N]; size(level).0.div_ceil(LANES)])).collect()
    };
    parts.into_par_iter().enumerate().for_each_init(buffers, |rows, (band, (last_row, outs))| {
        let widths = (0..=count).map(|level| size(level).0).collect();
        Arch::new().dispatch(Band { first: band << (count - 1), widths, rows, outs, mean, fill, store });
        let blocks = &rows[count as usize - 1][0];
        last_row.iter_mut().enumerate().for_each(|(x, out)| *out = texel(&blocks[x / LANES], x % LANES));
    });
    let stored = (1..=count).zip(stored).map(|(level, texels)| {
        let (width, height) = size(level);
        Level { width, height, texels }
    });
    (stored.collect(), Some(last))
}

/// The work of one band, which `pulp` compiles for several instruction sets.
struct Band<'a, const N: usize, M, S, R, F> {
    /// The first row of the first level that is made.
    first: usize,
    /// Of the image and of each level that is made.
    widths: Vec<usize>,
    rows: &'a mut [[Vec<Block<N>>; 2]],
    outs: Vec<&'a mut [S]>,
    mean: &'a M,
    fill: &'a R,
    store: &'a F,
}

impl<const N: usize, M, S, R, F> NullaryFnOnce for Band<'_, N, M, S, R, F>
where
    M: Mean<N>,
    S: Copy + Default,
    R: Fn(usize, usize, &mut Block<N>),
    F: Fn([f32; N]) -> S,
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { first, widths, rows, mut outs, mean, fill, store } = self;
        let mut above = [[[0.0; LANES]; N]; 2];
        for y in 0..1_usize << (rows.len() - 1) {
            for (j, out) in rows[0][y % 2].iter_mut().enumerate() {
                for half in 0..2 {
                    let x = (2 * j + half) * LANES;
                    if x < widths[0] {
                        let [top, bottom] = &mut above;
                        fill(x, 2 * (first + y), top);
                        fill(x, 2 * (first + y) + 1, bottom);
                        halve(mean, out, half, top, bottom);
                    }
                }
            }
            let (mut level, mut y) = (0, y);
            loop {
                let width = widths[level + 1];
                let out = &mut outs[level][y * width..][..width];
                out.chunks_mut(LANES).zip(&rows[level][y % 2]).for_each(|(out, block)| {
                    let mut lanes = [S::default(); LANES];
                    for (i, lane) in lanes.iter_mut().enumerate() {
                        *lane = store(texel(block, i));
                    }
                    out.copy_from_slice(&lanes[..out.len()]);
                });
                if y.is_multiple_of(2) || level + 1 == rows.len() {
                    break;
                }
                let (above, below) = rows.split_at_mut(level + 1);
                let [top, bottom] = &above[level];
                for (j, out) in below[0][y / 2 % 2].iter_mut().enumerate() {
                    let pairs = top.iter().zip(bottom).skip(2 * j).take(2);
                    pairs.enumerate().for_each(|(half, (top, bottom))| halve(mean, out, half, top, bottom));
                }
                (level, y) = (level + 1, y / 2);
            }
        }
    }
}

/// Half a block, the first or the second, from two blocks that lie over each other.
#[inline(always)]
fn halve<const N: usize, M: Mean<N>>(_: &M, out: &mut Block<N>, half: usize, top: &Block<N>, bottom: &Block<N>) {
    for i in 0..LANES / 2 {
        let quad = [(top, 2 * i), (top, 2 * i + 1), (bottom, 2 * i), (bottom, 2 * i + 1)];
        let mean = M::of_four(quad.map(|(block, i)| texel(block, i)));
        for k in 0..N {
            out[k][half * (LANES / 2) + i] = mean[k];
        }
    }
}

/// The level below one of `width` x `height` texels with an odd side; `row` appends the texels of one of its rows.
fn halved<const N: usize, M: Mean<N>>(
    _: &M,
    [width, height]: [usize; 2],
    row: impl Fn(usize, &mut Vec<[f32; N]>) + Sync,
) -> Level<[f32; N]> {
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut texels = vec![[0.0; N]; half_width * half_height];
    let rows = texels.par_chunks_mut(half_width).with_min_len(4096_usize.div_ceil(half_width)).enumerate();
    rows.for_each_init(
        || [(); 3].map(|()| Vec::with_capacity(width)),
        |above, (y, out)| {
            let down = footprint(height, y);
            for (buffer, (j, _)) in above.iter_mut().zip(down.weights()) {
                buffer.clear();
                row(j, buffer);
            }
            for (x, out) in out.iter_mut().enumerate() {
                let across = footprint(width, x);
                let parts = above.iter().zip(down.weights()).flat_map(|(row, (_, row_weight))| {
                    across.weights().map(move |(i, weight)| (weight * row_weight, row[i]))
                });
                *out = M::of_parts(parts);
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
