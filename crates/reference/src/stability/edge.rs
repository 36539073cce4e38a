//! Where outputs jump: two points with hardly any way between them and different values.

use std::collections::BTreeSet;
use std::ops::Range;

use halfvector_graph::document::NodeId;

use crate::stability::StabilityError;
use crate::stability::domain::{Input, POINTS, Points, Precision, Random, Source, between, settled};
use crate::stability::trace::Trace;
use crate::stability::wiring::Wiring;

/// Lines along each input.
const LINES: usize = 4;

/// Points of all lines together, where there are few inputs.
const LINE_POINTS: usize = 1024;

/// Fewest and most points of a line.
const LINE: [usize; 2] = [16, 128];

/// How often the way from a point of a line to the next is halved for the point that tells the slope there.
const NEAR: i32 = 10;

/// Pairs of neighbours on lines that are looked between for one output, until one has a jump between them.
const PAIRS: usize = 6;

/// How often the way between two neighbours is halved at most: until it is about as short as f64 has it.
const HALVINGS: usize = 44;

/// The least jump that is told where something is known to be decided, of the output's value or rms: 168 units of the last place
/// of f32.
const LEAST: f64 = 1e-5;

/// Places of a run.
const SIDES: usize = 128;

/// How much farther apart two points are taken to tell a jump from a slope.
const WIDER: f64 = 16.0;

/// How many times the tolerance an output changes between two numbers of the precision next to each other when that counts as a jump,
/// however it does it; a smaller change has to be a jump in exact arithmetic.
const STEEP: f64 = 16.0;

/// Points beside a suspicious one that are tried when a jump is looked for.
const TRIES: usize = 96;

/// Parts that the way across a jump is cut in, again and again: five times make 2^-35 of the way.
const PARTS: usize = 127;

/// How often.
const ROUNDS: usize = 5;

