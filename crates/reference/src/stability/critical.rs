//! Points where an intermediate number of the material is critical: the divisor that is 0, the root's end, the step that is
//! taken. They are found between points that miss them: where such a number changes its sign or its whole part the way is
//! halved, and where it is near its critical value its slope is followed.

mod descent;

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use halfvector_interp::Watch;

use crate::stability::StabilityError;
use crate::stability::critical::descent::descend;
use crate::stability::domain::{Input, Points, Precision, Random, Source, on_the_way, settled};
use crate::stability::edge::lines;
use crate::stability::effort::{Effort, at_most};
use crate::stability::trace::{Trace, Watched};

/// Ways that are followed of each number: between neighbours, and from low points.
const EACH: usize = 3;

/// Places of each sort that are looked at in one material: the first of each number before the second of any.
const MOST: usize = 512;

/// Points of a run: a program gives all its numbers at each.
const BATCH: usize = 512;

/// How often the way to a place is shortened at most; a continuous number is found after five to seven times, one that jumps
/// after 18.
const ROUNDS: usize = 24;

/// Rounds after which a number that is not found in a quarter of the way that was left is taken for one that jumps.
const SMOOTH: usize = 2;

/// Runs that shortening a way costs, about.
const COST: usize = 40;

/// How short it is then, as a part of what it was.
const SHORT: f64 = 1.5e-11;

/// How far points around a place lie, of what an input may move: bands beside it are as narrow.
const AROUND: [f64; 5] = [1e-6, 1e-5, 1e-4, 3e-4, 1e-3];

/// Inputs along which points are tried that are all next to each other, and around a place.
const AXES: usize = 3;

/// What was found.
#[derive(Debug, Default)]
pub(super) struct Critical {
    /// Points at poles and next to them, as numbers of the precision. Anything is steep there.
    pub(super) poles: Vec<Vec<f64>>,
    /// Points around all places, as numbers of the precision.
    pub(super) around: Vec<Vec<f64>>,
    /// Both sides of where something is decided, with hardly any way between them.
    pub(super) sides: Vec<[Vec<f64>; 2]>,
}

/// A number that is watched, where it was seen.
struct Watcher {
    /// Which one it is.
    number: usize,
    watch: Watch,
    /// The inputs that it was seen to change with.
    active: Vec<usize>,
    /// Neighbours on lines between which it passes what is critical.
    crossings: Vec<[Place; 2]>,
    /// Where it is near that.
    lows: Vec<Place>,
    /// How far it is from that on average.
    scale: f64,
}

impl Watcher {
    /// The critical value nearest to a number.
    fn target(&self, x: f64) -> f64 {
        if self.watch == Watch::Whole { x.round() } else { 0.0 }
    }
}

/// A point, and the number there.
#[derive(Clone, Debug)]
struct Place {
    at: Vec<f64>,
    x: f64,
}

/// Two points between which a number passes a critical value.
struct Bracket<'w> {
    watcher: &'w Watcher,
    target: f64,
    ends: [Place; 2],
    /// The part of the way between the ends that is left, and the number there.
    left: [(f64, f64); 2],
    /// Whether it jumps: no line through the ends tells where it passes.
    jumps: bool,
}

/// A point at which a number touches its critical value.
struct Touch<'w> {
    watcher: &'w Watcher,
    at: Vec<f64>,
}

