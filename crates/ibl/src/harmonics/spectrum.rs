//! From an equirectangular map to its coefficients, and from scaled coefficients to a map.

use super::fourier::{Complex, Fourier};
use super::gauss_legendre;
use super::legendre::{LANES, Lanes, Order};
use super::low::low_orders;
use crate::equirect::{Equirect, equirect_from_direction};
use pulp::NullaryFnOnce;
use rayon::prelude::*;
use std::f64::consts::PI;

/// The highest degree that [`Spectrum::from_equirect`] takes.
pub(crate) const MAX_BAND: usize = 1023;

/// The largest map that is analysed as it is; larger ones are averaged down, which changes little within [`MAX_BAND`].
const MAX_COLUMNS: usize = 2048;
pub(crate) const MAX_ROWS: usize = 1024;

/// Real and imaginary part of red, green and blue.
pub(super) type Channels = [f64; 6];

/// The spherical-harmonic coefficients of an environment: of f(theta, phi) = sum over l and m of c_lm P_lm(cos theta)
/// exp(i m phi), with theta from +Y and phi = atan2(z, x). f is real, so m >= 0 is enough.
pub(crate) struct Spectrum {
    /// `orders[m][l - m]`.
    orders: Vec<Vec<Channels>>,
}

/// Eight latitudes of the northern half (cos > 0), each with the row it lies in and that row's mirror image.
struct NodeBlock {
    cos: Lanes,
    sin: Lanes,
    weight: Lanes,
    north: [usize; LANES],
    south: [usize; LANES],
}

impl Spectrum {
    /// The coefficients up to degree `band` of a map taken as constant within each texel, each texel with its exact area.
    /// Maps of more than `max_rows` rows are averaged down first, but for degrees 0 to 3, which are those of all its texels.
    ///
    /// `more_nodes`: latitudes within each row beyond those that follow the functions of the highest degree to a few per
    /// cent. With two more all degrees are exact to 1e-4; without, the lower half is, and kernels leave little of the rest.
    pub(crate) fn from_equirect(map: &Equirect, band: usize, max_rows: usize, more_nodes: usize) -> Spectrum {
        let band = band.min(MAX_BAND);
        let low = low_orders(map);
        let height = map.height.min(max_rows).min(MAX_ROWS);
        let width = analysed_columns((map.width * height).div_ceil(map.height).max(1));
        let reduced;
        let map = if (width, height) == (map.width, map.height) {
            map
        } else {
            reduced = map.area_resampled(width, height);
            &reduced
        };
        let rows = row_spectra(map, band);
        let blocks = node_blocks(height, band, more_nodes);
        let orders = (0..=band)
            .into_par_iter()
            .map(|m| {
                let order = Order::new(m, band);
                pulp::Arch::new().dispatch(Analysis {
                    order: &order,
                    degrees: band - m + 1,
                    m,
                    rows: &rows,
                    blocks: &blocks,
                })
            })
            .collect();
        let mut spectrum = Spectrum { orders };
        for (coefficients, low) in spectrum.orders.iter_mut().zip(low) {
            coefficients.iter_mut().zip(low).for_each(|(coefficient, low)| *coefficient = low);
        }
        spectrum
    }

    /// Degrees 0 to 3 alone, of all texels of a map.
    pub(crate) fn low(map: &Equirect) -> Spectrum {
        Spectrum { orders: low_orders(map).into() }
    }

    /// The coefficient of degree l and order m, m <= l: real and imaginary part for each colour channel.
    pub(crate) fn coefficient(&self, l: usize, m: usize) -> [Complex; 3] {
        match self.orders.get(m).and_then(|order| order.get(l - m)) {
            Some(c) => [[c[0], c[1]], [c[2], c[3]], [c[4], c[5]]],
            None => [[0.0; 2]; 3],
        }
    }

