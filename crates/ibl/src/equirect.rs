//! Equirectangular maps: the frame, lookups, and changes of resolution that keep the energy.
//!
//! It holds no file format and no cube; see `load` and `cube`.

use std::f64::consts::PI;

/// An equirectangular environment of linear Rec. 709 radiance.
///
/// Row 0 is up. The texel at column i, row j is centred on u = (i + 0.5) / width, v = (j + 0.5) / height, where
/// v = acos(y) / pi and u = atan2(z, x) / (2 pi) + 1/2 for the unit direction (x, y, z).
#[derive(Clone, Debug, PartialEq)]
pub struct Equirect {
    /// Number of columns, at least 1.
    pub width: usize,
    /// Number of rows, at least 1.
    pub height: usize,
    /// `width * height` colours, row by row from the top.
    pub pixels: Vec<[f32; 3]>,
}

/// The direction that map coordinates (u, v), both 0..1, belong to.
pub fn direction_from_equirect(u: f64, v: f64) -> [f64; 3] {
    let (sin_theta, cos_theta) = (PI * v).sin_cos();
    let (sin_phi, cos_phi) = (2.0 * PI * (u - 0.5)).sin_cos();
    [sin_theta * cos_phi, cos_theta, sin_theta * sin_phi]
}

/// The map coordinates (u, v), both 0..1, of a direction, which need not be unit.
///
/// v comes from atan2 of the two legs rather than from acos(y), which loses half of the digits at the poles.
pub fn equirect_from_direction(dir: [f64; 3]) -> (f64, f64) {
    let [x, y, z] = dir;
    (z.atan2(x) / (2.0 * PI) + 0.5, (x * x + z * z).sqrt().atan2(y) / PI)
}

