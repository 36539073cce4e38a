//! What is unstable, what is an edge, and which node it began at.

use std::collections::{BTreeMap, BTreeSet};

use halfvector_graph::document::NodeId;
use halfvector_interp::Float;

use crate::stability::constant::gives_surface;
use crate::stability::critical::{self, Critical};
use crate::stability::dense;
use crate::stability::domain::{POINTS, Points, Precision, Random, Source, domain};
use crate::stability::edge::{self, Jump, Wrong};
use crate::stability::effort::Effort;
use crate::stability::trace::{Trace, Value};
use crate::stability::wiring::Wiring;
use crate::stability::{Edge, Finding, Stability, StabilityError};

/// How many times the change of f64 within [`ULPS`] an error may be.
const FACTOR: f64 = 8.0;

/// How far neighbours lie in units of the last place of the precision.
const ULPS: f64 = 2.0;

/// Neighbours of each point, that far away.
const NEIGHBOURS: usize = 8;

/// Neighbours anywhere within that distance, of points that seem wrong: what goes up and down within it may be the same at its ends.
const WITHIN: usize = 32;

/// Points at which one output is looked at closely.
const SUSPECTS: usize = 16;

/// Points at which it is tried what an output depends on.
const PROBES: usize = 64;

/// The size of a constant below which an error is measured against this size: what is left when constants that are alike are
/// subtracted is no fault before it matters beside 1.
const LEAST_CONSTANT: f64 = 1e-4;

/// A point at which an output is wrong.
#[derive(Clone, Copy, Debug)]
struct Suspect {
    value: usize,
    set: usize,
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

    fn wrong(&self, sets: &[Points]) -> Wrong {
        Wrong {
            value: self.value,
            at: sets[self.set].point(self.point),
            narrow: self.narrow,
            error: self.error(),
            tolerance: self.tolerance,
        }
    }
}

/// How often a value is at the ends of the range.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    nan: usize,
    infinite: usize,
    underflows: usize,
    beyond_f16: usize,
}

impl Counts {
    fn take(&mut self, precision: Precision, narrow: f64, exact: f64) {
        let is_nan = narrow.is_nan() || exact.is_nan();
        self.nan += usize::from(is_nan);
        self.infinite += usize::from(!is_nan && (narrow.is_infinite() || exact.is_infinite()));
        self.underflows += usize::from(exact != 0.0 && exact.abs() < precision.least_normal());
        self.beyond_f16 += usize::from(exact.abs() > 65504.0);
    }
}

/// What is seen at all points, by value.
#[derive(Debug, Default)]
struct Tally {
    counts: Vec<Counts>,
    /// Largest rms of each output.
    rms: Vec<f64>,
    /// The narrow arithmetic is wrong.
    suspects: BTreeMap<usize, Vec<Suspect>>,
    /// It is wrong by more than the tolerance, but exact arithmetic changes as much nearby: the worst.
    excused: BTreeMap<usize, Suspect>,
    /// Not finite in exact arithmetic, where all that the node is fed is.
    makers: BTreeMap<usize, Suspect>,
    /// Nodes that are not finite somewhere.
    not_finite: BTreeSet<NodeId>,
}

/// Where the points of a set come from.
enum Chosen<'j> {
    /// They are spread over the domain.
    Domain,
    /// Something may be wrong there.
    Searched,
    /// They lie at poles or the next number beside them, where f32 cannot be near: only what is not finite counts.
    Poles,
    /// They lie at jumps, of each point the jump: there its node alone is judged, since those behind it may have been fed the
    /// other side.
    Beside(&'j [&'j Jump]),
}

impl Chosen<'_> {
    fn jump(&self, point: usize) -> Option<&Jump> {
        match self {
            Chosen::Domain | Chosen::Searched | Chosen::Poles => None,
            Chosen::Beside(jumps) => Some(jumps[point]),
        }
    }
}

/// Some rows of columns.
fn part(columns: &[Vec<f64>], rows: &[usize]) -> Vec<Vec<f64>> {
    columns.iter().map(|column| rows.iter().map(|row| column[*row]).collect()).collect()
}

