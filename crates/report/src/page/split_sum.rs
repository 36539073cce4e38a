//! What the split sum leaves out: a plot for each environment, and its figures as a table of roughness by direction of view.

use std::fmt::Write;

use super::cell;
use crate::Row;
use crate::cost::Cost;
use crate::part::split_sum::{MODEL, WHOLE};
use crate::plot::curves::{Curve, curves};
use crate::plot::escaped;
use crate::unit::Unit;
use crate::words;

/// A row of the model: n.v, roughness, rms error.
type Case = [f64; 3];

/// Writes the figures, and gives back the rows that are in none.
pub(super) fn figures<'a>(rows: &[&'a Row], page: &mut String) -> Vec<&'a Row> {
    let mut shown: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| row.method == MODEL) {
        let name = environment(row);
        if !shown.contains(&name) && cases(rows, name).len() > 1 {
            shown.push(name);
            figure(rows, name, page);
        }
    }
    let is_shown = |row: &Row| {
        shown.contains(&environment(row)) && (row.method == WHOLE || row.method == MODEL && case(row).is_some())
    };
    rows.iter().copied().filter(|row| !is_shown(row)).collect()
}

/// The name that begins a domain.
fn environment(row: &Row) -> &str {
    row.domain.split(':').next().unwrap_or_default()
}

fn case(row: &Row) -> Option<Case> {
    let after = |name: &str| -> Option<f64> {
        let rest = row.domain.split_once(name)?.1;
        rest[..rest.find([',', ';']).unwrap_or(rest.len())].trim().parse().ok()
    };
    Some([after(", n.v ")?, after(", roughness ")?, row.error_rms?])
}

fn cases(rows: &[&Row], name: &str) -> Vec<Case> {
    rows.iter().filter(|row| row.method == MODEL && environment(row) == name).filter_map(|row| case(row)).collect()
}

fn figure(rows: &[&Row], name: &str, page: &mut String) {
    let cases = cases(rows, name);
    let title = finding(rows, name, &cases);
    let different = |axis: usize| {
        let mut found: Vec<f64> = cases.iter().map(|case| case[axis]).collect();
        found.sort_by(f64::total_cmp);
        found.dedup();
        found
    };
    let (views, widths) = (different(0), different(1));
    let error = |v: f64, r: f64| cases.iter().find(|case| case[0] == v && case[1] == r).map(|case| case[2]);
    let lines: Vec<Curve> = views
        .iter()
        .map(|&v| Curve {
            name: format!("n.v {v}"),
            points: widths.iter().filter_map(|&r| Some((r, error(v, r)?))).collect(),
        })
        .collect();
    let _ = write!(
        page,
        "<figure>\n<h3>{}</h3>\n<div class=\"scroll\">{}</div>\n<figcaption><p><b>How:</b> The environment <code>{}</code>; normals in many \
         directions, gold and a dielectric (f0 0.04). Prefiltered light times albedo, both by quadrature, against the sum of light times the \
         lobe over every texel; the error is relative to that sum. One line for each direction of view: n.v is its cosine to the normal, \
         1 is head-on. Lower is better.</p></figcaption>\n",
        escaped(&title),
        curves(&title, "perceptual roughness", Unit::Relative.title(), &lines),
        escaped(name)
    );
    page.push_str("<div class=\"scroll\"><table><thead><tr><th>rms error</th>");
    for v in &views {
        let _ = write!(page, "<th class=\"n\">n.v {v}</th>");
    }
    page.push_str("</tr></thead><tbody>\n");
    for &r in &widths {
        let _ = write!(page, "<tr><td>roughness {r}</td>");
        for &v in &views {
            page.push_str(&cell(error(v, r), |x| words::error(x, Unit::Relative)));
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n</figure>\n");
}

/// Where the split sum errs most and least, and what the sum over all light would take.
fn finding(rows: &[&Row], name: &str, cases: &[Case]) -> String {
    let by_error = |a: &&Case, b: &&Case| a[2].total_cmp(&b[2]);
    let said = |case: Option<&Case>| {
        case.map_or(String::new(), |[v, r, error]| {
            format!("{} at n.v {v} and roughness {r}", words::error(*error, Unit::Relative))
        })
    };
    let (least, most) = (said(cases.iter().min_by(by_error)), said(cases.iter().max_by(by_error)));
    let cost = |method: &str| {
        let of = |row: &&&Row| row.method == method && environment(row) == name;
        rows.iter().find(of).and_then(|row| row.cost_ns)
    };
    let times = match (cost(MODEL), cost(WHOLE)) {
        (Some(split), Some(whole)) => format!(
            "; the sum over every texel has no such error and takes {} instead of {}",
            words::cost(whole, Cost::Call),
            words::cost(split, Cost::Call)
        ),
        _ => String::new(),
    };
    format!("Under {name} the split sum errs from {least} to {most}{times}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_environment_has_a_plot_that_says_its_finding() {
        let row = |v: f64, r: f64, error: f64| Row {
            error_rms: Some(error),
            cost_ns: Some(400.0),
            ..Row::new("split_sum", MODEL, &format!("sky: the model, n.v {v}, roughness {r}; relative to all"))
        };
        let whole = Row { cost_ns: Some(1e6), ..Row::new("split_sum", WHOLE, "sky: the integral; the truth") };
        let rows = [row(0.3, 0.2, 0.015), row(0.3, 1.0, 0.54), row(1.0, 0.2, 0.007), row(1.0, 1.0, 0.05), whole];
        let mut page = String::new();
        let left = figures(&rows.iter().collect::<Vec<_>>(), &mut page);
        assert!(left.is_empty(), "{left:?}");
        let title = "Under sky the split sum errs from 0.70 % at n.v 1 and roughness 0.2 to 54 % at n.v 0.3 and roughness 1; the sum \
                     over every texel has no such error and takes 1.0 ms instead of 400 ns";
        assert!(
            page.contains(&format!("<h3>{title}</h3>")) && page.contains(&format!("<title>{title}</title>")),
            "{page}"
        );
        assert!(page.contains("perceptual roughness") && page.contains("rms error, relative"), "axes have titles");
        assert_eq!(page.matches("<circle").count(), 4);
    }
}
