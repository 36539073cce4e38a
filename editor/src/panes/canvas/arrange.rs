//! Places for cards by depth: what feeds a card stands left of it. Columns and their first order are those of Sugiyama, Tagawa and
//! Toda 1981, "Methods for visual understanding of hierarchical system structures": layers by the longest path, then orders by
//! barycentres, swept from right to left and back. Then things are moved one by one as long as that makes wires shorter and
//! takes them out from behind cards, which columns alone do not see.
//!
//! The same graph gives the same places, wherever its cards were before.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::sheet::{Card, Sheet};
use super::view::{GRID, to_grid};
use super::wire;

/// Least free space between things of one column.
const GAP: f32 = 24.0;
/// Free space between columns: more where wires run behind cards with less.
const GAPS: [f32; 3] = [70.0, 110.0, 160.0];
const SWEEPS: usize = 6;
/// How much is looked at with each, in pairs of a wire and a card: a tenth of a second at most.
const BUDGET: usize = 1_500_000;
/// What a wire behind a card costs at least.
const BEHIND: f32 = 3000.0;
/// How far a wire keeps from cards that it has nothing to do with.
const CLEAR: f32 = 7.0;

/// What is placed as one: a card, or a frame with all that lies in it.
#[derive(Debug)]
pub(super) struct Thing {
    pub(super) size: Vec2,
    /// Its cards, from its corner.
    pub(super) cards: Vec<Rect>,
}

/// A wire between two things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lane {
    pub(super) from: End,
    pub(super) to: End,
}

/// An end of a wire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    pub(super) thing: usize,
    /// Which of its cards.
    pub(super) card: usize,
    /// From its corner.
    pub(super) at: Vec2,
}

/// Places for the given cards at first sight, with the corner of them all at the origin. Nothing is made better: it is asked for with each
/// change of the document.
pub(super) fn places(sheet: &Sheet, chosen: &[usize]) -> Vec<(usize, Pos2)> {
    let thing = |&card: &usize| {
        let size = sheet.cards[card].size;
        Thing { size, cards: vec![Rect::from_min_size(Pos2::ZERO, size)] }
    };
    let things: Vec<Thing> = chosen.iter().map(thing).collect();
    let mut place_of = vec![None; sheet.cards.len()];
    chosen.iter().enumerate().for_each(|(place, &card)| place_of[card] = Some((place, 0, Vec2::ZERO)));
    let places = planned(&things, &lanes(sheet, &place_of), false);
    chosen.iter().copied().zip(places).collect()
}

/// The wires between things. `thing_of` has for each card its thing, which of its cards it is, and where it lies in there. Those
/// within one thing are left out.
pub(super) fn lanes(sheet: &Sheet, thing_of: &[Option<(usize, usize, Vec2)>]) -> Vec<Lane> {
    let end = |(card, row): (usize, usize)| {
        let (thing, of_thing, corner) = thing_of[card]?;
        let card: &Card = &sheet.cards[card];
        Some(End { thing, card: of_thing, at: corner + (card.socket(&card.rows[row]) - card.rect().min) })
    };
    let all = sheet.wires.iter().filter_map(|wire| Some(Lane { from: end(wire.from)?, to: end(wire.to)? }));
    let mut lanes: Vec<Lane> = all.filter(|lane| lane.from.thing != lane.to.thing).collect();
    let key = |lane: &Lane| (lane.from.thing, lane.to.thing, lane.to.at.y, lane.from.at.y);
    lanes.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    lanes.dedup();
    lanes
}

/// Places for things, on the grid, with the corner of them all at the origin.
pub(super) fn places_of(things: &[Thing], lanes: &[Lane]) -> Vec<Pos2> {
    planned(things, lanes, true)
}

fn planned(things: &[Thing], lanes: &[Lane], is_improved: bool) -> Vec<Pos2> {
    if things.is_empty() {
        return Vec::new();
    }
    let depths = depths(things.len(), lanes);
    let columns = ordered(columns(&depths), lanes, things.len());
    let mut best: Option<(f32, Vec<Pos2>)> = None;
    for gap in GAPS {
        let mut plan = Plan::new(things, lanes, columns.clone(), gap);
        plan.settle_all();
        let cost = if is_improved { plan.improve() } else { 0.0 };
        if best.as_ref().is_none_or(|(least, _)| cost + BEHIND < *least) {
            best = Some((cost, plan.places()));
        }
        // The narrowest one in which nothing is wrong.
        if !is_improved || !plan.has_hidden_wires() {
            break;
        }
    }
    let places = best.map_or_else(Vec::new, |(_, places)| places);
    let corner = places.iter().fold(pos2(f32::INFINITY, f32::INFINITY), |corner, place| corner.min(*place));
    places.iter().map(|place| to_grid((*place - corner).to_pos2())).collect()
}

