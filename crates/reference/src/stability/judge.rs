//! What is unstable, what is an edge, and which node it began at.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_graph::document::{Document, NodeId};
use halfvector_interp::{Float, Half};

use crate::stability::domain::{POINTS, Precision, Random, SETTINGS, contexts, setting};
use crate::stability::trace::{Trace, Value};
use crate::stability::{Finding, Stability, StabilityError};

/// How many times the change of f64 within [`ULPS`] an error may be.
const FACTOR: f64 = 8.0;

/// How far neighbours lie in units of the last place of the precision.
const ULPS: f64 = 2.0;

/// Neighbours of each point.
const NEIGHBOURS: usize = 8;

/// Points at which one output is looked at closely.
const SUSPECTS: usize = 16;

/// Neighbours that are tried when a jump is looked for.
const TRIES: usize = 96;

/// Parts that the way across a jump is cut in, again and again: five times make 2^-35 of the way.
const PARTS: usize = 127;

/// How often.
const ROUNDS: usize = 5;

/// A point at which an output is wrong.
#[derive(Clone, Copy, Debug)]
struct Suspect {
    value: usize,
    setting: usize,
    point: usize,
    narrow: f64,
    exact: f64,
    tolerance: f64,
}

impl Suspect {
    fn error(&self) -> f64 {
        let error = (self.narrow - self.exact).abs();
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// How often a value is at the ends of the range.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    not_finite: usize,
    underflows: usize,
    beyond_f16: usize,
}

pub(super) fn judge(trace: &Trace<'_>, precision: Precision) -> Result<Stability, StabilityError> {
    match precision {
        Precision::Single => judge_in::<f32>(trace, precision),
        Precision::Half => judge_in::<Half>(trace, precision),
    }
}

fn judge_in<F: Float>(trace: &Trace<'_>, precision: Precision) -> Result<Stability, StabilityError> {
    let mut random = Random::new(1);
    let mut domains = Vec::new();
    let settings = if trace.parameters.is_empty() { 1 } else { SETTINGS };
    for number in 0..settings {
        domains.push((contexts(trace, precision, &mut random), setting(trace, precision, number, &mut random)));
    }
    let mut counts = vec![Counts::default(); trace.values.len()];
    let mut suspects: BTreeMap<usize, Vec<Suspect>> = BTreeMap::new();
    for (number, (points, parameters)) in domains.iter().enumerate() {
        let narrow = trace.run::<F>(points, POINTS, parameters)?;
        let exact = trace.run::<f64>(points, POINTS, parameters)?;
        let change = change(trace, precision, points, parameters, &exact, &mut random)?;
        let rms = rms(&trace.values, &exact);
        for value in 0..trace.values.len() {
            for point in 0..POINTS {
                let (narrow, exact) = (narrow[value][point], exact[value][point]);
                let count = &mut counts[value];
                count.not_finite += usize::from(exact.is_finite() && !narrow.is_finite());
                count.underflows += usize::from(exact != 0.0 && narrow.abs() < precision.least_normal());
                count.beyond_f16 += usize::from(exact.abs() > 65504.0);
                let tolerance = precision.tolerance() * exact.abs().max(rms[trace.values[value].group]);
                let suspect = Suspect { value, setting: number, point, narrow, exact, tolerance };
                let allowed = FACTOR * change[value][point] + tolerance;
                if exact.is_finite() && (!narrow.is_finite() || suspect.error() > allowed) {
                    suspects.entry(value).or_default().push(suspect);
                }
            }
        }
    }
    let mut stability = Stability::default();
    let (mut unstable, mut edges) = (BTreeMap::new(), BTreeMap::new());
    for (value, mut all) in suspects {
        all.sort_by(|a, b| b.error().total_cmp(&a.error()));
        let mut worst = None;
        // From the worst to the least, evenly: the worst ones alone may all stand at jumps.
        let step = all.len().div_ceil(SUSPECTS).max(1);
        for suspect in all.iter().step_by(step) {
            let (points, parameters) = &domains[suspect.setting];
            if !suspect.narrow.is_finite() || !is_edge(trace, precision, points, parameters, suspect, &mut random)? {
                worst = Some(*suspect);
                break;
            }
        }
        let (list, suspect) = match worst {
            Some(suspect) => (&mut unstable, suspect),
            None => (&mut edges, all[0]),
        };
        let finding = finding(trace, &domains[suspect.setting], &suspect, counts[value]);
        let kept = list.entry(finding.node.clone()).or_insert_with(|| finding.clone());
        if finding.error() > kept.error() {
            *kept = finding;
        }
    }
    let wrong: BTreeSet<NodeId> = unstable.keys().cloned().collect();
    stability.unstable = unstable.into_values().filter(|f| !has_source(&trace.flat, &f.node, &wrong)).collect();
    let jumping: BTreeSet<NodeId> = edges.keys().chain(&wrong).cloned().collect();
    stability.edges = edges
        .into_values()
        .filter(|f| !wrong.contains(&f.node) && !has_source(&trace.flat, &f.node, &jumping))
        .collect();
    Ok(stability)
}

/// The largest change of each value between each point and its neighbours.
fn change(
    trace: &Trace<'_>,
    precision: Precision,
    points: &[Vec<f64>],
    parameters: &[Vec<f32>],
    exact: &[Vec<f64>],
    random: &mut Random,
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let mut change = vec![vec![0.0_f64; POINTS]; exact.len()];
    for _ in 0..NEIGHBOURS {
        let mut near = points.to_vec();
        near.iter_mut().flatten().for_each(|x| *x = precision.moved(*x, ULPS * (2.0 * random.unit() - 1.0).round()));
        for (value, there) in trace.run::<f64>(&near, POINTS, parameters)?.into_iter().enumerate() {
            for (point, there) in there.into_iter().enumerate() {
                let difference = (there - exact[value][point]).abs();
                if difference > change[value][point] {
                    change[value][point] = difference;
                }
            }
        }
    }
    Ok(change)
}

/// The rms of each output, all components together.
fn rms(values: &[Value], exact: &[Vec<f64>]) -> Vec<f64> {
    let groups = values.last().map_or(0, |value| value.group + 1);
    let mut sums = vec![(0.0, 0.0); groups];
    for (value, numbers) in values.iter().zip(exact) {
        let (sum, count) = &mut sums[value.group];
        for x in numbers.iter().filter(|x| x.is_finite()) {
            *sum += x * x;
            *count += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count): (f64, f64)| (sum / count.max(1.0)).sqrt()).collect()
}

/// Whether f64 jumps beside a point to what the narrow arithmetic gives at it.
fn is_edge(
    trace: &Trace<'_>,
    precision: Precision,
    points: &[Vec<f64>],
    parameters: &[Vec<f32>],
    suspect: &Suspect,
    random: &mut Random,
) -> Result<bool, StabilityError> {
    let at: Vec<f64> = points.iter().map(|column| column[suspect.point]).collect();
    // Ever farther, from less than an ulp.
    let mut tries: Vec<Vec<f64>> = vec![Vec::with_capacity(TRIES); at.len()];
    for number in 0..TRIES {
        let radius = precision.reach() * 0.5_f64.powf((TRIES - 1 - number) as f64 / 8.0);
        for (column, x) in tries.iter_mut().zip(&at) {
            column.push(x + radius * x.abs().max(1.0) * (2.0 * random.unit() - 1.0));
        }
    }
    let there = trace.run::<f64>(&tries, TRIES, parameters)?;
    let alike = |x: f64| (x - suspect.narrow).abs() <= 0.1 * suspect.error() + suspect.tolerance;
    let Some(found) = (0..TRIES).find(|&number| alike(there[suspect.value][number])) else { return Ok(false) };
    let mut ends = [at, tries.iter().map(|column| column[found]).collect::<Vec<f64>>()];
    let mut jump = f64::INFINITY;
    for _ in 0..ROUNDS {
        // All points of a round are one batch of the interpreter.
        let part = |a: f64, b: f64, number: usize| a + (b - a) * number as f64 / PARTS as f64;
        let on_the_way = |(a, b): (&f64, &f64)| (0..=PARTS).map(|number| part(*a, *b, number)).collect();
        let columns: Vec<Vec<f64>> = ends[0].iter().zip(&ends[1]).map(on_the_way).collect();
        let numbers = trace.run::<f64>(&columns, PARTS + 1, parameters)?.swap_remove(suspect.value);
        let step = |number: &usize| (numbers[number + 1] - numbers[*number]).abs();
        let Some(largest) = (0..PARTS).max_by(|a, b| step(a).total_cmp(&step(b))) else { return Ok(false) };
        jump = step(&largest);
        ends = [largest, largest + 1].map(|number| columns.iter().map(|column| column[number]).collect());
    }
    Ok(jump > 0.5 * suspect.error())
}

/// Whether one of some nodes feeds a node, at any distance.
fn has_source(document: &Document, node: &NodeId, of: &BTreeSet<NodeId>) -> bool {
    let mut open = vec![node];
    let mut seen = BTreeSet::new();
    while let Some(at) = open.pop() {
        for link in document.graph.links.iter().filter(|link| link.to.node == *at) {
            if of.contains(&link.from.node) {
                return true;
            }
            if seen.insert(&link.from.node) {
                open.push(&link.from.node);
            }
        }
    }
    false
}

fn finding(
    trace: &Trace<'_>,
    (points, parameters): &(Vec<Vec<f64>>, Vec<Vec<f32>>),
    suspect: &Suspect,
    counts: Counts,
) -> Finding {
    let Value { node, label, output, .. } = trace.values[suspect.value].clone();
    let contexts = trace
        .inputs()
        .zip(points)
        .map(|(name, column)| (name.strip_prefix("context.").unwrap_or(name).to_owned(), column[suspect.point]));
    let set = trace.parameters.iter().zip(parameters).flat_map(|(parameter, numbers)| {
        let name = |i: usize| if numbers.len() == 1 { String::new() } else { format!(".{}", ["x", "y", "z", "w"][i]) };
        numbers.iter().enumerate().map(move |(i, x)| (format!("{}{}", parameter.name, name(i)), f64::from(*x)))
    });
    Finding {
        node,
        label,
        output,
        narrow: suspect.narrow,
        exact: suspect.exact,
        input: contexts.chain(set).collect(),
        not_finite: counts.not_finite,
        underflows: counts.underflows,
        beyond_f16: counts.beyond_f16,
    }
}
