//! The levels of bakes, texel by texel against sums over every texel of the environment.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

use super::ibl::{Truth, largest, off, unit};
use crate::error::Errors;
use crate::timing::{Candidate, measured_and_told};
use crate::{Effort, Row, Run};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Cube, LevelMap, LoadedEnvironment, Prefilter, Quality, bake, direction_from_face,
    face_from_direction,
};
use rayon::prelude::*;

/// What stands beside a row that is judged and not timed yet.
pub(crate) const NOT_TIMED: &str = "it was not timed: the run was interrupted before";

/// The levels at random texel centres, by filter, quality and size. Cost is the time of a whole bake on all cores, irradiance
/// and harmonics included, shared out among the texels of its levels. Each bake is judged as soon as it is made once, and kept behind the
/// rows of `before`.
pub(super) fn rows(
    run: &Run<'_>,
    first: f64,
    name: &str,
    environment: &LoadedEnvironment,
    truth: &Truth,
    before: &[Row],
) -> Vec<Row> {
    let effort = run.effort();
    let rounds = effort.pick(2, 5);
    let cases: Vec<(&str, BakeOptions)> = [
        ("ggx preview", Quality::Preview, 128, Prefilter::Ggx),
        ("ggx preview", Quality::Preview, 256, Prefilter::Ggx),
        ("ggx", Quality::Default, 64, Prefilter::Ggx),
        ("ggx", Quality::Default, 128, Prefilter::Ggx),
        ("ggx", Quality::Default, 256, Prefilter::Ggx),
        ("ggx best", Quality::Best, 128, Prefilter::Ggx),
        ("ggx best", Quality::Best, 256, Prefilter::Ggx),
        ("hdre", Quality::Default, 256, Prefilter::Hdre),
    ]
    .into_iter()
    .map(|(method, quality, size, prefilter)| {
        let level_map = if prefilter == Prefilter::Hdre { LevelMap::Report } else { LevelMap::Geometric };
        let options = BakeOptions { size, quality, prefilter, level_map, ..BakeOptions::default() };
        (method, options)
    })
    .collect();
    // What is timed is what is judged: a bake takes too long to be made once more.
    let made: Vec<RefCell<Option<BakedEnvironment>>> = cases.iter().map(|_| RefCell::default()).collect();
    let mut runs: Vec<_> = cases
        .iter()
        .zip(&made)
        .map(|((_, options), made)| {
            |_| {
                let baked = bake(environment, options);
                let read = f64::from(baked.irradiance_sh[0][0]);
                made.replace(Some(baked));
                read
            }
        })
        .collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let mut judged = Judged { name, effort, truth, known: HashMap::new(), near: HashMap::new() };
    let mut rows: Vec<Row> = Vec::new();
    let mut bakes = 0;
    let times = measured_and_told(&mut candidates, rounds, |number| {
        bakes += 1;
        let share = first + 0.3 * (f64::from(bakes) / (rounds * cases.len()) as f64).min(1.0);
        let Some(baked) = made[number].take().filter(|_| number == rows.len()) else { return run.at(share) };
        let (method, options) = &cases[number];
        rows.push(Row { note: Some(NOT_TIMED.to_owned()), ..judged.row(method, options.size, &baked) });
        run.keep(&[before, &rows].concat(), share);
    });
    for (row, time) in rows.iter_mut().zip(times) {
        let texels = row.bytes.unwrap_or_default() / TEXEL;
        row.take_batch_time(time, texels as usize);
        row.note = None;
    }
    rows
}

/// Bytes of a texel: four numbers of 16 bits.
const TEXEL: u64 = 8;

/// What bakes of an environment are held against.
struct Judged<'a> {
    name: &'a str,
    effort: Effort,
    truth: &'a Truth,
    /// Bakes have many levels and places in common: what is true of a texel.
    known: HashMap<Key, [f64; 3]>,
    /// The same, nearly.
    near: HashMap<Key, [f64; 3]>,
}

/// A texel, by its level's size and roughness.
type Key = (usize, u32, Texel);

/// Perceptual roughness from which levels are judged: sums over texels are no truth of narrower lobes.
const LEAST_ROUGHNESS: f32 = 0.19;

