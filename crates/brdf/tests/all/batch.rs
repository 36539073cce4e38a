//! Batches: accurate as the scalar functions are, on every instruction set of the machine, at every length.

use halfvector_brdf::batch::kernels::{
    DiffuseEval, DiffuseSample, SampleSlices, SpecularEval, SpecularPdf, SpecularSample,
};
use halfvector_brdf::batch::{Kernel, LengthMismatch, Level, Simd};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use proptest::prelude::*;

use crate::data::{Table, points};
use crate::domain::{any_bits, unit, up_to_1};
use crate::points::lobe_scale;

fn levels() -> Vec<Simd> {
    let levels: Vec<_> = [Level::Baseline, Level::Avx2, Level::Avx512].into_iter().filter_map(Simd::at).collect();
    println!("levels: {:?}", levels.iter().map(|s| s.level()).collect::<Vec<_>>());
    levels
}

/// One kernel over columns.
fn run<K: Kernel<I, O>, const I: usize, const O: usize>(
    simd: Simd,
    kernel: &K,
    inputs: &[Vec<f32>; I],
) -> [Vec<f32>; O] {
    let mut outputs = [const { Vec::new() }; O];
    outputs.iter_mut().for_each(|o| o.resize(inputs[0].len(), -1.0));
    simd.run(kernel, inputs.each_ref().map(|v| &v[..]), outputs.each_mut().map(|v| &mut v[..])).unwrap();
    outputs
}

fn columns<const N: usize>(points: &Table, names: [&str; N]) -> [Vec<f32>; N] {
    names.map(|name| points.rows().map(|row| row.number(name) as f32).collect())
}

#[test]
fn evaluation_has_the_scalar_s_accuracy() {
    for table in points() {
        let names = ["vx", "vy", "vz", "lx", "ly", "lz", "alpha", "f0", "f0", "f0"];
        for simd in levels() {
            let [_, value, _] = run(simd, &SpecularEval, &columns(&table, names));
            let (mut worst, mut missed) = (0.0_f64, 0);
            for (row, value) in table.rows().zip(value) {
                let tolerance = 4e-6 + 4.0 * 6e-8 * row.number("cond_f32") + 2.0 * row.number("len_err_f32");
                let error = (f64::from(value) - row.number("spec_schlick_cos")).abs() / lobe_scale(row);
                if row.number("roughness") >= 0.045 {
                    worst = worst.max(error / tolerance);
                } else if error > tolerance || error.is_nan() {
                    missed += 1;
                }
            }
            println!("{:?}: worst {worst:.2} of the tolerance, {missed} missed below roughness 0.045", simd.level());
            assert!(worst <= 0.5 && missed <= 4);
        }
    }
}

#[test]
fn densities_are_the_table_s() {
    for table in points() {
        for simd in levels() {
            let [pdf] = run(simd, &SpecularPdf, &columns(&table, ["vx", "vy", "vz", "lx", "ly", "lz", "alpha"]));
            for (row, pdf) in table.rows().zip(pdf) {
                if row.number("roughness") < 0.045 {
                    continue;
                }
                let tolerance = 4e-6 + 4.0 * 6e-8 * row.number("cond_f32") + 2.0 * row.number("len_err_f32");
                let error = (f64::from(pdf) / row.number("pdf_vndf_l") - 1.0).abs();
                assert!(error <= tolerance, "row {}: error {error:.1e} of {tolerance:.1e}", row.text("id"));
            }
        }
    }
}

/// The lobe has no half vector to lose: only v.l, from |v + l|, counts 1 / max(n.v, n.l) times.
#[test]
fn diffuse_is_the_table_s() {
    for table in points() {
        for simd in levels() {
            let names = ["vx", "vy", "vz", "lx", "ly", "lz", "roughness", "rho", "rho", "rho"];
            let [value, ..] = run(simd, &DiffuseEval, &columns(&table, names));
            let mut worst = 0.0_f64;
            for (row, value) in table.rows().zip(value) {
                let n_dot_l = row.number("nol");
                let bound = (row.number("rho") / std::f64::consts::PI * n_dot_l).max(1e-9)
                    * (1.0 + row.number("roughness") / n_dot_l.max(row.number("nov")));
                worst = worst.max((f64::from(value) - row.number("eon_approx") * n_dot_l).abs() / bound);
            }
            println!("{:?}: diffuse, worst {worst:.1e}", simd.level());
            assert!(worst < 4e-6, "{worst}");
        }
    }
}

#[test]
fn diffuse_samples_are_the_scalar_s() {
    let [.., u0, u1] = draws(5_003);
    for simd in levels() {
        let [mut x, mut y, mut z, mut pdf] = [const { Vec::new() }; 4].map(|v: Vec<f32>| {
            let mut v = v;
            v.resize(u0.len(), -2.0);
            v
        });
        simd.diffuse_sample([&u0, &u1], [&mut x, &mut y, &mut z], &mut pdf).unwrap();
        for i in 0..u0.len() {
            let truth = DiffuseSample.call([u0[i], u1[i]].map(f64::from));
            let got = [x[i], y[i], z[i], pdf[i]].map(f64::from);
            assert!((0..4).all(|k| (got[k] - truth[k]).abs() < 5e-7), "{got:?}, {truth:?}");
        }
    }
}