/// Looks for the critical points of a material. `sets`: points of the domain.
pub(super) fn search(
    trace: &Trace<'_>,
    precision: Precision,
    sets: &[Points],
    effort: Effort,
    random: &mut Random,
) -> Result<Critical, StabilityError> {
    let watched = trace.watched()?;
    if watched.watches.is_empty() {
        return Ok(Critical::default());
    }
    let watchers = watchers(trace, &watched, sets, random)?;
    let (touches, found) = descend(trace, &watched, &watchers, effort.critical / 3)?;
    let mut brackets = Vec::new();
    for rank in 0..EACH {
        for watch in [Watch::Pole, Watch::Sign, Watch::Whole] {
            for watcher in watchers.iter().filter(|watcher| watcher.watch == watch) {
                if let Some(ends) = watcher.crossings.get(rank) {
                    brackets.push(Bracket::new(watcher, ends.clone()));
                }
            }
        }
    }
    brackets.truncate(MOST.min(effort.critical / 3 / COST));
    brackets.extend(found);
    narrow(trace, &watched, &mut brackets)?;
    let inputs = &trace.inputs;
    let mut critical = Critical::default();
    for Bracket { watcher, ends, left, .. } in &brackets {
        let sides = left.map(|(part, _)| on_the_way(inputs, &ends[0].at, &ends[1].at, part));
        let moved: Vec<usize> = (0..inputs.len()).filter(|i| ends[0].at[*i] != ends[1].at[*i]).collect();
        if watcher.watch == Watch::Pole {
            critical.poles.extend(next_to(inputs, precision, &sides[0], &moved));
        }
        critical.around.extend(around(inputs, precision, &sides[0], &watcher.active, &moved));
        critical.sides.push(sides);
    }
    critical.sides.extend(crossed(&critical.sides));
    for Touch { watcher, at } in &touches {
        critical.poles.extend(next_to(inputs, precision, at, &watcher.active));
        critical.around.extend(around(inputs, precision, at, &watcher.active, &watcher.active));
        if watcher.watch != Watch::Pole {
            critical.sides.extend(both_sides(inputs, at, &watcher.active));
        }
    }
    critical.poles = at_most(critical.poles, effort.judged / 4);
    critical.around = at_most(critical.around, effort.judged / 8);
    critical.sides = at_most(critical.sides, effort.judged / 8);
    Ok(critical)
}

/// Both sides of a point where a number is exactly what is critical, along a few inputs.
fn both_sides(inputs: &[Input], at: &[f64], active: &[usize]) -> Vec<[Vec<f64>; 2]> {
    let along = active.iter().filter_map(|i| Some((*i, inputs[*i].span()?)));
    let moved = |i: usize, step: f64| {
        let mut point = at.to_vec();
        point[i] += step;
        settled(inputs, at, point)
    };
    along.take(AXES).map(|(i, span)| [-0.5, 0.5].map(|side| moved(i, side * SHORT * span))).collect()
}

/// Sides of places with another input on a side of another place: the corners of what several inputs decide together.
fn crossed(sides: &[[Vec<f64>; 2]]) -> Vec<[Vec<f64>; 2]> {
    let along: Vec<(usize, &[Vec<f64>; 2])> = sides
        .iter()
        .filter_map(|sides| {
            let mut moved = (0..sides[0].len()).filter(|i| sides[0][*i] != sides[1][*i]);
            moved.next().filter(|_| moved.next().is_none()).map(|i| (i, sides))
        })
        .collect();
    let mut all = Vec::new();
    for (k, (i, one)) in along.iter().enumerate() {
        for (j, other) in along.iter().take(k).filter(|(j, _)| j != i) {
            for side in other.iter() {
                let [before, after] = one;
                all.push([before, after].map(|point| {
                    let mut point = point.clone();
                    point[*j] = side[*j];
                    point
                }));
            }
            if all.len() >= MOST {
                return all;
            }
        }
    }
    all
}

