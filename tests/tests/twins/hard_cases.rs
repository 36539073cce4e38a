//! The rows of the hard-case catalogue about normals, tangents and texture coordinates, on the GPU in f32 and f64; all texels
//! of an 8-bit map; and arguments that are no numbers.

use super::domain::Numbers;
use super::gpu::{Gpu, Number, library};

fn degrees(a: &[f64], b: [f64; 3]) -> f64 {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let lengths = a[..3].iter().map(|a| a * a).sum::<f64>() * b.iter().map(|b| b * b).sum::<f64>();
    (dot / lengths.sqrt()).clamp(-1.0, 1.0).acos().to_degrees()
}

fn is_near(a: &[f64], b: [f64; 3]) -> bool {
    is_unit(a) && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5)
}

fn is_unit(a: &[f64]) -> bool {
    (a[..3].iter().map(|a| a * a).sum::<f64>() - 1.0).abs() < 1e-5
}

/// Unit, and as far from +Z as the texel (.6, 0, .8).
fn keeps_tilt(a: &[f64]) -> bool {
    is_unit(a) && (a[2] - 0.8).abs() < 1e-5
}

fn is_tangent_of(a: &[f64], normal: [f64; 3]) -> bool {
    is_unit(a) && a.iter().zip(normal).map(|(a, n)| a * n).sum::<f64>().abs() < 1e-5
}

/// A call: a function of the library, its arguments, and whether its answer is right.
type Call = (&'static str, &'static [f32], fn(&[f64]) -> bool);

fn check<N: Number>(gpu: &Gpu, calls: &[Call]) {
    let module = library();
    for (function, arguments, is_right) in calls {
        let answer = gpu.call::<N>(&module, function, arguments).values;
        assert!(is_right(&answer), "{function} of {arguments:?} in {} bits: {answer:?}", 8 * size_of::<N>());
    }
}

