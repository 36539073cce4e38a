//! Normal mapping: the angle between what each method makes of a texel and what the texel says, from the table that the
//! tests of `halfvector-maps` hold (`data/normal_angle.csv`); blends of two normal maps against the sum of their height
//! fields; and what one texel costs, alone and in a batch. Frames on meshes are in `frames`, texels and heights in `texels`.

use halfvector_maps::batch;
use halfvector_maps::blend::{blend_linear, blend_partial_derivatives, blend_rnm, blend_udn, blend_whiteout};
use halfvector_maps::derivative::{normal_from_slopes, normal_tbn_derivative};
use halfvector_maps::normal::{normal_rotation_fixed, normal_rotation_report, normal_tbn};

use rayon::prelude::*;

use super::texels::degrees_between;
use super::{encode, frames, texels};
use crate::error::named;
use crate::placed::Columns;
use crate::search::{self, CHEAP};
use crate::timing::{Candidate, SITTINGS, Time, measured};
use crate::{Effort, Row};

/// normal, method, tilt [deg], mean, rms and largest error [deg].
const ANGLES: &str = include_str!("../../data/normal_angle.csv");

/// Where the errors of the term `normal` are from.
const FROM_TABLE: &str = "errors in f64, of a table to 1e-6 deg that a test of halfvector-maps holds";

/// Measures the part.
pub fn rows(run: &crate::Run<'_>) -> Vec<Row> {
    const PIECES: [fn(Effort) -> Vec<Row>; 5] = [methods, frames::rows, blends, texels::rows, encode::rows];
    run.pieces(&PIECES, |piece| piece(run.effort()))
}

/// Numbers in -1..1 that come out the same on every run.
fn numbers(count: usize, seed: u32) -> Vec<f32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// Times of a run over all texels: of calls, and of a batch where there is one.
struct Cost {
    method: &'static str,
    single: Time,
    batch: Option<Time>,
    texels: usize,
}

type Run<'a> = Box<dyn FnMut(usize) -> f64 + 'a>;

/// Calls `f` for every texel.
fn single<'a>(count: usize, f: impl Fn(usize) -> [f32; 3] + 'a) -> Run<'a> {
    Box::new(move |_| (0..count).map(|i| f64::from(f(i)[0])).sum())
}

/// What is read of a texel: its normal, the surface's normal and tangent.
type Texels = Columns<10>;

/// Calls `f` once for all texels.
fn whole<'a>(texels: &'a [Texels], count: usize, f: impl Fn([&[f32]; 10], [&mut [f32]; 3]) + 'a) -> Run<'a> {
    let mut out: [Columns<3>; SITTINGS] = std::array::from_fn(|sitting| Columns::written(count, sitting));
    Box::new(move |sitting| {
        f(texels[sitting].slices(), out[sitting].slices_mut());
        f64::from(out[sitting].slices()[0][count / 2])
    })
}

fn costs(effort: Effort) -> Vec<Cost> {
    let count = effort.pick(1 << 12, 1 << 14);
    let arrays: [Vec<f32>; 10] = std::array::from_fn(|k| numbers(count, k as u32));
    let a = arrays.each_ref().map(Vec::as_slice);
    let texels: [Texels; SITTINGS] = std::array::from_fn(|sitting| Columns::read(a, sitting));
    let (n_tangent, normal, tangent) = ([a[0], a[1], a[2]], [a[3], a[4], a[5]], [a[6], a[7], a[8], a[9]]);
    let n_at = |i: usize| n_tangent.map(|a| a[i]);
    let normal_at = |i: usize| normal.map(|a| a[i]);
    let mut runs = [
        single(count, |i| normal_tbn(n_at(i), normal_at(i), tangent.map(|a| a[i]))),
        single(count, |i| {
            let [x, y, z, w] = tangent.map(|a| a[i]);
            normal_tbn_derivative(n_at(i), [x, y, z], [w, z, y], normal_at(i), [x, w], [y, z])
        }),
        single(count, |i| normal_rotation_report(n_at(i), normal_at(i))),
        single(count, |i| normal_rotation_fixed(n_at(i), normal_at(i))),
        whole(&texels, count, |[x, y, z, a, b, c, t, u, v, w], out| {
            batch::normals_tbn([x, y, z], [a, b, c], [t, u, v, w], out);
        }),
        whole(&texels, count, |[x, y, z, a, b, c, ..], out| {
            batch::normals_rotation_report([x, y, z], [a, b, c], out);
        }),
        whole(&texels, count, |[x, y, z, a, b, c, ..], out| batch::normals_rotation_fixed([x, y, z], [a, b, c], out)),
    ];
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 200));
    let cost = |method, single: usize, batch: Option<usize>| Cost {
        method,
        single: times[single],
        batch: batch.map(|batch| times[batch]),
        texels: count,
    };
    vec![
        cost("tbn", 0, Some(4)),
        cost("tbn_derivative", 1, None),
        cost("rotation_report", 2, Some(5)),
        cost("rotation_fixed", 3, Some(6)),
    ]
}

