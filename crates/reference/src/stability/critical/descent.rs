//! From a point where a number is near its critical value to where it has it: Newton's way along its slope, in steps of one, two
//! (to where a square touches 0) and half the length that the slope says.

use crate::stability::StabilityError;
use crate::stability::critical::{Bracket, EACH, MOST, Place, Touch, Watcher, at, is_direction};
use crate::stability::domain::{Input, settled};
use crate::stability::trace::{Trace, Watched};

/// Steps at most.
const ROUNDS: usize = 24;

/// How far apart the slope is taken, of what an input may move: at first and at least, and of the way that is left to go. On the
/// way to a point, where the slope is not the same all around, it is nothing near that which is farther apart.
const NEAR: [f64; 2] = [1e-6, 1e-13];
const NEAR_OF_WAY: f64 = 1e-3;

/// Lengths of steps that are tried.
const STEPS: [f64; 3] = [1.0, 2.0, 0.5];

/// What a step has to leave of the distance at most.
const LESS: f64 = 0.9;

/// What is left of a number that touches its critical value, of what it was at first.
const NOTHING: f64 = 1e-6;

/// Steps of a way, about, each of which costs two runs for each input and three more.
const USUAL: usize = 6;

/// Most inputs that a slope is taken along.
const INPUTS: usize = 12;

/// A way down.
struct Way<'w> {
    watcher: &'w Watcher,
    target: f64,
    here: Place,
    /// The distance at the beginning.
    first: f64,
    /// How far apart the slope is taken.
    near: f64,
}

impl Way<'_> {
    fn distance(&self) -> f64 {
        self.here.x - self.target
    }
}

/// What the low points of the numbers lead to, with about so many runs.
pub(super) fn descend<'w>(
    trace: &Trace<'_>,
    watched: &Watched<'_>,
    watchers: &'w [Watcher],
    runs: usize,
) -> Result<(Vec<Touch<'w>>, Vec<Bracket<'w>>), StabilityError> {
    let inputs = &trace.inputs;
    let mut ways = Vec::new();
    for rank in 0..EACH {
        let begin = ways.len();
        for watcher in watchers {
            if let Some(place) = watcher.lows.get(rank) {
                let target = watcher.target(place.x);
                let first = (place.x - target).abs();
                ways.push(Way { watcher, target, here: place.clone(), first, near: NEAR[0] });
            }
        }
        // Those that are nearest to it for how large they are.
        let far = |way: &Way<'_>| way.first / way.watcher.scale;
        ways[begin..].sort_by(|a, b| far(a).total_cmp(&far(b)));
    }
    let mut left = runs;
    let mut is_affordable = |way: &Way<'_>| {
        let cost = USUAL * (2 * slopes_along(inputs, way).count() + STEPS.len());
        left.checked_sub(cost).inspect(|rest| left = *rest).is_some()
    };
    let affordable = ways.iter().take(MOST).take_while(|way| is_affordable(way)).count();
    ways.truncate(affordable);
    let (mut touches, mut brackets) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        // Those that are there.
        let (there, open): (Vec<Way<'w>>, Vec<Way<'w>>) = ways.into_iter().partition(|way| way.distance() == 0.0);
        touches.extend(there.into_iter().map(|way| Touch { watcher: way.watcher, at: way.here.at }));
        ways = open;
        if ways.is_empty() {
            break;
        }
        // The slope, in parts of what each input may move.
        let mut asked = Vec::new();
        let mut parts = Vec::new();
        for way in &ways {
            for i in slopes_along(inputs, way) {
                let span = inputs[i].span().unwrap_or_default();
                let moved = |step: f64| {
                    let mut point = way.here.at.clone();
                    point[i] += step;
                    settled(inputs, &way.here.at, point)
                };
                let sides = [moved(-way.near * span), moved(way.near * span)];
                // An end of a range holds it.
                let apart = if is_direction(&inputs[i]) { 2.0 * way.near } else { (sides[1][i] - sides[0][i]) / span };
                parts.push((i, apart));
                asked.extend(sides.map(|point| (way.watcher.number, point)));
            }
        }
        let numbers = at(trace, watched, &asked)?;
        let mut slopes = parts.into_iter().zip(numbers.chunks(2));
        let mut asked = Vec::new();
        for way in &ways {
            let slope: Vec<(usize, f64)> = slopes
                .by_ref()
                .take(slopes_along(inputs, way).count())
                .map(|((i, apart), numbers)| (i, (numbers[1] - numbers[0]) / apart))
                .collect();
            let square: f64 = slope.iter().map(|(_, slope)| slope * slope).sum();
            for length in STEPS {
                let mut point = way.here.at.clone();
                for (i, slope) in &slope {
                    let step = -length * way.distance() * slope / square;
                    // No slope, no step.
                    point[*i] += if step.is_finite() { step * inputs[*i].span().unwrap_or_default() } else { 0.0 };
                }
                asked.push((way.watcher.number, settled(inputs, &way.here.at, point)));
            }
        }
        let numbers = at(trace, watched, &asked)?;
        let mut left = Vec::new();
        let mut tried = asked.into_iter().zip(numbers);
        for mut way in ways {
            let tries: Vec<Place> = tried.by_ref().take(STEPS.len()).map(|((_, at), x)| Place { at, x }).collect();
            let distance = way.distance();
            let far = |place: &Place| (place.x - way.target).abs();
            if let Some(beyond) = tries.iter().find(|place| (place.x - way.target) * distance < 0.0) {
                brackets.push(Bracket::to(way.watcher, way.target, [way.here, beyond.clone()]));
                continue;
            }
            let best = tries.iter().filter(|place| far(place).is_finite()).min_by(|a, b| far(a).total_cmp(&far(b)));
            match best {
                Some(best) if far(best) < LESS * distance.abs() => {
                    let step = |i: usize| (best.at[i] - way.here.at[i]) / inputs[i].span().unwrap_or(1.0);
                    let step = slopes_along(inputs, &way).map(|i| step(i).powi(2)).sum::<f64>().sqrt();
                    way.near = (NEAR_OF_WAY * step * far(best) / distance.abs()).clamp(NEAR[1], NEAR[0]);
                    way.here = best.clone();
                    left.push(way);
                }
                _ if distance.abs() <= NOTHING * way.first => {
                    touches.push(Touch { watcher: way.watcher, at: way.here.at });
                }
                _ => {}
            }
        }
        ways = left;
    }
    let is_near = |way: &Way<'w>| way.distance().abs() <= NOTHING * way.first;
    touches.extend(ways.into_iter().filter(is_near).map(|way| Touch { watcher: way.watcher, at: way.here.at }));
    Ok((touches, brackets))
}

/// The inputs along which the slope of a number is taken.
fn slopes_along<'i>(inputs: &'i [Input], way: &Way<'i>) -> impl Iterator<Item = usize> + use<'i> {
    way.watcher.active.iter().copied().take(INPUTS).filter(move |i| inputs[*i].span().is_some())
}
