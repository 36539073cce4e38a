//! What the project says of its accuracy is what was measured. `HALFVECTOR_BLESS=1` writes it anew.
//!
//! `docs/accuracy.json` is a run of `halfvector report`; the page, the plots, the README's passage and the table of methods
//! are made of it. `crates/report/data/errors.csv` is the baseline of errors: they come out the same on every run.

use std::collections::HashMap;

use halfvector_report::comparison::comparisons;
use halfvector_report::part::{ibl, pictures, shaders::counted_rows};
use halfvector_report::publish::{README_MARKS, RUN, files, readme};
use halfvector_report::unit::Budget;
use halfvector_report::{Effort, PARTS, Part, Report, Row, Run, words};

use crate::support::{bless, root};

const BASELINE: &str = "crates/report/data/errors.csv";

/// Errors may differ by this part, for the elementary functions of another system, or by this much.
const PART: f64 = 0.05;
const FLOOR: f64 = 1e-9;

/// Instructions may differ by this part before they are to be counted anew.
const INSTRUCTIONS: f64 = 0.1;

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn write(path: &str, text: &str) {
    std::fs::write(root().join(path), text).unwrap_or_else(|error| panic!("{path}: {error}"));
}

/// Instructions are counted and not measured: they are renewed without another run.
fn committed_run() -> Report {
    let mut report = Report::from_json(&read(RUN)).expect("a report");
    let known = |row: &Row, counted: &Row| row.term == counted.term && row.method == counted.method;
    let counted = counted_rows();
    for row in &mut report.rows {
        let name = row.method.split(',').next().unwrap_or_default();
        let now = counted.iter().find(|counted| counted.term == row.term && counted.method == name);
        let (Some(now), Some(before)) = (now.and_then(|now| now.instructions), row.instructions) else { continue };
        if bless() {
            row.instructions = Some(now);
            continue;
        }
        let change = (now as f64 / before as f64 - 1.0).abs();
        assert!(
            change <= INSTRUCTIONS,
            "{} {}: {now} instructions, {RUN} says {before}; HALFVECTOR_BLESS=1 counts them anew",
            row.term,
            row.method
        );
    }
    let missing = counted.iter().find(|counted| !report.rows.iter().any(|row| known(row, counted)));
    assert!(missing.is_none(), "{RUN} has no row of {missing:?}; it says how to renew it in docs/accuracy.md");
    if bless() {
        write(RUN, &report.to_json());
    }
    report
}

#[test]
fn pages_and_tables_are_made_of_the_committed_run() {
    let report = committed_run();
    for (path, text) in files(&report) {
        if bless() {
            write(&path, &text);
        }
        assert!(read(&path) == text, "{path} differs from {RUN}; HALFVECTOR_BLESS=1 writes it anew");
    }
    let page = read("README.md");
    let [begin, end] = README_MARKS.map(|mark| page.find(mark).unwrap_or_else(|| panic!("README.md: no {mark:?}")));
    let begin = begin + README_MARKS[0].len();
    if bless() {
        write("README.md", &format!("{}{}{}", &page[..begin], readme(&report), &page[end..]));
        return;
    }
    assert!(page[begin..end] == readme(&report), "README.md differs from {RUN}; HALFVECTOR_BLESS=1 writes it anew");
}

/// What is said of the library's own methods is true in both figures, for every term of the committed run.
#[test]
fn what_is_told_of_the_library_is_better() {
    let report = Report::from_json(&read(RUN)).expect("a report");
    let page = halfvector_report::page::html(&report);
    let mut told = 0;
    for comparison in comparisons(&report.rows) {
        for budget in Budget::ALL {
            let choice = comparison.recommended(budget);
            let Some(other) = choice.of_library else { continue };
            told += 1;
            let said =
                format!("{} {}: {} for {}", comparison.term, budget.name(), other.row.method, choice.entry.row.method);
            assert!(other.rms < choice.entry.rms, "{said}");
            let keeps_alone = comparison.keeps(other, budget) && !choice.keeps;
            assert!(other.cost <= choice.entry.cost || budget == Budget::Film || keeps_alone, "{said}");
            // The sentence has both figures of both.
            let remark = words::of_library(&comparison, &choice).expect("a remark");
            for entry in [other, choice.entry] {
                assert!(remark.contains(&words::error(entry.rms, comparison.unit)), "{said}: {remark}");
                assert!(remark.contains(&words::cost(entry.cost, comparison.cost)), "{said}: {remark}");
            }
            assert!(page.contains(&remark), "{said}: {remark}");
        }
    }
    println!("{told} remarks");
    assert!(told > 0);
}

/// Examples whose pictures are drawn here: a plain material, and a scene with lamps.
const PICTURES: [&str; 2] = ["plain-dielectric.material.json", "report-3-rough-metal.scene.json"];

