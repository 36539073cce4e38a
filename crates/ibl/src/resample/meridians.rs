//! A cube of a map, each texel the mean over its solid angle.
//!
//! Solid angle is azimuth times cosine of the polar angle. So the sphere is cut into slices between meridians, in none
//! of which an edge of a column of the map lies, nor a corner of the cube's texels. Along the middle of each slice runs
//! a walk from texel to texel of the cube and from row to row of the map, and each step adds the radiance there times
//! the slice's width and the step's cosines. On the four faces round the horizon meridians run along columns of the
//! cube, on the faces about the poles they are rays across it.
//!
//! Where texels of the map are larger than the cube's, steps between them become ramps. A ramp gives as much to one
//! side as it takes from the other, so that it moves light only where an edge of the cube's texels lies within it.

use crate::cube::Cube;
use crate::equirect::Equirect;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// The fewest slices across a face: in each the azimuth is that of its middle.
const FEWEST_SLICES: usize = 64;

/// The faces that look to azimuth 0, a quarter turn from +X towards +Z, and so on.
const FACE_OF_QUARTER: [usize; 4] = [0, 4, 1, 5];

/// See [`cube_from_equirect`](super::cube_from_equirect).
pub(super) fn area_means(map: &Equirect, size: usize) -> Cube {
    let resampling = Resampling::new(map, size);
    let mut cube = Cube { size, texels: vec![[0.0; 3]; 6 * size * size] };
    // Where columns of the map go evenly into quarters, what is found out for one of them is true for all.
    if map.width.is_multiple_of(4) {
        resampling.quarters::<4>(0, &mut cube);
    } else {
        (0..4).for_each(|quarter| resampling.quarters::<1>(quarter, &mut cube));
    }
    cube
}

/// What all walks share.
struct Resampling<'a> {
    map: &'a Equirect,
    size: usize,
    /// Cosine of the polar angle at the upper edge of each row, and at the last one's lower edge.
    edges: Vec<f64>,
    /// How many columns of the map the cube's texels span in each row: on the faces about the poles, and on those round
    /// the horizon in the middle of the face.
    across: [Vec<f64>; 2],
    /// Whether any texel of the cube is smaller than one of the map.
    ramps: bool,
}

