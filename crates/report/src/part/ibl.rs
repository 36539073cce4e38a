//! Light of environments: levels, what is seen between them, diffuse light, the split sum's own error; on the two environments of our own, against
//! sums over every texel.

use super::nearly::Nearly;
use super::{levels, split_sum};
use crate::error::Errors;
use crate::search::{self, Search};
use crate::timing::{Candidate, measured};
use crate::{Effort, Row, Run};
use halfvector_ibl::environment::{
    environment_sample, environment_sample_hermite, irradiance_sh2, lod_geometric, lod_linear, lod_report,
};
use halfvector_ibl::sh::{ShOrder, ShWindow, irradiance_from_radiance_sh};
use halfvector_ibl::{
    BakeOptions, BakedEnvironment, Equirect, LevelMap, LoadedEnvironment, Quadrature, Source, bake, sky, studio,
};
use rayon::prelude::*;

/// Measures the part.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (first, name, environment) in [(0.0, "studio", studio()), (0.5, "sky", sky())] {
        under(run, first, name, &environment, &mut rows);
    }
    rows
}

/// The rows of one of the two environments, which take half the time.
pub fn rows_under_sky(run: &Run<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    under(run, 0.0, "sky", &sky(), &mut rows);
    rows
}

/// Adds the rows of an environment, the part's half from `first` on.
fn under(run: &Run<'_>, first: f64, name: &str, environment: &LoadedEnvironment, rows: &mut Vec<Row>) {
    let effort = run.effort();
    let Source::Equirect(map) = &environment.source else { return };
    let truth = Truth::new(map);
    let own = levels::rows(run, first, name, environment, &truth, rows);
    rows.extend(own);
    run.keep(rows, first + 0.35);
    // The largest bakes are made once for all that read them.
    let baked = |level_map| bake(environment, &BakeOptions { level_map, ..BakeOptions::default() });
    // At this size the linear mapping has the report's six levels.
    let maps = [baked(LevelMap::Geometric), baked(LevelMap::Linear)];
    run.at(first + 0.4);
    rows.extend(seen(effort, name, &maps, &truth));
    run.keep(rows, first + 0.42);
    rows.extend(diffuse(effort, name, &maps, &truth));
    run.keep(rows, first + 0.45);
    rows.extend(split_sum::rows(effort, name, environment, &maps[0]));
    run.keep(rows, first + 0.5);
}

/// Relative error of a colour, each channel against at least a thousandth of the mean radiance.
pub(super) fn add(errors: &mut Errors, value: [f32; 3], truth: [f64; 3], mean: [f64; 3], at: impl Fn() -> String) {
    errors.add_color(off(value, truth, mean), at);
}

/// The relative error of each channel, as [`add`] takes it.
pub(super) fn off(value: [f32; 3], truth: [f64; 3], mean: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| (f64::from(value[c]) - truth[c]) / truth[c].max(1e-3 * mean[c]))
}

/// The largest error of a channel.
pub(super) fn largest(errors: [f64; 3]) -> f64 {
    errors.into_iter().fold(0.0, |most, error| error.abs().max(most))
}

/// What is true of an environment: by every texel, and nearly, which is quick and says where an error is large.
pub(super) struct Truth {
    pub(super) exact: Quadrature,
    pub(super) near: Nearly,
}

/// Places, and the light that is expected there.
type Known<const N: usize> = Vec<([f64; N], [f64; 3])>;

/// How much is searched for a largest error by what is nearly true.
const SEARCH: Search = Search { starts: 16, rounds: 7 };

/// How much the search goes on by what is true.
const FURTHER: Search = Search { starts: 3, rounds: 6 };

/// How far the search by what is true begins to draw around a start, in edges of the unit cube.
const REACH: f64 = 0.015;

/// Edges of light that are looked at.
const EDGES: usize = 24;

impl Truth {
    pub(super) fn new(map: &Equirect) -> Truth {
        Truth { exact: Quadrature::new(map), near: Nearly::new(map) }
    }

    /// The light at some places, by what is true or nearly.
    fn known<const N: usize>(
        places: impl IntoParallelIterator<Item = [f64; N]>,
        light: impl Fn([f64; N]) -> [f64; 3] + Sync + Send,
    ) -> Known<N> {
        places.into_par_iter().map(|place| (place, light(place))).collect()
    }