/// Every row whose errors come quickly: whole parts, light under one of the two environments, and some pictures. Shaders are
/// counted by the other test; peers are other programs'.
fn rows_of_today() -> Vec<Row> {
    let whole = |part: &&Part| !["ibl", "peers", "pictures", "shaders"].contains(&part.name);
    let mut rows: Vec<Row> = PARTS.iter().filter(whole).flat_map(|part| part.measured(Effort::Quick)).collect();
    let run = Run::alone(Effort::Quick);
    rows.extend(ibl::rows_under_sky(&run));
    rows.extend(pictures::rows_of(&PICTURES.map(|name| root().join("examples").join(name)), &run));
    rows
}

/// The rms and the largest error, what hides them, and FLIP.
fn errors(row: &Row) -> [Option<f64>; 4] {
    [row.error_rms, row.error_max, row.error_bound, row.flip]
}

fn is_same(now: f64, before: f64) -> bool {
    now == before || (now - before).abs() <= PART * before.abs() + FLOOR
}

#[test]
fn errors_are_those_of_the_baseline_and_of_the_committed_run() {
    let rows = rows_of_today();
    // What a device computes is its own.
    let own: Vec<&Row> = rows.iter().filter(|row| row.gpu.is_none()).collect();
    if bless() {
        write(BASELINE, &baseline(&own));
    }
    let found: HashMap<String, &Row> = own.iter().map(|row| (name(row), *row)).collect();
    for line in read(BASELINE).lines().skip(1) {
        let (figures, name) = line
            .split_once(',')
            .and_then(|(rms, rest)| {
                let (max, name) = rest.split_once(',')?;
                Some(([rms, max].map(|x| x.parse::<f64>().unwrap_or(f64::INFINITY)), name))
            })
            .unwrap_or_else(|| panic!("{BASELINE}: {line:?}"));
        let row =
            found.get(name).unwrap_or_else(|| panic!("{name} has no row any more; HALFVECTOR_BLESS=1 takes it out"));
        let now = [row.error_rms, row.error_max].map(|x| x.unwrap_or(f64::INFINITY));
        for (what, (now, before)) in ["rms", "largest"].into_iter().zip(now.into_iter().zip(figures)) {
            let same = is_same(now, before);
            assert!(same, "{name}: the {what} error is {now:e}, was {before:e}; HALFVECTOR_BLESS=1 takes it as it is");
        }
    }
    for row in &rows {
        let failure = row.first_failure.as_ref().and_then(|text| text.split_once(": ").map(|(at, _)| at.to_owned()));
        for at in [row.at.clone(), failure].into_iter().flatten() {
            assert!(are_named(&at), "{}: the input is {at:?}, without names", name(row));
        }
    }
    held_against_committed_run(&rows);
}

/// Whether a text is names and values, `n.v = 0.02, f0 = [0.04, 0.04, 0.04]`, split by commas outside of brackets.
fn are_named(at: &str) -> bool {
    let mut depth = 0;
    let outside = |c: char| {
        depth += i32::from(c == '[') - i32::from(c == ']');
        c == ',' && depth == 0
    };
    let mut parts = at.split(outside).map(str::trim);
    parts.all(|part| part.split_once(" = ").is_some_and(|(name, value)| !name.is_empty() && !value.is_empty()))
}

/// What the published figures say of errors is what the code does, on devices too where it is the same one.
fn held_against_committed_run(rows: &[Row]) {
    let committed = Report::from_json(&read(RUN)).expect("a report");
    if committed.effort != Effort::Quick {
        println!("skipped: {RUN} is of a full run, which drew other points");
        return;
    }
    let known: HashMap<String, &Row> = committed.rows.iter().map(|row| (name(row), row)).collect();
    let is_drawn = |row: &Row| row.gpu.is_some();
    for row in rows {
        let name = name(row);
        let before = known.get(&name);
        if is_drawn(row) && before.is_none_or(|before| before.gpu != row.gpu) {
            continue;
        }
        let before = before.unwrap_or_else(|| panic!("{RUN} has no row {name}; docs/accuracy.md says how to renew it"));
        for (now, then) in errors(row).into_iter().zip(errors(before)) {
            // What is infinite is null in the file.
            let [now, then] = [now, then].map(|x| x.unwrap_or(f64::INFINITY));
            let same = is_same(now, then);
            assert!(same, "{name}: {now:e}, {RUN} says {then:e}; docs/accuracy.md says how to renew it");
        }
    }
}

fn name(row: &Row) -> String {
    format!("{} {}: {}", row.term, row.method, row.domain)
}

fn baseline(rows: &[&Row]) -> String {
    let mut lines: Vec<String> = rows
        .iter()
        .filter(|row| row.error_rms.is_some())
        .map(|row| {
            let [rms, max] = [row.error_rms, row.error_max].map(|x| x.map_or(String::new(), |x| format!("{x:.6e}")));
            format!("{rms},{max},{}", name(row))
        })
        .collect();
    lines.sort_by(|a, b| a.splitn(3, ',').nth(2).cmp(&b.splitn(3, ',').nth(2)));
    format!("error_rms,error_max,row\n{}\n", lines.join("\n"))
}
