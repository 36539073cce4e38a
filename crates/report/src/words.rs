//! Numbers and findings in words: what a plot shows, said from its data.

use std::fmt::Write;

use crate::Row;
use crate::choice::Choice;
use crate::comparison::{Comparison, Entry, alike as alike_within};
use crate::cost::Cost;
use crate::unit::{Budget, Unit};

/// A number with two digits that count: 0.013, 42, 5.1×10⁻⁸.
pub fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return "not a number".to_owned();
    }
    let exponent = format!("{x:.1e}").split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    match exponent {
        -3..=0 => format!("{x:.*}", (1 - exponent) as usize),
        1..=5 => thousands(x),
        _ => {
            let text = format!("{x:.1e}");
            let mantissa = text.split('e').next().unwrap_or("");
            format!("{mantissa}×{}", power_of_ten(exponent))
        }
    }
}

/// A whole number with a thin gap at the thousands.
fn thousands(x: f64) -> String {
    let digits = format!("{x:.0}");
    match digits.len() {
        0..=4 => digits,
        n => format!("{}\u{202f}{}", &digits[..n - 3], &digits[n - 3..]),
    }
}

/// 10⁻⁸.
pub fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32('⁰' as u32 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// An error with its unit, the same one however small it is: 13 %, 5.1×10⁻⁶ %, 12°.
pub fn error(x: f64, unit: Unit) -> String {
    match unit {
        // What is not all of it is not called that.
        Unit::Relative if (99.5..99.95).contains(&(100.0 * x)) => format!("{:.1} %", 100.0 * x),
        Unit::Relative => format!("{} %", number(100.0 * x)),
        Unit::Degrees => format!("{}°", number(x)),
        Unit::Ulps => format!("{} ulp", number(x)),
        Unit::Plain => number(x),
    }
}

/// An error with as many digits as tell on which side of a limit it is: 1.02° is not 1°.
pub fn error_beside(x: f64, unit: Unit, limit: f64) -> String {
    let text = error(x, unit);
    if x <= limit || text != error(limit, unit) {
        return text;
    }
    let (scale, sign) = match unit {
        Unit::Relative => (100.0, " %"),
        Unit::Degrees => (1.0, "°"),
        Unit::Ulps => (1.0, " ulp"),
        Unit::Plain => (1.0, ""),
    };
    // One digit more, until it shows.
    let digits = (0..15).find(|&digits| format!("{:.digits$}", scale * x) != format!("{:.digits$}", scale * limit));
    digits.map_or(text, |digits| format!("{:.digits$}{sign}", scale * x))
}

/// The rms error of a row, or what it is at most where noise hides it; empty where neither is known.
pub fn rms(row: &Row, unit: Unit) -> String {
    match (row.error_rms, row.error_bound) {
        (Some(rms), _) => error(rms, unit),
        (None, Some(bound)) => format!("below noise (≤ {})", error(bound, unit)),
        (None, None) => String::new(),
    }
}

/// The limits of a budget, for each kind of error.
pub fn limits(budget: Budget) -> String {
    format!(
        "{} % of the truth ({} where it is absolute, {}° for angles)",
        100.0 * Unit::Relative.limit(budget),
        Unit::Plain.limit(budget),
        Unit::Degrees.limit(budget)
    )
}

/// A cost with its unit: 3.4 ns, 8,100 bytes.
pub fn cost(x: f64, kind: Cost) -> String {
    match kind {
        Cost::Bytes if x >= 1e6 => format!("{} MB", number(x / 1e6)),
        Cost::Bytes if x >= 1e4 => format!("{} kB", number(x / 1e3)),
        Cost::Bytes => format!("{x:.0} {}", if x == 1.0 { "byte" } else { "bytes" }),
        Cost::Instructions => format!("{x:.0} instructions"),
        _ if x >= 1e6 => format!("{} ms", number(x / 1e6)),
        _ if x >= 1e4 => format!("{} µs", number(x / 1e3)),
        _ => format!("{} ns", number(x)),
    }
}

/// What the library alone has in the place of a choice: what it errs and what it costs, beside the choice.
pub fn of_library(comparison: &Comparison<'_>, choice: &Choice<'_, '_>) -> Option<String> {
    let other = choice.of_library?;
    let [errs, instead] = [other, choice.entry].map(|entry| error(entry.rms, comparison.unit));
    let [takes, chosen] = [other, choice.entry].map(|entry| cost(entry.cost, comparison.cost));
    let takes = if takes == chosen { format!("{takes} like it") } else { format!("{takes} instead of {chosen}") };
    let what = match comparison.cost {
        _ if comparison.is_of_bakes() => "a texel of a bake takes",
        Cost::Batch => "an element of a batch takes",
        Cost::Call => "one call takes",
        Cost::Bytes => "reads",
        Cost::Device => "a pixel on the device takes",
        Cost::Instructions => "has a shader of",
    };
    Some(format!("library: {} errs {errs} instead of {instead}, {what} {takes}", other.row.method))
}

/// Times are called alike up to this ratio where one of them is named as fast.
const ALIKE: f64 = 1.15;

/// What a comparison shows, in one sentence without a full stop; names of methods stand in backticks.
pub fn finding(comparison: &Comparison<'_>) -> String {
    let text = |entry: &Entry<'_>| error(entry.rms, comparison.unit);
    let best = comparison.choice(Budget::Film);
    let name = &best.row.method;
    let errs = if best.rms == 0.0 {
        "is exact".to_owned()
    } else if comparison.entries.iter().all(|entry| best.rms <= entry.rms.max(comparison.unit.limit(Budget::Film))) {
        format!("errs least, {}", text(best))
    } else {
        format!("errs {}, next to the least there is", text(best))
    };
    let front = || comparison.entries.iter().filter(|entry| entry.front);
    let least = front().map(|entry| entry.cost).fold(f64::INFINITY, f64::min);
    // Of those that take as long as the fastest, nearly, the one that errs least is worth a sentence.
    let alike = if comparison.cost.is_time() { ALIKE } else { 1.0 };
    let fast = front().filter(|entry| entry.cost <= alike * least);
    let cheapest = fast.min_by(|a, b| a.rms.total_cmp(&b.rms)).unwrap_or(best);
    if std::ptr::eq(cheapest, best) || (comparison.cost.is_time() && best.cost <= alike * cheapest.cost) {
        // Times that spread over each other are alike, whichever number is smaller.
        let spread = |entry: &Entry<'_>| comparison.cost.spread(entry.row);
        let is_beyond = |entry: &Entry<'_>| entry.cost * alike_within(spread(entry), spread(best)) < best.cost;
        let cheaper = if comparison.entries.iter().any(is_beyond) {
            "much cheaper"
        } else if comparison.entries.iter().any(|entry| entry.cost < best.cost) {
            "cheaper beyond the spread"
        } else {
            "cheaper"
        };
        return format!("`{name}` {errs}, and nothing is {cheaper}");
    }
    let ratio = best.cost / cheapest.cost;
    let saves = match comparison.cost {
        kind if !kind.is_time() => {
            format!("takes {} instead of {}", cost(cheapest.cost, kind), cost(best.cost, kind))
        }
        _ => format!("is {} times as fast", if ratio < 10.0 { format!("{ratio:.1}") } else { format!("{ratio:.0}") }),
    };
    format!("`{name}` {errs}; `{}` {saves} but errs {}", cheapest.row.method, text(cheapest))
}

/// What number formats do to the hard cases: in which of them forms give no number, and how far off the others are.
pub fn precision(rows: &[&Row]) -> String {
    // The distance of neighbouring numbers is at most this part of them.
    let said: Vec<String> = [("f32", 2_f64.powi(-23)), ("f16", 2_f64.powi(-10))]
        .into_iter()
        .filter_map(|(format, part)| {
            let is_own = |row: &&&Row| row.method.split(' ').any(|word| word == format);
            let mut own: Vec<&Row> = rows.iter().filter(is_own).copied().collect();
            let lost = own.iter().filter(|row| row.not_finite > Some(0)).count();
            own.sort_by(|a, b| b.error_max.partial_cmp(&a.error_max).unwrap_or(std::cmp::Ordering::Equal));
            let most = |at: usize| own.get(at).and_then(|row| row.error_max);
            // One that is far off by itself does not speak for the others.
            let alone = most(1).zip(most(0)).is_some_and(|(next, most)| most > 100.0 * next);
            let farthest = most(usize::from(alone))?;
            let off = format!("{} ({})", error(farthest, Unit::Ulps), error(part * farthest, Unit::Relative));
            let but = if alone { format!(" but for `{}`", own[0].method) } else { String::new() };
            Some(match (lost, own.len()) {
                (0, count) => format!("in {format} each of {count} forms gives numbers, at most {off} off{but}"),
                (lost, count) => format!(
                    "in {format} {lost} of {count} forms {} NaN or infinity where the right result is a number, and what is a number is up \
                     to {off} off{but}",
                    if lost == 1 { "gives" } else { "give" }
                ),
            })
        })
        .collect();
    halfvector_graph::docs::capitalised(&said.join("; "))
}

/// The inputs of the domains of a comparison, without repeating what they share.
pub fn inputs(domains: &[&str]) -> String {
    let inputs: Vec<&str> =
        domains.iter().map(|domain| domain.rsplit_once(';').map_or(*domain, |(inputs, _)| inputs)).collect();
    let shared = |mark: char| -> Option<String> {
        let heads: Option<Vec<(&str, &str)>> =
            inputs.iter().map(|text| text.split_once(mark).map(|(head, rest)| (head, rest.trim()))).collect();
        let heads = heads.filter(|heads| heads.iter().all(|(_, rest)| *rest == heads[0].1))?;
        let first: Vec<&str> = heads.iter().map(|(first, _)| *first).collect();
        // A long list stands in the table.
        let list = match first[..] {
            [begin, _, _, _, _, .., end] => format!("{} cases from {begin} to {end}", first.len()),
            _ => first.join("; "),
        };
        Some(format!("{list} (the worst of them): {}", heads[0].1))
    };
    match shared(':').or_else(|| shared(',')) {
        Some(text) if inputs.len() > 1 => text,
        _ if inputs.len() > 1 => format!("the worst of: {}", inputs.join("; or ")),
        _ => inputs.join(""),
    }
}

/// What errors are measured against: what stands behind the last semicolon of a domain.
pub fn against(domain: &str) -> &str {
    domain.rsplit_once(';').map_or("", |(_, rest)| rest.trim())
}

/// A text with its long numbers cut to four digits that count: 0.21741936 is 0.2174, and 9.9999999e-7 is 1e-6.
pub fn shortened(text: &str) -> String {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(is_part) {
        let end = rest[start..].find(|c| !is_part(c)).map_or(rest.len(), |length| start + length);
        let word = &rest[start..end];
        let exponent = exponent(&rest[end..]);
        out.push_str(&rest[..start]);
        match word.parse::<f64>() {
            Ok(x) if word.len() > 7 && word.contains('.') && x > 0.0 && !exponent.is_empty() => {
                // Rounded with its exponent, which a carry changes.
                let whole = format!("{word}{exponent}").parse::<f64>().unwrap_or(x);
                let short = format!("{whole:.3e}");
                let (digits, exponent) = short.split_once('e').unwrap_or((&short, "0"));
                let _ = write!(out, "{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'));
            }
            Ok(x) if word.len() > 7 && word.contains('.') && x > 0.0 => {
                let digits = (3.0 - x.log10().floor()).clamp(0.0, 12.0) as usize;
                let short = format!("{x:.digits$}");
                out.push_str(short.trim_end_matches('0').trim_end_matches('.'));
            }
            _ => {
                out.push_str(word);
                out.push_str(exponent);
            }
        }
        rest = &rest[end + exponent.len()..];
    }
    out + rest
}

/// The exponent that a text begins with, `e-7`; nothing where there is none.
fn exponent(text: &str) -> &str {
    let Some(rest) = text.strip_prefix('e') else { return "" };
    let digits = rest.strip_prefix('-').unwrap_or(rest);
    let count = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    if count == 0 { "" } else { &text[..text.len() - digits.len() + count] }
}

/// How many inputs the errors of some rows are of, and what their largest error is; nothing where it is not known of all.
pub(crate) fn points(rows: &[&Row]) -> String {
    let Some(counts) = rows.iter().map(|row| row.points).collect::<Option<Vec<u64>>>() else { return String::new() };
    let (Some(least), Some(most)) = (counts.iter().min(), counts.iter().max()) else { return String::new() };
    let [least, most] = [*least, *most].map(|count| number(count as f64));
    let count = if least == most { least } else { format!("{least} to {most}") };
    let largest = match rows.iter().filter(|row| row.searched).count() {
        0 => "the largest error is the largest of these",
        found if found == rows.len() => "the largest error is what a search from the worst of these finds",
        _ => {
            "the largest error is the largest of these, or of a search from the worst of them where that can be larger"
        }
    };
    format!(" Each error is of {count} inputs; {largest}.")
}

/// What the mark beside a largest error says that was not searched for.
pub(crate) const NOT_SEARCHED: &str =
    "the largest of the inputs that were drawn: it was not searched for, and may be larger between them.";

#[cfg(test)]
mod tests {
    use super::*;

    /// What is over a limit does not look as if it kept it.
    #[test]
    fn errors_beside_a_limit_have_digits_enough() {
        assert_eq!(error(1.0221, Unit::Degrees), "1.0°");
        assert_eq!(error_beside(1.0221, Unit::Degrees, 1.0), "1.02°");
        assert_eq!(error_beside(0.1004, Unit::Relative, 0.1), "10.04 %");
        assert_eq!(error_beside(0.99, Unit::Degrees, 1.0), "0.99°");
        assert_eq!(error(0.9953, Unit::Relative), "99.5 %");
        assert_eq!(error(1.0, Unit::Relative), "100 %");
    }

    #[test]
    fn numbers_have_two_digits() {
        let texts = [0.0, 0.9, 0.0131, 3.44, 42.4, 8100.0, 20649.0, 4.9e-8, 1.6e7].map(number);
        assert_eq!(
            texts,
            ["0", "0.90", "0.013", "3.4", "42", "8100", "20\u{202f}649", "4.9×10⁻⁸", "1.6×10⁷"].map(str::to_owned)
        );
        assert_eq!(error(0.134, Unit::Relative), "13 %");
        assert_eq!(error(5.1e-8, Unit::Relative), "5.1×10⁻⁶ %");
        assert_eq!(error(12.3, Unit::Degrees), "12°");
        let hidden = Row { error_bound: Some(0.02), ..Row::default() };
        assert_eq!(rms(&hidden, Unit::Relative), "below noise (≤ 2.0 %)");
        assert_eq!(cost(16_773_120.0, Cost::Bytes), "17 MB");
    }

    #[test]
    fn an_outlier_of_precision_is_named() {
        let row = |method: &str, most, lost| Row {
            error_max: Some(most),
            not_finite: Some(lost),
            ..Row::new("precision", method, "hard cases; in ulp of it")
        };
        let rows =
            [row("d_a f32 device", 9e6, 0), row("d_b f32", 67.0, 0), row("d_b f16", 3.0, 2), row("d_b f64", 0.0, 0)];
        assert_eq!(
            precision(&rows.iter().collect::<Vec<_>>()),
            "In f32 each of 2 forms gives numbers, at most 67 ulp (8.0×10⁻⁴ %) off but for `d_a f32 device`; in f16 1 of 1 forms gives \
             NaN or infinity where the right result is a number, and what is a number is up to 3.0 ulp (0.29 %) off"
        );
    }

    #[test]
    fn long_numbers_are_cut() {
        assert_eq!(shortened("[0.21741936, 1.9819709e-6, 0.01]"), "[0.2174, 1.982e-6, 0.01]");
        assert_eq!(shortened("n.h = 9.999999974752427e-7, x = 9.999999747378752e-5"), "n.h = 1e-6, x = 1e-4");
        assert_eq!(shortened("roughness 0.5, n = 12.000000001; 1..2"), "roughness 0.5, n = 12; 1..2");
    }

    #[test]
    fn what_domains_share_is_said_once() {
        assert_eq!(
            inputs(&["studio: levels; relative", "sky: levels; relative"]),
            "studio; sky (the worst of them): levels"
        );
        assert_eq!(inputs(&["n.v in 0..1; relative"]), "n.v in 0..1");
        let many = ["a: x; deg", "b: x; deg", "c: x; deg", "d: x; deg", "e: x; deg", "f: x; deg"];
        assert_eq!(inputs(&many), "6 cases from a to f (the worst of them): x");
        assert_eq!(against("all; angle in degrees"), "angle in degrees");
    }

    /// Of what is nearly as fast as the fastest the sentence names the one that errs least.
    #[test]
    fn a_finding_names_a_method_worth_taking() {
        let row = |method: &str, error, cost| Row {
            error_rms: Some(error),
            cost_ns: Some(cost),
            ..Row::new("d", method, "one; relative")
        };
        let rows = [row("good", 0.001, 3.0), row("fair", 0.1, 1.04), row("poor", 0.8, 1.0)];
        let found = |rows: &[Row]| finding(&crate::comparison::comparisons(rows)[0]);
        assert_eq!(found(&rows), "`good` errs least, 0.10 %; `fair` is 2.9 times as fast but errs 10 %");
        // Nobody is 1.0 times as fast.
        let rows = [row("good", 0.001, 1.04), row("poor", 0.8, 1.0)];
        assert_eq!(found(&rows), "`good` errs least, 0.10 %, and nothing is much cheaper");
        // What the rows' own spread tells apart is no noise, and what it does not is.
        let of = |spread| {
            let rows = [row("good", 0.001, 8.4), row("report", 0.8, 7.6)];
            rows.map(|row| Row { cost_spread: Some(spread), ..row })
        };
        assert_eq!(found(&of(0.001)), "`good` errs least, 0.10 %, and nothing is much cheaper");
        assert_eq!(found(&of(0.15)), "`good` errs least, 0.10 %, and nothing is cheaper beyond the spread");
        let rows = [row("least", 0.24, 2.0), row("next", 0.246, 1.05), row("poor", 0.8, 1.04)];
        assert_eq!(
            found(&rows),
            "`next` errs 25 %, next to the least there is, and nothing is cheaper beyond the spread"
        );
    }
}
