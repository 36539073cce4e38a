//! Light of environments: levels, what is seen between them, diffuse light, the split sum's own error; on the two environments of our own, against
//! sums over every texel.

use super::{levels, split_sum};
use crate::error::Errors;
use crate::search::Search;
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
    let own = levels::rows(run, first, name, environment, &truth.exact, rows);
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

/// What is true of an environment: by every texel, and by few of them, which is quick and says about where an error is large.
struct Truth {
    exact: Quadrature,
    near: Quadrature,
}

/// Rows of the map of which [`Truth::near`] is.
const NEAR_ROWS: usize = 96;

/// How much is searched for a largest error by what is nearly true.
const SEARCH: Search = Search { starts: 8, rounds: 6 };

/// How much the search goes on by what is true, where texels that are left together hide how large an error is: a narrow lobe sees what
/// is next to an edge, and they do not.
const SHARP: Search = Search { starts: 2, rounds: 8 };

/// For light so wide that the search by what is nearly true ends at the right place.
const WIDE: Search = Search { starts: SEARCH.starts, rounds: 0 };

/// How far the search by what is true begins to draw around a start, in edges of the unit cube.
const REACH: f64 = 0.03;

impl Truth {
    fn new(map: &Equirect) -> Truth {
        let near = map.area_resampled(2 * NEAR_ROWS, NEAR_ROWS);
        Truth { exact: Quadrature::new(map), near: Quadrature::new(&near) }
    }

    /// Prefiltered light in the direction and for the roughness of each place, nearly.
    fn nearly<const N: usize>(
        &self,
        count: usize,
        asked: impl Fn([f64; N]) -> ([f64; 3], f64) + Sync,
    ) -> Vec<([f64; N], [f64; 3])> {
        // Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
        const STEPS: [f64; 3] = [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
        let place = |k: usize| std::array::from_fn(|i| (0.5 + STEPS[i % 3] * k as f64).fract());
        let at = |k: usize| {
            let (dir, roughness) = asked(place(k));
            (place(k), self.near.prefiltered(dir, roughness))
        };
        (0..count).into_par_iter().map(at).collect()
    }

    /// Looks for a larger error than is known, from places where the light is nearly known: where it is large beside what is nearly
    /// true it is held against what is true, and from the worst of these places the search goes on by that.
    fn search<const N: usize>(
        &self,
        errors: &mut Errors,
        further: Search,
        known: &[([f64; N], [f64; 3])],
        asked: impl Fn([f64; N]) -> ([f64; 3], f64),
        read: impl Fn(([f64; 3], f64)) -> [f32; 3],
        at: impl Fn([f64; N]) -> String,
    ) {
        let mean = self.exact.mean();
        let drawn = known.iter().map(|&(place, light)| (place, largest(off(read(asked(place)), light, mean))));
        let near = |place: [f64; N]| {
            let (dir, roughness) = asked(place);
            largest(off(read((dir, roughness)), self.near.prefiltered(dir, roughness), mean))
        };
        let exact = |place: [f64; N]| {
            let (dir, roughness) = asked(place);
            largest(off(read((dir, roughness)), self.exact.prefiltered(dir, roughness), mean))
        };
        let starts = SEARCH.worst(drawn, near).into_iter().map(|(place, _)| (place, exact(place))).collect();
        for (place, found) in further.from(starts, REACH, exact) {
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
fn direction_at([a, b]: [f64; 2]) -> [f64; 3] {
    let (y, (sin, cos)) = (2.0 * a - 1.0, (b * std::f64::consts::TAU).sin_cos());
    let across = (1.0 - y * y).max(0.0).sqrt();
    [across * cos, y, across * sin]
}

/// Any direction and roughness from 0.1 to 1, read as a shader reads it: one row per mapping of roughness to levels.
/// `maps` are baked for the geometric and for the linear mapping; the latter has the report's levels.
fn seen(effort: Effort, name: &str, maps: &[BakedEnvironment; 2], truth: &Truth) -> Vec<Row> {
    let domain = format!(
        "{name}: as seen at any direction, roughness evenly in 0.1..1, 512 px; relative error against a sum over texels"
    );
    // A direction and a roughness at a place of the unit cube.
    let asked = |[a, b, r]: [f64; 3]| (direction_at([a, b]), 0.1 + 0.9 * r);
    let points: Vec<([f64; 3], f64)> = (0..effort.pick(60, 1000))
        .map(|k| (direction(k), 0.1 + 0.9 * (0.5 + 0.549_700_478 * k as f64).fract()))
        .collect();
    let expected: Vec<_> = points.par_iter().map(|&(dir, roughness)| truth.exact.prefiltered(dir, roughness)).collect();
    let known = truth.nearly(effort.pick(2000, 6000), asked);
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
            for (&(dir, roughness), &expected) in points.iter().zip(&expected) {
                let at = || format!("roughness = {roughness:?}, direction = {dir:?}");
                add(&mut errors, read(dir, roughness), expected, truth.exact.mean(), at);
            }
            truth.search(
                &mut errors,
                SHARP,
                &known,
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
    let points: Vec<[f64; 3]> = (0..effort.pick(60, 1000)).map(direction).collect();
    let expected: Vec<_> = points.par_iter().map(|&dir| truth.exact.prefiltered(dir, 1.0)).collect();
    let asked = |place: [f64; 2]| (direction_at(place), 1.0);
    let known = truth.nearly(effort.pick(300, 2000), asked);
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
            for (&dir, &expected) in points.iter().zip(&expected) {
                add(&mut errors, read(dir), expected, truth.exact.mean(), || format!("direction = {dir:?}"));
            }
            let at = |place: [f64; 2]| format!("direction = {:?}", direction_at(place));
            truth.search(&mut errors, WIDE, &known, asked, |(dir, _)| read(dir), at);
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
        truth.search(&mut errors, SHARP, &truth.nearly(2000, asked), asked, read, |place| format!("{place:?}"));
        let most = |k: usize| {
            let [a, b] = [0.754_877_666, 0.569_840_291].map(|step: f64| (0.5 + step * k as f64).fract());
            let (dir, roughness) = asked([a, b, 0.0]);
            largest(off(read((dir, roughness)), truth.exact.prefiltered(dir, roughness), truth.exact.mean()))
        };
        let found = (0..10_000).into_par_iter().map(most).reduce(|| 0.0, f64::max);
        assert!(errors.max() > 0.95 * found, "{} at most, but {found}", errors.max());
    }
}
