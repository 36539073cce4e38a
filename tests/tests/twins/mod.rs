//! The functions that exist twice, in WGSL (what ships) and in Rust (what the crates offer): one table names them all,
//! naga and syn prove it complete, and a GPU shows that each pair computes the same, in f32 and in f64.

mod brdf_hard_cases;
mod domain;
pub(crate) mod gpu;
mod hard_cases;
mod signatures;
pub(crate) mod table;
mod texel;
mod truth;

use std::collections::BTreeSet;

use domain::Numbers;
use gpu::{Gpu, Number, library};
use halfvector_shaders::function::library_files;
use signatures::{rust_functions, rust_twin, wgsl_functions};
use table::{RUST_ONLY, TWINS, Twin, WGSL_ONLY};

/// How many times each function is called.
const ROWS: usize = 1 << 13;

fn listed(list: &[(&str, &str)], name: &str) -> bool {
    list.iter().any(|(n, _)| *n == name)
}

#[test]
fn the_table_is_complete() {
    let module = library();
    let (mut problems, mut known) = (Vec::new(), BTreeSet::new());
    for file in library_files() {
        let wgsl = wgsl_functions(file.path, &module);
        let rust = rust_functions(file.path);
        known.extend(wgsl.iter().chain(&rust).map(|f| f.name.clone()));
        for function in &wgsl {
            let name = &function.name;
            if listed(WGSL_ONLY, name) {
                continue;
            }
            if !TWINS.iter().any(|t| t.name == name && t.file == file.path) {
                problems.push(format!("{}: `{name}` is not in the table of twins", file.path));
            }
            match rust.iter().find(|r| r.name == *name) {
                None => problems.push(format!("{}: no public `{name}`", rust_twin(file.path).display())),
                Some(twin) if twin != function => problems.push(format!("{function:?} and {twin:?} differ")),
                Some(_) => {}
            }
        }
        for function in &rust {
            let name = &function.name;
            if !listed(RUST_ONLY, name) && !listed(WGSL_ONLY, name) && wgsl.iter().all(|w| w.name != *name) {
                problems.push(format!("{}: no WGSL twin of `{name}`", file.path));
            }
        }
    }
    let named = TWINS.iter().map(|t| t.name).chain(WGSL_ONLY.iter().chain(RUST_ONLY).map(|(n, _)| *n));
    problems.extend(named.filter(|n| !known.contains(*n)).map(|n| format!("the table names `{n}`, which is nowhere")));
    assert!(problems.is_empty(), "{}", problems.join("\n"));
    println!("{} twins, {} functions of WGSL alone, {} of Rust alone", TWINS.len(), WGSL_ONLY.len(), RUST_ONLY.len());
}

/// The arguments of all calls of a twin, row after row.
pub(crate) fn arguments(twin: &Twin) -> Vec<f32> {
    let mut numbers = Numbers::new(twin.name);
    let mut all = Vec::new();
    for _ in 0..ROWS {
        for domain in twin.domain {
            domain.draw(&mut numbers, &mut all);
        }
    }
    all
}

/// Distance of two numbers in units of `unit` times the size of the second, or of `floor` where that is more; two equal
/// numbers (0 and 0 among them) are no distance apart, and NaN is infinitely far.
pub(crate) fn distance(value: f64, truth: f64, floor: f64, unit: impl Fn(f64) -> f64) -> f64 {
    if value == truth {
        return 0.0;
    }
    let error = (value - truth).abs() / unit(truth.abs().max(floor));
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Unit in the last place of an f32 of this size.
pub(crate) fn ulp(size: f64) -> f64 {
    let size = size.max(f64::from(f32::MIN_POSITIVE)) as f32;
    f64::from(f32::from_bits(size.to_bits() + 1)) - f64::from(size)
}

fn compare<N: Number>(
    gpu: &Gpu,
    twins: impl Iterator<Item = &'static Twin>,
    allowed: fn(&Twin) -> f64,
    unit: fn(f64) -> f64,
) {
    let module = library();
    let mut failures = Vec::new();
    for twin in twins {
        let inputs = arguments(twin);
        let outputs = gpu.call::<N>(&module, twin.name, &inputs);
        let (mut worst, mut at, mut squares) = (0.0, 0, 0.0);
        for (row, input) in inputs.chunks_exact(outputs.arguments).enumerate() {
            let input: Vec<f64> = input.iter().map(|x| f64::from(*x)).collect();
            let truth = (twin.rust)(&input);
            let output = &outputs.values[row * outputs.results..][..outputs.results];
            assert_eq!(truth.len(), output.len(), "{}: numbers that it returns", twin.name);
            for (value, truth) in output.iter().zip(&truth) {
                let error = distance(*value, *truth, twin.floor, unit);
                squares += error * error;
                if error > worst {
                    (worst, at) = (error, row);
                }
            }
        }
        let rms = (squares / outputs.values.len() as f64).sqrt();
        let bits = size_of::<N>() * 8;
        println!("f{bits} | {:<32} | {worst:>9.3} | {rms:>9.4} | {:>7} | {:e}", twin.name, allowed(twin), twin.floor);
        if worst > allowed(twin) {
            let input = &inputs[at * outputs.arguments..][..outputs.arguments];
            let output = &outputs.values[at * outputs.results..][..outputs.results];
            let truth = (twin.rust)(&input.iter().map(|x| f64::from(*x)).collect::<Vec<_>>());
            failures.push(format!(
                "{}: {worst:.2}, allowed {}, at {input:?}: WGSL {output:?}, Rust {truth:?}",
                twin.name,
                allowed(twin)
            ));
        }
    }
    assert!(failures.is_empty(), "{}:\n{}", gpu.name, failures.join("\n"));
}

#[test]
fn twins_agree_in_f32() {
    let Some(gpu) = Gpu::open() else { return };
    println!(
        "{}, {ROWS} calls each of WGSL in f32 against Rust in f64; errors in ulp of the value or of the floor",
        gpu.name
    );
    println!("    | function                         |       max |       rms | allowed | floor");
    compare::<f32>(&gpu, TWINS.iter(), |twin| twin.ulp, ulp);
}

#[test]
fn twins_agree_in_f64() {
    let Some(gpu) = Gpu::open() else { return };
    if !gpu.has_f64 {
        println!("skipped: {} has no f64", gpu.name);
        return;
    }
    println!("{}, {ROWS} calls each; relative errors in 1e-12", gpu.name);
    compare::<f64>(&gpu, TWINS.iter().filter(|t| t.f64), |_| 1.0, |size| size * 1e-12);
}
