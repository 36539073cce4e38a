//! A report as one HTML page, light and dark, that needs nothing beside itself.

use std::fmt::Write;

use crate::comparison::{Comparison, Entry, comparisons};
use crate::cost::Cost;
use crate::part::shaders;
use crate::plot::{dark_rules, escaped, scatter};
use crate::unit::Unit;
use crate::{PARTS, Report, Row, terms, words};

mod choices;
mod how;
mod split_sum;
mod tables;

const STYLE: &str = include_str!("page/style.css");
const SORT: &str = include_str!("page/sort.js");

/// The page.
pub fn html(report: &Report) -> String {
    let comparisons = comparisons(&report.rows);
    let mut page = String::new();
    let chapters: Vec<(&str, String)> = terms_of(report)
        .into_iter()
        .map(|term| (term, chapter(term, report, &comparisons)))
        .filter(|(_, text)| !text.is_empty())
        .collect();
    let names: Vec<&str> = chapters.iter().map(|(term, _)| *term).collect();
    head(report, &comparisons, &names, &mut page);
    choices::choices(report, &comparisons, &mut page);
    for (term, text) in chapters {
        let _ = writeln!(
            page,
            "<h2 id=\"{0}\">{1} <code>{0}</code></h2>",
            escaped(term),
            escaped(&capital(terms::help(term)))
        );
        let explained = terms::explained(term);
        if !explained.is_empty() {
            let _ = writeln!(page, "<p class=\"about\">{}</p>", code(explained));
        }
        page.push_str(&text);
    }
    rounding(report, &mut page);
    how::foot(report, &mut page);
    page
}

/// Terms with more to show than what the arithmetic adds, in the order measured.
fn terms_of(report: &Report) -> Vec<&str> {
    let mut terms: Vec<&str> = Vec::new();
    for row in report.rows.iter().filter(|row| !row.is_rounding()) {
        if !terms.contains(&row.term.as_str()) {
            terms.push(&row.term);
        }
    }
    terms
}

fn head(report: &Report, comparisons: &[Comparison<'_>], chapters: &[&str], page: &mut String) {
    let effort = report.effort.words();
    let dark = dark_rules();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Halfvector: speed against error</title>\n<style>\n{STYLE}@media (prefers-color-scheme: dark) {{ {dark} }}\n\
         </style>\n</head>\n<body>\n<header>\n<h1>Speed against error</h1>\n\
         <p class=\"lead\">Every approximation of Halfvector, how wrong it is and what it costs: {}, each error against a truth in \
         double precision.</p>\n<ul class=\"facts\"><li>{}</li><li>{}</li><li>{effort}</li></ul>\n",
        counted(report),
        escaped(&report.machine),
        escaped(&report.date),
    );
    let is_whole = |name: &str| report.parts.iter().any(|part| part == name);
    let missing = PARTS.iter().filter(|part| !is_whole(part.name)).map(|part| match report.rows_of(part.name).len() {
        0 => part.name.to_owned(),
        rows => format!("{} (interrupted; {rows} rows so far)", part.name),
    });
    let missing: Vec<String> = missing.collect();
    if !missing.is_empty() {
        let _ = writeln!(page, "<p class=\"muted\">Not measured in this run: {}.</p>", missing.join(", "));
    }
    if !report.left_out.is_empty() {
        let left: Vec<String> = report.left_out.iter().map(|left| escaped(&left.to_string())).collect();
        let _ = writeln!(page, "<p class=\"muted\">Not measured: {}.</p>", left.join("; "));
    }
    page.push_str("<nav>");
    if !comparisons.is_empty() {
        page.push_str("<a href=\"#choose\">What to choose</a>");
    }
    for term in chapters {
        let _ = write!(page, "<a href=\"#{0}\">{0}</a>", escaped(term));
    }
    if report.rows.iter().any(Row::is_rounding) {
        page.push_str("<a href=\"#rounding\">rounding</a>");
    }
    page.push_str("<a href=\"#how\">how it is measured</a></nav>\n</header>\n<main>\n");
}

