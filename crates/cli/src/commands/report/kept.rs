//! The report's folder: what is measured is written there as soon as it is finished, and an interrupt says what stands there.

use std::collections::HashSet;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use halfvector_report::missing::LeftOut;
use halfvector_report::{Effort, PARTS, Part, Report, Row, SoFar, page, write};

use crate::failure::Failure;
use crate::output::{check_place, note, write_file};

/// What a shell adds to the number of the signal that ended a command.
const ENDED_BY: i32 = 128;
/// The exit code of a command that the interrupt key or a request to end ended.
pub(super) const INTERRUPTED: [i32; 2] = [ENDED_BY + 2, ENDED_BY + 15];

/// A report on its way.
#[derive(Clone)]
pub(super) struct Kept {
    folder: PathBuf,
    report: Arc<Mutex<Report>>,
    /// A process that measures a part again.
    other: Arc<Mutex<Option<Child>>>,
}

/// Where another process writes what it measures again.
pub(super) fn again_folder() -> PathBuf {
    std::env::temp_dir().join(format!("halfvector-report-again-{}", std::process::id()))
}

impl Kept {
    /// Of a folder; when the command is interrupted, it says what stands there and ends.
    pub(super) fn begun(folder: &Path, effort: Effort) -> Kept {
        let report = Arc::new(Mutex::new(Report::begun(effort)));
        let kept = Kept { folder: folder.to_owned(), report, other: Arc::default() };
        let told = kept.clone();
        on_interrupt(move |signal| {
            // Held to the end: no file is half written.
            let report = told.locked();
            let _none_starts = told.end_other();
            for left in report.left_out.iter().filter(|left| !report.parts.contains(&left.part)) {
                note(format_args!("not measured: {left}"));
            }
            note(in_words(&report, &told.folder));
            std::process::exit(ENDED_BY + signal);
        });
        kept
    }

    fn locked(&self) -> MutexGuard<'_, Report> {
        self.report.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tries whether every file of the report can be written, before anything is measured: a file that is there is replaced by
    /// itself.
    pub(super) fn try_out(&self, parts: &[&Part]) -> Result<(), Failure> {
        let files = ["report.json", "index.html"].map(|name| self.folder.join(name));
        for path in files.into_iter().chain(parts.iter().map(|part| self.csv(part.name))) {
            check_place(&path)?;
            // What is no file may have no end, and is not to be replaced by one.
            if path.exists() && !path.is_file() {
                let failure = Failure::input("the report cannot be written there").at(&path);
                return Err(failure.because("it is no regular file").try_to("another folder for --output"));
            }
            match std::fs::read(&path) {
                Ok(known) => write_file(&path, &known)?,
                Err(_) => {
                    write_file(&path, b"")?;
                    // Where it stays it is written over soon.
                    let _ = std::fs::remove_file(&path);
                }
            }
        }
        Ok(())
    }

    /// Writes the rows of a part that are finished so far, and what it left out, where there is more of either. What cannot be written
    /// now cannot be at the part's end, and is told then.
    pub(super) fn part_so_far(&self, part: &str, so_far: SoFar<'_>) {
        let mut report = self.locked();
        let known = report.left_out.iter().filter(|left| left.part == part).count();
        if so_far.rows.is_empty() && so_far.left_out.len() == known {
            return;
        }
        if !so_far.rows.is_empty() {
            report.take(part, so_far.rows.to_vec());
        }
        report.leave_out(part, so_far.left_out.to_vec());
        let _ = self.write(&report, part);
    }

    /// Starts a process that an interrupt ends, too.
    pub(super) fn start(&self, command: &mut Command) -> std::io::Result<()> {
        let mut other = self.other.lock().unwrap_or_else(PoisonError::into_inner);
        *other = Some(command.spawn()?);
        Ok(())
    }

    /// How the process ended; none while it runs.
    pub(super) fn ended(&self) -> std::io::Result<Option<ExitStatus>> {
        let mut other = self.other.lock().unwrap_or_else(PoisonError::into_inner);
        match other.as_mut() {
            Some(child) => child.try_wait(),
            None => Ok(None),
        }
    }

    /// Ends the process, where one runs, and takes away what it wrote. While the guard lives no other one starts.
    fn end_other(&self) -> MutexGuard<'_, Option<Child>> {
        let mut other = self.other.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(mut child) = other.take() {
            // One that has ended by itself cannot be ended.
            let _ = child.kill();
            let _ = child.wait();
        }
        let _ = std::fs::remove_dir_all(again_folder());
        other
    }

    /// Writes a part that is measured to its end, and what of it is not.
    pub(super) fn part(&self, part: &str, rows: Vec<Row>, left_out: Vec<LeftOut>) -> Result<(), Failure> {
        let mut report = self.locked();
        report.take(part, rows);
        report.leave_out(part, left_out);
        report.parts.push(part.to_owned());
        self.write(&report, part)
    }

    /// The report as it is.
    pub(super) fn report(&self) -> Report {
        self.locked().clone()
    }

    fn write(&self, report: &Report, part: &str) -> Result<(), Failure> {
        self.clear(report);
        write_file(&self.csv(part), write::csv(&report.rows_of(part)).as_bytes())?;
        write_file(&self.folder.join("report.json"), report.to_json().as_bytes())?;
        write_file(&self.folder.join("index.html"), page::html(report).as_bytes())
    }

    fn csv(&self, part: &str) -> PathBuf {
        self.folder.join(format!("{part}.csv"))
    }

    /// Takes out the CSV files of parts that this report has not: those that a report wrote, by their names and their first line.
    fn clear(&self, report: &Report) {
        let own: HashSet<&str> = report.rows.iter().map(|row| row.part.as_str()).collect();
        for part in PARTS.iter().filter(|part| !own.contains(part.name)) {
            let path = self.csv(part.name);
            let mut first = String::new();
            let is_read =
                std::fs::File::open(&path).is_ok_and(|file| BufReader::new(file).read_line(&mut first).is_ok());
            if is_read && write::is_csv_head(&first) {
                // One that cannot be removed stays, as a file of an older report.
                let _ = std::fs::remove_file(path);
            }
        }
    }
}

fn in_words(report: &Report, folder: &Path) -> String {
    let folder = folder.display();
    let begun = report.rows.iter().map(|row| row.part.as_str()).rfind(|part| !report.parts.iter().any(|p| p == part));
    let mut parts = report.parts.clone();
    parts.extend(begun.map(|part| format!("{} rows of {part}", report.rows_of(part).len())));
    if parts.is_empty() {
        return format!("interrupted before the first row was measured: nothing new stands in {folder}");
    }
    format!(
        "interrupted: what is measured is kept in {folder}: {} (index.html, report.json, CSV files)",
        parts.join(", ")
    )
}

/// Ends the process on an interrupt or a request to end, after a last word. Where the system has no such signals it ends without one.
fn on_interrupt(last_word: impl FnOnce(i32) + Send + 'static) {
    #[cfg(unix)]
    if let Ok(mut signals) =
        signal_hook::iterator::Signals::new([signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM])
    {
        std::thread::spawn(move || {
            if let Some(signal) = signals.forever().next() {
                last_word(signal);
            }
        });
    }
    #[cfg(not(unix))]
    drop(last_word);
}
