//! The curve of a wire: its points on the screen and how far it is from a point.

use eframe::egui::{Pos2, Rect, vec2};

/// Points of the curve from an output to an input: a cubic that leaves and arrives level.
pub(super) fn curve(from: Pos2, to: Pos2, zoom: f32, out: &mut Vec<Pos2>) {
    out.clear();
    let reach = reach(from, to, zoom);
    let (a, b) = (from + vec2(reach, 0.0), to - vec2(reach, 0.0));
    let steps = steps(from, to);
    for i in 0..=steps {
        let t = i as f32 / steps as f32;
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let point = from.to_vec2() * weights[0]
            + a.to_vec2() * weights[1]
            + b.to_vec2() * weights[2]
            + to.to_vec2() * weights[3];
        out.push(point.to_pos2());
    }
}

/// A rectangle that the curve does not leave.
pub(super) fn bounds(from: Pos2, to: Pos2, zoom: f32) -> Rect {
    // The control points span a hull around the curve.
    let reach = reach(from, to, zoom);
    Rect::from_two_pos(from, to).union(Rect::from_two_pos(from + vec2(reach, 0.0), to - vec2(reach, 0.0))).expand(4.0)
}

/// How far a point is from a row of points that are joined by lines.
pub(super) fn distance(points: &[Pos2], to: Pos2) -> f32 {
    points.windows(2).map(|ends| segment_distance(ends[0], ends[1], to)).fold(f32::INFINITY, f32::min)
}

/// How many of the lines between points touch a rectangle.
pub(super) fn behind(points: &[Pos2], rect: Rect) -> usize {
    points.windows(2).filter(|ends| touches(ends[0], ends[1], rect)).count()
}

/// Whether two wires that lead to the right change sides.
pub(super) fn crosses(a: &[Pos2; 2], b: &[Pos2; 2]) -> bool {
    let (left, right) = (a[0].x.max(b[0].x), a[1].x.min(b[1].x));
    if left >= right || a[0] == b[0] || a[1] == b[1] {
        return false;
    }
    // The heights of the curves, level at both ends, where both are there.
    let height = |[from, to]: &[Pos2; 2], x: f32| {
        let t = ((x - from.x) / (to.x - from.x)).clamp(0.0, 1.0);
        from.y + (to.y - from.y) * t * t * (3.0 - 2.0 * t)
    };
    let (before, after) = (height(a, left) - height(b, left), height(a, right) - height(b, right));
    before * after < 0.0
}

/// Whether a line touches a rectangle: what is left of it after cutting at each side. Liang and Barsky 1984, "A new concept and method
/// for line clipping".
fn touches(a: Pos2, b: Pos2, rect: Rect) -> bool {
    let way = b - a;
    let (mut enters, mut leaves) = (0.0_f32, 1.0_f32);
    for (start, along, low, high) in [(a.x, way.x, rect.left(), rect.right()), (a.y, way.y, rect.top(), rect.bottom())]
    {
        if along == 0.0 {
            if start < low || start > high {
                return false;
            }
            continue;
        }
        let (first, second) = ((low - start) / along, (high - start) / along);
        enters = enters.max(first.min(second));
        leaves = leaves.min(first.max(second));
    }
    enters <= leaves
}

/// How far the curve's handles stick out: half of the way, with a little slack for wires that lead back.
fn reach(from: Pos2, to: Pos2, zoom: f32) -> f32 {
    let way = to - from;
    if way.x >= 0.0 {
        (way.x * 0.5).max((way.y.abs() * 0.35).min(40.0 * zoom))
    } else {
        (-way.x * 0.35 + 30.0 * zoom).min(160.0 * zoom)
    }
}

fn steps(from: Pos2, to: Pos2) -> usize {
    let way = to - from;
    if way.y.abs() < 1.0 && way.x > 0.0 {
        return 1;
    }
    (way.length() / 14.0).clamp(6.0, 28.0) as usize
}

fn segment_distance(a: Pos2, b: Pos2, point: Pos2) -> f32 {
    let way = b - a;
    let along = ((point - a).dot(way) / way.length_sq().max(1e-6)).clamp(0.0, 1.0);
    (a + way * along).distance(point)
}