    /// The map of the environment convolved with a zonal kernel, whose numbers k_l stand in `kernel` (further ones are 0),
    /// on a grid of `rows` latitudes and twice as many longitudes. `rows` is a power of two.
    pub(crate) fn synthesized(&self, kernel: &[f64], rows: usize) -> Grid {
        self.synthesized_with_grey(kernel, &vec![0.0; kernel.len()], rows)
    }

    /// [`Spectrum::synthesized`] with a fourth channel: the sum of the three colours convolved with a kernel of its own.
    pub(crate) fn synthesized_with_grey(&self, kernel: &[f64], grey: &[f64], rows: usize) -> Grid {
        let rows = rows.next_power_of_two().max(2);
        let columns = 2 * rows;
        let latitudes = rows / 2;
        let angles: Vec<[Lanes; 2]> = (0..latitudes)
            .step_by(LANES)
            .map(|first| {
                let theta: Lanes = std::array::from_fn(|i| PI * ((first + i) as f64 + 0.5) / rows as f64);
                [theta.map(f64::cos), theta.map(f64::sin)]
            })
            .collect();
        // `halves[m]` holds the sums over l for each latitude: north, then south.
        let halves: Vec<Vec<[f64; 8]>> = self
            .orders
            .par_iter()
            .take(kernel.len())
            .enumerate()
            .map(|(m, coefficients)| {
                let band = (m + coefficients.len()).min(kernel.len()) - 1;
                let order = Order::new(m, band);
                // Even and odd l - m in pairs, the last with 0.
                let mut scaled = vec![[[0.0; 8]; 2]; (band - m) / 2 + 1];
                for (i, ([a, b, c, d, e, f], (k, g))) in
                    coefficients.iter().zip(kernel[m..].iter().zip(&grey[m..])).enumerate()
                {
                    scaled[i / 2][i % 2] = [k * a, k * b, k * c, k * d, k * e, k * f, g * (a + c + e), g * (b + d + f)];
                }
                let mut sums = vec![[0.0; 8]; rows];
                for (first, [cos, sin]) in (0..latitudes).step_by(LANES).zip(&angles) {
                    let [even, odd] =
                        pulp::Arch::new().dispatch(Synthesis { order: &order, coefficients: &scaled, cos, sin });
                    for i in 0..LANES.min(latitudes - first) {
                        let row = first + i;
                        sums[row] = std::array::from_fn(|c| even[c][i] + odd[c][i]);
                        sums[rows - 1 - row] = std::array::from_fn(|c| even[c][i] - odd[c][i]);
                    }
                }
                sums
            })
            .collect();
        let fourier = Fourier::new(columns);
        // Where column 0 lies, for each order.
        let turns: Vec<Complex> = (0..halves.len())
            .map(|m| {
                let (sin, cos) = (m as f64 * (PI / columns as f64 - PI)).sin_cos();
                [cos, sin]
            })
            .collect();
        let texels = (0..rows)
            .into_par_iter()
            .flat_map_iter(|row| {
                // Two real functions f and g travel as f + i g.
                let mut red_green = vec![[0.0; 2]; columns];
                let mut blue_grey = vec![[0.0; 2]; columns];
                for (m, (sums, &[cos, sin])) in halves.iter().zip(&turns).enumerate() {
                    let s = sums[row];
                    let turned = |re: f64, im: f64| [re * cos - im * sin, re * sin + im * cos];
                    let [r, g, b, y] = [0, 2, 4, 6].map(|i| turned(s[i], s[i + 1]));
                    // Orders beyond the grid's own fold onto those it has: at its points they are the same functions.
                    let bin = m % columns;
                    add(&mut red_green[bin], [r[0] - g[1], r[1] + g[0]]);
                    add(&mut blue_grey[bin], [b[0] - y[1], b[1] + y[0]]);
                    if m > 0 {
                        let bin = (columns - bin) % columns;
                        add(&mut red_green[bin], [r[0] + g[1], g[0] - r[1]]);
                        add(&mut blue_grey[bin], [b[0] + y[1], y[0] - b[1]]);
                    }
                }
                fourier.backward(&mut red_green);
                fourier.backward(&mut blue_grey);
                red_green.into_iter().zip(blue_grey).map(|([r, g], [b, y])| [r, g, b, y].map(|x| x as f32))
            })
            .collect();
        Grid { rows, texels }
    }
}

