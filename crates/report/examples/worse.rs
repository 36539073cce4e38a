//! Holds several runs of `halfvector report` against each other, each against each: what any of them would be told to be worse in,
//! before anything is measured again. Runs of one program on one machine should be told nothing.
//!
//! ```sh
//! cargo run -p halfvector-report --example worse -- out/run1/report.json out/run2/report.json
//! ```

use std::process::ExitCode;

use halfvector_report::{Report, compare};

fn main() -> ExitCode {
    let mut runs = Vec::new();
    for path in std::env::args().skip(1) {
        let report = std::fs::read_to_string(&path)
            .map_err(|error| error.to_string())
            .and_then(|text| Report::from_json(&text).map_err(|error| error.to_string()));
        match report {
            Ok(report) => runs.push((path, report)),
            Err(error) => {
                eprintln!("{path}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    let (mut pairs, mut worse) = (0, 0);
    for (new_path, new) in &runs {
        for (old_path, old) in runs.iter().filter(|(path, _)| path != new_path) {
            let changes = compare::changes(old, new);
            for change in &changes {
                println!("{new_path} beside {old_path}: {change}");
            }
            (pairs, worse) = (pairs + 1, worse + changes.len());
        }
    }
    println!("{worse} figures worse in {pairs} pairs of runs");
    if worse == 0 { ExitCode::SUCCESS } else { ExitCode::from(3) }
}
