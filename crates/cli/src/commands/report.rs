//! `halfvector report`: speed against error of every method, measured here and now.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use halfvector_report::part::shaders;
use halfvector_report::{Effort, PARTS, Part, Report, Row, compare, mark_pareto, page, write};

use crate::failure::{FOUND, Failure};
use crate::output::{check_place, note, print, write_file};

/// Measures speed and error of every method on this machine and writes a page with plots, report.json and CSV files.
///
/// The files are written anew after each part: what is measured stays when the command is interrupted.
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
    /// Fewer points and runs: at most two minutes on two cores
    #[arg(long)]
    quick: bool,
    /// Measures this part only; may be given several times
    #[arg(long, value_name = "PART", value_parser = clap::builder::PossibleValuesParser::new(PARTS.iter().map(|p| p.name)))]
    only: Vec<String>,
    /// Lists what became slower or less accurate than in this report.json, beyond noise
    #[arg(long, value_name = "OLD.json")]
    compare: Option<PathBuf>,
}

/// How often what seems to be slower is measured again before it is told.
const CONFIRMATIONS: usize = 5;

/// What a shell says of a command that an interrupt ended: 128 and the signal's number.
#[cfg(unix)]
const INTERRUPTED: i32 = 130;

/// Before it is measured again.
const CALM: Duration = Duration::from_secs(2);

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<u8, Failure> {
    check_place(&args.output.join("report.json"))?;
    // Before the work: a wrong file is told at once, and it may be the one that is written.
    let old = args.compare.as_deref().map(read).transpose()?;
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
    let mut report = Report::begun(effort);
    let kept = Kept::told_when_interrupted(&args.output);
    let start = Instant::now();
    for (done, part) in parts.iter().enumerate() {
        let before: f64 = parts[..done].iter().map(|part| part.seconds(effort)).sum();
        // How much slower than foreseen this machine has been so far.
        let pace = if before > 2.0 { start.elapsed().as_secs_f64() / before } else { 1.0 };
        let left: f64 = pace * parts[done..].iter().map(|part| part.seconds(effort)).sum::<f64>();
        let bar = crate::output::progress(&format!("{}, about {} left", part.name, in_words(left)));
        let all: f64 = parts.iter().map(|part| part.seconds(effort)).sum();
        bar.set_position((1000.0 * before / all) as u64);
        let mut rows = (part.rows)(effort);
        bar.finish_and_clear();
        let first = report.rows.len();
        report.rows.append(&mut rows);
        shaders::share(&mut report.rows);
        let rows = &mut report.rows[first..];
        rows.iter_mut().for_each(|row| part.name.clone_into(&mut row.part));
        mark_pareto(rows);
        write_file(&args.output.join(format!("{}.csv", part.name)), write::csv(rows).as_bytes())?;
        report.parts.push(part.name.to_owned());
        write_file(&args.output.join("report.json"), report.to_json().as_bytes())?;
        write_file(&args.output.join("index.html"), page::html(&report).as_bytes())?;
        kept.add(part.name);
        note(format_args!("{}: {} rows", part.name, report.rows.len() - first));
    }
    let page = args.output.join("index.html");
    note(format_args!("{} after {}", page.display(), in_words(start.elapsed().as_secs_f64())));
    let Some(old) = old else { return Ok(0) };
    if old.effort != report.effort {
        note("the old report drew other points (--quick or not): errors are not compared, times are");
    }
    let mut changes = compare::changes(&old, &report);
    // What else the machine does slows one method more than another, in a whole run: a change stays.
    for _ in 0..CONFIRMATIONS {
        let doubtful = compare::doubtful(&changes, &report);
        if doubtful.is_empty() {
            break;
        }
        let mut again = report.clone();
        for part in parts.iter().filter(|part| doubtful.contains(part.name)) {
            note(format_args!("{}: measured again, for something seems to be slower", part.name));
            again.rows.retain(|row| row.part != part.name);
            // Whatever made the machine slow may be over by then.
            std::thread::sleep(CALM);
            again.rows.extend(measured_apart(part, effort)?);
        }
        compare::confirm(&mut changes, &compare::changes(&old, &again));
    }
    for change in &changes {
        print(&change.to_string())?;
    }
    let (common, worse) = (compare::common(&old, &report), changes.len());
    note(format_args!("figures that are worse: {worse}, of {common} rows that the report of {} has, too", old.date));
    Ok(if changes.is_empty() { 0 } else { FOUND })
}