/// How many methods and cases there are, and which of them are of this run.
fn counted(report: &Report) -> String {
    let names: std::collections::HashSet<_> = report.rows.iter().map(|row| (&row.term, &row.method)).collect();
    let recorded = report.rows.iter().filter(|row| row.recorded.is_some()).count();
    let count = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut text = format!(
        "{} in {}, measured in this run",
        count(names.len(), "method"),
        count(report.rows.len() - recorded, "case")
    );
    if report.rows.iter().any(|row| !row.part.is_empty() && !report.parts.contains(&row.part)) {
        text.push_str(" until it was interrupted");
    }
    match recorded {
        0 => text,
        1 => text + " (one more, of another program, was recorded earlier, as its line says)",
        n => format!("{text} ({n} more, of other programs, were recorded earlier, as their lines say)"),
    }
}

/// What there is to show of a term, below its heading; empty when it is told elsewhere.
fn chapter(term: &str, report: &Report, comparisons: &[Comparison<'_>]) -> String {
    let mut page = String::new();
    for comparison in comparisons.iter().filter(|comparison| comparison.term == term) {
        figure(comparison, report, &mut page);
    }
    let drawn = |row: &Row| {
        comparisons.iter().any(|comparison| {
            comparison.term == row.term
                && comparison.domains.contains(&row.domain.as_str())
                && comparison.entries.iter().any(|entry| entry.row.method == row.method)
        })
    };
    let others: Vec<&Row> =
        report.rows.iter().filter(|row| row.term == term && !row.is_rounding() && !drawn(row)).collect();
    // What the shader of a method costs stands in the tables of its errors already.
    let told = |row: &&Row| report.rows.iter().any(|other| shaders::tells_of(other, row));
    // What is only there to be held against, and has nothing to tell.
    let is_truth = |row: &&Row| row.term == "precision" && row.error_max.is_none() && row.not_finite == Some(0);
    let others: Vec<&Row> = others.into_iter().filter(|row| !told(row) && !is_truth(row)).collect();
    // What a shader alone costs has no error, and what has one makes a table of its own.
    let (wrong, counted): (Vec<&Row>, Vec<&Row>) = others.into_iter().partition(|row| !is_count(row));
    let wrong = if term == "split_sum" { split_sum::figures(&wrong, &mut page) } else { wrong };
    for rows in [wrong, counted].iter().filter(|rows| !rows.is_empty()) {
        tables::section(rows, &mut page);
    }
    page
}

/// Whether a row only says what a shader costs.
fn is_count(row: &Row) -> bool {
    row.term != "peer"
        && row.instructions.is_some()
        && row.error_rms.is_none()
        && row.error_max.is_none()
        && row.cost_ns.is_none()
}

/// Text with names in backticks, as HTML.
fn code(text: &str) -> String {
    let parts: Vec<String> = escaped(text).split('`').map(str::to_owned).collect();
    parts
        .iter()
        .enumerate()
        .map(|(i, part)| if i % 2 == 1 { format!("<code>{part}</code>") } else { part.clone() })
        .collect()
}

/// With a capital, but for a symbol such as n.v.
fn capital(text: &str) -> String {
    if text.get(1..).is_some_and(|rest| rest.starts_with('.')) {
        return text.to_owned();
    }
    halfvector_graph::docs::capitalised(text)
}

fn figure(comparison: &Comparison<'_>, report: &Report, page: &mut String) {
    let is_drawn = |row: &&Row| row.term == comparison.term && comparison.domains.contains(&row.domain.as_str());
    let has_entry = |row: &&Row| comparison.entries.iter().any(|entry| entry.row.method == row.method);
    let cases: Vec<&Row> = report.rows.iter().filter(is_drawn).filter(has_entry).collect();
    let spread = comparison.entries.iter().filter_map(|entry| comparison.cost.spread(entry.row)).reduce(f64::max);
    let sure = match spread {
        Some(spread) if comparison.cost.is_time() => {
            format!(" The sitting in the middle took up to {} % longer.", words::number(100.0 * spread))
        }
        None => " There were too few runs to say how sure that is.".to_owned(),
        _ => String::new(),
    };
    let whiskers = if comparison.domains.len() > 1 {
        " Each dot stands at the method's worst inputs; its line goes down to the best ones."
    } else {
        ""
    };
    let against = capital(words::against(comparison.domains[0]));
    let full_stop = if against.is_empty() { "" } else { "." };
    let _ = write!(
        page,
        "<figure>\n<h3>{}</h3>\n<div class=\"scroll\">{}</div>\n<figcaption><p class=\"legend\"><span><i class=\"dot\"></i>unbeaten: nothing else is both cheaper \
         and at least as accurate</span><span><i class=\"dot beaten\"></i>beaten</span><span>★ the default</span></p>\
         <p><b>How:</b> {}. {}{full_stop}{} {}{sure} Down and to the left is better.{whiskers}</p></figcaption>\n",
        code(&words::finding(comparison)),
        scatter(comparison),
        escaped(&capital(&words::inputs(&comparison.domains))),
        escaped(&against),
        words::points(&cases),
        escaped(&comparison.how()),
    );
    table(comparison, page);
    if comparison.domains.len() > 2 {
        let _ = write!(page, "<details><summary>rms error in each of the {} cases</summary>", comparison.domains.len());
        tables::matrix(&cases, page);
        page.push_str("</details>\n");
    }
    page.push_str("</figure>\n");
}

/// A cell with a number: shown short, sorted by its whole value.
fn cell(value: Option<f64>, text: impl Fn(f64) -> String) -> String {
    match value {
        Some(x) => format!("<td class=\"n\" data-value=\"{x:e}\">{}</td>", escaped(&text(x))),
        None => "<td class=\"n\" data-value=\"\"></td>".to_owned(),
    }
}

/// The cell of a largest error; marked where it is of a list of inputs, and was not searched for.
fn largest(row: &Row, unit: Unit) -> String {
    let mark = if row.is_of_list() { " †" } else { "" };
    cell(row.error_max, |x| words::error(x, unit) + mark)
}

/// What the mark of [`largest`] says, where a table has it.
fn not_searched<'a>(mut rows: impl Iterator<Item = &'a Row>, page: &mut String) {
    if rows.any(Row::is_of_list) {
        let _ = writeln!(page, "<p class=\"small muted\">† {}</p>", words::NOT_SEARCHED);
    }
}