/// A jump of an output, or a change that is as steep: between two numbers next to each other.
#[derive(Clone, Debug)]
pub(super) struct Jump {
    pub(super) value: usize,
    pub(super) before: Vec<f64>,
    pub(super) after: Vec<f64>,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Jump {
    pub(super) fn height(&self) -> f64 {
        (self.to - self.from).abs()
    }
}

/// An output that is wrong at a point.
#[derive(Clone, Debug)]
pub(super) struct Wrong {
    pub(super) value: usize,
    pub(super) at: Vec<f64>,
    pub(super) narrow: f64,
    pub(super) error: f64,
    pub(super) tolerance: f64,
}

/// Two neighbours on a line, between which an output changes in another way than its slope at one of them says.
#[derive(Clone, Debug)]
struct Pair {
    jump: Jump,
    /// What the output would change by with that slope.
    expected: f64,
    /// How much more it changes.
    score: f64,
}

/// The jumps of the outputs between points of the domain, at most one of an output and none of a node that is fed by a node with
/// one. `rms`: of each output. What is found is the same in every run.
pub(super) fn search(
    trace: &Trace<'_>,
    wiring: &Wiring<'_>,
    precision: Precision,
    domain: &[Points],
    rms: &[f64],
    random: &mut Random,
) -> Result<Vec<Jump>, StabilityError> {
    let (points, line) = lines(trace, domain, random);
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let exact = trace.run::<f64>(&Points::of(&trace.inputs, points.iter().map(Vec::as_slice)))?;
    // Each point's neighbour, a little on the way to the next; a line's last has none.
    let mut near = points[1..].to_vec();
    near.push(points[points.len() - 1].clone());
    for _ in 0..NEAR {
        near = near.iter().zip(&points).map(|(near, point)| between(&trace.inputs, point, near)).collect();
    }
    let near = trace.run::<f64>(&Points::of(&trace.inputs, near.iter().map(Vec::as_slice)))?;
    let limit = |jump: &Jump| {
        precision.tolerance() * jump.from.abs().max(jump.to.abs()).max(rms[trace.values[jump.value].group])
    };
    let mut outputs: Vec<Vec<Pair>> = vec![Vec::new(); rms.len()];
    for value in 0..trace.values.len() {
        // What is handed on unchanged jumps where it comes from.
        if (0..value).any(|earlier| exact[earlier] == exact[value]) {
            continue;
        }
        let slopes: Vec<f64> =
            near[value].iter().zip(&exact[value]).map(|(near, at)| (near - at) * f64::from(NEAR).exp2()).collect();
        for start in (0..points.len()).step_by(line) {
            if let Some(pair) = pair(value, &exact[value], &slopes, &points, start..start + line)
                && pair.jump.height() > limit(&pair.jump)
            {
                outputs[trace.values[value].group].push(pair);
            }
        }
    }
    outputs.iter_mut().for_each(|pairs| pairs.sort_by(|a, b| b.score.total_cmp(&a.score)));
    let mut jumps: Vec<Jump> = Vec::new();
    let mut found = vec![false; rms.len()];
    let mut jumping: BTreeSet<NodeId> = BTreeSet::new();
    for attempt in 0..PAIRS {
        let is_open = |pair: &&Pair| {
            let value = &trace.values[pair.jump.value];
            !found[value.group] && !wiring.has_source(&value.node, &jumping)
        };
        let pairs: Vec<Pair> = outputs.iter().filter_map(|pairs| pairs.get(attempt)).filter(is_open).cloned().collect();
        if pairs.is_empty() {
            continue;
        }
        for jump in narrowed(trace, precision, pairs, limit)? {
            let value = &trace.values[jump.value];
            found[value.group] = true;
            jumping.insert(value.node.clone());
            jumps.push(jump);
        }
    }
    jumps.retain(|jump| !wiring.has_source(&trace.values[jump.value].node, &jumping));
    Ok(jumps)
}

/// The jumps of the outputs where something is decided: the largest of each, and none of a node that is fed by a node with one.
/// `sides`: both sides of such places. `found`: jumps that are known.
pub(super) fn decided(
    trace: &Trace<'_>,
    wiring: &Wiring<'_>,
    sides: &[[Vec<f64>; 2]],
    rms: &[f64],
    mut found: Vec<Jump>,
) -> Result<Vec<Jump>, StabilityError> {
    let inputs = &trace.inputs;
    let mut largest: Vec<Option<Jump>> = vec![None; rms.len()];
    for sides in sides.chunks(SIDES) {
        // As far apart as they are, and wider.
        let wider = |[a, b]: &[Vec<f64>; 2]| {
            let moved = |from: &[f64], to: &[f64]| {
                let point = from.iter().zip(to).map(|(from, to)| from + 0.5 * WIDER * (to - from)).collect();
                settled(inputs, from, point)
            };
            [a.clone(), b.clone(), moved(b, a), moved(a, b)]
        };
        let points: Vec<Vec<f64>> = sides.iter().flat_map(wider).collect();
        let exact = trace.run::<f64>(&Points::of(inputs, points.iter().map(Vec::as_slice)))?;
        for (value, numbers) in exact.iter().enumerate() {
            let group = trace.values[value].group;
            for ([before, after], numbers) in sides.iter().zip(numbers.chunks(4)) {
                let (height, wide) = ((numbers[1] - numbers[0]).abs(), (numbers[3] - numbers[2]).abs());
                let least = LEAST * numbers[0].abs().max(numbers[1].abs()).max(rms[group]);
                let is_jump = height.is_finite() && height > least && height > 0.5 * wide;
                if is_jump && largest[group].as_ref().is_none_or(|jump| jump.height() < height) {
                    let (before, after) = (before.clone(), after.clone());
                    largest[group] = Some(Jump { value, before, after, from: numbers[0], to: numbers[1] });
                }
            }
        }
    }
    found.extend(largest.into_iter().flatten());
    let jumping: BTreeSet<NodeId> = found.iter().map(|jump| trace.values[jump.value].node.clone()).collect();
    found.retain(|jump| !wiring.has_source(&trace.values[jump.value].node, &jumping));
    Ok(found)
}

/// Points on lines, each along one input that may be moved alone, or along an arc of the directions; and how many a line has.
pub(super) fn lines(trace: &Trace<'_>, domain: &[Points], random: &mut Random) -> (Vec<Vec<f64>>, usize) {
    let inputs = &trace.inputs;
    let mut ways: Vec<Option<(usize, [f64; 2])>> = inputs
        .iter()
        .enumerate()
        .filter_map(|(number, input)| input.is_float().then_some(Some((number, input.range()?))))
        .collect();
    if inputs.iter().any(|input| matches!(input.source, Source::Frame { .. })) {
        ways.push(None);
    }
    let line = (LINE_POINTS / (LINES * ways.len()).max(1)).clamp(LINE[0], LINE[1]);
    let mut points = Vec::new();
    for way in ways {
        for number in 0..LINES {
            let set = &domain[number % domain.len()];
            let mut pick = || set.point(((random.unit() * POINTS as f64) as usize).min(POINTS - 1));
            let start = pick();
            match way {
                Some((input, [from, to])) => {
                    // Not at the same places on all lines: patterns have periods.
                    let offset = random.unit();
                    points.extend((0..line).map(|k| {
                        let mut point = start.clone();
                        point[input] = from + (to - from) * (k as f64 + offset) / line as f64;
                        point
                    }));
                }
                None => points.extend(arc(inputs, start, &pick(), line)),
            }
        }
    }
    (points, line)
}

/// Points on the way from one frame to another; everything else stays.
fn arc(inputs: &[Input], start: Vec<f64>, other: &[f64], count: usize) -> Vec<Vec<f64>> {
    let is_frame = |input: &Input| matches!(input.source, Source::Frame { .. });
    let end = inputs.iter().enumerate().map(|(i, input)| if is_frame(input) { other[i] } else { start[i] }).collect();
    let mut points: Vec<Vec<f64>> = vec![start, end];
    while points.len() < count {
        let halves = points.windows(2).flat_map(|ends| [ends[0].clone(), between(inputs, &ends[0], &ends[1])]);
        let last = points.last().cloned();
        points = halves.chain(last).collect();
    }
    points.truncate(count);
    points
}

/// The neighbours on a line between which an output changes least as its slopes say. Slopes are changes from a point to the next.
fn pair(value: usize, exact: &[f64], slopes: &[f64], points: &[Vec<f64>], line: Range<usize>) -> Option<Pair> {
    let mut best: Option<Pair> = None;
    for at in line.start..line.end - 1 {
        let step = exact[at + 1] - exact[at];
        // The slope of the line's last point is not known.
        let next = if at + 2 < line.end { slopes[at + 1] } else { slopes[at] };
        let beside = |slope: f64| (step - slope).abs();
        let expected = if beside(next) < beside(slopes[at]) { next } else { slopes[at] };
        let score = beside(expected);
        if score.is_finite() && best.as_ref().is_none_or(|best| best.score < score) {
            let (before, after) = (points[at].clone(), points[at + 1].clone());
            let jump = Jump { value, before, after, from: exact[at], to: exact[at + 1] };
            best = Some(Pair { jump, expected, score });
        }
    }
    best
}

/// Those of the pairs between which an output still jumps when the way between them is as short as it can be.
fn narrowed(
    trace: &Trace<'_>,
    precision: Precision,
    mut pairs: Vec<Pair>,
    limit: impl Fn(&Jump) -> f64,
) -> Result<Vec<Jump>, StabilityError> {
    let mut found = Vec::new();
    for _ in 0..HALVINGS {
        let middles: Vec<Vec<f64>> =
            pairs.iter().map(|pair| between(&trace.inputs, &pair.jump.before, &pair.jump.after)).collect();
        let exact = trace.run::<f64>(&Points::of(&trace.inputs, middles.iter().map(Vec::as_slice)))?;
        for (number, (pair, middle)) in pairs.iter_mut().zip(middles).enumerate() {
            let x = exact[pair.jump.value][number];
            pair.expected *= 0.5;
            let beside = |step: f64| (step - pair.expected).abs();
            if beside(x - pair.jump.from) > beside(pair.jump.to - x) {
                (pair.jump.to, pair.jump.after) = (x, middle);
            } else {
                (pair.jump.from, pair.jump.before) = (x, middle);
            }
        }
        // False of what is no number, too.
        pairs.retain(|pair| pair.jump.height() > limit(&pair.jump) && pair.jump.height().is_finite());
        let is_steep = |pair: &Pair| {
            pair.jump.height() > STEEP * limit(&pair.jump) && are_neighbours(&trace.inputs, precision, &pair.jump)
        };
        let (narrow, wide) = pairs.into_iter().partition(is_steep);
        found.extend::<Vec<Pair>>(narrow);
        pairs = wide;
        if pairs.is_empty() {
            break;
        }
    }
    Ok(found.into_iter().chain(pairs).map(|pair| pair.jump).collect())
}

/// Whether no number of the precision lies between the two sides of a jump; directions are as precise as numbers near 1.
fn are_neighbours(inputs: &[Input], precision: Precision, jump: &Jump) -> bool {
    let close = |(input, (a, b)): (&Input, (&f64, &f64))| {
        let size = if input.range().is_some() { a.abs().max(b.abs()) } else { 0.9 };
        (a - b).abs() <= precision.moved(size, 1.0) - size
    };
    inputs.iter().zip(jump.before.iter().zip(&jump.after)).all(close)
}

/// The numbers of the precision on both sides of jumps, and those next to them; and which jump each belongs to.
pub(super) fn both_sides(inputs: &[Input], precision: Precision, jumps: &[Jump]) -> (Points, Vec<usize>) {
    let (mut points, mut of) = (Vec::new(), Vec::new());
    for (jump_number, jump) in jumps.iter().enumerate() {
        let rounded = |point: &[f64]| -> Vec<f64> {
            inputs.iter().zip(point).map(|(input, x)| input.rounded(precision, *x)).collect()
        };
        let sides = [rounded(&jump.before), rounded(&jump.after)];
        for (number, input) in inputs.iter().enumerate() {
            let Some([from, to]) = input.range().filter(|_| jump.before[number] != jump.after[number]) else {
                continue;
            };
            for ulps in [-1.0, 1.0] {
                let mut beside = sides[0].clone();
                beside[number] = precision.rounded(precision.moved(beside[number], ulps)).clamp(from, to);
                points.push(beside);
            }
        }
        points.extend(sides);
        of.resize(points.len(), jump_number);
    }
    (Points::of(inputs, points.iter().map(Vec::as_slice)), of)
}

/// Which inputs a jump is at: those that differ between its sides and make the output differ, each alone.
pub(super) fn causes(trace: &Trace<'_>, jump: &Jump) -> Result<Vec<bool>, StabilityError> {
    let differ: Vec<bool> = jump.before.iter().zip(&jump.after).map(|(a, b)| a != b).collect();
    if differ.iter().filter(|differs| **differs).count() == 1 {
        return Ok(differ);
    }
    let one_over = |number: usize| {
        let mut point = jump.before.clone();
        point[number] = jump.after[number];
        point
    };
    let points: Vec<Vec<f64>> = (0..jump.before.len()).map(one_over).collect();
    let exact = trace.run::<f64>(&Points::of(&trace.inputs, points.iter().map(Vec::as_slice)))?;
    Ok(exact[jump.value].iter().map(|x| (x - jump.from).abs() > 0.5 * jump.height()).collect())
}

/// The jump of f64 beside a point, to what the narrow arithmetic gives at it, where there is one.
pub(super) fn beside(
    trace: &Trace<'_>,
    precision: Precision,
    wrong: &Wrong,
    random: &mut Random,
) -> Result<Option<Jump>, StabilityError> {
    let Wrong { value, at, narrow, error, tolerance } = wrong;
    // Ever farther, from less than an ulp.
    let mut tries = vec![Vec::with_capacity(TRIES); at.len()];
    for number in 0..TRIES {
        let radius = precision.reach() * 0.5_f64.powf((TRIES - 1 - number) as f64 / 8.0);
        for ((column, x), input) in tries.iter_mut().zip(at).zip(&trace.inputs) {
            let moved = x + radius * x.abs().max(1.0) * (2.0 * random.unit() - 1.0);
            // Every other time it stays: the point may lie at a jump along one input, and jump along another.
            column.push(if input.is_float() && random.unit() < 0.5 { moved } else { *x });
        }
    }
    let tries = Points { columns: tries, count: TRIES };
    let there = trace.run::<f64>(&tries)?;
    let alike = |x: f64| (x - narrow).abs() <= 0.1 * error + tolerance;
    let Some(found) = (0..TRIES).find(|&number| alike(there[*value][number])) else { return Ok(None) };
    let mut ends = [at.clone(), tries.point(found)];
    let mut sides = [0.0, 0.0];
    for _ in 0..ROUNDS {
        // All points of a round are one batch of the interpreter.
        let part = |a: f64, b: f64, number: usize| a + (b - a) * number as f64 / PARTS as f64;
        let on_the_way = |(a, b): (&f64, &f64)| (0..=PARTS).map(|number| part(*a, *b, number)).collect();
        let columns = ends[0].iter().zip(&ends[1]).map(on_the_way).collect();
        let way = Points { columns, count: PARTS + 1 };
        let numbers = trace.run::<f64>(&way)?.swap_remove(*value);
        let step = |number: &usize| (numbers[number + 1] - numbers[*number]).abs();
        let Some(largest) = (0..PARTS).max_by(|a, b| step(a).total_cmp(&step(b))) else { return Ok(None) };
        sides = [numbers[largest], numbers[largest + 1]];
        ends = [largest, largest + 1].map(|number| way.point(number));
    }
    let ([before, after], [from, to]) = (ends, sides);
    let jump = Jump { value: *value, before, after, from, to };
    Ok((jump.height() > 0.5 * error).then_some(jump))
}
