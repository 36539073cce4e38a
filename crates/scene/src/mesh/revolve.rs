//! Grids of quads over texture space, and profiles turned about +Y: what the built-in shapes are made with.

use super::MeshData;

/// A point of a surface: position and unit normal.
pub(super) type SurfacePoint = ([f64; 3], [f64; 3]);

/// Adds a grid of `columns` x `rows` quads, (u, v) from (0, 0) top left to (1, 1) bottom right as seen from outside.
/// `point` is given the column and row; a closed surface returns the same point for its first and last one.
pub(super) fn add_grid(
    data: &mut MeshData,
    [columns, rows]: [usize; 2],
    mut point: impl FnMut(usize, usize) -> SurfacePoint,
) {
    let first = data.positions.len() as u32;
    for row in 0..=rows {
        for column in 0..=columns {
            let uv = [column as f64 / columns as f64, row as f64 / rows as f64];
            push(data, point(column, row), uv);
        }
    }
    let at = |column: usize, row: usize| first + (row * (columns + 1) + column) as u32;
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (at(column, row), at(column + 1, row));
            let (c, d) = (at(column, row + 1), at(column + 1, row + 1));
            data.indices.extend([a, c, d, a, d, b]);
        }
    }
}

/// A point of a profile: distance from the axis, height, and unit normal in (radius, height).
#[derive(Clone, Copy, Debug)]
pub(super) struct ProfilePoint {
    pub(super) radius: f64,
    pub(super) height: f64,
    pub(super) normal: [f64; 2],
    /// Texture coordinate: 0 at the top.
    pub(super) v: f64,
}

/// Adds the surface of a profile, given from top to bottom, turned about +Y. u = 1/2 is at +Z and grows towards +X;
/// where the profile meets the axis every segment has a vertex of its own there, with u at the segment's middle.
pub(super) fn add_revolved(data: &mut MeshData, segments: usize, profile: &[ProfilePoint]) {
    let on_axis = |p: &ProfilePoint| p.radius == 0.0;
    let mut rows = Vec::with_capacity(profile.len());
    for point in profile {
        rows.push(data.positions.len() as u32);
        let (count, shift) = if on_axis(point) { (segments, 0.5) } else { (segments + 1, 0.0) };
        for i in 0..count {
            // The seam's two vertices must not differ by rounding.
            let around = 2.0 * std::f64::consts::PI * (((i % segments) as f64 + shift) / segments as f64 - 0.5);
            let (sin, cos) = around.sin_cos();
            let [normal_radius, normal_height] = point.normal;
            let position = [point.radius * sin, point.height, point.radius * cos];
            let normal = [normal_radius * sin, normal_height, normal_radius * cos];
            push(data, (position, normal), [(i as f64 + shift) / segments as f64, point.v]);
        }
    }
    for (pair, first) in profile.windows(2).zip(rows.windows(2)) {
        for i in 0..segments as u32 {
            let (upper, lower) = (first[0] + i, first[1] + i);
            match (on_axis(&pair[0]), on_axis(&pair[1])) {
                (true, true) => {}
                (true, false) => data.indices.extend([upper, lower, lower + 1]),
                (false, true) => data.indices.extend([upper, lower, upper + 1]),
                (false, false) => data.indices.extend([upper, lower, lower + 1, upper, lower + 1, upper + 1]),
            }
        }
    }
}

/// A profile through points (radius, height) from top to bottom: normals are the mean of the neighbouring segments',
/// v runs with the length of the curve. Use arcs for every edge: the profile has no creases.
pub(super) fn smooth_profile(points: &[[f64; 2]]) -> Vec<ProfilePoint> {
    let segment_normal = |i: usize| {
        let (dr, dy) = (points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]);
        let length = dr.hypot(dy);
        ([-dy / length, dr / length], length)
    };
    let total: f64 = (0..points.len() - 1).map(|i| segment_normal(i).1).sum();
    let mut walked = 0.0;
    let last = points.len() - 1;
    points
        .iter()
        .enumerate()
        .map(|(i, &[radius, height])| {
            let before = if i > 0 { segment_normal(i - 1).0 } else { segment_normal(0).0 };
            let after = if i < last { segment_normal(i).0 } else { segment_normal(last - 1).0 };
            let sum = [before[0] + after[0], before[1] + after[1]];
            let length = sum[0].hypot(sum[1]);
            let normal = if radius == 0.0 { [0.0, sum[1].signum()] } else { [sum[0] / length, sum[1] / length] };
            let v = walked / total;
            if i < last {
                walked += segment_normal(i).1;
            }
            ProfilePoint { radius, height, normal, v }
        })
        .collect()
}

/// Points of an arc about (radius, height) `center`: angles in degrees from the top (0) outwards (90).
pub(super) fn arc(center: [f64; 2], radius: f64, from: f64, to: f64, steps: usize) -> Vec<[f64; 2]> {
    (0..=steps)
        .map(|i| {
            let angle = (from + (to - from) * i as f64 / steps as f64).to_radians();
            let (sin, cos) = angle.sin_cos();
            // On the axis exactly where the arc starts or ends there.
            let r = center[0] + radius * sin;
            [if r.abs() < 1e-12 { 0.0 } else { r }, center[1] + radius * cos]
        })
        .collect()
}

fn push(data: &mut MeshData, (position, normal): SurfacePoint, uv: [f64; 2]) {
    data.positions.push(position.map(|x| x as f32));
    data.normals.get_or_insert_default().push(normal.map(|x| x as f32));
    data.uv0.get_or_insert_default().push(uv.map(|x| x as f32));
}