impl Judged<'_> {
    /// The errors of some texels of a level, each channel's.
    fn errors(&mut self, baked: &BakedEnvironment, level: usize, texels: &[Texel]) -> Vec<[f64; 3]> {
        let exact = &self.truth.exact;
        beside(&mut self.known, baked, level, texels, |dir, roughness| exact.prefiltered(dir, roughness), exact.mean())
    }

    /// The texels of a level that err most beside what is nearly true, no two of them near each other. All of a small level are looked at,
    /// and all around the worst of a large one.
    fn worst(&mut self, baked: &BakedEnvironment, level: usize) -> Vec<Texel> {
        let (size, truth) = (baked.radiance[level].size, self.truth);
        let mut errors = |texels: &[Texel]| -> Vec<(f64, Texel)> {
            let light = |dir: [f64; 3], roughness: f64| truth.near.prefiltered(dir, roughness);
            let errors = beside(&mut self.near, baked, level, texels, light, truth.exact.mean());
            errors.into_iter().map(largest).zip(texels.iter().copied()).collect()
        };
        let step = size.div_ceil(self.effort.pick(32, 64)).max(1);
        let places = || (0..size).step_by(step);
        let faces =
            (0..6).flat_map(|face| places().flat_map(move |row| places().map(move |column| (face, [column, row]))));
        let edges = marked(size);
        let mut all: Vec<Texel> = faces.chain(edges).collect::<BTreeSet<_>>().into_iter().collect();
        let (starts, apart) = (self.effort.pick(8, 24), (size / 12).max(2) as f64 * 2.0 / size as f64);
        let mut found = spaced(errors(&all), size, starts, apart);
        if step > 1 {
            all = found.iter().flat_map(|&texel| square(size, texel, step, 1)).collect();
            found = spaced(errors(&all), size, starts, apart);
        }
        found
    }

    /// From a texel of a level to where the error is larger than at the neighbours: the error there, and the texel.
    fn climbed(&mut self, baked: &BakedEnvironment, level: usize, from: Texel) -> (f64, Texel) {
        let size = baked.radiance[level].size;
        let mut best = (largest(self.errors(baked, level, &[from])[0]), from);
        for step in [4, 2, 1] {
            for _ in 0..3 {
                let around: Vec<Texel> = square(size, best.1, step, step).into_iter().collect();
                let errors = self.errors(baked, level, &around);
                let found = errors.into_iter().map(largest).zip(around).max_by(|a, b| a.0.total_cmp(&b.0));
                match found.filter(|found| found.0 > best.0) {
                    Some(found) => best = found,
                    None => break,
                }
            }
        }
        best
    }

    /// Adds the errors of a level, and of what a search on it finds. What is drawn over the whole level misses a sun, about which most of the
    /// error is: the texels around the brightest are all looked at, and count as many as they are.
    fn level(&mut self, baked: &BakedEnvironment, level: usize, errors: &mut Errors) {
        let (cube, roughness) = (&baked.radiance[level], baked.roughness[level]);
        let size = cube.size;
        let [brightest, steepest] = remarkable(cube);
        let bright = square(size, brightest, (size / 12).min(5), 1);
        let drawn: BTreeSet<Texel> = (0..self.effort.pick(120, 400)).map(|k| texel(size, k)).collect();
        let all = (6 * size * size) as f64;
        let rest = drawn.difference(&bright).count();
        let mut worst: Vec<(f64, Texel)> = Vec::new();
        for (texels, weight) in [
            (bright.iter().copied().collect::<Vec<_>>(), 1.0 / all),
            (drawn.difference(&bright).copied().collect(), (1.0 - bright.len() as f64 / all) / rest.max(1) as f64),
        ] {
            let mut found: Vec<(f64, Texel)> = Vec::new();
            for (error, &texel) in self.errors(baked, level, &texels).into_iter().zip(&texels) {
                errors.add_weighted(error, weight, || said(roughness, size, texel));
                found.push((largest(error), texel));
            }
            found.sort_by(|a, b| b.0.total_cmp(&a.0));
            worst.extend(found.iter().take(self.effort.pick(1, 4)));
        }
        let mut starts = self.worst(baked, level);
        starts.push(steepest);
        starts.extend(worst.into_iter().map(|(_, texel)| texel));
        let found = self.errors(baked, level, &starts).into_iter().map(largest).zip(starts).collect();
        for from in spaced(found, size, self.effort.pick(3, 8), 4.0 / size as f64) {
            let (found, texel) = self.climbed(baked, level, from);
            errors.search(found, || said(roughness, size, texel));
        }
    }

    /// The row of a bake, without its time.
    fn row(&mut self, method: &str, size: usize, baked: &BakedEnvironment) -> Row {
        let mut errors = Errors::default();
        for level in (1..baked.radiance.len()).filter(|&level| baked.roughness[level] >= LEAST_ROUGHNESS) {
            self.level(baked, level, &mut errors);
        }
        let domain = format!(
            "{}, {size} px: levels of roughness >= 0.2 at texel centres; relative error against a sum over texels",
            self.name
        );
        let mut row = Row::new("prefilter", method, &domain);
        errors.fill(&mut row);
        row.bytes = Some(baked.radiance.iter().map(|cube| TEXEL * cube.texels.len() as u64).sum());
        row
    }
}