impl Resampling<'_> {
    fn new(map: &Equirect, size: usize) -> Resampling<'_> {
        let angle = |rows: f64| PI * rows / map.height as f64;
        let column = TAU / map.width as f64;
        let largest = (PI / map.height as f64).max(column);
        let rows = |value: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            let middle = |row: usize| angle(row as f64 + 0.5).sin_cos();
            (0..map.height).map(middle).map(|(sin, cos)| value(sin, cos)).collect()
        };
        Resampling {
            map,
            size,
            edges: (0..=map.height).map(|row| angle(row as f64).cos()).collect(),
            across: [
                rows(&|sin, cos| texel_width(size, cos.abs()) / (column * sin)),
                rows(&|sin, _| texel_width(size, sin) / (column * sin)),
            ],
            // The smallest lie at the corners, where the largest component of a direction is 1 / sqrt(3).
            ramps: texel_width(size, 3f64.sqrt().recip()) < largest,
        }
    }

    /// The texels that belong to N quarters of the sphere, from one on.
    fn quarters<const N: usize>(&self, first: usize, cube: &mut Cube) {
        let size = self.size;
        let columns: Vec<_> = (0..size).into_par_iter().map(|column| self.side_column::<N>(first, column)).collect();
        for (i, column) in columns.iter().enumerate() {
            for (j, texels) in column.iter().enumerate() {
                for (k, texel) in texels.iter().enumerate() {
                    cube.texels[(FACE_OF_QUARTER[first + k] * size + j) * size + i] = *texel;
                }
            }
        }
        drop(columns);
        let strips: Vec<_> =
            (size / 2..size).into_par_iter().map(|major| self.pole_strips::<N>(first, major)).collect();
        for (major, strips) in (size / 2..size).zip(&strips) {
            for (minor, poles) in (size - 1 - major..).zip(strips) {
                for (below, texels) in poles.iter().enumerate() {
                    for (k, texel) in texels.iter().enumerate() {
                        let (i, j) = turned(first + k, size, major, minor);
                        let j = if below == 1 { size - 1 - j } else { j };
                        // Quarters meet in the diagonals, and all four in the middle of an odd number.
                        let diagonal = |minor: usize| if minor == major { 0.5 } else { 1.0 };
                        let share = diagonal(minor) * diagonal(size - 1 - minor);
                        for (sum, x) in cube.texels[((2 + below) * size + j) * size + i].iter_mut().zip(texel) {
                            *sum += share * x;
                        }
                    }
                }
            }
        }
    }

    /// The texels of a column of N faces round the horizon, from the top.
    fn side_column<const N: usize>(&self, first: usize, column: usize) -> Vec<[[f32; 3]; N]> {
        let size = self.size;
        let place = |i: usize| 2.0 * i as f64 / size as f64 - 1.0;
        let mut means = Means::new(size);
        let mut walk = Walk::new(self);
        // Seen from within, columns run against the azimuth.
        for slice in self.slices(first, evenly([-place(column + 1), -place(column)], FEWEST_SLICES.div_ceil(size))) {
            let slope = (1.0 + slice.tan * slice.tan).sqrt().recip();
            let cos = |j: usize| {
                let t = place(j) * slope;
                -t / (1.0 + t * t).sqrt()
            };
            let largest = |cos: f64| (1.0 - cos * cos).sqrt() * slope;
            // At the rims of the face.
            let rim = slice.ends.map(|tan| (2.0 + tan * tan).sqrt().recip());
            walk.start(cos(0), slice.width);
            walk.cross(rim, largest(cos(0)), None, Some(0));
            for j in 0..size - 1 {
                let end = cos(j + 1);
                walk.go_on(end, j);
                walk.cross([end; 2], largest(end), Some(j), Some(j + 1));
            }
            walk.go_on(cos(size), size - 1);
            walk.cross(rim.map(|cos| -cos), largest(cos(size)), Some(size - 1), None);
            means.weigh(&walk.steps);
            let at_edge = (1.0 + slice.edge_tan * slice.edge_tan).powf(-0.75);
            means.add(self, &slice, &walk.steps, 0, false, |row| self.across[1][row] * at_edge);
        }
        means.finished().into_iter().map(|[texels]| texels).collect()
    }

    /// The texels of a row of texels along the rim of N quarters of the faces about the poles, or along a line within
    /// them; above, and below.
    fn pole_strips<const N: usize>(&self, first: usize, major: usize) -> Vec<[[[f32; 3]; N]; 2]> {
        let size = self.size;
        let place = |i: f64| 2.0 * i / size as f64 - 1.0;
        // The middle of an odd number reaches over to the other side.
        let (near, far) = (place(major as f64).max(0.0), place((major + 1) as f64));
        let offset = size - 1 - major;
        let count = 2 * major + 2 - size;
        let mut means = Means::new(count);
        let mut walk = Walk::new(self);
        let mut cuts = evenly([-1.0, 1.0], if count < FEWEST_SLICES { FEWEST_SLICES } else { 1 });
        // Towards corners of texels at the strip's outer side, and at its inner one.
        let corners = || (1..count).map(|k| place((k + offset) as f64));
        cuts.extend(corners().map(|along| along / far));
        cuts.extend(corners().filter(|along| along.abs() < near).map(|along| along / near));
        // Across the triangles at its ends chords grow from nothing.
        let finer = |k: usize| 1.0 - (1.0 - near / far) * k as f64 / 4.0;
        cuts.extend((1..4).flat_map(|k| [finer(k), -finer(k)]));
        for slice in self.slices(first, cuts) {
            let length2 = 1.0 + slice.tan * slice.tan;
            let cos = |p: f64| (1.0 + p * p * length2).sqrt().recip();
            let ends = |p: f64| slice.ends.map(|tan| (1.0 + p * p * (1.0 + tan * tan)).sqrt().recip());
            // Where along the strip the ray lies, in texels.
            let along = |p: f64| (p * slice.tan + 1.0) * 0.5 * size as f64 - offset as f64;
            let last = count - 1;
            let texel_at = |p: f64| (along(p).max(0.0) as usize).min(last);
            let (from, to) = (texel_at(near), texel_at(far));
            walk.start(cos(near), slice.width);
            walk.cross(ends(near), cos(near), None, Some(from));
            let mut texel = from;
            while texel != to {
                let next = if to > texel { texel + 1 } else { texel - 1 };
                let edge = place((texel.max(next) + offset) as f64);
                let end = cos((edge / slice.tan).clamp(near, far));
                walk.go_on(end, texel);
                walk.cross([end; 2], end, Some(texel), Some(next));
                texel = next;
            }
            walk.go_on(cos(far), to);
            walk.cross(ends(far), cos(far), Some(to), None);
            means.weigh(&walk.steps);
            for (place, below) in [false, true].into_iter().enumerate() {
                means.add(self, &slice, &walk.steps, place, below, |row| self.across[0][row]);
            }
        }
        means.finished()
    }

    /// Slices from cut to cut, given by the tangents of their angles from the middle of a quarter, in any order; also
    /// cut where columns of the map meet, with ramps where they have their middles, too.
    fn slices(&self, quarter: usize, cuts: Vec<f64>) -> Vec<Slice> {
        let width = self.map.width as f64;
        let middle = width * (0.5 + 0.25 * quarter as f64);
        let tan = |column: f64| ((column - middle) * TAU / width).tan();
        let pieces = if self.ramps { 2.0 } else { 1.0 };
        let mut cuts: Vec<f64> = cuts.into_iter().map(|tan| middle + width / TAU * tan.atan()).collect();
        let [first, last] = [f64::min, f64::max].map(|choice| cuts.iter().copied().fold(cuts[0], choice));
        let edges = (first * pieces).ceil() as isize..=(last * pieces).floor() as isize;
        cuts.extend(edges.map(|edge| edge as f64 / pieces));
        cuts.sort_by(f64::total_cmp);
        let mut start = first;
        let mut slices = Vec::with_capacity(cuts.len());
        for end in cuts {
            // Slivers go to what follows.
            if end < start + 1e-9 {
                continue;
            }
            let at = 0.5 * (start + end);
            let own = at.floor();
            let (edge, other) = if at - own < 0.5 { (own, own - 1.0) } else { (own + 1.0, own + 1.0) };
            let wrapped = |column: f64| (column as isize).rem_euclid(self.map.width as isize) as usize;
            let [a, b] = [start, end].map(|column| (column - edge).abs());
            slices.push(Slice {
                tan: tan(at),
                ends: [start, end].map(tan),
                width: (end - start) * TAU / width,
                column: wrapped(own),
                other: wrapped(other),
                edge_tan: if self.ramps { tan(edge) } else { 0.0 },
                distances: [a.min(b), a.max(b)],
            });
            start = end;
        }
        slices
    }
}

