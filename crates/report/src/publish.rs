//! What the project shows of one committed run: `docs/accuracy.md`, two plots, the passage of the README, and the table of
//! methods that `halfvector methods` prints.

use std::fmt::Write;

use halfvector_graph::method::TERMS;

use crate::comparison::{Comparison, Entry, comparisons};
use crate::cost::Cost;
use crate::plot::{alone, scatter};
use crate::unit::{Budget, Unit};
use crate::{Effort, Report, Row, words};

/// Where the run stands that everything here is made of.
pub const RUN: &str = "docs/accuracy.json";

/// Terms whose first plot is shown in the README.
const SHOWN: [&str; 2] = ["v", "level_map"];

/// Where the README's passage begins and ends.
pub const README_MARKS: [&str; 2] =
    ["<!-- figures of docs/accuracy.json, written by a test -->\n", "<!-- end of figures -->\n"];

/// The files, by their places in the project.
pub fn files(report: &Report) -> Vec<(String, String)> {
    let comparisons = comparisons(&report.rows);
    let mut files = vec![
        ("docs/accuracy.md".to_owned(), page(report, &comparisons)),
        ("crates/graph/data/methods.csv".to_owned(), methods_csv(&comparisons, &report.rows)),
    ];
    files.extend(shown(&comparisons).map(|comparison| (picture(comparison.term), alone(&scatter(comparison)))));
    files
}

fn picture(term: &str) -> String {
    format!("docs/images/speed-against-error-{}.svg", term.replace('_', "-"))
}

fn shown<'a, 'r>(comparisons: &'a [Comparison<'r>]) -> impl Iterator<Item = &'a Comparison<'r>> {
    SHOWN.iter().filter_map(|term| comparisons.iter().find(|comparison| comparison.term == *term))
}

/// The passage of the README between its marks.
pub fn readme(report: &Report) -> String {
    let mut text = String::new();
    for comparison in shown(&comparisons(&report.rows)) {
        let (finding, help) = (words::finding(comparison), crate::terms::help(comparison.term));
        let picture = picture(comparison.term);
        let _ = write!(
            text,
            "**`{}`, {help}:** {finding}.\n\n![{}]({picture})\n\n",
            comparison.term,
            finding.replace('`', "")
        );
    }
    let _ = write!(
        text,
        "Down and to the left is better; blue methods are beaten by no other. {}, {}.\nEvery term, and what to choose on a phone, \
         a desktop or for film: [`docs/accuracy.md`](docs/accuracy.md).\n",
        report.machine, report.date
    );
    text
}