/// The longest way of each thing to an end. Wires that close a ring are overlooked.
fn depths(count: usize, lanes: &[Lane]) -> Vec<usize> {
    let mut depth = vec![0; count];
    // In a graph without rings no depth can reach the number of things.
    for _ in 0..count {
        let mut is_stable = true;
        for lane in lanes {
            let (from, to) = (lane.from.thing, lane.to.thing);
            if depth[from] <= depth[to] && depth[to] + 1 < count {
                depth[from] = depth[to] + 1;
                is_stable = false;
            }
        }
        if is_stable {
            break;
        }
    }
    depth
}

/// The things by depth.
fn columns(depths: &[usize]) -> Vec<Vec<usize>> {
    let mut columns = vec![Vec::new(); depths.iter().copied().max().unwrap_or(0) + 1];
    depths.iter().enumerate().for_each(|(i, depth)| columns[*depth].push(i));
    columns.retain(|column: &Vec<usize>| !column.is_empty());
    columns
}

/// Each column in the order of what its things are joined with.
fn ordered(mut columns: Vec<Vec<usize>>, lanes: &[Lane], count: usize) -> Vec<Vec<usize>> {
    let mut rank = vec![0.0; count];
    for column in &columns {
        column.iter().enumerate().for_each(|(place, &i)| rank[i] = place as f32);
    }
    for sweep in 0..SWEEPS {
        let to_left = sweep % 2 == 0;
        let order: Vec<usize> = if to_left { (0..columns.len()).collect() } else { (0..columns.len()).rev().collect() };
        for at in order {
            let near = |i: usize| {
                let ranks = lanes.iter().filter_map(|lane| match (lane.from.thing, lane.to.thing) {
                    // By the height of the socket, so that neighbours keep the order of a card's inputs.
                    (from, to) if to_left && from == i => Some(rank[to] + lane.to.at.y * 1e-3),
                    (from, to) if !to_left && to == i => Some(rank[from]),
                    _ => None,
                });
                (mean(ranks).unwrap_or(rank[i]), i)
            };
            let mut column: Vec<(f32, usize)> = columns[at].iter().map(|&i| near(i)).collect();
            column.sort_by(|a, b| a.0.total_cmp(&b.0));
            columns[at] = column.into_iter().map(|(_, i)| i).collect();
            columns[at].iter().enumerate().for_each(|(place, &i)| rank[i] = place as f32);
        }
    }
    columns
}

fn mean(numbers: impl Iterator<Item = f32>) -> Option<f32> {
    let (sum, count) = numbers.fold((0.0, 0), |(sum, count), x| (sum + x, count + 1));
    (count > 0).then(|| sum / count as f32)
}

fn up_to_grid(y: f32) -> f32 {
    (y / GRID).ceil() * GRID
}

fn down_to_grid(y: f32) -> f32 {
    (y / GRID).floor() * GRID
}

/// An arrangement that is being made better.
struct Plan<'a> {
    things: &'a [Thing],
    lanes: &'a [Lane],
    now: Places,
    /// The things that feed this one alone, over any number of others, and it.
    trees: Vec<Vec<usize>>,
    /// Between columns.
    gap: f32,
    /// What may still be looked at.
    left: usize,
}

/// Columns from the right, their things from above, and where each begins.
#[derive(Clone)]
struct Places {
    columns: Vec<Vec<usize>>,
    column_of: Vec<usize>,
    top: Vec<f32>,
}

