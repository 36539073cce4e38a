//! The two faces of a cube about the poles, each texel the exact mean of a map over its area.
//!
//! The map is taken as piecewise constant. Its cells are drawn on the plane of the face as polygons: meridians are straight
//! lines there, parallels circles of chords. What a texel sees changes only where it is crossed by an edge of two cells, so
//! each edge leaves its step, weighted by what lies beside it, and sums along the rows of texels make the means, as outlines
//! of letters are filled. Cost: an edge or two for each cell, whatever the map's columns crowd to.

use crate::equirect::Equirect;
use std::f64::consts::PI;

/// Chords of the smallest circle: a polygon of 64 corners lacks 0.16 % of it.
const FEWEST_CHORDS: usize = 64;

/// The texels of face +Y, or with `below` -Y, row by row.
pub(super) fn pole_face(map: &Equirect, size: usize, below: bool) -> Vec<[f32; 3]> {
    // Beyond the corners of the face, at the square root of 2, nothing is drawn.
    let radius = |row: usize| (PI * row as f64 / map.height as f64).tan();
    let in_front = map.height / 2;
    let rows = (1..in_front).find(|&row| radius(row) > 1.5).unwrap_or(in_front);
    // More than one chord for each column only where there are few.
    let finer = FEWEST_CHORDS.div_ceil(map.width);
    let corners = map.width * finer;
    let directions: Vec<[f64; 2]> = (0..corners)
        .map(|k| {
            let (sin, cos) = (2.0 * PI * (k as f64 / corners as f64 - 0.5)).sin_cos();
            [cos, sin]
        })
        .collect();
    let point = |radius: f64, direction: [f64; 2]| direction.map(|x| (x * radius + 1.0) * 0.5 * size as f64);

    let mut steps = Steps { size, sums: vec![[0.0; 3]; size * (size + 2)] };
    let mut inner = cells(map, 0, below);
    for row in 0..rows {
        // Outside of all is black.
        let outer = if row + 1 < rows { cells(map, row + 1, below) } else { vec![[0.0; 3]; inner.len()] };
        let far = if row + 1 < in_front { radius(row + 1) } else { 1e3 };
        let (near, count) = (radius(row), inner.len());
        for (k, &cell) in inner.iter().enumerate() {
            let direction = directions[k * (corners / count)];
            let before = inner[(k + count - 1) % count];
            steps.add(point(near, direction), point(far, direction), difference(before, cell));
        }
        let chords = outer.len().max(count) * finer;
        for k in 0..chords {
            let [from, to] = [k, (k + 1) % chords].map(|k| point(far, directions[k * (corners / chords)]));
            let step = difference(outer[k * outer.len() / chords], inner[k * count / chords]);
            steps.add(from, to, step);
        }
        inner = outer;
    }
    steps.summed(below)
}

/// A row of the map, counted from the pole, with so many of its columns averaged together that its cells are not much
/// narrower than they are high.
fn cells(map: &Equirect, row: usize, below: bool) -> Vec<[f64; 3]> {
    let start = map.width * if below { map.height - 1 - row } else { row };
    let around = 2.0 * map.height as f64 * (PI * (row as f64 + 0.5) / map.height as f64).sin();
    let mut together = 1;
    while map.width.is_multiple_of(2 * together) && map.width / (2 * together) >= FEWEST_CHORDS.max(around as usize) {
        together *= 2;
    }
    let mean = |texels: &[[f32; 3]]| {
        std::array::from_fn(|c| texels.iter().map(|texel| f64::from(texel[c])).sum::<f64>() / together as f64)
    };
    map.pixels[start..start + map.width].chunks_exact(together).map(mean).collect()
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| a[c] - b[c])
}

/// By how much the mean of each texel is larger than that of the one before it in its row; two more than a row has take
/// what lies beyond its end.
struct Steps {
    size: usize,
    sums: Vec<[f64; 3]>,
}

impl Steps {
    /// An edge between two points in texels, and what is larger on its one side than on the other: on the side of a quarter
    /// turn from x to -y of its direction.
    fn add(&mut self, from: [f64; 2], to: [f64; 2], step: [f64; 3]) {
        if step == [0.0; 3] || from[1] == to[1] {
            return;
        }
        let (sign, [x_0, y_0], [x_1, y_1]) = if from[1] < to[1] { (1.0, from, to) } else { (-1.0, to, from) };
        let slope = (x_1 - x_0) / (y_1 - y_0);
        let last = self.size as f64;
        let x_at = |y: f64| (x_0 + (y - y_0) * slope).clamp(0.0, last);
        let (top, bottom) = (y_0.max(0.0), y_1.min(last));
        let mut y = top;
        while y < bottom {
            let row = y as usize;
            let end = bottom.min((row + 1) as f64);
            let (a, b) = (x_at(y), x_at(end));
            let (left, right) = (a.min(b), a.max(b));
            let height = sign * (end - y);
            let line = &mut self.sums[row * (self.size + 2)..][..self.size + 2];
            let mut x = left;
            loop {
                let column = x as usize;
                let next = right.min((column + 1) as f64);
                // What of the texel lies beside the edge counts in it, the rest from the next one on.
                let part = if right > left { height * (next - x) / (right - left) } else { height };
                let rest = part * (0.5 * (x + next) - column as f64);
                for c in 0..3 {
                    line[column][c] += step[c] * (part - rest);
                    line[column + 1][c] += step[c] * rest;
                }
                if next >= right {
                    break;
                }
                x = next;
            }
            y = end;
        }
    }

    /// The means; with `flipped` the last row first.
    fn summed(&self, flipped: bool) -> Vec<[f32; 3]> {
        let row = |row: usize| {
            let mut sum = [0.0; 3];
            self.sums[row * (self.size + 2)..][..self.size].iter().map(move |step| {
                sum = std::array::from_fn(|c| sum[c] + step[c]);
                sum.map(|x: f64| x.max(0.0) as f32)
            })
        };
        (0..self.size).flat_map(|k| row(if flipped { self.size - 1 - k } else { k })).collect()
    }
}