/// A range's ends, and what cuts it into so many equal parts.
fn evenly([from, to]: [f64; 2], parts: usize) -> Vec<f64> {
    (0..=parts).map(|k| from + (to - from) * k as f64 / parts as f64).collect()
}

/// The texel of the face about the upper pole that lies `major` outwards and `minor` along in a quarter: column and row.
fn turned(quarter: usize, size: usize, major: usize, minor: usize) -> (usize, usize) {
    let other = |i: usize| size - 1 - i;
    match quarter {
        0 => (major, minor),
        1 => (other(minor), major),
        2 => (other(major), other(minor)),
        _ => (minor, other(major)),
    }
}

/// The root of the solid angle of a texel of the cube in a unit direction, whose largest component counts: the area of
/// the texel over the cube of its distance.
fn texel_width(size: usize, largest_component: f64) -> f64 {
    2.0 / size as f64 * largest_component * largest_component.sqrt()
}

/// What lies between two meridians, within one column of the map.
struct Slice {
    /// Tangent of the angle of its middle from the middle of its quarter.
    tan: f64,
    /// The same of its ends.
    ends: [f64; 2],
    /// In radians.
    width: f64,
    column: usize,
    /// The column beyond the nearer edge of its own.
    other: usize,
    /// That edge's tangent.
    edge_tan: f64,
    /// Its ends' distances from that edge, in columns, the nearer first.
    distances: [f64; 2],
}

