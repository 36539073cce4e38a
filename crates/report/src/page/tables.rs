//! Rows that no plot shows: a matrix of inputs by methods where there is an error and nothing else, else a table with a line
//! for each set of inputs above its rows.

use std::fmt::Write;

use super::{cell, code, largest, not_searched, tags};
use crate::Row;
use crate::cost::Cost;
use crate::plot::escaped;
use crate::timing::median;
use crate::unit::Unit;
use crate::words;

/// A card with rows of one term.
pub(super) fn section(rows: &[&Row], page: &mut String) {
    page.push_str("<section class=\"card\">");
    if let Some(title) = finding(rows) {
        let _ = write!(page, "<h3>{}</h3>", code(&title));
    }
    if is_matrix(rows) {
        matrix(rows, page)
    } else {
        plain(rows, page)
    }
    page.push_str("</section>\n");
}

/// The different ones among some texts, in order.
fn distinct<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    texts.for_each(|text| {
        if !found.contains(&text) {
            found.push(text);
        }
    });
    found
}

/// What stands before the last semicolon of a domain.
fn inputs_of(row: &Row) -> &str {
    row.domain.rsplit_once(';').map_or(row.domain.as_str(), |(inputs, _)| inputs)
}

/// Whether the rows have an error for every method in several cases, and of all else the same figures in nearly all cases.
fn is_matrix(rows: &[&Row]) -> bool {
    let has_error = |row: &&Row| row.error_rms.is_some() && row.flip.is_none() && row.not_finite.is_none();
    let methods = distinct(rows.iter().map(|row| row.method.as_str())).len();
    let cases = distinct(rows.iter().map(|row| row.domain.as_str())).len();
    rows.iter().all(has_error) && cases > 2 && methods * cases == rows.len()
}

/// What each method of a matrix takes: the same in every case, or the median of the cases.
fn costs(rows: &[&Row], methods: &[&str]) -> String {
    let of = |method: &str, figure: fn(&Row) -> Option<f64>| -> Option<f64> {
        let found: Vec<f64> = rows.iter().filter(|row| row.method == method).filter_map(|row| figure(row)).collect();
        (!found.is_empty()).then(|| median(found))
    };
    let said = |method: &&str| {
        let figures = [
            of(method, |row| row.cost_ns).map(|x| words::cost(x, Cost::Call)),
            of(method, |row| row.bytes.map(|x| x as f64))
                .map(|x| format!("reads from {}", words::cost(x, Cost::Bytes))),
            of(method, |row| row.instructions.map(|x| x as f64)).map(|x| format!("a shader of {x:.0} instructions")),
            of(method, |row| row.gpu_ns).map(|x| format!("{} for a pixel on the device", words::cost(x, Cost::Device))),
        ];
        let figures: Vec<String> = figures.into_iter().flatten().collect();
        (!figures.is_empty()).then(|| format!("{method}: {}", figures.join(", ")))
    };
    let all: Vec<String> = methods.iter().filter_map(said).collect();
    if all.is_empty() { String::new() } else { format!(" Cost: {}.", all.join("; ")) }
}

