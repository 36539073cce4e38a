//! Numbers and findings in words: what a plot shows, said from its data.

use crate::comparison::{Budget, Comparison, Cost, Entry, Unit};

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

/// An error with its unit: 13 %, 5.1×10⁻⁸, 12°.
pub fn error(x: f64, unit: Unit) -> String {
    match unit {
        Unit::Relative if x >= 1e-4 => format!("{} %", number(100.0 * x)),
        Unit::Degrees => format!("{}°", number(x)),
        Unit::Ulps => format!("{} ulp", number(x)),
        Unit::Relative | Unit::Plain => number(x),
    }
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
    let front = comparison.entries.iter().filter(|entry| entry.front);
    let cheapest = front.min_by(|a, b| a.cost.total_cmp(&b.cost)).unwrap_or(best);
    if std::ptr::eq(cheapest, best) {
        return format!("`{name}` {errs}, and nothing is cheaper");
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

/// A text with its long numbers cut to four digits that count: 0.21741936 is 0.2174.
pub fn shortened(text: &str) -> String {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(is_part) {
        let end = rest[start..].find(|c| !is_part(c)).map_or(rest.len(), |length| start + length);
        let word = &rest[start..end];
        out.push_str(&rest[..start]);
        match word.parse::<f64>() {
            Ok(x) if word.len() > 7 && word.contains('.') && x > 0.0 => {
                let digits = (3.0 - x.log10().floor()).clamp(0.0, 12.0) as usize;
                let short = format!("{x:.digits$}");
                out.push_str(short.trim_end_matches('0').trim_end_matches('.'));
            }
            _ => out.push_str(word),
        }
        rest = &rest[end..];
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_two_digits() {
        let texts = [0.0, 0.9, 0.0131, 3.44, 42.4, 8100.0, 20649.0, 4.9e-8, 1.6e7].map(number);
        assert_eq!(
            texts,
            ["0", "0.90", "0.013", "3.4", "42", "8100", "20\u{202f}649", "4.9×10⁻⁸", "1.6×10⁷"].map(str::to_owned)
        );
        assert_eq!(error(0.134, Unit::Relative), "13 %");
        assert_eq!(error(12.3, Unit::Degrees), "12°");
        assert_eq!(cost(16_773_120.0, Cost::Bytes), "17 MB");
    }

    #[test]
    fn long_numbers_are_cut() {
        assert_eq!(shortened("[0.21741936, 1.9819709e-6, 0.01]"), "[0.2174, 1.982e-6, 0.01]");
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
}
