//! The irradiance cube by its size: at the tables' directions, and at any direction against a sum over every texel.

use crate::{ENVIRONMENTS, data_table, environment, full, mirrored, numbers, relative_errors, share};
use halfvector_ibl::{BakeOptions, Equirect, Source, bake, equirect_texel_solid_angle};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The last two only with `HALFVECTOR_FULL=1`.
const SIZES: [usize; 5] = [64, 256, 448, 384, 512];

/// Irradiance over pi by a sum over the texels of a map, each constant and with its exact solid angle.
///
/// A bright texel on the horizon is cut into pieces: the middle alone would say that all of it is seen, or nothing.
struct Truth {
    /// Direction x, y, z, and radiance times solid angle over pi.
    texels: Vec<[f64; 6]>,
    /// The same of the pieces of the texels that are cut, each list with the index of its texel.
    cut: Vec<(usize, Vec<[f64; 6]>)>,
    /// Half of a texel's diagonal.
    half: f64,
}

const PIECES: usize = 24;

impl Truth {
    fn new(map: &Equirect) -> Truth {
        let (width, height) = (map.width, map.height);
        let mean = map.mean();
        let at = |column: f64, row: f64| {
            halfvector_ibl::direction_from_equirect((column + 0.5) / width as f64, (row + 0.5) / height as f64)
        };
        let mut truth = Truth { texels: Vec::new(), cut: Vec::new(), half: 1.5 * PI / height as f64 };
        for (k, pixel) in map.pixels.iter().enumerate() {
            let (row, column) = (k / width, k % width);
            let part = |[x, y, z]: [f64; 3], area: f64| {
                let [r, g, b] = pixel.map(|radiance| f64::from(radiance) * area / PI);
                [x, y, z, r, g, b]
            };
            truth.texels.push(part(at(column as f64, row as f64), equirect_texel_solid_angle(width, height, row)));
            if (0..3).any(|c| f64::from(pixel[c]) > 30.0 * mean[c]) {
                let pieces = (0..PIECES * PIECES).map(|piece| {
                    let offset = |k: usize| (k as f64 + 0.5) / PIECES as f64 - 0.5;
                    let fine =
                        equirect_texel_solid_angle(width * PIECES, height * PIECES, row * PIECES + piece / PIECES);
                    part(at(column as f64 + offset(piece % PIECES), row as f64 + offset(piece / PIECES)), fine)
                });
                truth.cut.push((k, pieces.collect()));
            }
        }
        truth
    }

    fn at(&self, dir: [f64; 3]) -> [f64; 3] {
        let cos = |part: &[f64; 6]| part[0] * dir[0] + part[1] * dir[1] + part[2] * dir[2];
        let add = |mut sum: [f64; 3], part: &[f64; 6], sign: f64| {
            let weight = sign * cos(part).max(0.0);
            for c in 0..3 {
                sum[c] += weight * part[3 + c];
            }
            sum
        };
        let mut sum = self.texels.iter().fold([0.0; 3], |sum, part| add(sum, part, 1.0));
        for (k, pieces) in &self.cut {
            if cos(&self.texels[*k]).abs() < self.half {
                sum = add(sum, &self.texels[*k], -1.0);
                sum = pieces.iter().fold(sum, |sum, part| add(sum, part, 1.0));
            }
        }
        sum
    }
}

/// The k-th direction of an even spread over the sphere (Roberts 2018).
fn direction(k: usize) -> [f64; 3] {
    let [u, v] = [0.754_877_666_2, 0.569_840_291].map(|g: f64| (0.5 + g * k as f64).fract());
    let (y, phi) = (2.0 * u - 1.0, 2.0 * PI * v);
    let across = (1.0 - y * y).sqrt();
    [across * phi.cos(), y, across * phi.sin()]
}

/// Worst error of each size of the cube, at 500 directions (20,000 with `HALFVECTOR_FULL=1`). Where a small lamp sets on a black
/// ground single directions are off by more than the rest: the linear mix rounds off the kink.
#[test]
fn sizes_of_the_cube() {
    for name in ENVIRONMENTS {
        let (Some(environment), Some(table)) = (environment(name), data_table(&format!("ibl/{name}_irradiance.csv")))
        else {
            return;
        };
        let Source::Equirect(map) = &environment.source else { unreachable!("the tables belong to maps") };
        let (truth, mean) = (Truth::new(map), map.mean());
        let directions: Vec<[f64; 3]> = (0..if full() { 20_000 } else { 500 }).map(direction).collect();
        let expected: Vec<[f64; 3]> = directions.par_iter().map(|&dir| truth.at(dir)).collect();
        for row in &table {
            let (found, table) = (truth.at(mirrored(numbers(row, 1))), numbers(row, 4));
            let worst = relative_errors(found.map(|x| x as f32), table, mean).into_iter().fold(0.0, f64::max);
            assert!(worst < 1e-3, "{name}: the sum is off the table by {worst}");
        }
        for size in SIZES.into_iter().take(if full() { 5 } else { 3 }) {
            let options = BakeOptions { size: 8, levels: Some(1), irradiance_size: size, ..BakeOptions::default() };
            let cube = bake(&environment, &options).irradiance_over_pi;
            let worst = |errors: &mut dyn Iterator<Item = [f64; 3]>| errors.flatten().fold(0.0, f64::max);
            let at_table = worst(
                &mut table
                    .iter()
                    .map(|row| relative_errors(cube.sample(mirrored(numbers(row, 1))), numbers(row, 4), mean)),
            );
            let anywhere = worst(
                &mut directions.iter().zip(&expected).map(|(&dir, &x)| relative_errors(cube.sample(dir), x, mean)),
            );
            let squares: f64 = directions
                .iter()
                .zip(&expected)
                .flat_map(|(&dir, &x)| relative_errors(cube.sample(dir), x, mean))
                .map(|e| e * e)
                .sum();
            let rms = (squares / (3 * directions.len()) as f64).sqrt();
            // Texel centres.
            let centres = share(100);
            let at_centres: Vec<f64> = (0..centres)
                .into_par_iter()
                .map(|k| {
                    let texel = (k * (6 * size * size) / centres + 7 * k) % (6 * size * size);
                    let (face, rest) = (texel / (size * size), texel % (size * size));
                    let place = |i: usize| (2.0 * i as f64 + 1.0) / size as f64 - 1.0;
                    let dir = halfvector_ibl::direction_from_face(face, place(rest % size), place(rest / size));
                    let length = dir.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let exact = truth.at(dir.map(|x| x / length));
                    relative_errors(cube.texels[texel], exact, mean).into_iter().fold(0.0, f64::max)
                })
                .collect();
            let at_centres = at_centres.into_iter().fold(0.0, f64::max);
            println!(
                "{name}, {size} texels: worst at centres {:.3} %, at the table's directions {:.3} %, anywhere {:.3} % (rms {:.4} %)",
                100.0 * at_centres,
                100.0 * at_table,
                100.0 * anywhere,
                100.0 * rms
            );
            if size == BakeOptions::default().irradiance_size {
                assert!(at_centres < 2e-3 && at_table < 2e-3 && anywhere < 5e-3, "{name}");
            }
        }
    }
}
