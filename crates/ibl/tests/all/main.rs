//! Tests of the crate as its users see it, in one binary. Those that need the data folder (`HALFVECTOR_DATA`, default
//! `../shared/data` beside the project) print a line and pass when it is not there.

mod albedo;
mod bake;
mod energy;
mod exr;
mod files;
mod hard;
mod irradiance;
mod occlusion;
mod peers;
mod sampling;
mod save;
mod seen;
mod sh;
mod truth;

use std::path::PathBuf;

/// A file of the data folder, or a printed line and nothing.
fn data_file(path: &str) -> Option<Vec<u8>> {
    let root = std::env::var_os("HALFVECTOR_DATA")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")), PathBuf::from);
    let bytes = std::fs::read(root.join(path)).ok();
    if bytes.is_none() {
        println!("skipped: no {path} in the data folder");
    }
    bytes
}

/// The rows of a CSV file of the data folder, without its header.
fn data_table(path: &str) -> Option<Vec<Vec<String>>> {
    let text = String::from_utf8(data_file(path)?).expect("a CSV file is text");
    Some(text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect())
}

/// Relative error of a colour, as the issue measures it: against the truth, at least a thousandth of the mean radiance.
fn relative_errors(value: [f32; 3], truth: [f64; 3], mean: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| (f64::from(value[c]) - truth[c]).abs() / truth[c].max(1e-3 * mean[c]))
}

/// Whether everything is to be measured that a test can, with `HALFVECTOR_FULL=1`, rather than what shows a mistake.
fn full() -> bool {
    std::env::var_os("HALFVECTOR_FULL").is_some_and(|value| value == "1")
}

/// As many of `all` points as a test takes: a quarter of them, or all with `HALFVECTOR_FULL=1`.
fn share(all: usize) -> usize {
    if full() { all } else { all.div_ceil(4) }
}

/// Root of the mean square.
fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64).sqrt()
}

/// The environments that the tables belong to.
const ENVIRONMENTS: [&str; 4] = ["bpy_city", "bpy_interior", "bpy_night", "bpy_studio"];

fn environment(name: &str) -> Option<halfvector_ibl::LoadedEnvironment> {
    let path = format!("env/{name}.exr");
    Some(halfvector_ibl::load(&data_file(&path)?, &path).expect("the file is sound"))
}

/// Three columns of a table's row.
fn numbers(row: &[String], at: usize) -> [f64; 3] {
    std::array::from_fn(|i| row[at + i].parse().expect("a number"))
}

/// Our frame from the tables'.
fn mirrored([x, y, z]: [f64; 3]) -> [f64; 3] {
    [z, y, x]
}