/// The sums over even and over odd l - m of coefficient times P_lm, at eight polar angles.
///
/// A struct, not a closure: only its call is sure to be compiled within what `pulp` compiles for each instruction set.
struct Synthesis<'a> {
    order: &'a Order,
    coefficients: &'a [[[f64; 8]; 2]],
    cos: &'a Lanes,
    sin: &'a Lanes,
}

impl NullaryFnOnce for Synthesis<'_> {
    type Output = [[Lanes; 8]; 2];

    #[inline(always)]
    fn call(self) -> Self::Output {
        let mut sums = [[[0.0; LANES]; 8]; 2];
        let [even, odd] = &mut sums;
        self.order.each_two(
            self.cos,
            self.sin,
            #[inline(always)]
            |k, p, q| {
                let [a, b] = &self.coefficients[k];
                for c in 0..8 {
                    for i in 0..LANES {
                        even[c][i] += a[c] * p[i];
                    }
                    for i in 0..LANES {
                        odd[c][i] += b[c] * q[i];
                    }
                }
            },
        );
        sums
    }
}

fn add(sum: &mut Complex, x: Complex) {
    sum[0] += x[0];
    sum[1] += x[1];
}

/// The sums over all latitudes of P_lm times the rows' order m, for each degree l.
struct Analysis<'a> {
    order: &'a Order,
    degrees: usize,
    m: usize,
    rows: &'a [Vec<Channels>],
    blocks: &'a [NodeBlock],
}

impl NullaryFnOnce for Analysis<'_> {
    type Output = Vec<Channels>;

    #[inline(always)]
    fn call(self) -> Vec<Channels> {
        // Six channels and two of nothing, which fill the vectors.
        let mut sums = vec![[[0.0; 8]; 2]; self.degrees.div_ceil(2)];
        for block in self.blocks {
            // Functions with even l - m are the same on both halves of the sphere, the others change sign.
            let mut values = [[[0.0; 8]; LANES]; 2];
            let [even, odd] = &mut values;
            for (i, (even, odd)) in even.iter_mut().zip(odd).enumerate() {
                let (north, south) = (&self.rows[block.north[i]][self.m], &self.rows[block.south[i]][self.m]);
                for c in 0..6 {
                    even[c] = block.weight[i] * (north[c] + south[c]);
                    odd[c] = block.weight[i] * (north[c] - south[c]);
                }
            }
            self.order.each_two(
                &block.cos,
                &block.sin,
                #[inline(always)]
                |k, p, q| {
                    let [even, odd] = &mut sums[k];
                    add_weighted(even, p, &values[0]);
                    add_weighted(odd, q, &values[1]);
                },
            );
        }
        let mut sums: Vec<Channels> =
            sums.into_flattened().into_iter().map(|s| [s[0], s[1], s[2], s[3], s[4], s[5]]).collect();
        sums.truncate(self.degrees);
        sums
    }
}

/// Adds the values of eight latitudes, each times its weight.
#[inline(always)]
fn add_weighted(sum: &mut [f64; 8], weights: &Lanes, values: &[[f64; 8]; LANES]) {
    let mut parts = [[0.0; 8]; 2];
    for i in 0..LANES {
        for c in 0..8 {
            parts[i % 2][c] += weights[i] * values[i][c];
        }
    }
    for c in 0..8 {
        sum[c] += parts[0][c] + parts[1][c];
    }
}

/// The number of columns for the Fourier transform: a power of two, the map's own where it can be.
fn analysed_columns(width: usize) -> usize {
    if width.is_power_of_two() { width.min(MAX_COLUMNS) } else { (2 * width).next_power_of_two().min(MAX_COLUMNS) }
}

