//! The library's compute shader without a GPU: `entry/bake.wgsl` makes its tree and filters a map through it, in f32 and
//! in f64, against the sum over the map's texels.

use std::f64::consts::PI;
use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use halfvector_ibl::{Source, direction_from_face, studio};
use halfvector_interp::{Column, Derivatives, Entry, Float, Limits, Outputs, Program, Resources};
use halfvector_shaders::FILES;

use super::valid;

const COLUMNS: usize = 96;
const ROWS: usize = 48;
/// The tree has 2^6 leaves on a side.
const DEPTH: u32 = 6;
const TREES: u32 = 2;
const FACE: usize = 4;
const NODES: u32 = TREES * ((1 << (2 * (DEPTH + 1))) - 1) / 3;

fn words(count: usize) -> Vec<AtomicU32> {
    (0..count).map(|_| AtomicU32::new(0)).collect()
}

fn float_bytes(numbers: impl IntoIterator<Item = f64>) -> Vec<u8> {
    numbers.into_iter().flat_map(|x| (x as f32).to_le_bytes()).collect()
}

/// The middle and the solid angle of each row.
fn rows() -> impl Iterator<Item = (f64, f64)> {
    (0..ROWS).map(|row| {
        let theta = PI * (row as f64 + 0.5) / ROWS as f64;
        (theta, 2.0 * PI / COLUMNS as f64 * 2.0 * theta.sin() * (0.5 * PI / ROWS as f64).sin())
    })
}

fn azimuth(column: usize) -> f64 {
    2.0 * PI * ((column as f64 + 0.5) / COLUMNS as f64 - 0.5)
}

/// Runs `entry` for `count` invocations with the uniforms of the shader.
fn dispatch<F: Float>(entry: &str, level: u32, alpha: f64, count: usize, resources: Resources<'_>) {
    let source = FILES.iter().find(|file| file.path == "entry/bake.wgsl").expect("the file").source;
    let (module, info) = valid(source).unwrap_or_else(|e| panic!("{e}"));
    let program = Program::compile(&module, &info, Entry::EntryPoint(entry)).unwrap_or_else(|e| panic!("{e}"));
    let numbers = [COLUMNS as u32, ROWS as u32, DEPTH, TREES, FACE as u32, 0, level];
    let mut uniforms: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    uniforms.extend(float_bytes([alpha, 1.0]));
    let ids: Vec<u32> = (0..count as u32).collect();
    let id = [Column::<F>::Word(&ids), Column::Word(&[0]), Column::Word(&[0])];
    let resources = resources.buffer(0, 0, &uniforms);
    program
        .run(&id, count, &mut Outputs::default(), &resources, Derivatives::Zero, Limits::default())
        .unwrap_or_else(|e| panic!("{e}"));
}

/// The texels of a filtered cube: its light, and how it changes with the lobe's width.
fn filtered<F: Float>(pixels: &[[f32; 3]], alpha: f64) -> Vec<[f32; 4]> {
    let pixels = float_bytes(pixels.as_flattened().iter().map(|x| f64::from(*x)));
    let (tall, wide) = (PI / ROWS as f64, 2.0 * PI / COLUMNS as f64);
    // No spread: the sum over points is then what is computed.
    let rows =
        float_bytes(rows().flat_map(|(theta, solid_angle)| {
            [theta.sin(), theta.cos(), solid_angle, 0.0, tall.max(wide * theta.sin())]
        }));
    let columns = float_bytes((0..COLUMNS).flat_map(|c| [azimuth(c).cos(), azimuth(c).sin()]));
    let (nodes, texels) = (words(8 * NODES as usize), words(4 * 6 * FACE * FACE));
    let resources = Resources::default()
        .buffer(0, 1, &pixels)
        .buffer(0, 2, &rows)
        .buffer(0, 3, &columns)
        .storage(0, 4, &nodes)
        .storage(0, 5, &texels);
    for level in 0..=DEPTH {
        let count = TREES << (2 * (DEPTH - level));
        dispatch::<F>("bake_level", level, alpha, count as usize, resources.clone());
    }
    dispatch::<F>("bake_texel", 0, alpha, 6 * FACE * FACE, resources);
    let floats: Vec<f32> = texels.iter().map(|word| f32::from_bits(word.load(Relaxed))).collect();
    floats.as_chunks().0.to_vec()
}

/// The same lobe summed over all texels of the map, in f64.
fn summed(pixels: &[[f32; 3]], alpha: f64, normal: [f64; 3]) -> [f64; 3] {
    let a = alpha * alpha;
    let mut sum = [0.0; 3];
    for (row, (theta, solid_angle)) in rows().enumerate() {
        for column in 0..COLUMNS {
            let light = [theta.sin() * azimuth(column).cos(), theta.cos(), theta.sin() * azimuth(column).sin()];
            let x: f64 = light.iter().zip(normal).map(|(l, n)| l * n).sum();
            let q = a / (a + 0.5 * (1.0 - a) * (1.0 - x));
            let weight = x.max(0.0) * q * q * solid_angle;
            for (sum, radiance) in sum.iter_mut().zip(pixels[row * COLUMNS + column]) {
                *sum += weight * f64::from(radiance);
            }
        }
    }
    sum
}

#[test]
fn the_bake_shader_runs_without_a_gpu() {
    let Source::Equirect(map) = studio().source else { panic!("the studio is a map") };
    let pixels = map.area_resampled(COLUMNS, ROWS).pixels;
    for alpha in [0.36, 1.0] {
        let (single, double) = (filtered::<f32>(&pixels, alpha), filtered::<f64>(&pixels, alpha));
        let (mut squares, mut apart) = (0.0_f64, 0.0_f64);
        for (i, (single, double)) in single.iter().zip(&double).enumerate() {
            let middle = |k: usize| (2 * k + 1) as f64 / FACE as f64 - 1.0;
            let (column, row, face) = (i % FACE, i / FACE % FACE, i / (FACE * FACE));
            let towards = direction_from_face(face, middle(column), middle(row));
            let length = towards.iter().map(|x| x * x).sum::<f64>().sqrt();
            let truth = summed(&pixels, alpha, towards.map(|x| x / length));
            for k in 0..3 {
                squares += (f64::from(double[k]) / truth[k] - 1.0).powi(2);
                apart = apart.max((f64::from(single[k]) / f64::from(double[k]) - 1.0).abs());
            }
        }
        let rms = (squares / (18 * FACE * FACE) as f64).sqrt();
        println!("alpha {alpha}: {:.3} % rms of the sum, f32 and f64 {:.1e} apart", 100.0 * rms, apart);
        assert!(rms < 0.005, "alpha {alpha}: {rms}");
        // A node that the one opens and the other does not counts for more than a rounding.
        assert!(apart < 1e-3, "alpha {alpha}: {apart}");
    }
}