fn said(roughness: f32, size: usize, texel: Texel) -> String {
    format!("roughness = {roughness:?}, direction = {:?}", centre(size, texel))
}

/// The brightest texel of a cube, and the one beside which it grows brighter the most, as a part of it.
fn remarkable(cube: &Cube) -> [Texel; 2] {
    let size = cube.size;
    let light = |(face, [column, row]): Texel| cube.texels[(face * size + row) * size + column].iter().sum::<f32>();
    let rise = |texel: Texel| {
        let around = square(size, texel, 1, 1).into_iter().map(light).fold(0.0, f32::max);
        around / light(texel).max(f32::MIN_POSITIVE)
    };
    let all = || (0..6 * size * size).map(|i| (i / (size * size), [i % size, i / size % size]));
    let most = |of: &dyn Fn(Texel) -> f32| all().max_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap_or_default();
    [most(&light), most(&rise)]
}

/// The errors of some texels of a level beside what is known of it, which is made where it is not.
fn beside(
    known: &mut HashMap<Key, [f64; 3]>,
    baked: &BakedEnvironment,
    level: usize,
    texels: &[Texel],
    light: impl Fn([f64; 3], f64) -> [f64; 3] + Sync,
    mean: [f64; 3],
) -> Vec<[f64; 3]> {
    let (cube, roughness) = (&baked.radiance[level], baked.roughness[level]);
    let key = |texel: Texel| (cube.size, roughness.to_bits(), texel);
    let is_new = |texel: &Texel| !known.contains_key(&key(*texel));
    let new: BTreeSet<Texel> = texels.iter().copied().filter(is_new).collect();
    let made = |texel: Texel| (key(texel), light(centre(cube.size, texel), f64::from(roughness)));
    known.par_extend(new.into_par_iter().map(made));
    let error = |&texel: &Texel| off(cube.sample(centre(cube.size, texel)), known[&key(texel)], mean);
    texels.iter().map(error).collect()
}

/// The texels of a cube in the corners of its faces and at the middles of their edges.
fn marked(size: usize) -> impl Iterator<Item = Texel> {
    let places = move || [0, size / 2, size - 1].into_iter();
    (0..6).flat_map(move |face| places().flat_map(move |row| places().map(move |column| (face, [column, row]))))
}

/// Of some texels with their errors the worst, no two of them nearer to each other than this chord.
fn spaced(mut found: Vec<(f64, Texel)>, size: usize, count: usize, apart: f64) -> Vec<Texel> {
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<Texel> = Vec::new();
    for (_, texel) in found {
        let dir = centre(size, texel);
        let is_near = |other: &Texel| {
            let other = centre(size, *other);
            (0..3).map(|i| (dir[i] - other[i]).powi(2)).sum::<f64>() < apart * apart
        };
        if chosen.len() < count && !chosen.iter().any(is_near) {
            chosen.push(texel);
        }
    }
    chosen
}

