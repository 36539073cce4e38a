//! Points where the narrow arithmetic is farthest from f64, looked for along each input, close to each other, and then closer.

use halfvector_interp::Float;

use crate::stability::StabilityError;
use crate::stability::domain::{POINTS, Points, Precision, Random, Source};
use crate::stability::effort::Effort;
use crate::stability::trace::Trace;

/// Fewest and most points along an input: the most are half a thousandth apart between two whole texture coordinates.
const LINE: [usize; 2] = [256, 4096];

/// Points of each value that are kept.
const KEPT: usize = 4;

/// Values that are looked at closer, those that are farthest off in parts of their tolerance.
const CLOSER: usize = 48;

/// Points that are tried around the worst of a value, from as far as its neighbours to 2^-16 of that.
const TRIES: usize = 32;

/// How often.
const ROUNDS: usize = 3;

/// How far a value is off at a point, in parts of its tolerance.
struct Worst {
    off: f64,
    at: Vec<f64>,
    /// The input along which the point was found, and how far its neighbours are.
    along: (usize, f64),
}

/// Points to judge: the worst of each value. `rms`: of each output. `sets`: points of the domain.
pub(super) fn search<F: Float>(
    trace: &Trace<'_>,
    precision: Precision,
    sets: &[Points],
    rms: &[f64],
    effort: Effort,
    random: &mut Random,
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let inputs = &trace.inputs;
    let ways: Vec<(usize, [f64; 2])> = inputs
        .iter()
        .enumerate()
        .filter_map(|(number, input)| input.is_float().then_some((number, input.range()?)))
        .collect();
    // In both precisions; what is left is for the closer points.
    let most = effort.dense * 2 / 3 / 2;
    let line = (most / ways.len().max(1)).clamp(LINE[0], LINE[1]);
    let mut worst: Vec<Vec<Worst>> = trace.values.iter().map(|_| Vec::new()).collect();
    for (way, (number, [from, to])) in ways.into_iter().enumerate() {
        let set = &sets[way % sets.len()];
        let base = set.point(((random.unit() * POINTS as f64) as usize).min(POINTS - 1));
        let offset = random.unit();
        let is_uv = matches!(inputs[number].source, Source::Range { is_uv: true, .. });
        // Half of the texture coordinates' points stand between 0 and 1.
        let parts = if is_uv { vec![[0.0, 1.0], [from, to]] } else { vec![[from, to]] };
        for [from, to] in parts.iter().copied() {
            let count = line / parts.len();
            let step = (to - from) / count as f64;
            let rows: Vec<Vec<f64>> = (0..count)
                .map(|k| {
                    let mut point = base.clone();
                    point[number] = precision.rounded(from + step * (k as f64 + offset)).clamp(from, to);
                    point
                })
                .collect();
            let points = Points::of(inputs, rows.iter().map(Vec::as_slice));
            let off = off::<F>(trace, precision, &points, rms)?;
            for (worst, off) in worst.iter_mut().zip(off) {
                for (row, off) in rows.iter().zip(off) {
                    keep(worst, off, row, (number, step));
                }
            }
        }
    }
    let values = (effort.dense / 3 / (2 * TRIES * ROUNDS)).min(CLOSER);
    closer::<F>(trace, precision, rms, &mut worst, values, random)?;
    Ok(worst.into_iter().flatten().filter(|worst| worst.off > 1.0).map(|worst| worst.at).collect())
}

/// Looks around the points where values are farthest off.
fn closer<F: Float>(
    trace: &Trace<'_>,
    precision: Precision,
    rms: &[f64],
    worst: &mut [Vec<Worst>],
    most: usize,
    random: &mut Random,
) -> Result<(), StabilityError> {
    let mut values: Vec<usize> =
        (0..worst.len()).filter(|value| worst[*value].first().is_some_and(|worst| worst.off.is_finite())).collect();
    values.sort_by(|a, b| worst[*b][0].off.total_cmp(&worst[*a][0].off));
    values.truncate(most);
    for _ in 0..ROUNDS {
        let mut rows = Vec::with_capacity(TRIES * values.len());
        for value in &values {
            let Worst { at, along: (number, step), .. } = &worst[*value][0];
            let [from, to] = trace.inputs[*number].range().unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            for k in 0..TRIES {
                let radius = step * 0.5_f64.powf(k as f64 * 0.5);
                let mut point = at.clone();
                let x = point[*number] + radius * (2.0 * random.unit() - 1.0);
                point[*number] = precision.rounded(x).clamp(from, to);
                rows.push(point);
            }
        }
        let points = Points::of(&trace.inputs, rows.iter().map(Vec::as_slice));
        let off = off::<F>(trace, precision, &points, rms)?;
        for (number, value) in values.iter().enumerate() {
            let along = worst[*value][0].along;
            for k in number * TRIES..(number + 1) * TRIES {
                keep(&mut worst[*value], off[*value][k], &rows[k], along);
            }
        }
    }
    Ok(())
}

/// Takes a point among the worst ones.
fn keep(worst: &mut Vec<Worst>, off: f64, at: &[f64], along: (usize, f64)) {
    if off > 0.0 && (worst.len() < KEPT || worst.last().is_some_and(|last| last.off < off)) {
        let place = worst.partition_point(|other| other.off >= off);
        worst.insert(place, Worst { off, at: at.to_vec(), along });
        worst.truncate(KEPT);
    }
}

/// How far each value is off at each point.
fn off<F: Float>(
    trace: &Trace<'_>,
    precision: Precision,
    points: &Points,
    rms: &[f64],
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let (narrow, exact) = (trace.run::<F>(points)?, trace.run::<f64>(points)?);
    let of = |value: usize| {
        let off = |(narrow, exact): (&f64, &f64)| {
            let off = (narrow - exact).abs();
            // What is no number in both is judged, too.
            if off.is_nan() {
                return f64::INFINITY;
            }
            // An output that is 0 everywhere else has no tolerance.
            let tolerance = precision.tolerance() * exact.abs().max(rms[trace.values[value].group]);
            if off == 0.0 { 0.0 } else { off / tolerance }
        };
        narrow[value].iter().zip(&exact[value]).map(off).collect()
    };
    Ok((0..trace.values.len()).map(of).collect())
}