/// Views, roughnesses, colours and two numbers a draw: a lattice without a pattern.
fn draws(count: u32) -> [Vec<f32>; 9] {
    let radical = |i: u32, step: u32| f64::from(i.wrapping_mul(step)) / 4_294_967_296.0;
    let column = |f: &dyn Fn(u32) -> f64| (1..=count).map(|i| f(i) as f32).collect::<Vec<_>>();
    let z = |i| radical(i, 2_654_435_769).max(1e-3);
    let phi = |i| std::f64::consts::TAU * radical(i, 1_640_531_527);
    let sine = |i| (1.0 - z(i) * z(i)).sqrt();
    [
        column(&|i| sine(i) * phi(i).cos()),
        column(&|i| sine(i) * phi(i).sin()),
        column(&z),
        column(&|i| (0.045 + 0.955 * radical(i, 3_242_174_889)).powi(2)),
        column(&|_| 1.0),
        column(&|_| 0.5),
        column(&|_| 0.04),
        column(&|i| radical(i, 2_447_445_413)),
        column(&|i| radical(i, 3_039_177_861)),
    ]
}

/// Largest errors of samples against f64: of the direction, of the density (relative), of the weight times n.l, which
/// goes to 0 at the horizon as n.l does, with the direction's absolute error.
fn sample_errors(inputs: &[Vec<f32>; 9], outputs: &[Vec<f32>; 7]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for i in 0..inputs[0].len() {
        let truth = SpecularSample.call::<f64>(inputs.each_ref().map(|c| f64::from(c[i])));
        let got = outputs.each_ref().map(|c| f64::from(c[i]));
        let error = |range: std::ops::Range<usize>| range.map(|c| (got[c] - truth[c]).abs()).fold(0.0, f64::max);
        let errors = [error(0..3), (got[3] / truth[3] - 1.0).abs(), error(4..7) * truth[2].abs().max(1e-3)];
        worst = [0, 1, 2].map(|k| worst[k].max(errors[k]));
    }
    worst
}

/// Where the cap's lower edge is drawn the sampler is badly conditioned in `u`, in lanes as in f32: 2e-4 of a direction.
#[test]
fn samples_have_the_scalar_s_accuracy() {
    let inputs = draws(20_011);
    let mut scalar = [const { Vec::new() }; 7];
    for i in 0..inputs[0].len() {
        let values = SpecularSample.call::<f32>(inputs.each_ref().map(|c| c[i]));
        scalar.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }
    let bound = sample_errors(&inputs, &scalar);
    println!("scalar f32: light {:.1e}, density {:.1e} relative, weight n.l {:.1e}", bound[0], bound[1], bound[2]);
    for simd in levels() {
        let worst = sample_errors(&inputs, &run(simd, &SpecularSample, &inputs));
        println!("{:?}: light {:.1e}, density {:.1e}, weight n.l {:.1e}", simd.level(), worst[0], worst[1], worst[2]);
        assert!((0..3).all(|k| worst[k] <= 2.0 * bound[k]), "{worst:?}, scalar {bound:?}");
    }
}

#[test]
fn weight_times_density_is_the_lobe() {
    for i in 0..2_000 {
        let inputs = draws(2_000).map(|c| f64::from(c[i]));
        let [vx, vy, vz, alpha, r, g, b, ..] = inputs;
        let [lx, ly, lz, pdf, wr, ..] = SpecularSample.call(inputs);
        let [value, ..] = SpecularEval.call([vx, vy, vz, lx, ly, lz, alpha, r, g, b]);
        let [density] = SpecularPdf.call([vx, vy, vz, lx, ly, lz, alpha]);
        // The f32 view is unit to 6e-8 only, and a roughness of 0.045 makes that 1e-4 of D.
        assert!((wr * pdf - value).abs() <= 1e-3 * value + 1e-9, "{wr} * {pdf}, {value}");
        assert!((density / pdf - 1.0).abs() <= 1e-3, "{density}, {pdf}");
    }
}

#[test]
fn every_length() {
    let inputs = draws(131);
    for simd in levels() {
        let whole: [Vec<f32>; 7] = run(simd, &SpecularSample, &inputs);
        for length in 0..=131 {
            let part: [Vec<f32>; 7] = run(simd, &SpecularSample, &inputs.each_ref().map(|c| c[..length].to_vec()));
            for (part, whole) in part.iter().zip(&whole) {
                assert_eq!(part[..], whole[..length]);
            }
        }
    }
}