/// Each method on each normal: the largest and the mean square of the table's lines.
fn methods(effort: Effort) -> Vec<Row> {
    let costs = costs(effort);
    let mut rows: Vec<Row> = Vec::new();
    let mut tilts = 0.0;
    for line in ANGLES.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [normal, method, _, _, rms, max] = fields[..] else { continue };
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        let domain = format!("normal {normal}, texels of tilt 0..85 deg, all azimuths; angle to the truth in degrees");
        if rows.last().is_none_or(|row| row.method != method || row.domain != domain) {
            let mut row = Row::new("normal", method, &domain);
            row.note = Some(FROM_TABLE.to_owned());
            row.points = Some(if normal == "sphere" { 60 * TABLE_POINTS } else { TABLE_POINTS });
            if let Some(cost) = costs.iter().find(|cost| cost.method == method) {
                row.take_time(cost.single, cost.texels);
                cost.batch.into_iter().for_each(|time| row.take_batch_time(time, cost.texels));
            }
            rows.push(row);
            tilts = 0.0;
        }
        let Some(row) = rows.last_mut() else { continue };
        if row.error_max.is_none_or(|known| number(max) > known) {
            row.error_max = Some(number(max));
        }
        let squares = row.error_rms.map_or(0.0, |rms| rms * rms * tilts);
        tilts += 1.0;
        row.error_rms = Some(((squares + number(rms) * number(rms)) / tilts).sqrt());
    }
    rows.par_iter_mut().for_each(search_between);
    rows
}

/// What the table has of a normal: tilts 0, 5, ... 85 degrees, azimuths 0, 1, ... 359.
const TABLE_POINTS: u64 = 18 * 360;

/// How a normal map's texel becomes a direction, on a surface with this normal and tangent.
type Turned = fn([f64; 3], [f64; 3], [f64; 3]) -> [f64; 3];

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

const TURNED: [(&str, Turned); 4] = [
    ("tbn", |texel, normal, [x, y, z]| normal_tbn(texel, normal, [x, y, z, 1.0])),
    ("tbn_derivative", |texel, normal, tangent| {
        // The screen that the table has, which looks at the surface askew.
        let bitangent = cross(normal, tangent);
        let along = |a: f64, b: f64| std::array::from_fn(|k| a * tangent[k] + b * bitangent[k]);
        normal_tbn_derivative(texel, along(0.01, 0.002), along(-0.004, 0.03), normal, [0.01, -0.002], [-0.004, -0.03])
    }),
    ("rotation_report", |texel, normal, _| normal_rotation_report(texel, normal)),
    ("rotation_fixed", |texel, normal, _| normal_rotation_fixed(texel, normal)),
];

