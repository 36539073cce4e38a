//! `halfvector report`: speed against error of every method, measured here and now.

use std::path::PathBuf;

use halfvector_report::{Effort, PARTS, mark_pareto, write};

use crate::failure::Failure;
use crate::output::{check_place, note, write_file};

/// Measures speed and error of every method on this machine and writes report.json and one CSV file per part.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  halfvector report --quick -o out/report")]
pub(crate) struct ReportArgs {
    /// Folder for the files
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Fewer points and runs: at most two minutes on two cores
    #[arg(long)]
    quick: bool,
    /// Measures one part only
    #[arg(long, value_name = "PART", value_parser = clap::builder::PossibleValuesParser::new(PARTS.iter().map(|p| p.name)))]
    only: Option<String>,
}

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<u8, Failure> {
    check_place(&args.output.join("report.json"))?;
    let effort = if args.quick { Effort::Quick } else { Effort::Full };
    let parts = PARTS.iter().filter(|part| args.only.as_deref().is_none_or(|only| only == part.name));
    let mut all = Vec::new();
    for part in parts {
        let bar = crate::output::progress(part.name);
        let mut rows = (part.rows)(effort);
        bar.finish_and_clear();
        mark_pareto(&mut rows);
        write_file(&args.output.join(format!("{}.csv", part.name)), write::csv(&rows).as_bytes())?;
        note(format_args!("{}: {} rows", part.name, rows.len()));
        all.append(&mut rows);
    }
    let report = write::json(&write::machine(), &all);
    write_file(&args.output.join("report.json"), format!("{report:#}\n").as_bytes())?;
    Ok(0)
}