#[test]
fn lengths_that_differ_are_told() {
    let x = [0.5; 4];
    let mut out = [[7.0; 4]; 3];
    let [r, g, b] = &mut out;
    let error = Simd::best().specular_eval([&x; 3], [&x, &x, &x[..3]], &x, [&x; 3], [r, g, b]).unwrap_err();
    assert_eq!(error, LengthMismatch { kind: "input", index: 5, found: 3, expected: 4 });
    assert!(error.to_string().contains("input 5"), "{error}");
    assert_eq!(out, [[7.0; 4]; 3]);
    let mut short = [0.0; 2];
    let [mut a, mut d, mut e, mut f, mut g, mut h] = [[0.0; 4]; 6];
    let slices =
        SampleSlices { light: [&mut a, &mut d, &mut e], pdf_solid_angle: &mut short, weight: [&mut f, &mut g, &mut h] };
    let error = Simd::best().specular_sample([&x; 3], &x, [&x; 3], [&x; 2], slices).unwrap_err();
    assert_eq!(error, LengthMismatch { kind: "output", index: 3, found: 2, expected: 4 });
}

#[test]
fn named_calls_put_slices_in_order() {
    let inputs = draws(40);
    let simd = Simd::best();
    let [vx, vy, vz, alpha, r, g, b, u0, u1] = inputs.each_ref().map(|c| &c[..]);
    let want: [Vec<f32>; 7] = run(simd, &SpecularSample, &inputs);
    let mut got = [const { [0.0; 40] }; 7];
    let [lx, ly, lz, pdf_solid_angle, wr, wg, wb] = got.each_mut().map(|c| &mut c[..]);
    let out = SampleSlices { light: [lx, ly, lz], pdf_solid_angle, weight: [wr, wg, wb] };
    simd.specular_sample([vx, vy, vz], alpha, [r, g, b], [u0, u1], out).unwrap();
    assert_eq!(got.map(|c| c.to_vec()), want);

    let light = want.each_ref().map(|c| &c[..]);
    let light = [light[0], light[1], light[2]];
    let mut pdf = [0.0; 40];
    simd.specular_pdf([vx, vy, vz], light, alpha, &mut pdf).unwrap();
    let mut value = [[0.0; 40]; 3];
    let [r_out, g_out, b_out] = &mut value;
    simd.specular_eval([vx, vy, vz], light, alpha, [r, g, b], [r_out, g_out, b_out]).unwrap();
    for i in 0..40 {
        let frame = frame_from_normal([0.0, 0.0, 1.0], [vx[i], vy[i], vz[i]]);
        let p = Specular { f0: [r[i], g[i], b[i]], f90: [1.0; 3], alpha: alpha[i] };
        let scalar = specular_eval(frame, [light[0][i], light[1][i], light[2][i]], p);
        for c in 0..3 {
            assert!((value[c][i] - scalar[c]).abs() <= 1e-4 * scalar[c] + 1e-9, "{} {}", value[c][i], scalar[c]);
            let weighted = want[4 + c][i] * want[3][i];
            assert!((weighted - scalar[c]).abs() <= 1e-3 * scalar[c] + 1e-9, "{weighted} {}", scalar[c]);
        }
        assert!((pdf[i] / want[3][i] - 1.0).abs() < 1e-3);
    }
}

proptest! {
    #[test]
    fn inside_the_domain_all_is_finite(
        view in unit(), light in unit(), alpha in up_to_1(1e-8), f0 in up_to_1(1e-6), u in [0.0..1.0_f32, 0.0..1.0_f32],
    ) {
        let [vx, vy, vz] = [view[0], view[1], view[2].abs()].map(|x| vec![x]);
        let [lx, ly, lz] = light.map(|x| vec![x]);
        let [u0, u1] = u.map(|x| vec![x]);
        let (alpha, f0) = (vec![alpha], vec![f0]);
        for simd in levels() {
            let eval = [&vx, &vy, &vz, &lx, &ly, &lz, &alpha, &f0, &f0, &f0].map(Clone::clone);
            let sample = [&vx, &vy, &vz, &alpha, &f0, &f0, &f0, &u0, &u1].map(Clone::clone);
            let pdf = [&vx, &vy, &vz, &lx, &ly, &lz, &alpha].map(Clone::clone);
            let values: [Vec<f32>; 3] = run(simd, &SpecularEval, &eval);
            let [density] = run(simd, &SpecularPdf, &pdf);
            let drawn: [Vec<f32>; 7] = run(simd, &SpecularSample, &sample);
            for x in values.iter().chain([&density]).chain(&drawn[3..]) {
                prop_assert!(x[0].is_finite() && x[0] >= 0.0, "{x:?}");
            }
            let length = drawn[..3].iter().map(|c| f64::from(c[0]).powi(2)).sum::<f64>().sqrt();
            prop_assert!((length - 1.0).abs() < 1e-6, "{length}");
        }
    }

    #[test]
    fn evaluation_of_any_bits_is_finite(x in prop::collection::vec(any_bits(), 10)) {
        for simd in levels() {
            let inputs: [Vec<f32>; 10] = std::array::from_fn(|i| vec![x[i]; 3]);
            for values in [run(simd, &SpecularEval, &inputs), run(simd, &DiffuseEval, &inputs)] {
                let values: [Vec<f32>; 3] = values;
                prop_assert!(values.iter().flatten().all(|v| v.is_finite() && *v >= 0.0), "{values:?}");
            }
        }
    }
}