    /// Directions where errors are often the largest, as places of the unit square: of cubes the corners and the middles of edges and
    /// faces, of light where it changes most and where it comes from.
    fn remarkable(&self) -> Vec<[f64; 2]> {
        let cube = search::corners::<3>().map(|place| place.map(|x| 2.0 * x - 1.0)).filter(|dir| *dir != [0.0; 3]);
        // Beside a corner, where three texels meet, it is not as in it.
        let beside = |dir: [f64; 3]| {
            let aside = (0..6).map(move |k| {
                let mut dir = dir;
                dir[k / 2] *= if k % 2 == 0 { 0.985 } else { 1.015 };
                dir
            });
            let is_corner = dir.iter().all(|x| *x != 0.0);
            std::iter::once(dir).chain(aside.filter(move |_| is_corner))
        };
        let all = cube.flat_map(beside).map(unit).chain(self.near.edges(EDGES)).chain([self.near.brightest()]);
        all.map(place_of).collect()
    }

    /// Looks for a larger error than is known, from places where the light is `near`ly known: the largest beside what is nearly true
    /// are held against what is true, and from the worst of these and of the places where it is known by that the search goes on.
    fn search<const N: usize>(
        &self,
        errors: &mut Errors,
        [near, known]: [&Known<N>; 2],
        asked: impl Fn([f64; N]) -> ([f64; 3], f64),
        read: impl Fn(([f64; 3], f64)) -> [f32; 3],
        at: impl Fn([f64; N]) -> String,
    ) {
        let against = |place: [f64; N], light: [f64; 3]| largest(off(read(asked(place)), light, self.exact.mean()));
        let about = |place: [f64; N]| {
            let (dir, roughness) = asked(place);
            against(place, self.near.prefiltered(dir, roughness))
        };
        let exact = |place: [f64; N]| {
            let (dir, roughness) = asked(place);
            against(place, self.exact.prefiltered(dir, roughness))
        };
        let worst = SEARCH.worst(near.iter().map(|&(place, light)| (place, against(place, light))), about);
        let mut starts: Vec<_> = worst.into_iter().map(|(place, _)| (place, exact(place))).collect();
        starts.extend(known.iter().map(|&(place, light)| (place, against(place, light))));
        for (place, found) in FURTHER.from(starts, REACH, exact) {
            errors.search(found, || at(place));
        }
    }
}

pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// The k-th direction of an even spread over the sphere.
pub(super) fn direction(k: usize) -> [f64; 3] {
    direction_at([(0.5 + 0.819_172_513 * k as f64).fract(), (0.671_043_607 * k as f64).fract()])
}

/// The direction at a place of the unit square, of which equal parts are equal parts of the sphere.
pub(super) fn direction_at([a, b]: [f64; 2]) -> [f64; 3] {
    let (y, (sin, cos)) = (2.0 * a - 1.0, (b * std::f64::consts::TAU).sin_cos());
    let across = (1.0 - y * y).max(0.0).sqrt();
    [across * cos, y, across * sin]
}

/// The place of a direction in the unit square.
fn place_of([x, y, z]: [f64; 3]) -> [f64; 2] {
    [0.5 * (y + 1.0), (z.atan2(x) / std::f64::consts::TAU).rem_euclid(1.0)]
}

