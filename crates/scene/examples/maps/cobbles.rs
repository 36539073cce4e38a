//! A height map of cobbles: round stones in sand, for displacement.

use image::DynamicImage;

use super::height_map;
use super::noise::{fractal, hash, mix, smooth, wrapped};

/// Stones along each edge of the tile.
const STONES: u32 = 4;

/// File name and picture.
pub(super) fn maps() -> Vec<(&'static str, DynamicImage)> {
    vec![("cobbles_height.png", height_map(256, height))]
}

/// 0 to 1: a dome over each cell of random points (Worley 1996), flattened above, with sand in between.
fn height([u, v]: [f64; 2]) -> f64 {
    let cells = f64::from(STONES);
    let (mut nearest, mut second, mut stone) = (f64::MAX, f64::MAX, 0);
    for index in 0..STONES * STONES {
        let (column, row) = (index % STONES, index / STONES);
        let random = |salt: u32| 0.5 + 0.62 * (f64::from(hash(column, row, salt)) / f64::from(u32::MAX) - 0.5);
        let du = wrapped(u - (f64::from(column) + random(11)) / cells) * cells;
        let dv = wrapped(v - (f64::from(row) + random(12)) / cells) * cells;
        let distance = (du * du + dv * dv).sqrt();
        if distance < nearest {
            second = nearest;
            nearest = distance;
            stone = index;
        } else if distance < second {
            second = distance;
        }
    }
    // Half of the way to the border between two cells is (second - nearest) / 2.
    let inside = smooth(0.04, 0.75, second - nearest);
    let dome = inside * (2.0 - inside);
    let size = 0.75 + 0.25 * f64::from(hash(stone, 5, 13)) / f64::from(u32::MAX);
    let rough = 0.06 * (fractal([u, v], 16, 2, 14) - 0.5);
    (mix(0.08, 0.9 * size, dome) + rough * mix(1.5, 1.0, dome)).clamp(0.0, 1.0)
}