fn table(comparison: &Comparison<'_>, page: &mut String) {
    let has = |some: fn(&Row) -> bool| comparison.entries.iter().any(|entry| some(entry.row));
    let instructions = comparison.cost != Cost::Instructions && has(|row| row.instructions.is_some());
    let device = comparison.cost != Cost::Device && has(|row| row.gpu_ns.is_some());
    let bytes = comparison.cost != Cost::Bytes && has(|row| row.bytes.is_some());
    let cheapest = comparison.entries.iter().map(|entry| entry.cost).fold(f64::INFINITY, f64::min);
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th>method</th><th class=\"n\" aria-sort=\"ascending\">rms error</th>\
         <th class=\"n\">largest error</th>",
    );
    let _ = write!(page, "<th class=\"n\">{}</th><th class=\"n\">× cheapest</th>", short(comparison));
    for (there, name) in [(instructions, "instructions"), (device, "device pixel"), (bytes, "memory")] {
        if there {
            let _ = write!(page, "<th class=\"n\">{name}</th>");
        }
    }
    page.push_str("<th>largest at</th></tr></thead><tbody>\n");
    for entry in &comparison.entries {
        let row = entry.row;
        let error = |x| words::error(x, comparison.unit);
        let front = if entry.front { " class=\"front\"" } else { "" };
        let _ = write!(page, "<tr{front}><td>{}{}</td>", escaped(&row.method), tags(row));
        page.push_str(&cell(Some(entry.rms), error));
        page.push_str(&largest(entry.largest, comparison.unit));
        page.push_str(&cell(Some(entry.cost), |x| words::cost(x, comparison.cost)));
        page.push_str(&cell(Some(entry.cost / cheapest.max(f64::MIN_POSITIVE)), |x| format!("{x:.1}")));
        if instructions {
            page.push_str(&cell(row.instructions.map(|x| x as f64), |x| format!("{x:.0}")));
        }
        if device {
            page.push_str(&cell(row.gpu_ns, |x| words::cost(x, Cost::Call)));
        }
        if bytes {
            page.push_str(&cell(row.bytes.map(|x| x as f64), |x| words::cost(x, Cost::Bytes)));
        }
        let _ = writeln!(page, "<td class=\"small\">{}</td></tr>", escaped(&notes(entry)));
    }
    page.push_str("</tbody></table></div>\n");
    not_searched(comparison.entries.iter().map(|entry| entry.largest), page);
}