fn page(report: &Report, comparisons: &[Comparison<'_>]) -> String {
    let mut page = format!(
        "# Accuracy and speed\n\nWhat each approximation of Halfvector costs, and how wrong it is: errors against truth in double \
         precision, times as medians of interleaved runs, to be read as ratios. Measured on {}, {}, {}.\n\nThis page is made of \
         [`accuracy.json`](accuracy.json). To renew both:\n\n```sh\ncargo run --release -- report{} -o out/report\ncp \
         out/report/report.json docs/accuracy.json\nHALFVECTOR_BLESS=1 cargo test --workspace --test all -- accuracy\n```\n\n\
         `out/report/index.html` is the same with plots, inputs and where each error is largest.\n\n## What to choose\n\nEach \
         budget takes the cheapest of the methods that err little enough.\n\n* Little enough is an rms error of at most {} for **mobile** and {} \
         for **desktop**; for **film** it is what is within 5 % of the least error. Where no method errs as little, the one for film stands there, \
         marked *over the limit*.\n* Cheapest is by the time on the device{}, where every method has one, and then by the instructions of the \
         same shaders; else by the cost in the tables below. Times on one machine change from run to run: those that differ by less than 50 %, \
         or by less than their spreads, are alike, as are instructions that differ by less than 5 %. For mobile memory comes first, where it is \
         known of all: of those that take up to half as long again as the cheapest, the one that reads the least.\n* Of methods that are alike \
         in all this it is the most accurate, and of equals that which `halfvector methods` lists first.\n\nOnly what `--method` knows is \
         recommended. Where the library alone has a method that errs less it stands behind, with what it costs: where that is no \
         more, or only it keeps the limit, and for film at any cost.\n\n\
         | term | inputs | mobile | desktop | film |\n|---|---|---|---|---|\n",
        report.machine,
        report.date,
        report.effort.words(),
        match report.effort {
            Effort::Quick => " --quick",
            Effort::Full => "",
        },
        words::limits(Budget::Mobile),
        words::limits(Budget::Desktop),
        comparisons
            .iter()
            .flat_map(|comparison| &comparison.entries)
            .find_map(|entry| entry.row.gpu.as_deref())
            .map_or(String::new(), |name| format!(" ({name})")),
    );
    for comparison in comparisons {
        let chosen = Budget::ALL.map(|budget| {
            let choice = comparison.recommended(budget);
            let said = |entry: &Entry<'_>| {
                let rms = words::error_beside(entry.rms, comparison.unit, comparison.unit.limit(budget));
                format!("`{}` {rms}", cell(&entry.row.method))
            };
            let text = said(choice.entry);
            let text = if choice.keeps { text } else { format!("{text}, *over the limit*") };
            let text = if choice.library_only { format!("{text}, library only") } else { text };
            match words::of_library(comparison, &choice) {
                Some(remark) => format!("{text}; {}", cell(&remark)),
                None => text,
            }
        });
        let inputs = words::inputs(&comparison.domains);
        let _ = writeln!(page, "| `{}` | {} | {} |", comparison.term, cell(&inputs), chosen.join(" | "));
    }
    for comparison in comparisons {
        let _ = write!(
            page,
            "\n## {}: {}\n\n{}. {}. {}{}\n\n| method | rms error | largest error | {} | beside the cheapest | unbeaten |\n\
             |---|---|---|---|---|---|\n",
            comparison.term,
            words::finding(comparison),
            words::inputs(&comparison.domains),
            words::against(comparison.domains[0]),
            comparison.how(),
            words::points(&comparison.entries.iter().map(|entry| entry.largest).collect::<Vec<_>>()),
            match comparison.cost {
                Cost::Bytes => "memory",
                Cost::Instructions => "instructions",
                Cost::Batch | Cost::Call | Cost::Device => "time",
            },
        );
        let cheapest = comparison.entries.iter().map(|entry| entry.cost).fold(f64::INFINITY, f64::min);
        for entry in &comparison.entries {
            let error = |x: Option<f64>| x.map_or(String::new(), |x| words::error(x, comparison.unit));
            let mark = if entry.largest.is_of_list() { " †" } else { "" };
            let _ = writeln!(
                page,
                "| `{}` | {} | {}{mark} | {} | {:.1} | {} |",
                cell(&entry.row.method),
                error(Some(entry.rms)),
                error(entry.largest.error_max),
                words::cost(entry.cost, comparison.cost),
                entry.cost / cheapest.max(f64::MIN_POSITIVE),
                if entry.front { "yes" } else { "" }
            );
        }
        if comparison.entries.iter().any(|entry| entry.largest.is_of_list()) {
            let _ = writeln!(page, "\n† {}", words::NOT_SEARCHED);
        }
    }
    precision(report, &mut page);
    page
}

/// Forms that give what is no number in some format.
fn precision(report: &Report, page: &mut String) {
    let rows: Vec<&Row> = report.rows.iter().filter(|row| row.term == "precision" && row.error_max.is_some()).collect();
    if rows.is_empty() {
        return;
    }
    let device = rows
        .iter()
        .find_map(|row| row.gpu.as_deref())
        .map_or(String::new(), |name| format!(", and where the name says `device` by the WGSL on {}", cell(name)));
    let _ = write!(
        page,
        "\n## precision: {}\n\nHard cases: cosines from 1e-6, roughness from 0.0001; on the CPU, f16 with each operation \
         rounded{device}. The error is in units in the last place of the format; `lost` counts results that are NaN or infinite \
         although the format holds the right one.\n\n| form and format | rms [ulp] | largest [ulp] | at | lost | first lost \
         |\n|---|---|---|---|---|---|\n",
        words::precision(&rows)
    );
    for row in rows.iter().filter(|row| !row.method.contains(" f64")) {
        let number = |x: Option<f64>| x.map_or(String::new(), words::number);
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {} | {} | {} |",
            row.method,
            number(row.error_rms),
            number(row.error_max),
            cell(&words::shortened(row.at.as_deref().unwrap_or(""))),
            row.not_finite.unwrap_or(0),
            cell(&words::shortened(row.first_failure.as_deref().unwrap_or("")))
        );
    }
}