/// For each row, the integral over longitude of row times exp(-i m phi), for m = 0 ..= band.
fn row_spectra(map: &Equirect, band: usize) -> Vec<Vec<Channels>> {
    let n = map.width;
    let fourier = Fourier::new(n);
    // What a texel of constant value contributes beside its value at the centre, and where column 0 lies.
    let texel_width = 2.0 * PI / n as f64;
    let factors: Vec<Complex> = (0..=band)
        .map(|m| {
            let half = m as f64 * texel_width / 2.0;
            let sinc = if m == 0 { 1.0 } else { half.sin() / half };
            let (sin, cos) = (-(m as f64) * (texel_width / 2.0 - PI)).sin_cos();
            [texel_width * sinc * cos, texel_width * sinc * sin]
        })
        .collect();
    map.pixels
        .par_chunks(n)
        .map(|row| {
            let mut pair: Vec<Complex> = row.iter().map(|p| [f64::from(p[0]), f64::from(p[1])]).collect();
            let mut single: Vec<Complex> = row.iter().map(|p| [f64::from(p[2]), 0.0]).collect();
            fourier.forward(&mut pair);
            fourier.forward(&mut single);
            factors
                .iter()
                .enumerate()
                .map(|(m, factor)| {
                    let (k, mirrored) = (m % n, (n - m % n) % n);
                    // The spectra of two real functions that travelled as f + i g.
                    let (z, w) = (pair[k], pair[mirrored]);
                    let r = [(z[0] + w[0]) / 2.0, (z[1] - w[1]) / 2.0];
                    let g = [(z[1] + w[1]) / 2.0, (w[0] - z[0]) / 2.0];
                    let b = single[k];
                    let turned =
                        |x: Complex| [x[0] * factor[0] - x[1] * factor[1], x[0] * factor[1] + x[1] * factor[0]];
                    let [r, g, b] = [turned(r), turned(g), turned(b)];
                    [r[0], r[1], g[0], g[1], b[0], b[1]]
                })
                .collect()
        })
        .collect()
}

/// Latitudes at which the functions are evaluated to integrate over each row: enough of them within a row that the fastest
/// function, which turns `band` times half round from pole to pole, is followed.
fn node_blocks(rows: usize, band: usize, more_nodes: usize) -> Vec<NodeBlock> {
    let row_angle = PI / rows as f64;
    let rule = gauss_legendre((0.75 * band as f64 * row_angle / 2.0).ceil() as usize + more_nodes);
    let mut nodes = Vec::new();
    for row in 0..rows.div_ceil(2) {
        for &(x, w) in &rule {
            let theta = row_angle * (row as f64 + 0.5 + x / 2.0);
            // The middle row of an odd number is its own mirror image: its upper half counts twice, its middle once.
            let share = if 2 * row + 1 < rows || x < -1e-12 {
                1.0
            } else if x.abs() <= 1e-12 {
                0.5
            } else {
                continue;
            };
            nodes.push((theta, share * w / 2.0 * row_angle * theta.sin(), row));
        }
    }
    nodes
        .chunks(LANES)
        .map(|chunk| {
            // Short blocks are filled up with nodes of no weight.
            let node = |i: usize| chunk.get(i).copied().unwrap_or((PI / 2.0, 0.0, 0));
            NodeBlock {
                cos: std::array::from_fn(|i| node(i).0.cos()),
                sin: std::array::from_fn(|i| node(i).0.sin()),
                weight: std::array::from_fn(|i| node(i).1),
                north: std::array::from_fn(|i| node(i).2),
                south: std::array::from_fn(|i| rows - 1 - node(i).2),
            }
        })
        .collect()
}

/// A smooth map, read by cubic interpolation.
pub(crate) struct Grid {
    rows: usize,
    /// Red, green, blue and the grey channel.
    texels: Vec<[f32; 4]>,
}

