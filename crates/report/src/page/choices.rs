//! The chapter "What to choose": for each term what each budget takes.

use std::fmt::Write;

use crate::choice::Choice;
use crate::comparison::{Comparison, Entry};
use crate::cost::Cost;
use crate::plot::escaped;
use crate::unit::Budget;
use crate::{Report, words};

/// The chapter; nothing where there is nothing to choose from.
pub(super) fn choices(report: &Report, comparisons: &[Comparison<'_>], page: &mut String) {
    if comparisons.is_empty() {
        return;
    }
    let _ = write!(
        page,
        "<h2 id=\"choose\">What to choose</h2>\n<p>Made from the figures below by one rule. Each budget takes the cheapest of the methods \
         that err little enough.</p>\n<ul><li><b>Little enough</b> is an rms error of at most {} for <b>mobile</b> and {} for <b>desktop</b>; \
         for <b>film</b> it is what is within 5 % of the least error. Where no method errs as little, the one for film stands there, and is \
         marked <span class=\"tag plain\">over the limit</span>.</li>\n<li><b>Cheapest</b> is by the time on the device{}, where every method \
         has one, and then by the instructions of the same shaders; else by the cost of the figure below. Times on one machine change from run \
         to run: those that differ by less than 50 %, or by less than their spreads, are alike, as are instructions that differ by less than \
         5 %. For mobile memory comes first, where it is known of all: of those that take up to half as long again as the cheapest, the one \
         that reads the least.</li>\n<li>Of methods that are alike in all this it is the most <b>accurate</b>, and of equals that which \
         <code>halfvector methods</code> lists first.</li></ul>\n<p>Only what <code>--method</code> knows is recommended. Where the library alone has a method that errs \
         less it is named below, with what it costs: where that is no more, or only it keeps the limit, and for film at any \
         cost.</p>\n{}<section class=\"card\"><div class=\"scroll\"><table class=\"choices\"><thead><tr><th>term</th>\
         <th>mobile</th><th>desktop</th><th>film</th></tr></thead><tbody>\n",
        words::limits(Budget::Mobile),
        words::limits(Budget::Desktop),
        device(comparisons).map_or(String::new(), |name| format!(" ({})", escaped(name))),
        if comparisons.iter().any(|comparison| !report.unfinished(comparison.term).is_empty()) {
            "<p><b>This run is not whole.</b> What is marked incomplete was chosen among what was measured, and may be another method \
             when the parts that stand there are measured to their end.</p>\n"
        } else {
            ""
        },
    );
    for comparison in comparisons {
        let unfinished = report.unfinished(comparison.term);
        let unfinished = match unfinished[..] {
            [] => String::new(),
            _ => format!("<br><span class=\"tag plain\">incomplete: {}</span>", escaped(&unfinished.join(", "))),
        };
        let truth = words::against(comparison.domains[0]).split_once("against ").map_or("", |(_, truth)| truth);
        let inputs = words::inputs(&comparison.domains) + if truth.is_empty() { "" } else { "; against " } + truth;
        let _ = write!(
            page,
            "<tr><td class=\"term\"><a href=\"#{0}\"><code>{0}</code></a>{unfinished}<br><span class=\"small muted\">{1}</span></td>",
            escaped(comparison.term),
            escaped(&inputs)
        );
        for budget in Budget::ALL {
            let choice = comparison.recommended(budget);
            let Choice { entry, weighed, keeps, library_only, .. } = choice;
            let figures = figures(comparison, entry, weighed, budget);
            let over = if keeps { "" } else { "<span class=\"tag plain\">over the limit</span>" };
            let tag = if library_only { "<span class=\"tag plain\">library only</span>" } else { "" };
            let of_library = words::of_library(comparison, &choice)
                .map_or(String::new(), |remark| format!("<br><span class=\"small muted\">{}</span>", escaped(&remark)));
            let _ = write!(
                page,
                "<td data-label=\"{}\"><b>{}</b>{tag}{over}<br><span class=\"muted\">{}</span>{of_library}</td>",
                budget.name(),
                escaped(&entry.row.method),
                escaped(&figures)
            );
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div></section>\n");
}

/// The device that shaders were timed on.
fn device<'a>(comparisons: &[Comparison<'a>]) -> Option<&'a str> {
    comparisons.iter().flat_map(|comparison| &comparison.entries).find_map(|entry| entry.row.gpu.as_deref())
}

/// Error and cost of a choice.
fn figures(comparison: &Comparison<'_>, entry: &Entry<'_>, weighed: Cost, budget: Budget) -> String {
    let cost = match weighed.of(entry.row).filter(|_| weighed != comparison.cost) {
        Some(cost) => words::cost(cost, weighed),
        None => words::cost(entry.cost, comparison.cost),
    };
    let place = if weighed == Cost::Device { " on the device" } else { "" };
    let memory = entry.row.bytes.filter(|_| weighed != Cost::Bytes && comparison.cost != Cost::Bytes);
    let memory = memory.map_or(String::new(), |bytes| format!(", {}", words::cost(bytes as f64, Cost::Bytes)));
    let count = entry.row.instructions.filter(|_| weighed == Cost::Device);
    let count = count.map_or(String::new(), |count| format!(", {}", words::cost(count as f64, Cost::Instructions)));
    format!(
        "{}, {cost}{place}{count}{memory}",
        words::error_beside(entry.rms, comparison.unit, comparison.unit.limit(budget))
    )
}
