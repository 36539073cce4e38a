//! Equirectangular maps to cubes and back, filtered by area.

use crate::cube::{Cube, texel_direction};
use crate::equirect::Equirect;
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
    // A texel in the middle of a face is this wide, in radians; those nearer to the corners are smaller.
    let width_of_texel = 2.0 / size as f64;
    let mut reduced;
    let mut map = map;
    while width_of_texel * map.height as f64 / PI > MAX_TEXELS_PER_EDGE {
        reduced = map.area_resampled(map.width.div_ceil(2), map.height.div_ceil(2));
        map = &reduced;
    }
    let rows_per_radian = map.height as f64 / PI;
    let columns_per_radian = map.width as f64 / (2.0 * PI);
    Cube::from_texels(size, |face, i, j| {
        let centre = texel_direction(size, face, i as f64, j as f64);
        let [x, y, z] = centre;
        let across = x * x + z * z;
        let length2 = across + y * y;
        // The texel's width seen from the cube's middle, and how many columns and rows of the map that is.
        let angle = width_of_texel / length2.sqrt();
        let sin_theta = (across / length2).sqrt().max(1e-9);
        let columns = (angle * columns_per_radian / sin_theta).min(MAX_TEXELS_AT_POLES);
        let texels = columns.max(angle * rows_per_radian);
        if texels <= 1.0 {
            return map.sample(centre);
        }
        let n = (LOOKUPS_PER_TEXEL * texels).ceil() as usize;
        let mut sum = [0.0f64; 3];
        for k in 0..n * n {
            let offset = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
            let dir = texel_direction(size, face, i as f64 + offset(k % n), j as f64 + offset(k / n));
            let texel = map.sample(dir);
            for c in 0..3 {
                sum[c] += f64::from(texel[c]);
            }
        }
        sum.map(|x| (x / (n * n) as f64) as f32)
    })
}

/// The map, four times as wide as the cube's faces, that returns the cube's value in each direction, by bilinear lookups.
pub fn equirect_from_cube(cube: &Cube) -> Equirect {
    Equirect::from_fn(4 * cube.size, 2 * cube.size, |dir| cube.sample(dir))
}