impl Equirect {
    /// A map whose texels are `radiance(direction)` at the texel centres.
    pub fn from_fn(width: usize, height: usize, radiance: impl Fn([f64; 3]) -> [f32; 3] + Sync) -> Equirect {
        use rayon::prelude::*;
        let (width, height) = (width.max(1), height.max(1));
        let pixels = (0..height)
            .into_par_iter()
            .flat_map_iter(|row| {
                let radiance = &radiance;
                (0..width).map(move |column| {
                    let (u, v) = ((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
                    radiance(direction_from_equirect(u, v))
                })
            })
            .collect();
        Equirect { width, height, pixels }
    }

    /// Radiance from a direction, interpolated bilinearly: columns wrap, rows beyond a pole go on down the other side.
    pub fn sample(&self, dir: [f64; 3]) -> [f32; 3] {
        self.at(equirect_from_direction(dir))
    }

    /// [`Equirect::sample`] at map coordinates within 0..1.
    pub(crate) fn at(&self, (u, v): (f64, f64)) -> [f32; 3] {
        let (x, y) = (u * self.width as f64 - 0.5, v * self.height as f64 - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = ((x - column) as f32, (y - row) as f32);
        let (column, row) = (column as isize, row as isize);
        let first = row * self.width as isize + column;
        let inside = (0..self.width as isize - 1).contains(&column) && (0..self.height as isize - 1).contains(&row);
        let [a, b, c, d] = match inside.then(|| self.pixels.get(first as usize..)) {
            // Nearly all lookups: no neighbour lies round the seam or over a pole.
            Some(Some([a, b, below @ ..])) if below.len() >= self.width => {
                [*a, *b, below[self.width - 2], below[self.width - 1]]
            }
            _ => [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| self.texel(column + dx, row + dy)),
        };
        std::array::from_fn(|i| {
            let above = a[i] + (b[i] - a[i]) * s;
            let below = c[i] + (d[i] - c[i]) * s;
            above + (below - above) * t
        })
    }

    /// The texel at a column and row that may lie up to one map outside: round the seam, or over a pole.
    fn texel(&self, column: isize, row: isize) -> [f32; 3] {
        let (width, height) = (self.width as isize, self.height as isize);
        let (column, row) = if row < 0 {
            (column + width / 2, -1 - row)
        } else if row >= height {
            (column + width / 2, 2 * height - 1 - row)
        } else {
            (column, row)
        };
        let column = column.rem_euclid(width);
        self.pixels[(row.clamp(0, height - 1) * width + column) as usize]
    }

    /// The map with another number of columns and rows, each texel the mean over its solid angle of the old map taken
    /// as piecewise constant. The energy of every region is kept, whatever the ratio.
    pub fn area_resampled(&self, width: usize, height: usize) -> Equirect {
        use rayon::prelude::*;
        let (width, height) = (width.max(1), height.max(1));
        let column_spans = overlaps(self.width, width, |x| x);
        // Areas of latitude bands are differences of the cosine.
        let row_spans = overlaps(self.height, height, |v| -(PI * v).cos());
        let pixels = row_spans
            .par_iter()
            .flat_map_iter(|rows| {
                let mut line = vec![[0.0f64; 3]; self.width];
                for &(row, weight) in rows {
                    for (sum, texel) in line.iter_mut().zip(&self.pixels[row * self.width..(row + 1) * self.width]) {
                        for c in 0..3 {
                            sum[c] += weight * f64::from(texel[c]);
                        }
                    }
                }
                column_spans
                    .iter()
                    .map(|columns| {
                        let mut sum = [0.0; 3];
                        for &(column, weight) in columns {
                            for c in 0..3 {
                                sum[c] += weight * line[column][c];
                            }
                        }
                        sum.map(|x| x as f32)
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
        Equirect { width, height, pixels }
    }

    /// A map in this crate's convention (rows centred at v = (j + 0.5) / height) of one whose rows are centred at
    /// v = j / (rows - 1), first and last row exactly at the poles, as some renderers read their files.
    ///
    /// Rows are interpolated linearly. `height` is the number of rows of the result: twice or four times as many as there
    /// are keeps the interpolated function nearly unchanged, equally many softens it by up to half a row.
    pub fn resampled_rows_from_vertex_grid(&self, height: usize) -> Equirect {
        let height = height.max(1);
        let mut pixels = Vec::with_capacity(self.width * height);
        for row in 0..height {
            let y = (row as f64 + 0.5) / height as f64 * (self.height - 1) as f64;
            let above = (y.floor() as usize).min(self.height - 1);
            let below = (above + 1).min(self.height - 1);
            let t = (y - above as f64) as f32;
            pixels.extend((0..self.width).map(|column| {
                let a = self.pixels[above * self.width + column];
                let b = self.pixels[below * self.width + column];
                std::array::from_fn::<f32, 3, _>(|i| a[i] + (b[i] - a[i]) * t)
            }));
        }
        Equirect { width: self.width, height, pixels }
    }

    /// Mean radiance over the sphere, each texel with its exact solid angle.
    pub fn mean(&self) -> [f64; 3] {
        let one = self.area_resampled(1, 1);
        one.pixels[0].map(f64::from)
    }
}

/// For each of `to` equal intervals of 0..1: the `from` intervals that it meets and the share of `measure` in each.
fn overlaps(from: usize, to: usize, measure: impl Fn(f64) -> f64) -> Vec<Vec<(usize, f64)>> {
    (0..to)
        .map(|i| {
            let (start, end) = (i as f64 / to as f64, (i + 1) as f64 / to as f64);
            let first = (i * from) / to;
            let last = ((i + 1) * from).div_ceil(to).min(from);
            let whole = measure(end) - measure(start);
            (first..last)
                .map(|j| {
                    let (a, b) = ((j as f64 / from as f64).max(start), ((j + 1) as f64 / from as f64).min(end));
                    (j, ((measure(b) - measure(a)) / whole).max(0.0))
                })
                .filter(|&(_, weight)| weight > 0.0)
                .collect()
        })
        .collect()
}