/// The numbers that differ between points, each once, with where they are near to what is critical.
fn watchers(
    trace: &Trace<'_>,
    watched: &Watched<'_>,
    sets: &[Points],
    random: &mut Random,
) -> Result<Vec<Watcher>, StabilityError> {
    let (points, line) = lines(trace, sets, random);
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let numbers = watched.run(&Points::of(&trace.inputs, points.iter().map(Vec::as_slice)))?;
    let mut seen = HashSet::new();
    let mut watchers = Vec::new();
    for (number, watch) in watched.watches.iter().enumerate() {
        let column = numbers.column(number);
        let mut hasher = DefaultHasher::new();
        watch.hash(&mut hasher);
        column.iter().for_each(|x| x.to_bits().hash(&mut hasher));
        let mut watcher =
            Watcher { number, watch: *watch, active: Vec::new(), crossings: Vec::new(), lows: Vec::new(), scale: 0.0 };
        let mut crossings = Vec::new();
        for start in (0..points.len()).step_by(line) {
            let part = &column[start..start + line];
            if part.iter().all(|x| *x == part[0]) {
                continue;
            }
            let moves = |i: &usize| points[start][*i] != points[start + 1][*i];
            watcher.active.extend((0..trace.inputs.len()).filter(moves));
            let passes = |at: &usize| passes(*watch, column[*at], column[at + 1]);
            crossings.extend((start..start + line - 1).filter(passes));
        }
        watcher.active.sort_unstable();
        watcher.active.dedup();
        if watcher.active.is_empty() || !seen.insert(hasher.finish()) {
            continue;
        }
        let place = |at: usize| Place { at: points[at].clone(), x: column[at] };
        // Not all of one line.
        let chosen: Vec<usize> = match crossings.as_slice() {
            [] => Vec::new(),
            [first, .., last] => vec![*first, *last, crossings[crossings.len() / 2]],
            [one] => vec![*one],
        };
        let chosen: Vec<usize> = chosen.into_iter().fold(Vec::new(), |mut kept, at| {
            if !kept.contains(&at) {
                kept.push(at);
            }
            kept
        });
        watcher.crossings = chosen.into_iter().map(|at| [place(at), place(at + 1)]).collect();
        if let Some(at) = lowest(&watcher, column) {
            watcher.lows.push(place(at));
        }
        watcher.scale = scale(&watcher, column);
        watchers.push(watcher);
    }
    // A step that is passed is known well enough.
    let is_open = |watcher: &Watcher| watcher.watch == Watch::Pole || watcher.crossings.is_empty();
    let (first, last) = (&sets[0], &sets[sets.len() - 1]);
    for (set, points) in [first, last].into_iter().enumerate() {
        if set == 0 || sets.len() > 1 {
            let numbers = watched.run(points)?;
            for watcher in watchers.iter_mut().filter(|watcher| is_open(watcher)) {
                let column = numbers.column(watcher.number);
                if let Some(at) = lowest(watcher, column) {
                    watcher.lows.push(Place { at: points.point(at), x: column[at] });
                }
            }
        }
    }
    for watcher in watchers.iter_mut().filter(|watcher| !is_open(watcher)) {
        watcher.lows.clear();
    }
    Ok(watchers)
}

/// Whether a number passes what is critical on the way from one value to another.
fn passes(watch: Watch, a: f64, b: f64) -> bool {
    match watch {
        Watch::Pole | Watch::Sign => (a >= 0.0) != (b >= 0.0),
        Watch::Whole => a.floor() != b.floor(),
    }
}

/// Where a number is nearest to what is critical.
fn lowest(watcher: &Watcher, column: &[f64]) -> Option<usize> {
    let far = |at: usize| (column[at] - watcher.target(column[at])).abs();
    (0..column.len()).filter(|at| far(*at).is_finite()).min_by(|a, b| far(*a).total_cmp(&far(*b)))
}

/// How far a number is on average from what is critical.
fn scale(watcher: &Watcher, column: &[f64]) -> f64 {
    let far: Vec<f64> = column.iter().map(|x| (x - watcher.target(*x)).abs()).filter(|far| far.is_finite()).collect();
    far.iter().sum::<f64>() / far.len().max(1) as f64
}