impl Grid {
    /// The colour in a direction: the cubic through four neighbours in each way. Never below 0.
    pub(crate) fn sample(&self, dir: [f64; 3]) -> [f32; 3] {
        let [r, g, b, _] = self.at(equirect_from_direction(dir));
        [r, g, b]
    }

    /// [`Grid::sample`] at map coordinates within 0..1, with the grey channel, which may be below 0.
    pub(crate) fn at(&self, (u, v): (f64, f64)) -> [f32; 4] {
        let columns = 2 * self.rows;
        let (x, y) = (u * columns as f64 - 0.5, v * self.rows as f64 - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (wx, wy) = (cubic_weights((x - column) as f32), cubic_weights((y - row) as f32));
        let (column, row) = (column as isize, row as isize);
        // Columns are a power of two, so the mask wraps negative ones too.
        let wrap = |column: isize| column as usize & (columns - 1);
        let mut sum = [0.0f32; 4];
        for (dy, wy) in wy.into_iter().enumerate() {
            let row = row + dy as isize - 1;
            let (row, turn) = if row < 0 {
                (-1 - row, self.rows as isize)
            } else if row >= self.rows as isize {
                (2 * self.rows as isize - 1 - row, self.rows as isize)
            } else {
                (row, 0)
            };
            let line = &self.texels[row as usize * columns..][..columns];
            for (dx, wx) in wx.into_iter().enumerate() {
                let texel = line[wrap(column + dx as isize - 1 + turn)];
                for c in 0..4 {
                    sum[c] += wx * wy * texel[c];
                }
            }
        }
        [sum[0].max(0.0), sum[1].max(0.0), sum[2].max(0.0), sum[3]]
    }
}

/// Lagrange's weights of the points -1, 0, 1, 2 at t in 0..1.
fn cubic_weights(t: f32) -> [f32; 4] {
    let (before, after, two) = (t + 1.0, t - 1.0, t - 2.0);
    [-t * after * two / 6.0, before * after * two / 2.0, -before * t * two / 2.0, before * t * after / 6.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map that is a sum of few harmonics comes back as it was, and its coefficients are the known ones.
    #[test]
    fn low_harmonics_come_back() {
        let f = |d: [f64; 3]| [1.0 + 0.5 * d[0], 2.0 + d[1] * d[2], 1.0 + 0.3 * d[2]].map(|x| x as f32);
        let spectrum = Spectrum::from_equirect(&Equirect::from_fn(512, 256, f), 16, MAX_ROWS, 2);
        let y00 = (4.0 * PI).sqrt();
        assert!((spectrum.coefficient(0, 0)[0][0] - y00).abs() < 1e-4);
        let grid = spectrum.synthesized(&[1.0; 17], 64);
        for dir in [[0.0, 1.0, 0.0], [0.6, 0.0, 0.8], [-0.6, 0.48, -0.64], [0.0, -1.0, 0.0], [-1.0, 0.0, -1e-9]] {
            let (exact, value) = (f(dir), grid.sample(dir));
            for c in 0..3 {
                assert!((exact[c] - value[c]).abs() < 2e-4, "{dir:?}: {value:?} for {exact:?}");
            }
        }
    }

    /// Odd row counts, one texel, widths that are no power of two: a constant stays one.
    #[test]
    fn constants_of_any_shape_stay() {
        for (width, height) in [(1, 1), (2, 1), (3, 5), (100, 51), (64, 32), (2050, 3)] {
            let map = Equirect { width, height, pixels: vec![[1.0, 2.0, 0.25]; width * height] };
            let spectrum = Spectrum::from_equirect(&map, 40, MAX_ROWS, 2);
            let grid = spectrum.synthesized(&[1.0; 41], 32);
            for texel in &grid.texels {
                for (value, exact) in texel.iter().zip([1.0, 2.0, 0.25]) {
                    // Without a kernel the highest degrees, which are the least exact, count in full.
                    assert!((value / exact - 1.0).abs() < 5e-5, "{width} x {height}: {texel:?}");
                }
            }
        }
    }
}
