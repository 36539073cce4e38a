//! Rows as text.

use crate::Row;

/// The report as one JSON object: `{"schema": 1, "machine": ..., "rows": [...]}`.
pub fn json(machine: &str, rows: &[Row]) -> serde_json::Value {
    serde_json::json!({ "schema": 1, "machine": machine, "rows": rows })
}

/// The rows as CSV, with a line of names; a figure that does not apply is empty.
pub fn csv(rows: &[Row]) -> String {
    let mut text =
        "term,method,domain,error_max,error_rms,at,cost_ns,cost_batch_ns,instructions,gpu_ns,gpu,bytes,pareto\n"
            .to_owned();
    for row in rows {
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:e}"));
        let count = |x: Option<u64>| x.map_or(String::new(), |x| x.to_string());
        let word = |x: &Option<String>| quoted(x.as_deref().unwrap_or(""));
        let fields = [
            quoted(&row.term),
            quoted(&row.method),
            quoted(&row.domain),
            number(row.error_max),
            number(row.error_rms),
            word(&row.at),
            number(row.cost_ns),
            number(row.cost_batch_ns),
            count(row.instructions),
            number(row.gpu_ns),
            word(&row.gpu),
            count(row.bytes),
            row.pareto.to_string(),
        ];
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

/// A field of CSV (RFC 4180): in quotes when it holds a comma, a quote or a line break.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// The machine, in words: processor, cores, operating system.
pub fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        text.lines()
            .find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, name)| name.trim().to_owned()))
    });
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    format!("{}, {cores} cores, {}", cpu.as_deref().unwrap_or(std::env::consts::ARCH), std::env::consts::OS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_with_commas_stays_one_field() {
        let row = Row { at: Some("n.v = 0, \"floor\"".into()), error_max: Some(0.5), ..Row::new("d", "ggx", "a, b") };
        let text = csv(std::slice::from_ref(&row));
        assert_eq!(text.lines().nth(1), Some("d,ggx,\"a, b\",5e-1,,\"n.v = 0, \"\"floor\"\"\",,,,,,,false"));
        let back: Row =
            serde_json::from_value(json("here", std::slice::from_ref(&row))["rows"][0].clone()).expect("a row");
        assert_eq!(back, row);
    }
}
