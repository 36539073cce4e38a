//! Compiles and runs WGSL in a line.

use halfvector_interp::{
    Column, Derivatives, Entry, Float, Limits, Outputs, Program, Resources, RunError, Unsupported,
};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

pub(crate) fn valid(source: &str) -> (naga::Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    (module, info)
}

pub(crate) fn compile(source: &str, function: &str) -> Result<Program, Unsupported> {
    let (module, info) = valid(source);
    Program::compile(&module, &info, Entry::Function(function))
}

pub(crate) fn try_run<F: Float>(
    source: &str,
    inputs: &[Column<'_, F>],
    lanes: usize,
    limits: Limits,
) -> Result<Outputs<F>, RunError> {
    let program = compile(source, "f").unwrap_or_else(|e| panic!("{e}"));
    let mut outputs = Outputs::default();
    program.run(inputs, lanes, &mut outputs, &Resources::default(), Derivatives::Zero, limits)?;
    Ok(outputs)
}

/// Runs the function `f` of a source; rows of results as f64, words as unsigned integers.
pub(crate) fn run<F: Float>(source: &str, inputs: &[Column<'_, F>], lanes: usize) -> Vec<Vec<f64>> {
    let outputs = try_run(source, inputs, lanes, Limits::default()).unwrap_or_else(|e| panic!("{e}"));
    let columns: Vec<Vec<f64>> = outputs.columns.iter().map(|c| c.to_f64()).collect();
    (0..lanes).map(|i| columns.iter().map(|c| c[i]).collect()).collect()
}

/// One expression of type `result` on words.
pub(crate) fn words(arguments: &str, result: &str, body: &str, inputs: &[&[u32]]) -> Vec<Vec<f64>> {
    let source = format!("fn f({arguments}) -> {result} {{ return {body}; }}");
    let columns: Vec<Column<'_, f32>> = inputs.iter().map(|c| Column::Word(c)).collect();
    let lanes = inputs.iter().map(|c| c.len()).max().unwrap_or(1);
    run(&source, &columns, lanes)
}

/// One expression of type `result` on floats `a`, `b`, `c`, in both scalars, which must agree within `tolerance`.
pub(crate) fn floats(result: &str, body: &str, inputs: &[&[f32]], tolerance: f64) -> Vec<Vec<f64>> {
    let arguments: Vec<String> = ["a", "b", "c"].iter().take(inputs.len()).map(|n| format!("{n}: f32")).collect();
    let source = format!("fn f({}) -> {result} {{ return {body}; }}", arguments.join(", "));
    let lanes = inputs.iter().map(|c| c.len()).max().unwrap_or(1);
    let single: Vec<Column<'_, f32>> = inputs.iter().map(|c| Column::Float(c)).collect();
    let wide: Vec<Vec<f64>> = inputs.iter().map(|c| c.iter().map(|x| f64::from(*x)).collect()).collect();
    let double: Vec<Column<'_, f64>> = wide.iter().map(|c| Column::Float(c)).collect();
    let (a, b) = (run(&source, &single, lanes), run(&source, &double, lanes));
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        let close = a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= tolerance * b.abs().max(1.0);
        assert!(close, "{body}: {a} in f32, {b} in f64");
    }
    a
}