impl Slice {
    /// The other column's share where the ramp goes so many columns to each side of the edge: 1/2 there, 0 at its end.
    fn share_of_other(&self, ramp: f64) -> f64 {
        if ramp <= self.distances[0] {
            return 0.0;
        }
        let [near, far] = self.distances.map(|distance| (ramp - distance).max(0.0).powi(2));
        (near - far) / (4.0 * ramp * (self.distances[1] - self.distances[0]))
    }
}

/// So much solid angle of a row of the map belongs to a texel of the cube.
struct Step {
    texel: usize,
    row: usize,
    /// Whether it is the column of the map on the other side of the pole that counts.
    over_pole: bool,
    weight: f64,
}

/// A walk down a slice.
struct Walk<'a> {
    resampling: &'a Resampling<'a>,
    /// Where it has got to: the row, and the cosine of the polar angle.
    row: usize,
    cos: f64,
    width: f64,
    steps: Vec<Step>,
}

impl<'a> Walk<'a> {
    fn new(resampling: &'a Resampling<'a>) -> Walk<'a> {
        Walk { resampling, row: 0, cos: 1.0, width: 0.0, steps: Vec::new() }
    }

    /// Begins anew; the row of the last walk's end is where the search for its row begins.
    fn start(&mut self, cos: f64, width: f64) {
        let edges = &self.resampling.edges;
        while self.row > 0 && edges[self.row] < cos {
            self.row -= 1;
        }
        while self.row + 2 < edges.len() && edges[self.row + 1] >= cos {
            self.row += 1;
        }
        (self.cos, self.width) = (cos, width);
        self.steps.clear();
    }

    /// Goes on to a smaller cosine, within a texel of the cube.
    fn go_on(&mut self, cos: f64, texel: usize) {
        let edges = &self.resampling.edges;
        if self.row == 0 {
            let moved = self.width * (self.over_pole(cos) - self.over_pole(self.cos));
            if moved > 0.0 {
                self.steps.push(Step { texel, row: 0, over_pole: true, weight: moved });
                self.steps.push(Step { texel, row: 0, over_pole: false, weight: -moved });
            }
        }
        while self.row + 2 < edges.len() && edges[self.row + 1] > cos {
            let edge = edges[self.row + 1];
            self.steps.push(Step { texel, row: self.row, over_pole: false, weight: self.width * (self.cos - edge) });
            self.cos = edge;
            self.row += 1;
        }
        self.steps.push(Step { texel, row: self.row, over_pole: false, weight: self.width * (self.cos - cos) });
        self.cos = cos;
    }

    /// How much from the pole to a cosine the ramp over it gives to the other side.
    fn over_pole(&self, cos: f64) -> f64 {
        let Resampling { edges, map, size, ramps, .. } = self.resampling;
        let smaller = 1.0 - texel_width(*size, 1.0) * map.height as f64 / PI;
        // With fewer rows it would reach beyond the faces about the poles.
        if !ramps || smaller <= 0.0 || map.height < 4 {
            return 0.0;
        }
        let ramp = 0.5 * smaller * (edges[0] - edges[1]);
        let distance = (edges[0] - cos).min(ramp);
        0.5 * distance - distance * distance / (4.0 * ramp)
    }

    /// Crosses from one texel into another: by how much of the map's next row the one has more, and the other less,
    /// than what the middle of the slice says. The cosines are those at the slice's ends where the other texel is
    /// another walk's, in other slices, and else the walk's own; the largest component is that of the unit direction.
    fn cross(&mut self, cosines: [f64; 2], largest_component: f64, from: Option<usize>, to: Option<usize>) {
        let Resampling { edges, map, size, ramps, .. } = self.resampling;
        if !ramps && cosines[0] == cosines[1] {
            return;
        }
        let smaller = (1.0 - texel_width(*size, largest_component) * map.height as f64 / PI).max(0.0);
        for lower in [self.row, self.row + 1] {
            if lower == 0 || lower == map.height {
                continue;
            }
            let height = |row: usize| edges[row] - edges[row + 1];
            let ramp = 0.5 * smaller * height(lower - 1).min(height(lower));
            let beyond = |cos: f64| edges[lower] - cos;
            let moved = self.width * (mean_beyond(cosines.map(beyond), ramp) - beyond(self.cos).max(0.0));
            // Far from the row's edge the two are the same but for rounding.
            if moved <= 1e-12 * self.width {
                continue;
            }
            for (texel, moved) in [(from, moved), (to, -moved)] {
                if let Some(texel) = texel {
                    self.steps.push(Step { texel, row: lower, over_pole: false, weight: moved });
                    self.steps.push(Step { texel, row: lower - 1, over_pole: false, weight: -moved });
                }
            }
        }
    }
}