/// A test for each row of the catalogue, in f32 and, where the GPU has it, in f64.
macro_rules! rows {
    ($($(#[doc = $row:literal])* $name:ident [$($call:expr),* $(,)?])*) => {$(
        $(#[doc = $row])*
        #[test]
        fn $name() {
            let Some(gpu) = Gpu::open() else { return };
            let calls: &[Call] = &[$($call),*];
            check::<f32>(&gpu, calls);
            if gpu.has_f64 {
                check::<f64>(&gpu, calls);
            } else {
                println!("{} has no f64", gpu.name);
            }
        }
    )*};
}

rows! {
    /// Row "degenerate UV".
    degenerate_uv [
        ("tangent_from_derivatives", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], |a| a[..3] == [0.0; 3]),
        ("normal_tbn_derivative", &[0.6, 0.0, 0.8, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], keeps_tilt),
    ]

    /// Row "near-degenerate UV".
    near_degenerate_uv [
        ("tangent_from_derivatives", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 7.071e-7, 0.0, 0.0, -7.071e-7], |a| is_near(a, [1.0, 0.0, 0.0]) && a[3] == 1.0),
    ]

    /// Row "mirrored UV".
    mirrored_uv [
        ("normal_tbn", &[0.0, 0.6, 0.8, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0], |a| is_near(a, [0.0, -0.6, 0.8])),
        ("tangent_from_derivatives", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, -1.0], |a| is_near(a, [-1.0, 0.0, 0.0]) && a[3] == -1.0),
    ]

    /// Row "tangent || normal".
    tangent_along_normal [
        ("normal_tbn", &[0.6, 0.0, 0.8, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0], keeps_tilt),
        ("normal_tbn", &[0.6, 0.0, 0.8, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], keeps_tilt),
    ]

    /// Row "Frisvad basis".
    frisvad_basis [
        ("tangent_from_normal", &[0.0, 0.0, -1.0], |a| is_tangent_of(a, [0.0, 0.0, -1.0])),
        ("tangent_from_normal", &[0.000_488_3, 0.0, -0.999_999_9], |a| is_tangent_of(a, [0.000_488_3, 0.0, -0.999_999_9])),
        ("tangent_from_normal", &[0.000_345_3, 0.0, -0.999_999_94], |a| is_tangent_of(a, [0.000_345_3, 0.0, -0.999_999_94])),
    ]

    /// Row "normal texel zero".
    normal_texel_zero [
        ("normal_from_texel", &[0.5, 0.5, 0.5, 1.0, 0.0], |a| *a == [0.0, 0.0, 1.0]),
    ]

    /// Row "normal texel 8-bit flat".
    normal_texel_8_bit_flat [
        ("normal_from_texel", &[128.0 / 255.0, 128.0 / 255.0, 1.0, 1.0, 0.0], |a| is_unit(a) && (degrees(a, [0.0, 0.0, 1.0]) - 0.3178).abs() < 0.005),
    ]

    /// Row "BC5 z reconstruct".
    bc5_z_reconstruct [
        ("normal_from_texel_two_channel", &[0.9, 0.85, 0.3, 1.0, 0.0], |a| is_near(a, [0.752_577, 0.658_505, 0.0])),
    ]

    /// Row "normal z=0 rotation".
    normal_z_0_rotation [
        // ax = az = atan(.6 / 0), ay = atan(.4 / 0): half turns by halves, (0, 0, 1) -> (0, -1, 0) -> (0, -1, 0) -> (1, 0, 0).
        ("normal_rotation_report", &[0.4, 0.6, 0.0, 0.0, 0.0, 1.0], |a| is_near(a, [1.0, 0.0, 0.0])),
        ("normal_rotation_report", &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], |a| is_near(a, [0.0, 0.0, 1.0])),
        ("normal_rotation_fixed", &[0.0, 0.6, 0.0, 0.0, 0.0, 1.0], |a| is_near(a, [0.0, 1.0, 0.0])),
        ("normal_tbn", &[0.6, 0.8, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0], |a| is_near(a, [0.6, 0.8, 0.0])),
    ]

    /// Row "normal z<0 rotation".
    normal_z_below_0_rotation [
        // The report's atan loses the quadrant, the mended one keeps it.
        ("normal_rotation_report", &[0.3, 0.4, -0.5, 0.0, 0.0, 1.0], |a| is_unit(a) && a[2] > 0.0),
        ("normal_rotation_fixed", &[0.3, 0.4, -0.5, 0.0, 0.0, 1.0], |a| is_unit(a) && a[2] < 0.0),
    ]

    /// Row "rotation method accuracy".
    rotation_method_accuracy [
        ("normal_rotation_fixed", &[0.6, 0.6, 0.529_150_25, 0.0, 0.0, 1.0], |a| is_near(a, [0.496_078_37, 0.75, 0.4375]) && (degrees(a, [0.6, 0.6, 0.529_150_25]) - 11.72).abs() < 0.01),
        ("normal_tbn", &[0.6, 0.6, 0.529_150_25, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0], |a| is_near(a, [0.6, 0.6, 0.529_150_25])),
    ]

    /// Row "non-unit interpolated n".
    non_unit_interpolated_n [
        ("normal_tbn", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.707_106_77, 1.0, 0.0, 0.0, 1.0], |a| is_near(a, [0.0, 0.0, 1.0])),
    ]

    /// Row "opposed interpolated n".
    opposed_interpolated_n [
        ("normal_tbn", &[0.6, 0.0, 0.8, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0], keeps_tilt),
        ("normal_rotation_report", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], |a| is_near(a, [0.0, 0.0, 1.0])),
        ("normal_rotation_fixed", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], |a| is_near(a, [0.0, 0.0, 1.0])),
    ]
}

