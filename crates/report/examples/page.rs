//! Writes the page of a report that was measured before: to look at wording and plots without another run.
//!
//! ```sh
//! cargo run -p halfvector-report --example page -- docs/accuracy.json out/page.html
//! ```

use halfvector_report::{Report, page};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(report), Some(target)) = (arguments.next(), arguments.next()) else {
        return Err("usage: page REPORT.json PAGE.html".into());
    };
    let report = Report::from_json(&std::fs::read_to_string(report)?)?;
    std::fs::write(target, page::html(&report))?;
    Ok(())
}