/// How much lies beyond the edge of a row up to a distance d: nothing or d itself, with a ramp to each side
/// (d + ramp)^2 / (4 ramp) within it. The mean of it between two distances.
fn mean_beyond([a, b]: [f64; 2], ramp: f64) -> f64 {
    if a.max(b) <= -ramp {
        return 0.0;
    }
    if a.min(b) >= ramp {
        return 0.5 * (a + b);
    }
    if (a - b).abs() < 1e-4 * ramp {
        return (0.5 * (a + b) + ramp).powi(2) / (4.0 * ramp);
    }
    let summed = |d: f64| {
        if d <= -ramp {
            0.0
        } else if d >= ramp {
            0.5 * d * d + ramp * ramp / 6.0
        } else {
            (d + ramp).powi(3) / (12.0 * ramp)
        }
    };
    (summed(b) - summed(a)) / (b - a)
}

/// Sums for some texels in each of N quarters, P times.
struct Means<const N: usize, const P: usize> {
    weights: Vec<f64>,
    sums: Vec<[[[f64; 3]; N]; P]>,
}

impl<const N: usize, const P: usize> Means<N, P> {
    fn new(texels: usize) -> Self {
        Means { weights: vec![0.0; texels], sums: vec![[[[0.0; 3]; N]; P]; texels] }
    }

    fn weigh(&mut self, steps: &[Step]) {
        for step in steps {
            self.weights[step.texel] += step.weight;
        }
    }

    /// Adds the map's radiance along a walk, and along the same in the other quarters; `below` with the rows from the
    /// bottom. `across` says how many columns of the map the cube's texels span in a row.
    fn add(
        &mut self,
        resampling: &Resampling<'_>,
        slice: &Slice,
        steps: &[Step],
        place: usize,
        below: bool,
        across: impl Fn(usize) -> f64,
    ) {
        let Equirect { width: columns, height, pixels } = resampling.map;
        let quarter = columns / 4;
        let of_quarters = |column: usize| -> [usize; N] { std::array::from_fn(|k| (column + k * quarter) % columns) };
        let (own, other) = (of_quarters(slice.column), of_quarters(slice.other));
        let over_pole = of_quarters(slice.column + columns / 2);
        for step in steps {
            let row = if below { height - 1 - step.row } else { step.row };
            let line = &pixels[row * columns..][..*columns];
            let sums = &mut self.sums[step.texel][place];
            let own = if step.over_pole { &over_pole } else { &own };
            let share = if resampling.ramps && !step.over_pole {
                slice.share_of_other(0.5 * (1.0 - across(step.row)))
            } else {
                0.0
            };
            let [mine, others] = [step.weight * (1.0 - share), step.weight * share];
            for k in 0..N {
                let texel = line[own[k]];
                for c in 0..3 {
                    sums[k][c] += mine * f64::from(texel[c]);
                }
            }
            if share > 0.0 {
                for k in 0..N {
                    let texel = line[other[k]];
                    for c in 0..3 {
                        sums[k][c] += others * f64::from(texel[c]);
                    }
                }
            }
        }
    }

    fn finished(self) -> Vec<[[[f32; 3]; N]; P]> {
        let mean = |(sums, weight): ([[[f64; 3]; N]; P], f64)| {
            sums.map(|sums| sums.map(|sum| sum.map(|x| (x / weight).max(0.0) as f32)))
        };
        self.sums.into_iter().zip(self.weights).map(mean).collect()
    }
}
