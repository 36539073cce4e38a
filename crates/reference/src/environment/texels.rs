//! The texels of a map with a border, so that four neighbours always lie in two runs of two.

use std::f64::consts::{FRAC_1_PI, TAU};

use halfvector_ibl::Equirect;

use super::EnvironmentFilter;
use crate::elementary::{atan2, choose, whole};

/// A map of radiance, the fourth number of each texel being the density at which directions of its cell are drawn [1/sr].
pub(super) struct Texels {
    width: usize,
    height: usize,
    /// Texels in a row with both of its ends.
    stride: usize,
    texels: Vec<[f32; 4]>,
    /// Place in texels = (u, v) * scale + offset.
    scale: [f64; 2],
    offset: [f64; 2],
    /// 0 where texels are constant.
    smooth: f64,
}

/// Where a direction falls.
#[derive(Clone, Copy, Default)]
pub(super) struct Spot {
    /// The upper left one of four texels.
    pub(super) index: u32,
    /// The texel that the direction lies in: one of the four.
    pub(super) cell: u32,
    /// How far it is from the left and the upper ones to the others.
    pub(super) s: f64,
    pub(super) t: f64,
}

impl Texels {
    pub(super) fn new(map: &Equirect, filter: EnvironmentFilter) -> Texels {
        let (width, height) = (map.width, map.height);
        let texel = |column: isize, row: isize| {
            let (w, h) = (width as isize, height as isize);
            // Over a pole and down the other side; rows at the poles are never passed.
            let (column, row) = match row {
                row if filter == EnvironmentFilter::VertexRows => (column, row.clamp(0, h - 1)),
                row if row < 0 => (column + w / 2, -1 - row),
                row if row >= h => (column + w / 2, 2 * h - 1 - row),
                row => (column, row),
            };
            let [r, g, b] = map.pixels[row as usize * width + column.rem_euclid(w) as usize];
            [r, g, b, 0.0]
        };
        let rows = -1..=height as isize;
        let texels = rows.flat_map(|row| (-1..=width as isize).map(move |column| texel(column, row))).collect();
        let (columns, rows) = (width as f64, height as f64);
        let (scale, offset, smooth) = match filter {
            EnvironmentFilter::Bilinear => ([columns, rows], [-0.5, -0.5], 1.0),
            EnvironmentFilter::Box => ([columns, rows], [0.0, 0.0], 0.0),
            EnvironmentFilter::VertexRows => ([columns, rows - 1.0], [-0.5, 0.0], 1.0),
        };
        Texels { width, height, stride: width + 2, texels, scale, offset, smooth }
    }

    /// The number of a texel of the map among those with a border.
    #[inline(always)]
    pub(super) fn index(&self, column: f64, row: f64) -> u32 {
        whole((row + 1.0) * self.stride as f64 + column + 1.0)
    }

    /// Fills in the densities, row by row.
    pub(super) fn set_densities(&mut self, densities: &[f64]) {
        for (number, density) in densities.iter().enumerate() {
            let (row, column) = (number / self.width, number % self.width);
            let index = self.index(column as f64, row as f64);
            self.texels[index as usize][3] = *density as f32;
        }
    }

    #[inline(always)]
    pub(super) fn density(&self, index: u32) -> f64 {
        f64::from(self.texels[index as usize][3])
    }

    /// Where a direction of the map's own frame falls.
    #[inline(always)]
    pub(super) fn spot(&self, [x, y, z]: [f64; 3]) -> Spot {
        let u = atan2(z, x) * (1.0 / TAU) + 0.5;
        let v = atan2((x * x + z * z).sqrt(), y) * FRAC_1_PI;
        let below = |x: f64, most: usize| {
            let (x, most) = (x.floor(), most as f64 - 1.0);
            choose(x < most, x, most)
        };
        let (x, y) = (u * self.scale[0] + self.offset[0], v * self.scale[1] + self.offset[1]);
        let (column, row) = (below(x, self.width), below(y, self.height));
        let cell = self.index(below(u * self.width as f64, self.width), below(v * self.height as f64, self.height));
        Spot { index: self.index(column, row), cell, s: (x - column) * self.smooth, t: (y - row) * self.smooth }
    }

    /// Radiance between the texels, and the density of the cell.
    #[inline(always)]
    pub(super) fn read(&self, spot: Spot) -> [f64; 4] {
        let Spot { index, cell, s, t } = spot;
        let start = index as usize;
        let (upper, lower) =
            (&self.texels[start..start + 2], &self.texels[start + self.stride..start + self.stride + 2]);
        let [a, b, c, d] = [upper[0], upper[1], lower[0], lower[1]].map(|texel| texel.map(f64::from));
        let [r, g, b, _] = std::array::from_fn(|i| {
            let above = a[i] + (b[i] - a[i]) * s;
            above + (c[i] + (d[i] - c[i]) * s - above) * t
        });
        [r, g, b, self.density(cell)]
    }
}