/// The normal and tangent of a picture that hangs upright, or lies with its top to the back.
const FRAMES: [(&str, [[f64; 3]; 2]); 4] = [
    ("+Z", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
    ("+X", [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]),
    ("+Y", [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
    ("-Z", [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]]),
];

/// The angle between what a method makes of a texel of this tilt and azimuth [deg] and what the texel says.
fn angle(turned: Turned, [normal, tangent]: [[f64; 3]; 2], tilt: f64, azimuth: f64) -> f64 {
    let ((sine, cosine), (sin, cos)) = (tilt.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    let (texel, bitangent) = ([sine * cos, sine * sin, cosine], cross(normal, tangent));
    let truth = std::array::from_fn(|k| texel[0] * tangent[k] + texel[1] * bitangent[k] + texel[2] * normal[k]);
    degrees_between(turned(texel, normal, tangent), truth)
}

/// Searches for a larger angle between the tilts and azimuths of the table, on a sphere between its normals, too; and says where it is.
fn search_between(row: &mut Row) {
    let Some(&(_, turned)) = TURNED.iter().find(|(name, _)| *name == row.method) else { return };
    let named = |name: &str| row.domain.starts_with(&format!("normal {name},"));
    let fixed = FRAMES.iter().find(|(name, _)| named(name)).map(|(_, frame)| *frame);
    // A picture is around a sphere: its tangent runs along the equator.
    let frame = |s: f64, t: f64| {
        fixed.unwrap_or_else(|| {
            let (y, (sin, cos)) = (2.0 * s - 1.0, (std::f64::consts::TAU * t).sin_cos());
            let sine = (1.0 - y * y).max(0.0).sqrt();
            [[sine * sin, y, sine * cos], [cos, 0.0, -sin]]
        })
    };
    let of = |[tilt, azimuth, s, t]: [f64; 4]| (frame(s, t), 85.0 * tilt, 360.0 * azimuth);
    let error = |place: [f64; 4]| {
        let (frame, tilt, azimuth) = of(place);
        angle(turned, frame, tilt, azimuth)
    };
    let drawn = (0..1 << 13).map(search::place).map(|place| (place, error(place)));
    let worst = CHEAP.worst(drawn, error);
    row.searched = true;
    let Some(&(place, most)) = worst.first() else { return };
    let ([normal, tangent], tilt, azimuth) = of(place);
    let surface = match fixed {
        Some(_) => String::new(),
        None => format!(", normal = {normal:?}, tangent = {tangent:?}"),
    };
    row.at = Some(format!("tilt = {tilt:?} deg, azimuth = {azimuth:?} deg{surface}"));
    // What is less is rounding, and the table has none.
    if most > 1e-6 {
        row.error_max = row.error_max.map(|known| known.max(most));
    }
}

/// Blends of a base of slopes up to 1.3 with a detail of slopes up to 0.7, against the normal of the sum of the slopes.
fn blends(effort: Effort) -> Vec<Row> {
    const DOMAIN: &str = "base slopes to 1.3, detail slopes to 0.7; angle to the sum of the heights in degrees";
    type Blend = fn([f32; 3], [f32; 3]) -> [f32; 3];
    const BLENDS: [(&str, Blend); 5] = [
        ("rnm", blend_rnm),
        ("partial_derivatives", blend_partial_derivatives),
        ("whiteout", blend_whiteout),
        ("udn", blend_udn),
        ("linear", blend_linear),
    ];
    let count = effort.pick(1 << 12, 1 << 14);
    // Slopes of the base and of the detail.
    let slopes = |[a, b, c, d]: [f64; 4]| {
        [1.3 * (2.0 * a - 1.0), 1.3 * (2.0 * b - 1.0), 0.7 * (2.0 * c - 1.0), 0.7 * (2.0 * d - 1.0)].map(|x| x as f32)
    };
    let normals = |place: [f64; 4]| {
        let [a, b, c, d] = slopes(place);
        (normal_from_slopes(a, b), normal_from_slopes(c, d))
    };
    // Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
    let place = |k: usize| {
        [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_865, 0.538_597_257_223_612]
            .map(|step| (0.5 + step * k as f64).fract())
    };
    let pairs: Vec<_> = (0..count).map(|k| normals(place(k))).collect();
    let mut runs: Vec<_> = BLENDS
        .iter()
        .map(|(_, blend)| |_| pairs.iter().map(|&(base, detail)| f64::from(blend(base, detail)[0])).sum::<f64>())
        .collect();
    let mut candidates: Vec<_> = runs.iter_mut().map(|run| run as Candidate<'_>).collect();
    let times = measured(&mut candidates, effort.pick(20, 200));
    let row = |(&(name, blend), time): (&(&str, Blend), Time)| {
        let angle = |place: [f64; 4]| {
            let (base, detail) = normals(place);
            let [a, b, c, d] = slopes(place).map(f64::from);
            degrees_between(blend(base, detail).map(f64::from), normal_from_slopes(a + c, b + d))
        };
        let at = |place: [f64; 4]| named(&[("base slopes", 2), ("detail slopes", 2)], &slopes(place));
        let mut row = Row::new("normal_blend", name, DOMAIN);
        CHEAP.errors((0..effort.pick(1 << 14, 1 << 16)).map(place), angle, at).fill(&mut row);
        row.take_time(time, count);
        row
    };
    BLENDS.par_iter().zip(times).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::inputs;

    /// What a row says of its largest error can be put in again, and gives it.
    #[test]
    fn the_largest_angle_is_where_its_row_says() {
        for row in methods(Effort::Quick) {
            let said = inputs(row.at.as_deref().expect("a place"));
            let of = |name: &str| said.iter().find(|(own, _)| own == name).map(|(_, numbers)| numbers.clone());
            let vector = |name: &str| of(name).map(|numbers| [numbers[0], numbers[1], numbers[2]]);
            let fixed = FRAMES.iter().find(|(name, _)| row.domain.starts_with(&format!("normal {name},")));
            let frame =
                fixed.map_or_else(|| ["normal", "tangent"].map(|name| vector(name).expect("of a sphere")), |f| f.1);
            let (_, turned) = TURNED.iter().find(|(name, _)| *name == row.method).expect("a method");
            let [tilt, azimuth] = ["tilt", "azimuth"].map(|name| of(name).expect("an angle")[0]);
            let found = angle(*turned, frame, tilt, azimuth);
            let most = row.error_max.expect("an error");
            assert!((found - most).abs() <= 1e-6 + 1e-9 * most, "{found}, but {row:?}");
        }
    }

    #[test]
    fn every_method_has_a_row_on_every_normal() {
        let rows = methods(Effort::Quick);
        assert_eq!(rows.len(), 20);
        assert!(rows.iter().all(|r| r.error_max >= r.error_rms && r.cost_ns.is_some()), "{rows:?}");
        let tbn = rows.iter().find(|r| r.method == "tbn").expect("a row");
        assert!(tbn.error_max < Some(1e-5));
        assert!(blends(Effort::Quick).iter().any(|r| r.method == "partial_derivatives" && r.error_max < Some(1e-3)));
    }
}
