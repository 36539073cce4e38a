//! Rows as text, and what is known of the machine and the day.

use crate::Row;

/// How the first line of every report's CSV begins.
const HEAD: &str = "term,method,domain,error_max";

/// Whether a line is the first one of a CSV that a report wrote.
pub fn is_csv_head(line: &str) -> bool {
    line.starts_with(HEAD)
}

/// The rows as CSV, with a line of names; a figure that does not apply is empty.
pub fn csv(rows: &[Row]) -> String {
    let mut text =
        "term,method,domain,error_max,error_rms,error_bound,points,searched,at,flip,not_finite,first_failure,cost_ns,cost_spread,cost_batch_ns,cost_batch_spread,yardstick_ns,instructions,\
         gpu_ns,gpu_spread,gpu,bytes,note,recorded,pareto\n"
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
            number(row.error_bound),
            count(row.points),
            if row.searched { "true".to_owned() } else { String::new() },
            word(&row.at),
            number(row.flip),
            count(row.not_finite),
            word(&row.first_failure),
            number(row.cost_ns),
            number(row.cost_spread),
            number(row.cost_batch_ns),
            number(row.cost_batch_spread),
            number(row.yardstick_ns),
            count(row.instructions),
            number(row.gpu_ns),
            number(row.gpu_spread),
            word(&row.gpu),
            count(row.bytes),
            word(&row.note),
            word(&row.recorded),
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

/// The day, UTC: 2026-05-31.
pub fn today() -> String {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    day(now.as_secs() / 86_400)
}

/// The date of a day after 1970-01-01. Howard Hinnant 2013, "chrono-Compatible Low-Level Date Algorithms": eras of 400
/// years that begin in March, so that the leap day is a year's last.
fn day(since_1970: u64) -> String {
    let days = since_1970 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = 400 * era + year_of_era + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_with_commas_stays_one_field() {
        let row = Row { at: Some("n.v = 0, \"floor\"".into()), error_max: Some(0.5), ..Row::new("d", "ggx", "a, b") };
        let text = csv(std::slice::from_ref(&row));
        assert_eq!(
            text.lines().nth(1),
            Some("d,ggx,\"a, b\",5e-1,,,,,\"n.v = 0, \"\"floor\"\"\",,,,,,,,,,,,,,,,false")
        );
        let columns = |line: usize| {
            text.lines().nth(line).map(|line| line.replace("a, b", "").replace("0, ", "").split(',').count())
        };
        assert_eq!(columns(0), columns(1));
    }

    #[test]
    fn days_have_their_dates() {
        assert_eq!([0, 11_016, 11_017, 20_603].map(day), ["1970-01-01", "2000-02-29", "2000-03-01", "2026-05-30"]);
    }
}
