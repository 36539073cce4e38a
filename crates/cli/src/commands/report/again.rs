//! What seems to be slower is measured again, by other processes, before it is told: with progress, and within a bound.

use std::fs::File;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use halfvector_report::compare::{self, Change};
use halfvector_report::{Effort, Part, Report, Row};

use super::in_words;
use super::kept::{INTERRUPTED, Kept, again_folder};
use crate::failure::Failure;
use crate::output::{note, progress};

/// How often what seems to be slower is measured again before it is told.
const CONFIRMATIONS: usize = 5;

/// Before it is measured again: whatever made the machine slow may be over by then.
const CALM: Duration = Duration::from_secs(2);

/// How often it is looked whether another process has ended.
const TICK: Duration = Duration::from_millis(50);

/// How long measuring again may take in all [s]: after it was done once it is not begun again where that would take longer.
fn longest(effort: Effort) -> f64 {
    match effort {
        Effort::Quick => 120.0,
        Effort::Full => 600.0,
    }
}

/// Measures again the parts in which something seems to be slower, and leaves the changes that are found again. `parts` are those of this
/// run, and how long each took [s].
pub(super) fn confirm(
    slower: &mut Vec<Change>,
    old: &Report,
    report: &Report,
    parts: &[(&Part, f64)],
    kept: &Kept,
) -> Result<(), Failure> {
    let (start, bound) = (Instant::now(), longest(report.effort));
    for round in 1..=CONFIRMATIONS {
        let doubtful = compare::doubtful(slower, report);
        let own: Vec<(&Part, f64)> = parts.iter().copied().filter(|(part, _)| doubtful.contains(part.name)).collect();
        if own.is_empty() {
            break;
        }
        let each: f64 = own.iter().map(|(_, seconds)| seconds + CALM.as_secs_f64()).sum();
        if round > 1 && start.elapsed().as_secs_f64() + each > bound {
            note(format_args!(
                "measured again no more: after {} another time would take longer than {} in all",
                in_words(start.elapsed().as_secs_f64()),
                in_words(bound)
            ));
            break;
        }
        let names: Vec<&str> = own.iter().map(|(part, _)| part.name).collect();
        note(format_args!(
            "{}: measured again, for something seems to be slower ({round} of at most {CONFIRMATIONS} times, about {} each, at most {} more)",
            names.join(", "),
            in_words(each),
            in_words(most(each, round, bound, start.elapsed().as_secs_f64()))
        ));
        let mut again = report.clone();
        let begun = Instant::now();
        for &(part, seconds) in &own {
            again.rows.retain(|row| row.part != part.name);
            let bar = progress(part.name);
            let before = begun.elapsed().as_secs_f64();
            let rows = measured_apart(part, report.effort, kept, || {
                let spent = begun.elapsed().as_secs_f64();
                let share = ((spent - before) / (seconds + CALM.as_secs_f64()).max(0.1)).min(0.99);
                bar.set_position((1000.0 * share) as u64);
                bar.set_message(format!(
                    "{} again, {round} of at most {CONFIRMATIONS}, about {} left",
                    part.name,
                    in_words((each - spent).max(1.0))
                ));
            });
            bar.finish_and_clear();
            again.rows.extend(rows?);
        }
        compare::confirm(slower, &compare::changes(old, &again), &again);
    }
    Ok(())
}

/// How long it may still take: as often as it may be done again, but for the bound.
fn most(each: f64, round: usize, bound: f64, spent: f64) -> f64 {
    (each * (CONFIRMATIONS + 1 - round) as f64).min((bound - spent).max(each))
}

/// The rows of a part as another process measures them: its code, stack and data lie elsewhere in memory, which changes some
/// times more than anything that one process sees. `waiting` is called now and then.
fn measured_apart(part: &Part, effort: Effort, kept: &Kept, waiting: impl Fn()) -> Result<Vec<Row>, Failure> {
    let failed =
        |why: &dyn std::fmt::Display| Failure::input(format!("{} could not be measured again", part.name)).because(why);
    let calm = Instant::now();
    while calm.elapsed() < CALM {
        waiting();
        std::thread::sleep(TICK);
    }
    let folder = again_folder();
    std::fs::create_dir_all(&folder).map_err(|error| failed(&error))?;
    let said = folder.join("said.txt");
    let errors = File::create(&said).map_err(|error| failed(&error))?;
    let mut command = Command::new(std::env::current_exe().map_err(|error| failed(&error))?);
    command.args(["report", "--only", part.name, "-o"]).arg(&folder);
    if effort == Effort::Quick {
        command.arg("--quick");
    }
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(errors);
    // The process is where an interrupt finds and ends it.
    kept.start(&mut command).map_err(|error| failed(&error))?;
    let status = loop {
        waiting();
        match kept.ended() {
            Ok(Some(status)) => break status,
            Ok(None) => std::thread::sleep(TICK),
            Err(error) => return Err(failed(&error)),
        }
    };
    if status.code().is_some_and(|code| INTERRUPTED.contains(&code)) {
        // Whoever interrupted it interrupted this process, too, which is about to say so and end.
        std::thread::sleep(CALM);
    }
    let text = std::fs::read_to_string(folder.join("report.json"));
    let said = std::fs::read_to_string(said).unwrap_or_default();
    // What is left of a temporary folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    if !status.success() {
        return Err(failed(&said));
    }
    let report = Report::from_json(&text.map_err(|error| failed(&error))?).map_err(|error| failed(&error))?;
    Ok(report.rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_bounded() {
        assert_eq!(most(10.0, 1, 120.0, 0.0), 50.0);
        assert_eq!(most(10.0, 5, 120.0, 40.0), 10.0);
        assert_eq!(most(50.0, 1, 120.0, 0.0), 120.0);
        assert_eq!(most(500.0, 1, 120.0, 0.0), 500.0, "once it is done in any case");
    }
}
