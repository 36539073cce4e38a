//! The few lowest coefficients of a map, from every texel of it.
//!
//! What is sharp in a map does not show in them, but where a lamp stands does: averaging a map down moves each lamp by
//! up to half of a texel of the smaller one, and a coefficient by a thousandth.

use super::gauss_legendre;
use super::legendre::{LANES, Lanes, Order};
use super::spectrum::Channels;
use crate::equirect::Equirect;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// The highest degree.
const DEGREE: usize = 3;

/// For m = 0 ..= 3 the coefficients of degree m, m + 1, ... 3, as [`Spectrum`](super::Spectrum) has them, of a map
/// taken as constant within each texel, exact but for rounding.
pub(super) fn low_orders(map: &Equirect) -> [Vec<Channels>; DEGREE + 1] {
    let tall = PI / map.height as f64;
    let wide = TAU / map.width as f64;
    // exp(-i m phi) of each column, m = 1 ..= 3.
    let turns: Vec<[[f64; 2]; DEGREE]> = (0..map.width)
        .map(|column| {
            let phi = wide * (column as f64 + 0.5) - PI;
            std::array::from_fn(|k| {
                let (sin, cos) = ((k + 1) as f64 * phi).sin_cos();
                [cos, -sin]
            })
        })
        .collect();
    // What a texel contributes beside its value at the middle.
    let widths: [f64; DEGREE + 1] = std::array::from_fn(|m| {
        let half = m as f64 * wide / 2.0;
        if m == 0 { wide } else { wide * half.sin() / half }
    });
    let orders: [Order; DEGREE + 1] = std::array::from_fn(|m| Order::new(m, DEGREE));
    let rule = gauss_legendre(LANES);
    let of_row = |row: usize| {
        let pixels = &map.pixels[row * map.width..][..map.width];
        let mut sums = [[0.0f64; 6]; DEGREE + 1];
        for (pixel, turns) in pixels.iter().zip(&turns) {
            let [r, g, b] = pixel.map(f64::from);
            let [first, others @ ..] = &mut sums;
            for (sum, x) in first.iter_mut().zip([r, 0.0, g, 0.0, b, 0.0]) {
                *sum += x;
            }
            for (sums, [cos, sin]) in others.iter_mut().zip(turns) {
                for (sum, x) in sums.iter_mut().zip([r * cos, r * sin, g * cos, g * sin, b * cos, b * sin]) {
                    *sum += x;
                }
            }
        }
        let theta: Lanes = std::array::from_fn(|i| tall * (row as f64 + 0.5 + 0.5 * rule[i].0));
        let (sin, cos) = (theta.map(f64::sin), theta.map(f64::cos));
        let integral = |p: &Lanes| -> f64 { (0..LANES).map(|i| 0.5 * tall * rule[i].1 * sin[i] * p[i]).sum() };
        let mut coefficients = [[[0.0; 6]; DEGREE + 1]; DEGREE + 1];
        for (m, order) in orders.iter().enumerate() {
            order.each_two(&cos, &sin, |k, even, odd| {
                for (l, p) in [(m + 2 * k, even), (m + 2 * k + 1, odd)] {
                    if l <= DEGREE {
                        coefficients[m][l] = sums[m].map(|x| x * widths[m] * integral(p));
                    }
                }
            });
        }
        coefficients
    };
    let rows: Vec<_> = (0..map.height).into_par_iter().map(of_row).collect();
    // One after the other: the sum does not depend on the number of threads.
    let mut whole = [[[0.0; 6]; DEGREE + 1]; DEGREE + 1];
    for row in rows {
        for (sum, x) in whole.as_flattened_mut().as_flattened_mut().iter_mut().zip(row.as_flattened().as_flattened()) {
            *sum += x;
        }
    }
    std::array::from_fn(|m| whole[m][m..].to_vec())
}