/// Any direction and roughness from 0.1 to 1, read as a shader reads it: one row per mapping of roughness to levels.
/// `maps` are baked for the geometric and for the linear mapping; the latter has the report's levels.
fn seen(effort: Effort, name: &str, maps: &[BakedEnvironment; 2], truth: &Truth) -> Vec<Row> {
    let domain = format!(
        "{name}: as seen at any direction, roughness evenly in 0.1..1, 512 px; relative error against a sum over texels"
    );
    // A direction and a roughness at a place of the unit cube.
    let asked = |[a, b, r]: [f64; 3]| (direction_at([a, b]), 0.1 + 0.9 * r);
    let light = |place: [f64; 3]| {
        let (dir, roughness) = asked(place);
        truth.exact.prefiltered(dir, roughness)
    };
    let drawn = Truth::known((0..effort.pick(300, 1500)).into_par_iter().map(search::place), light);
    let points: Vec<([f64; 3], f64)> = drawn.iter().map(|&(place, _)| asked(place)).collect();
    // Narrow lobes show most of what is between levels and texels.
    let remarkable = |roughness: &[f64]| -> Vec<[f64; 3]> {
        let at = |[a, b]: [f64; 2]| roughness.iter().map(move |&r| [a, b, r]);
        truth.remarkable().into_iter().flat_map(at).collect()
    };
    let mut known = Truth::known(remarkable(&[0.0]), light);
    known.extend(&drawn);
    let near = (0..effort.pick(6000, 12_000)).map(search::place).chain(remarkable(&[0.05, 0.13, 0.25, 0.5, 0.9]));
    let near = Truth::known(near.collect::<Vec<_>>(), |place| {
        let (dir, roughness) = asked(place);
        truth.near.prefiltered(dir, roughness)
    });
    let [geometric, linear] = maps;
    let count = |baked: &BakedEnvironment| baked.radiance.len() as f64;
    type Read<'a> = (&'a str, &'a BakedEnvironment, &'a (dyn Fn([f64; 3], f64) -> [f32; 3] + Sync));
    let methods: [Read<'_>; 4] = [
        ("hermite", geometric, &|dir, roughness| {
            let lod = lod_geometric(roughness, count(geometric));
            environment_sample_hermite(&geometric.radiance, &geometric.slope, dir, lod)
        }),
        ("geometric", geometric, &|dir, roughness| {
            environment_sample(&geometric.radiance, dir, lod_geometric(roughness, count(geometric)))
        }),
        ("linear", linear, &|dir, roughness| {
            environment_sample(&linear.radiance, dir, lod_linear(roughness, count(linear)))
        }),
        ("report", linear, &|dir, roughness| {
            environment_sample(&linear.radiance, dir, lod_report(roughness, count(linear)))
        }),
    ];
    let mut runs: Vec<_> = methods
        .iter()
        .map(|(_, _, read)| |_| points.iter().map(|&(dir, roughness)| f64::from(read(dir, roughness)[0])).sum::<f64>())
        .collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 50));
    methods
        .par_iter()
        .zip(times)
        .map(|((method, baked, read), time)| {
            let mut errors = Errors::default();
            for (&(dir, roughness), &(_, expected)) in points.iter().zip(&drawn) {
                let at = || format!("roughness = {roughness:?}, direction = {dir:?}");
                add(&mut errors, read(dir, roughness), expected, truth.exact.mean(), at);
            }
            truth.search(
                &mut errors,
                [&near, &known],
                asked,
                |(dir, roughness)| read(dir, roughness),
                |place| {
                    let (dir, roughness) = asked(place);
                    format!("roughness = {roughness:?}, direction = {dir:?}")
                },
            );
            let mut row = Row::new("level_map", method, &domain);
            errors.fill(&mut row);
            if ["linear", "report"].contains(method) {
                row.note = Some("at this size both linear and report have the same six levels".to_owned());
            }
            row.take_time(time, points.len());
            row.bytes = Some(8 * baked.radiance.iter().map(|cube| cube.texels.len() as u64).sum::<u64>());
            row
        })
        .collect()
}

/// Diffuse light from any direction: the cube, harmonics to degree 1, 2 and 3 as they are and windowed, and the report's last
/// level. A third degree adds nothing: the cosine lobe has none (Ramamoorthi and Hanrahan 2001).
fn diffuse(effort: Effort, name: &str, maps: &[BakedEnvironment; 2], truth: &Truth) -> Vec<Row> {
    let domain = format!("{name}: irradiance over pi at any direction; relative error against a sum over texels");
    let asked = |place: [f64; 2]| (direction_at(place), 1.0);
    let light = |place: [f64; 2]| truth.exact.prefiltered(direction_at(place), 1.0);
    let drawn = Truth::known((0..effort.pick(300, 1500)).into_par_iter().map(search::place), light);
    let points: Vec<[f64; 3]> = drawn.iter().map(|&(place, _)| direction_at(place)).collect();
    let mut known = Truth::known(truth.remarkable(), light);
    known.extend(&drawn);
    let near = (0..effort.pick(1000, 4000)).into_par_iter().map(search::place);
    let near = Truth::known(near, |place| truth.near.prefiltered(direction_at(place), 1.0));
    let [baked, report] = maps;
    let harmonics = |coefficients: [[f32; 4]; 9], dir: [f64; 3]| irradiance_sh2(coefficients, dir.map(|x| x as f32));
    let plain = baked.irradiance_sh_padded();
    let of_radiance = |order, window, dir| irradiance_from_radiance_sh(&baked.radiance_sh, order, window, dir);
    type Read<'a> = (&'a str, u64, &'a (dyn Fn([f64; 3]) -> [f32; 3] + Sync));
    let methods: [Read<'_>; 7] = [
        ("cube", 8 * baked.irradiance_over_pi.texels.len() as u64, &|dir| baked.irradiance_over_pi.sample(dir)),
        ("sh2", 144, &|dir| harmonics(plain, dir)),
        ("sh1, four coefficients", 64, &|dir| harmonics(first_order(plain), dir)),
        ("sh2 windowed", 256, &|dir| of_radiance(ShOrder::Two, ShWindow::Hann, dir)),
        ("sh3", 256, &|dir| of_radiance(ShOrder::Three, ShWindow::None, dir)),
        ("sh3 windowed", 256, &|dir| of_radiance(ShOrder::Three, ShWindow::Hann, dir)),
        ("last_level", 8 * report.radiance[5].texels.len() as u64, &|dir| report.radiance[5].sample(dir)),
    ];
    let mut runs: Vec<_> =
        methods.iter().map(|(_, _, read)| |_| points.iter().map(|&dir| f64::from(read(dir)[0])).sum::<f64>()).collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 50));
    methods
        .par_iter()
        .zip(times)
        .map(|((method, bytes, read), time)| {
            let mut errors = Errors::default();
            for (&dir, &(_, expected)) in points.iter().zip(&drawn) {
                add(&mut errors, read(dir), expected, truth.exact.mean(), || format!("direction = {dir:?}"));
            }
            let at = |place: [f64; 2]| format!("direction = {:?}", direction_at(place));
            truth.search(&mut errors, [&near, &known], asked, |(dir, _)| read(dir), at);
            let mut row = Row::new("irradiance", method, &domain);
            errors.fill(&mut row);
            row.take_time(time, points.len());
            row.bytes = Some(*bytes);
            row
        })
        .collect()
}

