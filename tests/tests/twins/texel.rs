//! Hard cases of normal maps' texels on the GPU, by each reading.

use super::gpu::{Gpu, library};

/// Function, texel, and the direction that it says (made unit).
const CASES: [(&str, [f64; 3], [f64; 3]); 11] = [
    // Row "normal texel zero".
    ("normal_from_texel", [0.5, 0.5, 0.5], [0.0, 0.0, 1.0]),
    ("normal_from_texel_snorm", [128.0 / 255.0, 128.0 / 255.0, 128.0 / 255.0], [0.0, 0.0, 1.0]),
    ("normal_from_texel_two_channel", [0.5, 0.5, 0.0], [0.0, 0.0, 1.0]),
    // Row "normal texel 8-bit flat".
    ("normal_from_texel", [128.0 / 255.0, 128.0 / 255.0, 1.0], [1.0 / 255.0, 1.0 / 255.0, 1.0]),
    ("normal_from_texel", [127.0 / 255.0, 127.0 / 255.0, 1.0], [-1.0 / 255.0, -1.0 / 255.0, 1.0]),
    ("normal_from_texel_snorm", [128.0 / 255.0, 128.0 / 255.0, 1.0], [0.0, 0.0, 1.0]),
    ("normal_from_texel_snorm", [0.0, 128.0 / 255.0, 1.0], [-1.0, 0.0, 1.0]),
    // Row "BC5 z reconstruct": x^2 + y^2 > 1, on the circle, and inside of it.
    ("normal_from_texel_two_channel", [0.9, 0.85, 0.3], [0.8, 0.7, 0.0]),
    ("normal_from_texel_two_channel", [1.0, 1.0, 0.0], [1.0, 1.0, 0.0]),
    ("normal_from_texel_two_channel", [1.0, 0.5, 1.0], [1.0, 0.0, 0.0]),
    ("normal_from_texel_two_channel", [0.8, 0.7, 1.0], [0.6, 0.4, 0.692_820_323]),
];

#[test]
fn texels_on_the_gpu_are_the_right_answers() {
    let Some(gpu) = Gpu::open() else { return };
    let library = library();
    for (function, [r, g, b], want) in CASES {
        let results = gpu.call::<f32>(&library, function, &[r as f32, g as f32, b as f32, 1.0, 0.0]);
        let length = want.iter().map(|x| x * x).sum::<f64>().sqrt();
        let got = &results.values[..3];
        let far = got.iter().zip(want).any(|(got, want)| (got - want / length).abs() > 1e-6);
        assert!(!far, "{function}({r}, {g}, {b}) is {got:?}, not {want:?} made unit");
    }
}
