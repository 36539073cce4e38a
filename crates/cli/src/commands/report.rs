//! `halfvector report`: speed against error of every method, measured here and now.

mod again;
mod kept;

use std::path::{Path, PathBuf};
use std::time::Instant;

use halfvector_report::{Effort, PARTS, Part, Report, Run, SoFar, compare};

use self::kept::Kept;
use crate::failure::{FOUND, Failure};
use crate::output::{check_place, note, print};

/// Measures speed and error of every method on this machine and writes a page with plots, report.json and CSV files.
///
/// The files are written anew whenever rows are finished: what is measured stays when the command is interrupted. CSV files of
/// an older report in the same folder go, for they would not belong to this one's page.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:
  halfvector report --quick -o out/report
  halfvector report --quick --compare out/report/report.json -o out/new

Exit code 3: --compare found something slower or less accurate. 130: interrupted (Ctrl-C); what was measured is kept, and
it says where.")]
pub(crate) struct ReportArgs {
    /// Folder for index.html, report.json and the CSV files
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Fewer points and runs: about two minutes on two cores, and with --compare about two more, for it measures again what seems slower
    #[arg(long)]
    quick: bool,
    /// Measures this part only; may be given several times
    #[arg(long, value_name = "PART", value_parser = clap::builder::PossibleValuesParser::new(PARTS.iter().map(|p| p.name)))]
    only: Vec<String>,
    /// Lists what became slower or less accurate than in this report.json, beyond noise
    #[arg(long, value_name = "OLD.json")]
    compare: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<u8, Failure> {
    check_place(&args.output.join("report.json"))?;
    // Before the work: a wrong file is told at once, and it may be the one that is written.
    let old = args.compare.as_deref().map(read).transpose()?;
    if let Some(path) = &args.compare {
        not_replaced(path, &args.output.join("report.json"))?;
    }
    let effort = if args.quick { Effort::Quick } else { Effort::Full };
    let parts: Vec<_> =
        PARTS.iter().filter(|part| args.only.is_empty() || args.only.iter().any(|only| only == part.name)).collect();
    if let (Some(old), Some(path)) = (&old, &args.compare) {
        comparable(old, path, &parts)?;
    }
    std::fs::create_dir_all(&args.output).map_err(|error| {
        let failure = Failure::input("the folder cannot be made").at(&args.output).because(error);
        failure.try_to("another folder, or one with other permissions")
    })?;
    let kept = Kept::begun(&args.output, effort);
    kept.try_out(&parts)?;
    let start = Instant::now();
    let all: f64 = parts.iter().map(|part| part.seconds(effort)).sum();
    let mut took: Vec<(&Part, f64)> = Vec::new();
    for (done, part) in parts.iter().enumerate() {
        let before: f64 = parts[..done].iter().map(|part| part.seconds(effort)).sum();
        let bar = crate::output::progress(part.name);
        let at = |share: f64| {
            let foreseen = before + share * part.seconds(effort);
            // How much slower than foreseen this machine has been so far.
            let pace = if foreseen > 2.0 { start.elapsed().as_secs_f64() / foreseen } else { 1.0 };
            bar.set_position((1000.0 * foreseen / all) as u64);
            bar.set_message(format!("{}, about {} left", part.name, in_words(pace * (all - foreseen))));
        };
        at(0.0);
        let told = |so_far: SoFar<'_>| {
            at(so_far.done);
            kept.part_so_far(part.name, so_far);
        };
        let (run, begun) = (Run::new(effort, &told), Instant::now());
        let rows = (part.rows)(&run);
        took.push((part, begun.elapsed().as_secs_f64()));
        bar.finish_and_clear();
        let (count, left_out) = (rows.len(), run.left_out());
        // Told when it is kept: whoever interrupts the command after that line finds the whole part.
        kept.part(part.name, rows, left_out.clone())?;
        note(format_args!("{}: {count} rows", part.name));
        for left in &left_out {
            note(format_args!("not measured: {left}"));
        }
    }
    let report = kept.report();
    let page = args.output.join("index.html");
    note(format_args!("{} after {}", page.display(), in_words(start.elapsed().as_secs_f64())));
    let Some(old) = old else { return Ok(0) };
    if old.effort != report.effort {
        note("the old report drew other points (--quick or not): errors are not compared, times are");
    }
    if let Some([before, now]) = compare::other_device(&old, &report) {
        note(format_args!("the old report's device is {before}, this one's {now}: their times are not compared"));
    }
    let (mut slower, certain): (Vec<_>, Vec<_>) =
        compare::changes(&old, &report).into_iter().partition(|change| change.is_doubtful());
    for change in &certain {
        print(&change.to_string())?;
    }
    if let Some(hidden) = compare::hidden(&old, &report) {
        note(hidden);
    }
    // What else the machine does slows one method more than another, in a whole run: a change stays.
    again::confirm(&mut slower, &old, &report, &took, &kept)?;
    compare::settle(&mut slower);
    for change in &slower {
        print(&change.to_string())?;
    }
    let (common, worse) = (compare::common(&old, &report), certain.len() + slower.len());
    note(format_args!("figures that are worse: {worse}, of {common} rows that the report of {} has, too", old.date));
    Ok(if worse == 0 { 0 } else { FOUND })
}

/// The report that is compared with stays: measured anew it would lose the parts that are not.
fn not_replaced(old: &Path, new: &Path) -> Result<(), Failure> {
    // What is not there cannot be replaced.
    let places = [old, new].map(|path| path.canonicalize().ok());
    if places[0].is_none() || places[0] != places[1] {
        return Ok(());
    }
    let failure = Failure::input("the old report would be replaced by the new one").at(old);
    Err(failure.because("--output writes it in the same place").try_to("another folder for --output"))
}

/// Whether an old report has rows of any of the parts that are to be measured.
fn comparable(old: &Report, path: &Path, parts: &[&Part]) -> Result<(), Failure> {
    // Rows of before parts were told name none.
    let has_rows = |name: &str| old.rows.iter().any(|row| row.part == name || row.part.is_empty());
    if parts.iter().any(|part| has_rows(part.name) && old.parts.iter().any(|name| name == part.name)) {
        return Ok(());
    }
    let its: Vec<&str> = old.parts.iter().map(String::as_str).filter(|name| has_rows(name)).collect();
    let its = if its.is_empty() { "no part that was measured to its end".to_owned() } else { its.join(", ") };
    let names: Vec<&str> = parts.iter().map(|part| part.name).collect();
    let failure = Failure::input("the old report has nothing to compare").at(path);
    Err(failure
        .because(format_args!("it holds {its}; measured would be {}", names.join(", ")))
        .try_to("--only a part that both have"))
}

/// 40 s, or 2 min 10 s.
fn in_words(seconds: f64) -> String {
    let seconds = seconds.ceil() as u64;
    if seconds < 60 { format!("{seconds} s") } else { format!("{} min {} s", seconds / 60, seconds % 60) }
}

fn read(path: &Path) -> Result<Report, Failure> {
    let wrong = |why: &dyn std::fmt::Display| {
        let remedy = "a report.json that `halfvector report` wrote";
        Failure::input("the old report cannot be read").at(path).because(why).try_to(remedy)
    };
    // A pipe or a device may have no end.
    if path.exists() && !path.is_file() {
        return Err(wrong(&"it is no regular file"));
    }
    let text = std::fs::read_to_string(path).map_err(|error| wrong(&error))?;
    Report::from_json(&text).map_err(|error| wrong(&error))
}
