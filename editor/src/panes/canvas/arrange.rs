//! Places for cards by depth: what feeds a card stands left of it, and each column is ordered so that few wires cross.
//! The same graph gives the same places.
//!
//! Sugiyama, Tagawa and Toda 1981, "Methods for visual understanding of hierarchical system structures": layers by the
//! longest path, then orders by barycentres, swept from right to left and back.

use eframe::egui::{Pos2, Vec2, pos2};

use super::sheet::{Card, Wire};
use super::view::to_grid;

/// Free space between columns and between cards of one column.
const GAP: [f32; 2] = [70.0, 24.0];
const SWEEPS: usize = 6;

/// Places for the given cards, with the corner of them all at the origin.
pub(super) fn places(cards: &[Card], wires: &[Wire], chosen: &[usize]) -> Vec<(usize, Pos2)> {
    let sizes: Vec<Vec2> = chosen.iter().map(|&card| cards[card].size).collect();
    let mut place_of = vec![None; cards.len()];
    chosen.iter().enumerate().for_each(|(place, &card)| place_of[card] = Some(place));
    let places = places_of(&sizes, edges(wires, &place_of));
    chosen.iter().copied().zip(places).collect()
}

/// Wires between what cards belong to, as from, to and the row of the input; each once. Those within one thing are left out.
pub(super) fn edges(wires: &[Wire], thing_of: &[Option<usize>]) -> Vec<[usize; 3]> {
    let ends = wires.iter().filter_map(|wire| Some([thing_of[wire.from.0]?, thing_of[wire.to.0]?, wire.to.1]));
    let mut edges: Vec<[usize; 3]> = ends.filter(|[from, to, _]| from != to).collect();
    // By the row of the socket, so that neighbours keep the order of a card's inputs.
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Places for things of these sizes, with the corner of them all at the origin.
pub(super) fn places_of(sizes: &[Vec2], edges: Vec<[usize; 3]>) -> Vec<Pos2> {
    let columns = ordered(columns(sizes.len(), &edges), &edges, sizes.len());
    let mut right = 0.0;
    let mut out = vec![Pos2::ZERO; sizes.len()];
    let mut middle = vec![0.0; sizes.len()];
    for column in &columns {
        let width = column.iter().map(|&i| sizes[i].x).fold(0.0, f32::max);
        right -= width;
        let heights: f32 = column.iter().map(|&i| sizes[i].y + GAP[1]).sum();
        // A thing stands beside what it feeds, and no higher than its upper neighbour's end.
        let wanted: Vec<f32> = column
            .iter()
            .map(|&i| mean(edges.iter().filter(|edge| edge[0] == i).map(|edge| middle[edge[1]])).unwrap_or(0.0))
            .collect();
        let start = mean(wanted.iter().copied()).unwrap_or(0.0) - (heights - GAP[1]) / 2.0;
        let mut y = start;
        for &i in column {
            middle[i] = y + sizes[i].y / 2.0;
            out[i] = pos2(right + width - sizes[i].x, y);
            y += sizes[i].y + GAP[1];
        }
        right -= GAP[0];
    }
    let corner = out.iter().fold(pos2(f32::INFINITY, f32::INFINITY), |corner, place| corner.min(*place));
    out.iter().map(|place| to_grid((*place - corner).to_pos2())).collect()
}

/// The cards by the longest way to an end, which is column 0. Wires that close a ring are overlooked.
fn columns(count: usize, edges: &[[usize; 3]]) -> Vec<Vec<usize>> {
    let mut depth = vec![0; count];
    // In a graph without rings no depth can reach the number of cards.
    for _ in 0..count {
        let mut is_stable = true;
        for [from, to, _] in edges {
            if depth[*from] <= depth[*to] && depth[*to] + 1 < count {
                depth[*from] = depth[*to] + 1;
                is_stable = false;
            }
        }
        if is_stable {
            break;
        }
    }
    let deepest = depth.iter().copied().max().unwrap_or(0);
    let mut columns = vec![Vec::new(); deepest + 1];
    (0..count).for_each(|i| columns[depth[i]].push(i));
    columns.retain(|column: &Vec<usize>| !column.is_empty());
    columns
}

/// Each column in the order of what its cards are joined with.
fn ordered(mut columns: Vec<Vec<usize>>, edges: &[[usize; 3]], count: usize) -> Vec<Vec<usize>> {
    let mut rank = vec![0.0; count];
    let number = |columns: &[Vec<usize>], rank: &mut [f32]| {
        for column in columns {
            column.iter().enumerate().for_each(|(place, &i)| rank[i] = place as f32);
        }
    };
    number(&columns, &mut rank);
    for sweep in 0..SWEEPS {
        let to_left = sweep % 2 == 0;
        let order: Vec<usize> = if to_left { (0..columns.len()).collect() } else { (0..columns.len()).rev().collect() };
        for at in order {
            let mut column: Vec<(f32, usize)> = columns[at]
                .iter()
                .map(|&i| {
                    let near = edges.iter().filter_map(|&[from, to, row]| {
                        if to_left && from == i {
                            Some(rank[to] + row as f32 * 0.01)
                        } else if !to_left && to == i {
                            Some(rank[from])
                        } else {
                            None
                        }
                    });
                    (mean(near).unwrap_or(rank[i]), i)
                })
                .collect();
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
