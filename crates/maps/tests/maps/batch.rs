//! Batches are the single functions, bit for bit, at every length.

use halfvector_maps::batch::{normals_from_texels, normals_rotation_fixed, normals_rotation_report, normals_tbn};
use halfvector_maps::normal::{normal_from_texel, normal_rotation_fixed, normal_rotation_report, normal_tbn};

/// Numbers in -1..1, with what a buffer may hold by mistake among them.
fn numbers(count: usize, seed: u32) -> Vec<f32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state >> 8
    };
    let special = [f32::NAN, f32::INFINITY, 0.0, -0.0, 1e-30, -3e38, 1.0, f32::NEG_INFINITY];
    (0..count)
        .map(|_| match next() {
            n if n % 16 == 0 => special[(n >> 4) as usize % special.len()],
            n => n as f32 / (1 << 23) as f32 - 1.0,
        })
        .collect()
}

/// Holds a batch against the single function.
fn same<const N: usize>(
    name: &str,
    batch: impl Fn([&[f32]; N], [&mut [f32]; 3]),
    single: impl Fn([f32; N]) -> [f32; 3],
) {
    for count in [0, 1, 63, 64, 65, 1000] {
        let inputs: [Vec<f32>; N] = std::array::from_fn(|k| numbers(count, 7 * count as u32 + k as u32));
        let mut out: [Vec<f32>; 3] = std::array::from_fn(|_| vec![f32::NAN; count]);
        batch(inputs.each_ref().map(Vec::as_slice), out.each_mut().map(Vec::as_mut_slice));
        for i in 0..count {
            let input = inputs.each_ref().map(|a| a[i]);
            let want = single(input);
            assert_eq!(out.each_ref().map(|a| a[i].to_bits()), want.map(f32::to_bits), "{name} {i} {input:?} {want:?}");
        }
    }
}

#[test]
fn batches_are_the_single_functions() {
    same("texel", |c, out| normals_from_texels(c, 0.7, true, out), |c| normal_from_texel(c, 0.7, true));
    same(
        "tbn",
        |a: [&[f32]; 10], out| normals_tbn([a[0], a[1], a[2]], [a[3], a[4], a[5]], [a[6], a[7], a[8], a[9]], out),
        |a| normal_tbn([a[0], a[1], a[2]], [a[3], a[4], a[5]], [a[6], a[7], a[8], a[9]]),
    );
    same(
        "rotation_report",
        |a: [&[f32]; 6], out| normals_rotation_report([a[0], a[1], a[2]], [a[3], a[4], a[5]], out),
        |a| normal_rotation_report([a[0], a[1], a[2]], [a[3], a[4], a[5]]),
    );
    same(
        "rotation_fixed",
        |a: [&[f32]; 6], out| normals_rotation_fixed([a[0], a[1], a[2]], [a[3], a[4], a[5]], out),
        |a| normal_rotation_fixed([a[0], a[1], a[2]], [a[3], a[4], a[5]]),
    );
}

#[test]
#[should_panic(expected = "arrays of one length")]
fn lengths_must_agree() {
    normals_from_texels([&[0.0; 3], &[0.0; 3], &[0.0; 2]], 1.0, false, [&mut [0.0; 3], &mut [0.0; 3], &mut [0.0; 3]]);
}