/// Row "sRGB decode negative/over": below 0 the line goes on, above 1 the power. GPUs have no powers in f64.
#[test]
fn srgb_decode_negative_and_over() {
    let Some(gpu) = Gpu::open() else { return };
    fn is(a: &[f64], want: [f64; 3]) -> bool {
        a.iter().zip(want).all(|(a, want)| (a - want).abs() <= 2e-5 * want.abs())
    }
    let calls: &[Call] = &[
        ("linear_from_srgb", &[-0.1, -0.055, -1.0], |a| is(a, [-0.1 / 12.92, -0.055 / 12.92, -1.0 / 12.92])),
        ("linear_from_srgb", &[0.0, 1.0, 2.0], |a| is(a, [0.0, 1.0, 4.9538458])),
        ("srgb_from_linear", &[-0.1, -1e-6, -2.0], |a| is(a, [-1.292, -1.292e-5, -25.84])),
        ("srgb_from_linear", &[0.0, 1.0, 4.0], |a| is(a, [0.0, 1.0, 1.8247963])),
    ];
    check::<f32>(&gpu, calls);
}

/// Panics where a function's answer is not unit.
fn all_unit(gpu: &Gpu, module: &naga::Module, function: &str, arguments: &[f32]) -> Vec<f32> {
    let results = gpu.call::<f32>(module, function, arguments);
    for (row, value) in results.values.chunks_exact(results.results).enumerate() {
        let input = || &arguments[row * results.arguments..][..results.arguments];
        assert!(is_unit(value), "{}: {function} of {:?} is {value:?}", gpu.name, input());
    }
    results.values.iter().map(|x| *x as f32).collect()
}

/// Every red and green of an 8-bit map, with the blues that matter, through every method.
#[test]
fn every_8_bit_texel_is_unit_on_the_gpu() {
    let Some(gpu) = Gpu::open() else { return };
    let module = library();
    let texels = (0..1_u32 << 16).flat_map(|code| [0, 127, 128, 255].map(|b| [code & 255, code >> 8, b]));
    let colors = texels.map(|t| t.map(|c| c as f32 / 255.0));
    let arguments: Vec<f32> = colors.flat_map(|[r, g, b]| [r, g, b, 1.0, 0.0]).collect();
    let normals = all_unit(&gpu, &module, "normal_from_texel", &arguments);
    all_unit(&gpu, &module, "normal_from_texel_snorm", &arguments);
    all_unit(&gpu, &module, "normal_from_texel_two_channel", &arguments);
    let frames = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.267_261_24, -0.534_522_5, 0.801_783_7]];
    for function in ["normal_rotation_report", "normal_rotation_fixed", "normal_tbn"] {
        let tangent: &[f32] = if function == "normal_tbn" { &[0.6, 0.0, -0.8, -1.0] } else { &[] };
        let with_frame = normals.chunks_exact(3).enumerate();
        let arguments: Vec<f32> = with_frame.flat_map(|(i, n)| [n, &frames[i / 4 % 4], tangent].concat()).collect();
        all_unit(&gpu, &module, function, &arguments);
    }
}

/// Whatever a buffer or a texture holds by mistake.
#[test]
fn normals_of_any_bits_are_unit() {
    let Some(gpu) = Gpu::open() else { return };
    let module = library();
    let functions = [
        ("normal_from_texel", 5),
        ("normal_from_texel_snorm", 5),
        ("normal_from_texel_two_channel", 5),
        ("normal_tbn", 10),
        ("normal_rotation_report", 6),
        ("normal_rotation_fixed", 6),
        ("normal_tbn_derivative", 16),
        ("normal_from_slopes", 2),
        ("normal_with_strength", 4),
        ("blend_linear", 6),
        ("blend_partial_derivatives", 6),
        ("blend_rnm", 6),
        ("blend_udn", 6),
        ("blend_whiteout", 6),
        ("direction_from_octahedral", 2),
    ];
    for (function, count) in functions {
        let mut numbers = Numbers::new(function);
        let arguments: Vec<f32> = (0..count << 14).map(|_| numbers.anything()).collect();
        all_unit(&gpu, &module, function, &arguments);
    }
}