/// Text in a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// Whether a row is of a method: by its name, or by its name with a variant after a comma (`unorm, 16 bits`).
fn is_named(row: &Row, method: &str) -> bool {
    row.method == method || row.method.split(',').next() == Some(method)
}

/// What is of a method: what has its name alone, before what has a variant of it.
fn named<'a, T>(all: &'a [T], row: impl Fn(&T) -> &Row, method: &str) -> Option<&'a T> {
    all.iter().find(|one| row(one).method == method).or_else(|| all.iter().find(|one| is_named(row(one), method)))
}

/// One line for each method of the list that was measured: its worst error, and its cost.
fn methods_csv(comparisons: &[Comparison<'_>], rows: &[Row]) -> String {
    let mut text =
        "term,method,error_rms,error_max,unit,time_beside_default,instructions,gpu_ns,bytes,inputs\n".to_owned();
    for term in TERMS {
        for method in term.methods {
            let found = comparisons
                .iter()
                .filter(|comparison| comparison.term == term.name)
                .find_map(|comparison| Some((comparison, named(&comparison.entries, |entry| entry.row, method.name)?)));
            let own = || rows.iter().filter(|row| row.term == term.name && is_named(row, method.name));
            let instructions = own().find_map(|row| row.instructions);
            if found.is_none() && instructions.is_none() {
                continue;
            }
            let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.3e}"));
            let beside = found.filter(|(comparison, _)| matches!(comparison.cost, Cost::Batch | Cost::Call)).and_then(
                |(comparison, entry)| {
                    let default = named(&comparison.entries, |entry| entry.row, term.methods[0].name)?;
                    Some(entry.cost / default.cost)
                },
            );
            let unit = found.map_or("", |(comparison, _)| match comparison.unit {
                Unit::Relative => "relative",
                Unit::Degrees => "degrees",
                Unit::Ulps => "ulp",
                Unit::Plain => "absolute",
            });
            let bytes = found.and_then(|(_, entry)| {
                own().filter(|row| row.method == entry.row.method).filter_map(|row| row.bytes).max()
            });
            let inputs = found.map_or(String::new(), |(comparison, _)| words::inputs(&comparison.domains));
            let _ = writeln!(
                text,
                "{},{},{},{},{unit},{},{},{},{},\"{}\"",
                term.name,
                method.name,
                number(found.map(|(_, entry)| entry.rms)),
                number(found.and_then(|(_, entry)| entry.largest.error_max)),
                beside.map_or(String::new(), |x| format!("{x:.2}")),
                instructions.map_or(String::new(), |x| x.to_string()),
                own().find_map(|row| row.gpu_ns).map_or(String::new(), |x| format!("{x:.1}")),
                bytes.map_or(String::new(), |x| x.to_string()),
                inputs.replace('"', "'")
            );
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was not searched for is marked, as on the report's own page, and the number of inputs stands there.
    #[test]
    fn largest_errors_of_lists_are_marked() {
        let of = |method: &str, searched| Row {
            error_max: Some(0.4),
            error_rms: Some(0.1),
            cost_ns: Some(1.0),
            points: Some(12),
            searched,
            ..Row::new("d", method, "all; relative")
        };
        let page = |searched| {
            let report = Report { rows: vec![of("a", searched), of("b", searched)], ..Report::begun(Effort::Quick) };
            files(&report).swap_remove(0).1
        };
        assert_eq!(page(false).matches("40 % †").count(), 2, "{}", page(false));
        assert!(page(false).contains("† the largest of the inputs") && page(false).contains("of 12 inputs"));
        assert!(!page(true).contains('†'), "{}", page(true));
    }

    #[test]
    fn a_method_s_own_row_comes_before_its_variants() {
        let rows = ["unorm, 16 bits", "unorm", "snorm, 16 bits"].map(|method| Row::new("normal_decode", method, ""));
        assert_eq!(named(&rows, |row| row, "unorm").map(|row| &*row.method), Some("unorm"));
        assert_eq!(named(&rows, |row| row, "snorm").map(|row| &*row.method), Some("snorm, 16 bits"));
        assert!(named(&rows, |row| row, "two_channel").is_none());
    }
}