impl<'w> Bracket<'w> {
    /// Of two neighbours between which the number passes; a whole number that it passes.
    fn new(watcher: &'w Watcher, ends: [Place; 2]) -> Bracket<'w> {
        let target = if watcher.watch == Watch::Whole { ends[0].x.floor().max(ends[1].x.floor()) } else { 0.0 };
        Bracket::to(watcher, target, ends)
    }

    /// Of two points between which the number passes a value.
    fn to(watcher: &'w Watcher, target: f64, ends: [Place; 2]) -> Bracket<'w> {
        let left = [(0.0, ends[0].x), (1.0, ends[1].x)];
        Bracket { watcher, target, ends, left, jumps: false }
    }

    fn width(&self) -> f64 {
        self.left[1].0 - self.left[0].0
    }

    /// Parts of the way that are tried next: around where a straight line passes, and the middle.
    fn tries(&self) -> [f64; 4] {
        let [(a, x), (b, y)] = self.left;
        let width = self.width();
        if self.jumps {
            return [0.2, 0.4, 0.6, 0.8].map(|part| a + part * width);
        }
        let middle = a + 0.5 * width;
        let line = a + width * (self.target - x) / (y - x);
        let line = if line > a && line < b { line } else { middle };
        let beside = (width * width).max(0.3 * SHORT).min(0.2 * width);
        let mut tries = [line - beside, line, line + beside, middle].map(|part| part.clamp(a, b));
        tries.sort_by(f64::total_cmp);
        tries
    }

    /// Keeps the first part between two tries in which the number passes.
    fn keep(&mut self, tries: [f64; 4], numbers: &[f64]) {
        let side = |x: f64| x >= self.target;
        let mut before = self.left[0];
        let all = tries.into_iter().zip(numbers.iter().copied()).chain([self.left[1]]);
        for after in all {
            if side(after.1) != side(before.1) {
                self.left = [before, after];
                return;
            }
            before = after;
        }
    }
}

/// Shortens the ways between points until hardly any is left.
fn narrow(trace: &Trace<'_>, watched: &Watched<'_>, brackets: &mut [Bracket<'_>]) -> Result<(), StabilityError> {
    for round in 0..ROUNDS {
        let mut open: Vec<&mut Bracket<'_>> = brackets.iter_mut().filter(|bracket| bracket.width() > SHORT).collect();
        if open.is_empty() {
            break;
        }
        let tries: Vec<[f64; 4]> = open.iter().map(|bracket| bracket.tries()).collect();
        let mut asked = Vec::with_capacity(4 * open.len());
        for (bracket, tries) in open.iter().zip(&tries) {
            let [a, b] = [&bracket.ends[0].at, &bracket.ends[1].at];
            asked.extend(tries.iter().map(|part| (bracket.watcher.number, on_the_way(&trace.inputs, a, b, *part))));
        }
        let numbers = at(trace, watched, &asked)?;
        for ((bracket, tries), numbers) in open.iter_mut().zip(tries).zip(numbers.chunks(4)) {
            let width = bracket.width();
            bracket.keep(tries, numbers);
            bracket.jumps |= round >= SMOOTH && bracket.width() > 0.25 * width;
        }
    }
    Ok(())
}

/// A number at each of some points.
fn at(trace: &Trace<'_>, watched: &Watched<'_>, asked: &[(usize, Vec<f64>)]) -> Result<Vec<f64>, StabilityError> {
    let mut all = Vec::with_capacity(asked.len());
    for asked in asked.chunks(BATCH) {
        let points = Points::of(&trace.inputs, asked.iter().map(|(_, point)| point.as_slice()));
        let numbers = watched.run(&points)?;
        all.extend(asked.iter().enumerate().map(|(point, (number, _))| numbers.column(*number)[point]));
    }
    Ok(all)
}

/// The numbers of the precision at a point and next to it, along a few inputs all together.
fn next_to(inputs: &[Input], precision: Precision, at: &[f64], along: &[usize]) -> Vec<Vec<f64>> {
    let rounded: Vec<f64> = inputs.iter().zip(at).map(|(input, x)| input.rounded(precision, *x)).collect();
    let mut all = vec![rounded.clone()];
    let beside = |point: &[f64], i: usize, ulps: f64| {
        let mut moved = point.to_vec();
        let x = precision.rounded(precision.moved(point[i], ulps));
        moved[i] = inputs[i].range().map_or(x, |[from, to]| x.clamp(from, to));
        moved
    };
    for i in along.iter().copied().filter(|i| inputs[*i].is_float()) {
        let from = if along.len() <= AXES { all.clone() } else { vec![rounded.clone()] };
        all.extend(from.iter().flat_map(|point| [beside(point, i, -1.0), beside(point, i, 1.0)]));
    }
    all
}

/// Points at distances from a place: bands beside it are as narrow.
fn around(inputs: &[Input], precision: Precision, at: &[f64], active: &[usize], moved: &[usize]) -> Vec<Vec<f64>> {
    let along = if active.len() <= AXES { active } else { moved };
    let mut all = Vec::new();
    for i in along.iter().take(AXES) {
        let Some(span) = inputs[*i].span() else { continue };
        for radius in AROUND.into_iter().flat_map(|part| [-part * span, part * span]) {
            let mut point = at.to_vec();
            point[*i] += radius;
            let point = settled(inputs, at, point);
            all.push(inputs.iter().zip(&point).map(|(input, x)| input.rounded(precision, *x)).collect());
        }
    }
    all
}

/// Whether an input is a component of a direction.
fn is_direction(input: &Input) -> bool {
    matches!(input.source, Source::Frame { .. })
}