impl<'a> Plan<'a> {
    fn new(things: &'a [Thing], lanes: &'a [Lane], columns: Vec<Vec<usize>>, gap: f32) -> Plan<'a> {
        let mut column_of = vec![0; things.len()];
        for (at, column) in columns.iter().enumerate() {
            column.iter().for_each(|&i| column_of[i] = at);
        }
        let now = Places { columns, column_of, top: vec![0.0; things.len()] };
        let is_small = things.len() <= 60;
        let trees = (0..things.len()).map(|i| if is_small { tree(i, things.len(), lanes) } else { vec![i] }).collect();
        Plan { things, lanes, now, trees, gap, left: BUDGET }
    }

    /// Puts each thing beside what it feeds, as far as its column has room.
    fn settle_all(&mut self) {
        for at in 0..self.now.columns.len() {
            let column = self.now.columns[at].clone();
            let heights: f32 = column.iter().map(|&i| self.things[i].size.y + GAP).sum();
            let wanted = column.iter().filter_map(|&i| {
                let fed = self.lanes.iter().filter(|lane| lane.from.thing == i);
                mean(fed.map(|lane| self.now.top[lane.to.thing] + lane.to.at.y))
            });
            let mut y = mean(wanted).unwrap_or(0.0) - (heights - GAP) / 2.0;
            for i in column {
                self.now.top[i] = up_to_grid(y);
                y = self.now.top[i] + self.things[i].size.y + GAP;
            }
        }
    }

    /// Moves things as long as something becomes better; how bad the rest is.
    fn improve(&mut self) -> f32 {
        let mut cost = self.cost(&self.now);
        while self.left > 0 {
            let before = cost;
            for i in 0..self.things.len() {
                let mut best = None;
                for candidate in self.candidates(i) {
                    if self.left == 0 {
                        return cost;
                    }
                    self.left = self.left.saturating_sub((self.lanes.len() * self.things.len()).max(1));
                    let its = self.cost(&candidate);
                    if its < cost - 0.5 {
                        cost = its;
                        best = Some(candidate);
                    }
                }
                if let Some(best) = best {
                    self.now = best;
                }
            }
            if cost >= before {
                break;
            }
        }
        cost
    }

    /// Whether some wire runs behind a card.
    fn has_hidden_wires(&self) -> bool {
        self.hidden(&self.corners(&self.now)).0 > 0.0
    }

    /// Where else a thing could be, with those that must make way.
    fn candidates(&self, i: usize) -> Vec<Places> {
        let mut all = Vec::new();
        let now = &self.now;
        let top = now.top[i];
        let mut tops: Vec<f32> =
            [1.0, 2.0, 4.0, 8.0, 16.0].iter().flat_map(|by| [top - by * GRID, top + by * GRID]).collect();
        // Level with what it is joined with, and just beside that.
        for lane in self.lanes.iter().filter(|lane| lane.from.thing == i || lane.to.thing == i) {
            let (own, other) = if lane.from.thing == i { (lane.from, lane.to) } else { (lane.to, lane.from) };
            let level = ((now.top[other.thing] + other.at.y - own.at.y) / GRID).round() * GRID;
            tops.extend([level - GRID, level, level + GRID]);
        }
        tops.sort_by(f32::total_cmp);
        tops.dedup();
        for wanted in tops.into_iter().filter(|wanted| *wanted != top) {
            all.push(self.moved(now, i, wanted));
            if self.trees[i].len() > 1 {
                let mut tree = now.clone();
                for &j in &self.trees[i] {
                    tree = self.moved(&tree, j, now.top[j] + wanted - top);
                }
                all.push(tree);
            }
        }
        let column = &now.columns[now.column_of[i]];
        if let Some(place) = column.iter().position(|j| *j == i) {
            for other in place + 1..column.len() {
                let mut swapped = now.clone();
                swapped.columns[now.column_of[i]].swap(place, other);
                let first = column[place..=other].iter().map(|j| now.top[*j]).fold(f32::INFINITY, f32::min);
                let mut y = first;
                for at in place..=other {
                    let j = swapped.columns[now.column_of[i]][at];
                    swapped.top[j] = up_to_grid(y);
                    y = swapped.top[j] + self.things[j].size.y + GAP;
                }
                let last = swapped.columns[now.column_of[i]][other];
                let its = swapped.top[last];
                all.push(self.moved(&swapped, last, its));
            }
        }
        // Another column, between what it feeds and what feeds it.
        let low =
            self.lanes.iter().filter(|lane| lane.from.thing == i).map(|lane| now.column_of[lane.to.thing] + 1).max();
        let high = self.lanes.iter().filter(|lane| lane.to.thing == i).map(|lane| now.column_of[lane.from.thing]).min();
        let (low, high) = (low.unwrap_or(0), high.unwrap_or(now.columns.len()));
        for at in (low..high).filter(|at| *at != now.column_of[i]) {
            let mut other = now.clone();
            other.columns[now.column_of[i]].retain(|j| *j != i);
            let middle = top + self.things[i].size.y / 2.0;
            let above = |j: &usize| now.top[*j] + self.things[*j].size.y / 2.0 < middle;
            let place = other.columns[at].iter().take_while(|j| above(j)).count();
            other.columns[at].insert(place, i);
            other.column_of[i] = at;
            all.push(self.moved(&other, i, top));
        }
        all
    }

    /// With a thing somewhere else in its column; those above and below make way.
    fn moved(&self, places: &Places, i: usize, top: f32) -> Places {
        let mut moved = places.clone();
        moved.top[i] = top;
        let column = &places.columns[places.column_of[i]];
        let Some(place) = column.iter().position(|j| *j == i) else { return moved };
        let mut end = top + self.things[i].size.y;
        for &j in &column[place + 1..] {
            moved.top[j] = moved.top[j].max(up_to_grid(end + GAP));
            end = moved.top[j] + self.things[j].size.y;
        }
        let mut start = top;
        for &j in column[..place].iter().rev() {
            moved.top[j] = moved.top[j].min(down_to_grid(start - GAP - self.things[j].size.y));
            start = moved.top[j];
        }
        moved
    }

    fn places(&self) -> Vec<Pos2> {
        self.corners(&self.now)
    }

    fn corners(&self, places: &Places) -> Vec<Pos2> {
        let mut out = vec![Pos2::ZERO; self.things.len()];
        let mut right = 0.0;
        for column in places.columns.iter().filter(|column| !column.is_empty()) {
            let width = column.iter().map(|&i| self.things[i].size.x).fold(0.0, f32::max);
            for &i in column {
                // Their outputs in one line, and all on the grid.
                out[i] = pos2(down_to_grid(right - self.things[i].size.x), places.top[i]);
            }
            right = down_to_grid(right - width - self.gap);
        }
        out
    }

    /// How bad an arrangement is: wires behind cards first, then wires that cross, then their length and the room that is used.
    fn cost(&self, places: &Places) -> f32 {
        let corners = self.corners(places);
        let (mut cost, ends) = self.hidden(&corners);
        for [from, to] in &ends {
            let way = *to - *from;
            cost += way.y.abs() + 0.2 * way.x.abs() + if way.x < 0.0 { 400.0 } else { 0.0 };
        }
        if ends.len() <= 80 {
            for (i, a) in ends.iter().enumerate() {
                let crossings = ends[..i].iter().filter(|b| wire::crosses(a, b)).count();
                cost += 90.0 * crossings as f32;
            }
        }
        let bounds = corners.iter().zip(self.things).map(|(at, thing)| Rect::from_min_size(*at, thing.size));
        let size = bounds.reduce(Rect::union).map_or(vec2(0.0, 0.0), |rect| rect.size());
        cost + 0.4 * size.y + 0.3 * size.x
    }

    /// What wires behind cards cost, and the ends of all wires.
    fn hidden(&self, corners: &[Pos2]) -> (f32, Vec<[Pos2; 2]>) {
        let cards =
            |i: usize| self.things[i].cards.iter().map(move |card| card.translate(corners[i].to_vec2()).expand(CLEAR));
        let obstacles: Vec<(usize, usize, Rect)> =
            (0..self.things.len()).flat_map(|i| cards(i).enumerate().map(move |(j, rect)| (i, j, rect))).collect();
        let ends: Vec<[Pos2; 2]> =
            self.lanes.iter().map(|lane| [lane.from, lane.to].map(|end| corners[end.thing] + end.at)).collect();
        let (mut cost, mut points) = (0.0, Vec::new());
        for (lane, [from, to]) in self.lanes.iter().zip(&ends) {
            let bounds = wire::bounds(*from, *to, 1.0);
            points.clear();
            for (thing, card, rect) in &obstacles {
                let is_end = |end: End| end.thing == *thing && end.card == *card;
                if !bounds.intersects(*rect) || is_end(lane.from) || is_end(lane.to) {
                    continue;
                }
                if points.is_empty() {
                    wire::curve(*from, *to, 1.0, &mut points);
                }
                let behind = wire::behind(&points, *rect);
                if behind > 0 {
                    cost += BEHIND + 120.0 * behind as f32;
                }
            }
        }
        (cost, ends)
    }
}

/// A thing and all that feeds it alone.
fn tree(root: usize, count: usize, lanes: &[Lane]) -> Vec<usize> {
    let mut is_in = vec![false; count];
    is_in[root] = true;
    loop {
        let feeds = |i: usize| lanes.iter().any(|lane| lane.from.thing == i);
        let only = |i: usize, is_in: &[bool]| {
            lanes.iter().filter(|lane| lane.from.thing == i).all(|lane| is_in[lane.to.thing])
        };
        let Some(next) = (0..count).find(|&i| !is_in[i] && feeds(i) && only(i, &is_in)) else { break };
        is_in[next] = true;
    }
    (0..count).filter(|i| is_in[*i]).collect()
}
