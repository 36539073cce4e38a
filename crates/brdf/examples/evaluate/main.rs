//! Evaluates every term of the crate at the points of a table, in f32 and in f64.
//!
//!     cargo run -p halfvector-brdf --example evaluate -- IN.csv OUT.csv
//!
//! IN has a header line with at least `id`, `roughness` (perceptual), `alpha_x`, `alpha_y`, `f0`, `f82_tint`, `rho`, and the
//! directions `vx vy vz lx ly lz` in a frame whose normal is +Z; they need not be unit. OUT has a row for each of them, in
//! order: `id`, and for every value NAME the columns `NAME_f32` and `NAME_f64`, in the fewest digits that read back to the
//! same number. Exit code 1: a file cannot be read or written, or is no such table; 2: the command line is wrong.

mod columns;
mod table;

use std::fmt::Write;
use std::process::ExitCode;

use columns::{INPUTS, OUTPUTS, Point, values};
use table::{Problem, Row, Table};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        eprintln!("usage: evaluate IN.csv OUT.csv");
        return ExitCode::from(2);
    };
    match run(input, output) {
        Ok(rows) => {
            eprintln!("{output}: {rows} rows of {} values in f32 and f64", OUTPUTS.len());
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(input: &str, output: &str) -> Result<usize, String> {
    let text = std::fs::read_to_string(input).map_err(|e| format!("{input}: cannot be read: {e}"))?;
    let (text, rows) = evaluate(&text).map_err(|e| format!("{input}: {e}"))?;
    std::fs::write(output, text).map_err(|e| format!("{output}: cannot be written: {e}"))?;
    Ok(rows)
}

/// The table of values of a table of points, and its number of rows.
fn evaluate(text: &str) -> Result<(String, usize), Problem> {
    let table = Table::parse(text)?;
    let id = table.column("id")?;
    let mut inputs = [0; INPUTS.len()];
    for (place, name) in inputs.iter_mut().zip(INPUTS) {
        *place = table.column(name)?;
    }
    let mut out = String::from("id");
    for name in OUTPUTS {
        out += &format!(",{name}_f32,{name}_f64");
    }
    out.push('\n');
    let mut rows = 0;
    for row in table.rows() {
        let point = point(row, &inputs)?;
        let cell = row.text(id);
        if cell.contains([',', '"']) {
            out += &format!("\"{}\"", cell.replace('"', "\"\""));
        } else {
            out += cell;
        }
        for (single, double) in values::<f32>(&point).into_iter().zip(values::<f64>(&point)) {
            write!(out, ",{single:e},{double:e}").expect("a string takes all");
        }
        out.push('\n');
        rows += 1;
    }
    Ok((out, rows))
}

fn point(row: Row, inputs: &[usize; INPUTS.len()]) -> Result<Point, Problem> {
    let mut point = [0.0; INPUTS.len()];
    for (number, column) in point.iter_mut().zip(inputs) {
        *number = row.number(*column)?;
    }
    for (name, direction) in [("v", &point[6..9]), ("l", &point[9..12])] {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(1e-3..=1e3).contains(&length) {
            return Err(row.problem(format!(
                "the direction ({name}x, {name}y, {name}z) has the length {length:e}; it has to be between 1e-3 and 1e3"
            )));
        }
    }
    Ok(point)
}
