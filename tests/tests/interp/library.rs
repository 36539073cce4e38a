//! Every twin of the library, run by the interpreter on the arguments of the twins' own test: in f64 the WGSL and the
//! Rust function are the same to 1e-12, in f32 they are as near as on a GPU.

use halfvector_interp::{Column, Derivatives, Float, Limits, Outputs, Program, Resources};
use halfvector_shaders::function::with_dependencies;
use naga::ScalarKind;

use super::{compile, valid};
use crate::twins::gpu::{Gpu, Number, library};
use crate::twins::table::{TWINS, Twin};
use crate::twins::{arguments, distance, ulp};

/// Runs a compiled twin on rows of arguments; rows of results.
fn call<F: Float>(program: &Program, inputs: &[f32]) -> Vec<Vec<f64>> {
    let width = program.inputs().len();
    let rows = inputs.len() / width;
    let column = |i: usize| (0..rows).map(move |row| inputs[row * width + i]);
    let floats: Vec<Vec<F>> = (0..width).map(|i| column(i).map(|x| F::from_f64(f64::from(x))).collect()).collect();
    let doubles: Vec<Vec<f64>> = (0..width).map(|i| column(i).map(f64::from).collect()).collect();
    let word = |i: usize, x: f32| match program.inputs()[i].scalar.kind {
        ScalarKind::Bool => u32::from(x != 0.0),
        _ => (x as i32).cast_unsigned(),
    };
    let words: Vec<Vec<u32>> = (0..width).map(|i| column(i).map(|x| word(i, x)).collect()).collect();
    let columns: Vec<Column<'_, F>> = program
        .inputs()
        .iter()
        .enumerate()
        .map(|(i, slot)| match (slot.scalar.kind, slot.scalar.width) {
            (ScalarKind::Float, 4) => Column::Float(&floats[i]),
            (ScalarKind::Float, _) => Column::Double(&doubles[i]),
            _ => Column::Word(&words[i]),
        })
        .collect();
    let mut out = Outputs::default();
    program
        .run(&columns, rows, &mut out, &Resources::default(), Derivatives::Zero, Limits::default())
        .unwrap_or_else(|e| panic!("{e}"));
    let columns: Vec<Vec<f64>> = out.columns.iter().map(|c| c.to_f64()).collect();
    (0..rows).map(|row| columns.iter().map(|c| c[row]).collect()).collect()
}

/// Largest distance of the results from what `truth` says of each row.
fn worst(twin: &Twin, found: &[Vec<f64>], unit: fn(f64) -> f64, truth: impl Fn(usize) -> Vec<f64>) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for (row, found) in found.iter().enumerate() {
        let expected = truth(row);
        assert_eq!(found.len(), expected.len(), "{}: numbers that it returns", twin.name);
        for (value, expected) in found.iter().zip(&expected) {
            let error = distance(*value, *expected, twin.floor, unit);
            if error > worst.0 {
                worst = (error, row);
            }
        }
    }
    worst
}

fn rust(twin: &Twin, inputs: &[f32], width: usize, row: usize) -> Vec<f64> {
    let arguments: Vec<f64> = inputs[row * width..][..width].iter().map(|x| f64::from(*x)).collect();
    (twin.rust)(&arguments)
}

fn compare(prelude: &str, allowed: fn(&Twin) -> f64, unit: fn(f64) -> f64) {
    let mut failures = Vec::new();
    for twin in TWINS {
        let source = format!("{prelude}{}", with_dependencies(twin.name, prelude));
        // Some built-ins exist in f32 only.
        if !prelude.is_empty() && !twin.f64 && valid(&source).is_err() {
            println!("{}: no f64", twin.name);
            continue;
        }
        let program = compile(&source, twin.name);
        let inputs = arguments(twin);
        let width = program.inputs().len();
        let found = call::<f32>(&program, &inputs);
        let (error, at) = worst(twin, &found, unit, |row| rust(twin, &inputs, width, row));
        println!("{}: max {error:.2e} of {}, {} steps", twin.name, allowed(twin), program.steps());
        if error > allowed(twin) {
            let input = &inputs[at * width..][..width];
            let expected = rust(twin, &inputs, width, at);
            failures.push(format!("{}: {error:.2} at {input:?}: {:?}, Rust {expected:?}", twin.name, found[at]));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn twins_agree_in_f64_without_a_gpu() {
    compare(f64::PRELUDE, |_| 1.0, |size| size * 1e-12);
}

#[test]
fn twins_agree_in_f32_without_a_gpu() {
    compare(f32::PRELUDE, |twin| twin.ulp, ulp);
}

#[test]
fn library_functions_are_those_of_the_gpu() {
    let Some(gpu) = Gpu::open() else { return };
    let module = library();
    for twin in TWINS {
        let inputs = arguments(twin);
        let device = gpu.call::<f32>(&module, twin.name, &inputs);
        let found = call::<f32>(&compile(&with_dependencies(twin.name, ""), twin.name), &inputs);
        let rows = |row: usize| device.values[row * device.results..][..device.results].to_vec();
        let (error, at) = worst(twin, &found, ulp, rows);
        println!("{}: {error:.2} ulp apart", twin.name);
        // Both are within the twin's ulp of the truth.
        assert!(
            error <= 2.0 * twin.ulp,
            "{}: {error} ulp apart at row {at}: {:?}, {}: {:?}",
            twin.name,
            found[at],
            gpu.name,
            rows(at)
        );
    }
}