fn short(comparison: &Comparison<'_>) -> &'static str {
    match comparison.cost {
        Cost::Batch if comparison.term == "prefilter" => "a texel of a bake",
        Cost::Batch => "batch element",
        Cost::Call => "one call",
        Cost::Bytes => "memory",
        Cost::Device => "device pixel",
        Cost::Instructions => "instructions",
    }
}

/// Where the largest error is, and what else is to be known.
fn notes(entry: &Entry<'_>) -> String {
    let at = words::shortened(entry.largest.at.as_deref().unwrap_or(""));
    let notes = [at.as_str(), entry.row.note.as_deref().unwrap_or("")];
    notes.into_iter().filter(|note| !note.is_empty()).collect::<Vec<_>>().join("; ")
}

fn tags(row: &Row) -> String {
    let tag = |there: bool, text: &str| if there { text.to_owned() } else { String::new() };
    tag(terms::is_default(&row.term, &row.method), "<span class=\"tag\">default</span>")
        + &tag(
            terms::is_report(&row.term, &row.method),
            "<span class=\"tag plain\" title=\"the form of the report that this project began with\">the report's</span>",
        )
}

/// What f32 adds to each form.
fn rounding(report: &Report, page: &mut String) {
    let mut rows: Vec<&Row> = report.rows.iter().filter(|row| row.is_rounding()).collect();
    let rms = |row: &Row| row.error_rms.unwrap_or(f64::INFINITY);
    rows.sort_by(|a, b| rms(b).total_cmp(&rms(a)));
    let Some(worst) = rows.first() else { return };
    let _ = write!(
        page,
        "<h2 id=\"rounding\">Rounding</h2>\n<p class=\"muted\">What 32-bit arithmetic adds to each form, against the very same \
         form in 64 bits. This is no property of the model.</p>\n<section class=\"card\"><h3>No form loses more than {} rms \
         to 32-bit arithmetic; {} of <code>{}</code> loses most</h3>",
        words::error(rms(worst), Unit::Relative),
        escaped(&worst.method),
        escaped(&worst.term)
    );
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th>term</th><th>method</th>\
         <th class=\"n\" aria-sort=\"descending\">rms error</th><th class=\"n\">largest error</th><th class=\"n\">one call</th>\
         <th>inputs</th></tr></thead><tbody>\n",
    );
    for row in rows {
        let _ = write!(page, "<tr><td>{}</td><td>{}</td>", escaped(&row.term), escaped(&row.method));
        let error = |x| words::error(x, Unit::of(&row.domain));
        page.push_str(&cell(row.error_rms, error));
        page.push_str(&cell(row.error_max, error));
        page.push_str(&cell(row.cost_ns, |x| words::cost(x, Cost::Call)));
        let _ = writeln!(page, "<td class=\"small\">{}</td></tr>", escaped(words::inputs(&[&row.domain]).as_str()));
    }
    page.push_str("</tbody></table></div></section>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Effort;
    use crate::missing::LeftOut;

    #[test]
    fn what_is_left_out_is_named() {
        let mut report = Report::begun(Effort::Quick);
        assert!(!html(&report).contains("Not measured: "));
        let (part, what, why) = ("pictures".into(), Some("helmet.scene".into()), "no such file".into());
        report.left_out.push(LeftOut { part, what, why });
        assert!(html(&report).contains("Not measured: pictures: helmet.scene: no such file."));
    }

    /// The head says what is of this run, and what is only shown.
    #[test]
    fn what_was_recorded_is_not_called_measured() {
        let mut report = Report::begun(Effort::Quick);
        let of = |method: &str| Row { part: "peers".into(), ..Row::new("peer", method, "a bake; now") };
        report.rows = vec![of("ours"), Row { recorded: Some("2026-11-22, a machine".into()), ..of("theirs") }];
        let page = html(&report);
        assert!(
            page.contains("2 methods in 1 case, measured in this run until it was interrupted (one more, "),
            "{page}"
        );
        report.parts.push("peers".into());
        assert!(html(&report).contains("measured in this run (one more, of another program, was recorded earlier"));
    }

    /// A choice that keeps no limit says so, and absolute errors have a limit of their own.
    #[test]
    fn what_is_over_the_limit_is_marked() {
        let row = |method: &str, error| Row {
            error_rms: Some(error),
            cost_ns: Some(1.0),
            part: "lobes".into(),
            ..Row::new("sheen", method, "all; relative error")
        };
        let report = Report { rows: vec![row("ring", 0.2), row("irradiance", 0.3)], ..Report::begun(Effort::Quick) };
        let page = html(&report);
        assert_eq!(page.matches("<b>ring</b><span class=\"tag plain\">over the limit</span>").count(), 2, "{page}");
        assert!(page.contains("at most 10 % of the truth (0.1 where it is absolute, 5° for angles)"), "{page}");
    }
}