/// `live`: the material with its constant nodes, where it has such, and which those are.
pub(super) fn judge<F: Float>(
    trace: &Trace<'_>,
    live: Option<&(Trace<'_>, BTreeSet<NodeId>)>,
    precision: Precision,
) -> Result<Stability, StabilityError> {
    let mut random = Random::new(1);
    let mut sets = domain(&trace.inputs, precision, &mut random);
    let wiring = Wiring::new(trace);
    let fed = wiring.fed();
    let fed: Vec<&[usize]> = trace.values.iter().map(|value| fed[&value.node].as_slice()).collect();
    let mut tally = Tally { counts: vec![Counts::default(); trace.values.len()], ..Tally::default() };
    let settings = sets.len();
    for (set, points) in sets.iter().enumerate() {
        tally.take::<F>(trace, precision, &fed, (set, points), &Chosen::Domain, &mut random)?;
    }
    let jumps = edge::search(trace, &wiring, precision, &sets, &tally.rms, &mut random)?;
    let effort = Effort::of(trace);
    let Critical { poles, around: mut points, sides } = critical::search(trace, precision, &sets, effort, &mut random)?;
    points.extend(dense::search::<F>(trace, precision, &sets, &tally.rms, effort, &mut random)?);
    for (points, chosen) in [(points, Chosen::Searched), (poles, Chosen::Poles)] {
        for points in points.chunks(POINTS) {
            let points = Points::of(&trace.inputs, points.iter().map(Vec::as_slice));
            tally.take::<F>(trace, precision, &fed, (sets.len(), &points), &chosen, &mut random)?;
            sets.push(points);
        }
    }
    let mut jumps = edge::decided(trace, &wiring, &sides, &tally.rms, jumps)?;
    if !jumps.is_empty() {
        let (points, of) = edge::both_sides(&trace.inputs, precision, &jumps);
        let jump_at: Vec<&Jump> = of.iter().map(|number| &jumps[*number]).collect();
        tally.take::<F>(trace, precision, &fed, (sets.len(), &points), &Chosen::Beside(&jump_at), &mut random)?;
        sets.push(points);
    }
    // What remains when edges are excused.
    let mut worst: Vec<Suspect> = Vec::new();
    for all in tally.suspects.values_mut() {
        all.sort_by(|a, b| b.error().total_cmp(&a.error()));
        // From the worst to the least, evenly: the worst ones alone may all stand at jumps.
        let step = all.len().div_ceil(SUSPECTS).max(1);
        let mut kept = None;
        for suspect in all.iter().step_by(step) {
            let jump = if suspect.narrow.is_finite() {
                edge::beside(trace, precision, &suspect.wrong(&sets), &mut random)?
            } else {
                None
            };
            match jump {
                Some(jump) => kept = kept.or(Some(jump)),
                None => {
                    worst.push(*suspect);
                    kept = None;
                    break;
                }
            }
        }
        jumps.extend(kept);
    }
    for (value, suspect) in &tally.excused {
        if !tally.suspects.contains_key(value) && !jumps.iter().any(|jump| jump.value == *value) {
            jumps.extend(edge::beside(trace, precision, &suspect.wrong(&sets), &mut random)?);
        }
    }
    let constants = match live {
        Some((live, constant)) => constants::<F>(live, constant, precision)?,
        None => Vec::new(),
    };
    let wrong: BTreeSet<NodeId> = worst
        .iter()
        .map(|suspect| trace.values[suspect.value].node.clone())
        .chain(constants.iter().map(|finding| finding.node.clone()))
        .collect();
    let reads = if worst.is_empty() && tally.makers.is_empty() && jumps.is_empty() {
        Vec::new()
    } else {
        reads::<F>(trace, precision, &sets[settings - 1], &mut random)?
    };
    let is_first = |node: &NodeId| !wiring.has_source(node, &wrong);
    let spoiled = worst.iter().filter(|suspect| is_first(&trace.values[suspect.value].node));
    let found = spoiled.chain(tally.makers.values()).map(|suspect| {
        let is_read = |input: usize| reads[input][suspect.value];
        let input = input(trace, is_read, &sets[suspect.set].point(suspect.point));
        finding(&trace.values[suspect.value], suspect, tally.counts[suspect.value], input)
    });
    let mut unstable: BTreeMap<NodeId, Finding> = BTreeMap::new();
    for finding in constants.into_iter().filter(|finding| is_first(&finding.node)).chain(found) {
        let kept = unstable.entry(finding.node.clone()).or_insert_with(|| finding.clone());
        if finding.error() > kept.error() {
            *kept = finding;
        }
    }
    let is_surface = |node: &&NodeId| {
        let def = trace.flat.graph.nodes.get(*node).and_then(|node| trace.library.get(&node.node));
        def.is_some_and(gives_surface)
    };
    let named: BTreeSet<NodeId> = unstable.keys().cloned().collect();
    let unnamed: BTreeSet<&NodeId> = wrong.union(&tally.not_finite).filter(|node| !named.contains(*node)).collect();
    for finding in unstable.values_mut() {
        let first = BTreeSet::from([finding.node.clone()]);
        // A surface only gathers what it is fed.
        let behind = unnamed.iter().copied().filter(|node| !is_surface(node) && wiring.has_source(node, &first));
        finding.behind = behind.cloned().collect();
    }
    let mut edges: BTreeMap<NodeId, Jump> = BTreeMap::new();
    for jump in jumps {
        let node = &trace.values[jump.value].node;
        if edges.get(node).is_none_or(|kept| kept.height() < jump.height()) {
            edges.insert(node.clone(), jump);
        }
    }
    let jumping: BTreeSet<NodeId> = edges.keys().chain(&wrong).cloned().collect();
    edges.retain(|node, _| !wrong.contains(node) && !named.contains(node) && !wiring.has_source(node, &jumping));
    let edge = |jump: Jump| {
        let Value { node, label, output, .. } = trace.values[jump.value].clone();
        let at: Vec<f64> =
            trace.inputs.iter().zip(&jump.before).map(|(input, x)| input.rounded(precision, *x)).collect();
        let causes = edge::causes(trace, &jump)?;
        let input = input(trace, |input| causes[input] || reads[input][jump.value], &at);
        Ok(Edge { node, label, output, from: jump.from, to: jump.to, input })
    };
    let edges = edges.into_values().map(edge).collect::<Result<_, _>>()?;
    Ok(Stability { unstable: unstable.into_values().collect(), edges })
}

impl Tally {
    /// Looks at the points of a set. `fed`: the values that each value's node is fed.
    fn take<F: Float>(
        &mut self,
        trace: &Trace<'_>,
        precision: Precision,
        fed: &[&[usize]],
        (set, points): (usize, &Points),
        chosen: &Chosen<'_>,
        random: &mut Random,
    ) -> Result<(), StabilityError> {
        let narrow = trace.run::<F>(points)?;
        let exact = trace.run::<f64>(points)?;
        let is_pole = matches!(chosen, Chosen::Poles);
        // What was searched for says little of how large an output is.
        let rms = if let Chosen::Domain = chosen { rms(&trace.values, &exact) } else { self.rms.clone() };
        let tolerance = |value: usize, x: f64| precision.tolerance() * x.abs().max(rms[trace.values[value].group]);
        // How much exact arithmetic changes nearby is asked for where there is something to excuse.
        let is_off = |point: &usize| {
            let is_off = |value: usize| {
                let exact = exact[value][*point];
                (narrow[value][*point] - exact).abs() > tolerance(value, exact)
            };
            !is_pole && (0..trace.values.len()).any(is_off)
        };
        let off: Vec<usize> = (0..points.count).filter(is_off).collect();
        let mut row = vec![0; points.count];
        off.iter().enumerate().for_each(|(number, point)| row[*point] = number);
        let at_off = part(&exact, &off);
        let mut change = change(trace, precision, &points.of_numbers(&off), &at_off, random)?;
        let beyond = |value: usize, point: usize| match chosen.jump(point) {
            // The other side is an ulp away.
            Some(jump) if jump.value == value => jump.height(),
            _ => 0.0,
        };
        let seems_wrong = |&number: &usize| {
            let point = off[number];
            (0..trace.values.len()).any(|value| {
                let there = exact[value][point];
                let error = (narrow[value][point] - there).abs();
                error > FACTOR * change[value][number].max(beyond(value, point)) + tolerance(value, there)
            })
        };
        let wrong: Vec<usize> = (0..off.len()).filter(seems_wrong).collect();
        let wrong_points: Vec<usize> = wrong.iter().map(|number| off[*number]).collect();
        let closer = change_within(trace, precision, &points.of_numbers(&wrong_points), &part(&at_off, &wrong))?;
        for (change, closer) in change.iter_mut().zip(&closer) {
            wrong.iter().zip(closer).for_each(|(number, closer)| change[*number] = change[*number].max(*closer));
        }
        self.rms.resize(rms.len(), 0.0);
        self.rms.iter_mut().zip(&rms).for_each(|(most, rms)| *most = most.max(*rms));
        for (value, Value { node, .. }) in trace.values.iter().enumerate() {
            for point in 0..points.count {
                if chosen.jump(point).is_some_and(|jump| trace.values[jump.value].node != *node) {
                    continue;
                }
                let (narrow, there) = (narrow[value][point], exact[value][point]);
                self.counts[value].take(precision, narrow, there);
                let tolerance = tolerance(value, there);
                let suspect = Suspect { value, set, point, narrow, exact: there, tolerance };
                if !there.is_finite() {
                    self.not_finite.insert(node.clone());
                    if fed[value].iter().all(|from| exact[*from][point].is_finite()) {
                        let kept = self.makers.entry(value).or_insert(suspect);
                        if kept.narrow.is_finite() && !narrow.is_finite() {
                            *kept = suspect;
                        }
                    }
                } else if !narrow.is_finite() {
                    self.suspects.entry(value).or_default().push(suspect);
                } else if suspect.error() > tolerance && !is_pole {
                    if suspect.error() > FACTOR * change[value][row[point]].max(beyond(value, point)) + tolerance {
                        self.suspects.entry(value).or_default().push(suspect);
                    } else {
                        let kept = self.excused.entry(value).or_insert(suspect);
                        if kept.error() < suspect.error() {
                            *kept = suspect;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

/// The largest change of each value between each point and others within [`ULPS`] of it, in exact arithmetic.
fn change_within(
    trace: &Trace<'_>,
    precision: Precision,
    points: &Points,
    exact: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let mut change = vec![vec![0.0_f64; points.count]; exact.len()];
    if points.count == 0 {
        return Ok(change);
    }
    // Its own: what is tried elsewhere does not depend on what seems wrong.
    let mut random = Random::new(2);
    for _ in 0..WITHIN {
        let mut near = points.clone();
        for (input, column) in trace.inputs.iter().zip(&mut near.columns) {
            if input.is_float() {
                column.iter_mut().for_each(|x| *x = precision.moved(*x, ULPS * (2.0 * random.unit() - 1.0)));
            }
        }
        widen(&mut change, trace.run::<f64>(&near)?, exact);
    }
    Ok(change)
}

/// Takes in how far values are from others.
fn widen(change: &mut [Vec<f64>], there: Vec<Vec<f64>>, exact: &[Vec<f64>]) {
    for ((change, there), exact) in change.iter_mut().zip(there).zip(exact) {
        for ((change, there), exact) in change.iter_mut().zip(there).zip(exact) {
            // Not of what is no number.
            let difference = (there - exact).abs();
            if difference > *change {
                *change = difference;
            }
        }
    }
}

/// The largest change of each value between each point and its neighbours.
fn change(
    trace: &Trace<'_>,
    precision: Precision,
    points: &Points,
    exact: &[Vec<f64>],
    random: &mut Random,
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let mut change = vec![vec![0.0_f64; points.count]; exact.len()];
    let mut ways: Vec<Vec<f64>> = Vec::new();
    for number in 0..NEIGHBOURS {
        // Every other neighbour lies opposite to the last. The first ones are moved along all inputs, the others along half.
        if number % 2 == 0 {
            let reach = if number < NEIGHBOURS / 2 { 1.0 } else { 0.5 };
            let mut way = || {
                let x = 2.0 * random.unit() - 1.0;
                if x.abs() < reach { x.signum() } else { 0.0 }
            };
            ways = points.columns.iter().map(|column| column.iter().map(|_| way()).collect()).collect();
        }
        let ulps = if number % 2 == 0 { ULPS } else { -ULPS };
        let mut near = points.clone();
        for ((input, column), ways) in trace.inputs.iter().zip(&mut near.columns).zip(&ways) {
            if input.is_float() {
                column.iter_mut().zip(ways).for_each(|(x, way)| *x = precision.moved(*x, ulps * way));
            }
        }
        widen(&mut change, trace.run::<f64>(&near)?, exact);
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

/// Which inputs change which values, by input, in either arithmetic.
fn reads<F: Float>(
    trace: &Trace<'_>,
    precision: Precision,
    set: &Points,
    random: &mut Random,
) -> Result<Vec<Vec<bool>>, StabilityError> {
    let first = |column: &Vec<f64>| column[..PROBES].to_vec();
    let mut points = Points { columns: set.columns.iter().map(first).collect(), count: PROBES };
    let run = |points: &Points| Ok([trace.run::<F>(points)?, trace.run::<f64>(points)?].concat());
    let before = run(&points)?;
    let mut reads = Vec::with_capacity(trace.inputs.len());
    for (number, input) in trace.inputs.iter().enumerate() {
        let others = match input.source {
            Source::Parameter { from, to, .. } => {
                (0..PROBES).map(|_| input.rounded(precision, random.between(from, to))).collect()
            }
            Source::Range { .. } | Source::Frame { .. } | Source::Fixed(_) => {
                set.columns[number][PROBES..2 * PROBES].to_vec()
            }
        };
        let kept = std::mem::replace(&mut points.columns[number], others);
        let after = run(&points)?;
        points.columns[number] = kept;
        let differ = |(a, b): (&f64, &f64)| a != b && !(a.is_nan() && b.is_nan());
        let changed: Vec<bool> = before.iter().zip(&after).map(|(a, b)| a.iter().zip(b).any(differ)).collect();
        let (narrow, exact) = changed.split_at(trace.values.len());
        reads.push(narrow.iter().zip(exact).map(|(a, b)| *a || *b).collect());
    }
    Ok(reads)
}

/// Those inputs at a point that something depends on.
fn input(trace: &Trace<'_>, is_read: impl Fn(usize) -> bool, at: &[f64]) -> Vec<(String, f64)> {
    let all = trace.inputs.iter().zip(at).enumerate();
    all.filter(|(number, _)| is_read(*number)).map(|(_, (input, x))| (input.name.clone(), *x)).collect()
}

/// What f32 (or f16) makes of constants that the shader has the result of.
fn constants<F: Float>(
    trace: &Trace<'_>,
    constant: &BTreeSet<NodeId>,
    precision: Precision,
) -> Result<Vec<Finding>, StabilityError> {
    let points = domain(&trace.inputs, precision, &mut Random::new(1)).swap_remove(0);
    let point = Points::of(&trace.inputs, [points.point(0).as_slice()]);
    let (narrow, exact) = (trace.run::<F>(&point)?, trace.run::<f64>(&point)?);

    let rms = rms(&trace.values, &exact);
    let mut findings = Vec::new();
    for (number, value) in trace.values.iter().enumerate().filter(|(_, value)| constant.contains(&value.node)) {
        let (narrow, exact) = (narrow[number][0], exact[number][0]);
        let tolerance = precision.tolerance() * exact.abs().max(rms[value.group]).max(LEAST_CONSTANT);
        let suspect = Suspect { value: number, set: 0, point: 0, narrow, exact, tolerance };
        if suspect.error() > tolerance {
            let mut counts = Counts::default();
            counts.take(precision, narrow, exact);
            findings.push(finding(value, &suspect, counts, Vec::new()));
        }
    }
    Ok(findings)
}

fn finding(value: &Value, suspect: &Suspect, counts: Counts, input: Vec<(String, f64)>) -> Finding {
    let Value { node, label, output, .. } = value.clone();
    let Counts { nan, infinite, underflows, beyond_f16 } = counts;
    Finding {
        node,
        label,
        output,
        narrow: suspect.narrow,
        exact: suspect.exact,
        input,
        nan,
        infinite,
        underflows,
        beyond_f16,
        behind: Vec::new(),
    }
}