/// The rms error of each method, which have a column each, in each case.
pub(super) fn matrix(rows: &[&Row], page: &mut String) {
    let methods = distinct(rows.iter().map(|row| row.method.as_str()));
    let domains = distinct(rows.iter().map(|row| row.domain.as_str()));
    page.push_str("<div class=\"scroll\"><table><thead><tr><th>inputs</th>");
    for method in &methods {
        let _ = write!(page, "<th class=\"n\">{}</th>", escaped(method));
    }
    page.push_str("</tr></thead><tbody>\n");
    let (shared, own) = split(&domains.iter().map(|domain| words::inputs(&[domain])).collect::<Vec<_>>());
    for (domain, own) in domains.iter().zip(own) {
        let _ = write!(page, "<tr><td>{}</td>", escaped(&own));
        for method in &methods {
            let row = rows.iter().find(|row| row.domain == **domain && row.method == **method);
            page.push_str(&cell(row.and_then(|row| row.error_rms), |x| words::error(x, Unit::of(domain))));
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n");
    let against = words::against(domains.first().copied().unwrap_or_default());
    let _ = writeln!(
        page,
        "<p class=\"small muted\">Rms errors. {}{}.{}</p>",
        escaped(&shared),
        escaped(against),
        escaped(&costs(rows, &methods))
    );
}

/// What texts share behind their first colon, and what each has before it; nothing and the whole texts where they differ.
fn split(texts: &[String]) -> (String, Vec<String>) {
    let parts: Option<Vec<(&str, &str)>> = texts.iter().map(|text| text.split_once(": ")).collect();
    match parts {
        Some(parts) if parts.iter().all(|part| part.1 == parts[0].1) => {
            (format!("Of all: {}; ", parts[0].1), parts.iter().map(|part| part.0.to_owned()).collect())
        }
        _ => (String::new(), texts.to_vec()),
    }
}

/// Every figure of each row, under a line with its inputs.
fn plain(rows: &[&Row], page: &mut String) {
    let has = |some: fn(&Row) -> bool| rows.iter().any(|row| some(row));
    let columns = [
        ("rms error", has(|row| row.error_rms.or(row.error_bound).is_some())),
        ("largest error", has(|row| row.error_max.is_some())),
        ("FLIP", has(|row| row.flip.is_some())),
        ("NaN or inf", has(|row| row.not_finite.is_some())),
        ("one call", has(|row| row.cost_ns.is_some())),
        ("one of many", has(|row| row.cost_batch_ns.is_some())),
        ("memory", has(|row| row.bytes.is_some())),
        ("instructions", has(|row| row.instructions.is_some())),
        ("device pixel", has(|row| row.gpu_ns.is_some())),
    ];
    page.push_str("<div class=\"scroll\"><table class=\"grouped\"><thead><tr><th>method</th>");
    let shown = columns.iter().filter(|(_, there)| *there);
    for (name, _) in shown.clone() {
        let name = match (*name, rows[0].term.as_str()) {
            ("one call", "picture") => "one picture",
            ("one call", "peer") => "time",
            (name, _) => name,
        };
        let _ = write!(page, "<th class=\"n\">{name}</th>");
    }
    page.push_str("<th>remarks</th></tr></thead><tbody>\n");
    let across = 2 + shown.count();
    for inputs in distinct(rows.iter().map(|row| inputs_of(row))) {
        let own: Vec<&Row> = rows.iter().copied().filter(|row| inputs_of(row) == inputs).collect();
        // What all rows of a case are held against stands above them.
        let against = distinct(own.iter().map(|row| words::against(&row.domain)));
        let shared = if own.len() > 1 && against.len() == 1 { against[0] } else { "" };
        let above = [inputs, shared].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; ");
        let _ =
            writeln!(page, "<tr class=\"case\"><td colspan=\"{across}\"><span>{}</span></td></tr>", escaped(&above));
        for row in own {
            let _ = write!(page, "<tr><td>{}{}</td>", escaped(&row.method), tags(row));
            let cells = [
                cell(row.error_rms.or(row.error_bound), |_| words::rms(row, Unit::of(&row.domain))),
                largest(row, Unit::of(&row.domain)),
                cell(row.flip, words::number),
                cell(row.not_finite.map(|x| x as f64), |x| format!("{x:.0}")),
                cell(row.cost_ns, |x| words::cost(x, Cost::Call)),
                cell(row.cost_batch_ns, |x| words::cost(x, Cost::Batch)),
                cell(row.bytes.map(|x| x as f64), |x| words::cost(x, Cost::Bytes)),
                cell(row.instructions.map(|x| x as f64), |x| format!("{x:.0}")),
                cell(row.gpu_ns, |x| words::cost(x, Cost::Call)),
            ];
            for (cell, _) in cells.iter().zip(&columns).filter(|(_, (_, there))| *there) {
                page.push_str(cell);
            }
            let failure = row.first_failure.as_deref().map(|at| format!("fails first at {}", words::shortened(at)));
            let note = row.note.clone().unwrap_or_default();
            let recorded = row.recorded.as_deref().map_or(String::new(), |when| format!("recorded on {when}"));
            let against = if shared.is_empty() { words::against(&row.domain).to_owned() } else { String::new() };
            let at = row.at.as_deref().filter(|_| row.error_max > Some(0.0));
            let at = at.map_or(String::new(), |at| format!("largest at {}", words::shortened(at)));
            let notes = [against, at, failure.unwrap_or_default(), recorded, note];
            let notes: Vec<&str> = notes.iter().map(String::as_str).filter(|note| !note.is_empty()).collect();
            let _ = writeln!(page, "<td class=\"small\">{}</td></tr>", escaped(&notes.join("; ")));
        }
    }
    page.push_str("</tbody></table></div>\n");
    not_searched(rows.iter().copied(), page);
}

/// What rows without another to weigh them against show.
fn finding(rows: &[&Row]) -> Option<String> {
    if rows[0].term == "peer" {
        return peers(rows);
    }
    if rows[0].term == "picture" {
        return pictures(rows);
    }
    if rows.iter().all(|row| row.not_finite.is_some()) {
        return Some(words::precision(rows));
    }
    let methods = distinct(rows.iter().map(|row| row.method.as_str()));
    // Of pictures it is said how different they look.
    let looks = rows.iter().all(|row| row.flip.is_some());
    let figure = |row: &Row| if looks { row.flip } else { row.error_rms };
    let of = |method: &str| -> Vec<f64> {
        rows.iter().filter(|row| row.method == method).filter_map(|row| figure(row)).collect()
    };
    let unit = if looks { Unit::Plain } else { Unit::of(&rows[0].domain) };
    let errs = if looks { "differs by a FLIP of" } else { "errs" };
    if rows.iter().all(|row| row.error_rms.is_none()) {
        let count = |row: &&&Row| row.instructions;
        let (least, most) = (rows.iter().min_by_key(count)?, rows.iter().max_by_key(count)?);
        return Some(format!(
            "`{}` makes a shader of {} instructions, `{}` one of {}",
            least.method, least.instructions?, most.method, most.instructions?
        ));
    }
    // Those that were measured, the least wrong first; of each the median of its cases.
    let mut told: Vec<(&str, f64, usize)> = methods
        .iter()
        .map(|method| (*method, of(method)))
        .filter(|(_, errors)| !errors.is_empty())
        .map(|(method, errors)| (method, median(errors.clone()), errors.len()))
        .collect();
    told.sort_by(|a, b| a.1.total_cmp(&b.1));
    let text = |x| if x == 0.0 { "nothing".to_owned() } else { words::error(x, unit) };
    let ((best, least, cases), (worst, most, _)) = (told.first()?, told.last()?);
    let medians = if *cases > 1 { format!(" (medians of {cases} cases)") } else { String::new() };
    if told.len() == 1 {
        return Some(format!("`{best}` {errs} {}{medians}", text(*least)));
    }
    if words::error(*least, unit) == words::error(*most, unit) {
        return Some(format!(
            "All of them {} {}{medians}",
            if looks { "differ by a FLIP of" } else { "err" },
            text(*most)
        ));
    }
    Some(format!("`{best}` {errs} least, {}; `{worst}` most, {}{medians}", text(*least), text(*most)))
}

/// What drawers differ by from the reference, and what specialising saves.
fn pictures(rows: &[&Row]) -> Option<String> {
    let of = |method: &str, figure: fn(&Row) -> Option<f64>| -> Option<f64> {
        let found: Vec<f64> = rows.iter().filter(|row| row.method == method).filter_map(|row| figure(row)).collect();
        (!found.is_empty()).then(|| median(found))
    };
    let looks = |method: &str| {
        let flip = of(method, |row| row.flip)?;
        Some(format!("`{method}` looks a FLIP of {} different from the reference", words::number(flip)))
    };
    // Each example's two shaders, one over the other.
    let ratio = |figure: fn(&Row) -> Option<f64>| -> Option<f64> {
        let example = |row: &Row| row.domain.split(':').next().map(str::to_owned);
        let ratios = rows.iter().filter(|row| row.method == "gpu").filter_map(|own| {
            let is_other = |row: &&&Row| row.method == "gpu, unspecialised" && example(row) == example(own);
            Some(figure(own)? / figure(rows.iter().find(is_other)?)?)
        });
        let ratios: Vec<f64> = ratios.collect();
        (!ratios.is_empty()).then(|| median(ratios))
    };
    let saves = ratio(|row| row.instructions.map(|x| x as f64)).map(|count| {
        let time = ratio(|row| row.gpu_ns)
            .map_or(String::new(), |time| format!(" and {} % of its time on the device", words::number(100.0 * time)));
        format!(
            "the specialised shader has {} % of the unspecialised one's instructions{time}",
            words::number(100.0 * count)
        )
    });
    let said: Vec<String> = [looks("gpu"), looks("cpu"), saves].into_iter().flatten().collect();
    (!said.is_empty()).then(|| format!("{} (medians of the examples)", said.join("; ")))
}

/// Each of our programs beside the other at the same work.
fn peers(rows: &[&Row]) -> Option<String> {
    let work = |row: &Row| row.domain.split(';').next().unwrap_or_default().to_owned();
    let costs = [Cost::Batch, Cost::Instructions, Cost::Call];
    let said: Vec<String> = distinct(rows.iter().map(|row| row.method.as_str()))
        .iter()
        .filter_map(|method| {
            let ours = rows.iter().find(|row| row.method == *method)?;
            let other =
                rows.iter().skip_while(|row| row.method != *method).skip(1).find(|row| work(row) == work(ours))?;
            let (cost, [a, b]) = costs.iter().find_map(|cost| Some((cost, [cost.of(ours)?, cost.of(other)?])))?;
            let what = if cost.is_time() { "of the time" } else { "of the instructions" };
            let when =
                other.recorded.as_ref().map_or(String::new(), |when| format!(" (not of this run: recorded on {when})"));
            let errors = match (ours.error_rms, other.error_rms) {
                (Some(a), Some(b)) => {
                    let unit = Unit::of(&ours.domain);
                    format!(" and errs {} instead of {}", words::error(a, unit), words::error(b, unit))
                }
                _ => String::new(),
            };
            let part = words::number(100.0 * a / b);
            Some(format!("`{}` takes {part} % {what} of `{}`{when}{errors}", ours.method, other.method))
        })
        .collect();
    (!said.is_empty()).then(|| said.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(method: &str, domain: &str, error: f64) -> Row {
        Row { error_rms: Some(error), ..Row::new("normal_frame", method, domain) }
    }

    fn shown(rows: &[Row]) -> String {
        let mut page = String::new();
        section(&rows.iter().collect::<Vec<_>>(), &mut page);
        page
    }

    #[test]
    fn methods_in_several_cases_make_a_matrix() {
        let cases = ["flat: a mesh; in degrees", "ball: a mesh; in degrees", "bent: a mesh; in degrees"];
        let rows: Vec<Row> =
            cases.iter().enumerate().flat_map(|(i, case)| [row("a", case, i as f64), row("b", case, 9.0)]).collect();
        let page = shown(&rows);
        assert!(
            page.contains("<code>a</code> errs least, 1.0°; <code>b</code> most, 9.0° (medians of 3 cases)"),
            "{page}"
        );
        assert!(page.contains("<tr><td>ball</td>") && page.contains("Of all: a mesh; in degrees."), "{page}");
        let hidden = [Row { error_rms: None, error_bound: Some(0.5), ..row("a", "x; in degrees", 0.0) }];
        assert!(shown(&hidden).contains(">below noise (≤ 0.50°)</td>"), "{}", shown(&hidden));
        assert!(shown(&rows[1..]).contains("<tr class=\"case\">"), "a case without a method is no matrix");
    }

    /// What was searched for and what is the largest of a list look different.
    #[test]
    fn a_largest_error_of_a_list_is_marked() {
        let of = |method: &str, searched| Row {
            error_max: Some(9.0),
            points: Some(64),
            searched,
            ..row(method, "a mesh; in degrees", 3.0)
        };
        let page = shown(&[of("list", false), of("search", true)]);
        assert_eq!((page.matches("9.0° †").count(), page.matches("† the largest").count()), (1, 1), "{page}");
        assert!(!shown(&[of("search", true)]).contains('†'));
    }

    #[test]
    fn peers_are_set_beside_the_same_work() {
        let mut rows = vec![Row::new("peer", "ours", "a bake; now"), Row::new("peer", "theirs", "a bake; now")];
        (rows[0].cost_ns, rows[1].cost_ns) = (Some(2.0), Some(8.0));
        assert!(shown(&rows).contains("<code>ours</code> takes 25 % of the time of <code>theirs</code></h3>"));
        rows[1].recorded = Some("2026-11-22, a machine".into());
        let page = shown(&rows);
        assert!(
            page.contains("of <code>theirs</code> (not of this run: recorded on 2026-11-22, a machine)</h3>"),
            "{page}"
        );
        assert!(page.contains("<td class=\"small\">recorded on 2026-11-22, a machine</td>"), "{page}");
    }
}
