//! Equirectangular maps to cubes and back, filtered by area.

mod pole;

use crate::cube::{Cube, equirect_from_six_faces, texels_of_six};
use crate::equirect::Equirect;
use pole::pole_face;
use std::borrow::Cow;
use std::f64::consts::PI;

/// Texels of the map along an edge of a footprint beyond which the map is halved first.
const MAX_TEXELS_PER_EDGE: f64 = 2.0;

/// The same at a pole, where a map's columns crowd together and are not halved.
const MAX_TEXELS_AT_POLES: f64 = 8.0;

/// Lookups for each texel of the map along an edge: so close together that their interpolated sum is even.
const LOOKUPS_PER_TEXEL: f64 = 1.5;

/// The cube that returns, for each direction, the map's radiance from there.
///
/// Where the cube is finer than the map each texel is one bilinear lookup at its centre, so nothing is softened that need
/// not be; where it is coarser (also in longitude alone, near the poles) each texel is the mean of a regular grid of
/// lookups over its area, close enough that no texel of the map falls between them.
pub fn cube_from_equirect(map: &Equirect, size: usize) -> Cube {
    let size = size.max(1);
    resampled(&reduced(map, size), size, LOOKUPS_PER_TEXEL, Some(MAX_TEXELS_AT_POLES))
}

/// [`cube_from_equirect`] with half of the lookups along an edge, so that texels of the map that lie in the middle of a lookup
/// count more than the others; the faces about the poles, where the map's columns crowd together, are exact means instead.
/// Where the cube is finer than the map all is as in [`cube_from_equirect`].
pub(crate) fn preview_from_equirect(map: &Equirect, size: usize) -> Cube {
    let size = size.max(1);
    let reduced = reduced(map, size);
    if texels_per_edge(&reduced, size) <= 1.0 {
        return resampled(&reduced, size, LOOKUPS_PER_TEXEL, Some(MAX_TEXELS_AT_POLES));
    }
    let mut cube = resampled(&reduced, size, 0.5 * LOOKUPS_PER_TEXEL, None);
    let (above, below) = rayon::join(|| pole_face(&reduced, size, false), || pole_face(&reduced, size, true));
    cube.texels.splice(2 * size * size..4 * size * size, above.into_iter().chain(below));
    cube
}

/// Rows of the map along an edge of a cube's texel in the middle of a face; those nearer to the corners are smaller.
fn texels_per_edge(map: &Equirect, size: usize) -> f64 {
    2.0 / size as f64 * map.height as f64 / PI
}

/// The map, halved until a texel of the cube is at most [`MAX_TEXELS_PER_EDGE`] wide.
fn reduced(map: &Equirect, size: usize) -> Cow<'_, Equirect> {
    let mut map = Cow::Borrowed(map);
    while texels_per_edge(&map, size) > MAX_TEXELS_PER_EDGE {
        map = Cow::Owned(map.area_resampled(map.width.div_ceil(2), map.height.div_ceil(2)));
    }
    map
}

/// A grid of lookups for each texel; the faces about the poles stay black where `texels_at_poles` is not given.
fn resampled(map: &Equirect, size: usize, lookups_per_texel: f64, texels_at_poles: Option<f64>) -> Cube {
    let width_of_texel = 2.0 / size as f64;
    let rows_per_radian = map.height as f64 / PI;
    let columns_per_radian = map.width as f64 / (2.0 * PI);
    let place = |i: f64| (2.0 * i + 1.0) / size as f64 - 1.0;
    let texels = texels_of_six(size, |i, j| {
        let (s, t) = (place(i as f64), place(j as f64));
        let length2 = 1.0 + s * s + t * t;
        // The texel's width seen from the cube's middle, and how many columns and rows of the map that is, on the four
        // faces round the horizon and on the two about the poles.
        let angle = width_of_texel / length2.sqrt();
        let lookups = |across: f64| {
            let sin_theta = (across / length2).sqrt().max(1e-9);
            let columns = (angle * columns_per_radian / sin_theta).min(texels_at_poles.unwrap_or(f64::INFINITY));
            let texels = columns.max(angle * rows_per_radian);
            if texels <= 1.0 { 1 } else { (lookups_per_texel * texels).ceil() as usize }
        };
        let (sides, poles) = (lookups(1.0 + s * s), lookups(s * s + t * t));
        let mut sums = [[0.0f64; 3]; 6];
        let mut add = |n: usize, faces: &[usize]| {
            let share = 1.0 / (n * n) as f64;
            let offset = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
            for k in 0..n * n {
                let coordinates =
                    equirect_from_six_faces(place(i as f64 + offset(k % n)), place(j as f64 + offset(k / n)));
                for &face in faces {
                    let texel = map.at(coordinates[face]);
                    for c in 0..3 {
                        sums[face][c] += f64::from(texel[c]) * share;
                    }
                }
            }
        };
        if texels_at_poles.is_none() {
            add(sides, &[0, 1, 4, 5]);
        } else if sides == poles {
            add(sides, &[0, 1, 2, 3, 4, 5]);
        } else {
            add(sides, &[0, 1, 4, 5]);
            add(poles, &[2, 3]);
        }
        sums.map(|sum| sum.map(|x| x as f32))
    });
    Cube { size, texels }
}

/// The map, four times as wide as the cube's faces, that returns the cube's value in each direction, by bilinear lookups.
pub fn equirect_from_cube(cube: &Cube) -> Equirect {
    Equirect::from_fn(4 * cube.size, 2 * cube.size, |dir| cube.sample(dir))
}