/// A texel of a cube: its face, column and row.
type Texel = (usize, [usize; 2]);

/// The texels of a square about one, every so many of them, over the edges of faces too.
fn square(size: usize, (face, [column, row]): Texel, reach: usize, step: usize) -> BTreeSet<Texel> {
    let steps = move || (-(reach as isize)..=reach as isize).step_by(step.max(1));
    let place = |at: usize, by: isize| (2 * (at as isize + by) + 1) as f64 / size as f64 - 1.0;
    let index = |x: f64| ((0.5 * (x + 1.0) * size as f64) as usize).min(size - 1);
    let moved = |(x, y): (isize, isize)| {
        let (face, s, t) = face_from_direction(direction_from_face(face, place(column, x), place(row, y)));
        (face, [index(s), index(t)])
    };
    steps().flat_map(|y| steps().map(move |x| (x, y))).map(moved).collect()
}

/// The k-th of evenly spread texels of a cube.
fn texel(size: usize, k: usize) -> Texel {
    let place = |g: f64| ((0.5 + g * k as f64).fract() * size as f64) as usize;
    (k % 6, [place(0.754_877_666), place(0.569_840_291)])
}

/// The middle of a texel, as a unit direction.
fn centre(size: usize, (face, [column, row]): Texel) -> [f64; 3] {
    let place = |at: usize| (2 * at + 1) as f64 / size as f64 - 1.0;
    unit(direction_from_face(face, place(column), place(row)))
}

/// The k-th of evenly spread texel centres of a cube, as a unit direction.
pub(super) fn texel_centre(size: usize, k: usize) -> [f64; 3] {
    centre(size, texel(size, k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfvector_ibl::Equirect;

    /// A sun at the edge of two faces: what errs most lies beside it, and most of the mean square.
    #[test]
    fn the_largest_error_beside_a_sun_is_found() {
        const SUN: [f64; 3] = [-0.437, 0.651, 0.620];
        let map = Equirect::from_fn(256, 128, |dir| {
            let cosine: f64 = (0..3).map(|i| SUN[i] * dir[i]).sum();
            if cosine > 0.998 { [3000.0, 2500.0, 2000.0] } else { [0.3, 0.4, 0.5 + 0.2 * dir[1] as f32] }
        });
        let truth = Truth::new(&map);
        let options = BakeOptions { size: 64, quality: Quality::Preview, ..BakeOptions::default() };
        let baked = bake(&map.into(), &options);
        let mut judged =
            Judged { name: "sun", effort: Effort::Quick, truth: &truth, known: HashMap::new(), near: HashMap::new() };
        let row = judged.row("ggx preview", 64, &baked);
        let (mut most, mut squares, mut levels) = (0.0_f64, 0.0, 0.0);
        for level in (1..baked.radiance.len()).filter(|&level| baked.roughness[level] >= LEAST_ROUGHNESS) {
            let size = baked.radiance[level].size;
            let all: Vec<Texel> =
                (0..6 * size * size).map(|i| (i / (size * size), [i % size, i / size % size])).collect();
            let errors = judged.errors(&baked, level, &all);
            most = errors.iter().copied().map(largest).fold(most, f64::max);
            squares += errors.iter().flatten().map(|error| error * error).sum::<f64>() / (3 * all.len()) as f64;
            levels += 1.0;
        }
        let rms = (squares / levels).sqrt();
        assert!(row.error_max.is_some_and(|said| said > 0.9 * most), "{most}, but {row:?}");
        assert!(row.error_rms.is_some_and(|said| said > 0.5 * rms && said < 2.0 * rms), "{rms}, but {row:?}");
    }

    /// Neighbours of a texel in a corner of a face are on the other two.
    #[test]
    fn squares_go_on_over_edges() {
        let found = square(8, (0, [0, 0]), 1, 1);
        let faces: BTreeSet<usize> = found.iter().map(|(face, _)| *face).collect();
        assert_eq!(faces, BTreeSet::from([0, 2, 4]));
        assert!(found.len() >= 8 && found.contains(&(0, [1, 1])), "{found:?}");
    }
}