/// The coefficients of degrees 0 and 1 alone.
fn first_order(mut coefficients: [[f32; 4]; 9]) -> [[f32; 4]; 9] {
    coefficients[4..].fill([0.0; 4]);
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside a bright edge a mixture of levels leaves far more light than there is: narrow lobes in many directions drawn by chance
    /// find nothing that errs more, but for a little.
    #[test]
    fn the_largest_error_beside_an_edge_is_found() {
        let map =
            Equirect::from_fn(400, 200, |[x, y, z]| if x > 0.9 && y.abs() < z.abs() { [40.0; 3] } else { [0.05; 3] });
        let truth = Truth::new(&map);
        let baked = bake(&map.into(), &BakeOptions { size: 64, level_map: LevelMap::Linear, ..BakeOptions::default() });
        let asked = |[a, b, r]: [f64; 3]| (direction_at([a, b]), 0.1 + 0.9 * r);
        let read = |(dir, roughness): ([f64; 3], f64)| {
            environment_sample(&baked.radiance, dir, lod_linear(roughness, baked.radiance.len() as f64))
        };
        let mut errors = Errors::default();
        let near = Truth::known((0..2000).into_par_iter().map(search::place), |place| {
            let (dir, roughness) = asked(place);
            truth.near.prefiltered(dir, roughness)
        });
        truth.search(&mut errors, [&near, &Vec::new()], asked, read, |place| format!("{place:?}"));
        let most = |k: usize| {
            let [a, b] = [0.754_877_666, 0.569_840_291].map(|step: f64| (0.5 + step * k as f64).fract());
            let (dir, roughness) = asked([a, b, 0.0]);
            largest(off(read((dir, roughness)), truth.exact.prefiltered(dir, roughness), truth.exact.mean()))
        };
        let found = (0..10_000).into_par_iter().map(most).reduce(|| 0.0, f64::max);
        assert!(errors.max() > 0.95 * found, "{} at most, but {found}", errors.max());
    }

    /// An error that stands in one corner of a cube alone is found, where nothing that is drawn comes near it.
    #[test]
    fn errors_of_the_corners_of_cubes_are_found() {
        let truth = Truth::new(&Equirect::from_fn(64, 32, |[_, y, _]| [1.0 + 0.5 * y as f32; 3]));
        let corner = unit([-1.0, -1.0, 1.0]);
        let read = |(dir, _): ([f64; 3], f64)| {
            let cosine: f64 = (0..3).map(|i| corner[i] * dir[i]).sum();
            let light = truth.exact.prefiltered(dir, 1.0);
            light.map(|x| if cosine > 0.99995 { 1.2 * x as f32 } else { x as f32 })
        };
        let asked = |place: [f64; 2]| (direction_at(place), 1.0);
        let light = |place: [f64; 2]| truth.exact.prefiltered(direction_at(place), 1.0);
        let known = Truth::known(truth.remarkable(), light);
        let near = Truth::known((0..300).into_par_iter().map(search::place), light);
        let mut errors = Errors::default();
        truth.search(&mut errors, [&near, &known], asked, read, |place| format!("{place:?}"));
        assert!(errors.max() > 0.19, "{}", errors.max());
    }
}
