//! Where dragged cards come to rest: in line with others near by, or on the grid.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::view::GRID;

/// How near an edge must be to another one to be drawn there, in screen points.
const PULL: f32 = 6.0;

/// A way to go, and the lines that it brings cards in line with.
#[derive(Clone, Debug, Default)]
pub(super) struct Snapped {
    pub(super) way: Vec2,
    /// Lines on the canvas to be shown.
    pub(super) lines: Vec<[Pos2; 2]>,
}

/// The way nearest to `way` that brings a rectangle in line with another one, or its corner to the grid.
pub(super) fn snap(moving: Rect, others: &[Rect], way: Vec2, zoom: f32) -> Snapped {
    let moved = moving.translate(way);
    let edges =
        |rect: &Rect| ([rect.left(), rect.center().x, rect.right()], [rect.top(), rect.center().y, rect.bottom()]);
    let (xs, ys) = edges(&moved);
    let mut best = [None::<f32>; 2];
    for other in others {
        let (other_xs, other_ys) = edges(other);
        for (axis, own, theirs) in [(0, xs, other_xs), (1, ys, other_ys)] {
            for (mine, its) in own.iter().zip(theirs) {
                let by = its - mine;
                if by.abs() * zoom <= PULL && best[axis].is_none_or(|best| by.abs() < best.abs()) {
                    best[axis] = Some(by);
                }
            }
        }
    }
    let to_grid = |x: f32| (x / GRID).round() * GRID - x;
    let by = vec2(best[0].unwrap_or_else(|| to_grid(moved.left())), best[1].unwrap_or_else(|| to_grid(moved.top())));
    let rest = moved.translate(by);
    Snapped { way: way + by, lines: lines(rest, others, best) }
}

/// The lines along which a rectangle agrees with others.
fn lines(rest: Rect, others: &[Rect], found: [Option<f32>; 2]) -> Vec<[Pos2; 2]> {
    let mut lines = Vec::new();
    let agree = |a: f32, b: f32| (a - b).abs() < 0.01;
    for other in others {
        let both = rest.union(*other);
        if found[0].is_some() {
            for (mine, its) in
                [(rest.left(), other.left()), (rest.center().x, other.center().x), (rest.right(), other.right())]
            {
                if agree(mine, its) {
                    lines.push([pos2(mine, both.top()), pos2(mine, both.bottom())]);
                }
            }
        }
        if found[1].is_some() {
            for (mine, its) in
                [(rest.top(), other.top()), (rest.center().y, other.center().y), (rest.bottom(), other.bottom())]
            {
                if agree(mine, its) {
                    lines.push([pos2(both.left(), mine), pos2(both.right(), mine)]);
                }
            }
        }
    }
    lines
}