/// The parts whose figures are written already.
#[derive(Clone, Default)]
struct Kept(Arc<Mutex<Vec<&'static str>>>);

impl Kept {
    /// Of a report that is written to a folder: when the command is interrupted, it says what stands there and ends.
    fn told_when_interrupted(folder: &Path) -> Kept {
        let kept = Kept::default();
        let (told, folder) = (kept.clone(), folder.to_owned());
        on_interrupt(move || note(told.in_words(&folder)));
        kept
    }

    fn add(&self, part: &'static str) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(part);
    }

    fn in_words(&self, folder: &Path) -> String {
        let parts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = folder.display();
        if parts.is_empty() {
            return format!("interrupted before the first part was measured: nothing new stands in {folder}");
        }
        format!(
            "interrupted: what is measured is kept in {folder}: {} (index.html, report.json, CSV files)",
            parts.join(", ")
        )
    }
}

/// Ends the process on an interrupt, after a last word. Where the system has no such signal an interrupt ends it without a word.
fn on_interrupt(last_word: impl FnOnce() + Send + 'static) {
    #[cfg(unix)]
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([signal_hook::consts::SIGINT]) {
        std::thread::spawn(move || {
            if signals.forever().next().is_some() {
                last_word();
                std::process::exit(INTERRUPTED);
            }
        });
    }
    #[cfg(not(unix))]
    drop(last_word);
}

/// Whether an old report has any of the parts that are to be measured.
fn comparable(old: &Report, path: &Path, parts: &[&Part]) -> Result<(), Failure> {
    if parts.iter().any(|part| old.parts.iter().any(|name| name == part.name)) {
        return Ok(());
    }
    let its = if old.parts.is_empty() { "no part".to_owned() } else { old.parts.join(", ") };
    let names: Vec<&str> = parts.iter().map(|part| part.name).collect();
    let failure = Failure::input("the old report has nothing to compare").at(path);
    Err(failure
        .because(format_args!("it holds {its}; measured would be {}", names.join(", ")))
        .try_to("--only a part that both have"))
}

/// The rows of a part as another process measures them: its code, stack and data lie elsewhere in memory, which changes some
/// times more than anything that one process sees.
fn measured_apart(part: &Part, effort: Effort) -> Result<Vec<Row>, Failure> {
    let failed =
        |why: &dyn std::fmt::Display| Failure::input(format!("{} could not be measured again", part.name)).because(why);
    let folder = std::env::temp_dir().join(format!("halfvector-report-again-{}", std::process::id()));
    let mut command = Command::new(std::env::current_exe().map_err(|error| failed(&error))?);
    command.args(["report", "--only", part.name, "-o"]).arg(&folder);
    if effort == Effort::Quick {
        command.arg("--quick");
    }
    let output = command.stdin(Stdio::null()).output().map_err(|error| failed(&error))?;
    let text = std::fs::read_to_string(folder.join("report.json"));
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    if !output.status.success() {
        return Err(failed(&String::from_utf8_lossy(&output.stderr)));
    }
    let report = Report::from_json(&text.map_err(|error| failed(&error))?).map_err(|error| failed(&error))?;
    Ok(report.rows)
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
    let text = std::fs::read_to_string(path).map_err(|error| wrong(&error))?;
    Report::from_json(&text).map_err(|error| wrong(&error))
}
