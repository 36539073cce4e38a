//! A whole run: its rows, and what has to be known to read them.

use serde::{Deserialize, Serialize};

use crate::faults;
use crate::missing::{self, LeftOut, Null};
use crate::part::shaders;
use crate::{Effort, PARTS, Row, mark_pareto, write};

/// What `report.json` holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Version of this layout: 1.
    pub schema: u32,
    /// Processor, cores, operating system.
    pub machine: String,
    /// The day of the run, UTC: 2026-05-31.
    pub date: String,
    /// How long was measured; errors of different efforts are of different points.
    pub effort: Effort,
    /// Names of the parts that are measured so far.
    pub parts: Vec<String>,
    /// What was measured, part by part. Rows of a part that is not among `parts` are those that were finished when the run was
    /// interrupted.
    pub rows: Vec<Row>,
    /// Why figures of the rows are null.
    #[serde(default)]
    pub nulls: Vec<Null>,
    /// What the parts left out, and why.
    #[serde(default)]
    pub left_out: Vec<LeftOut>,
}

/// The version of the layout.
const SCHEMA: u32 = 1;

/// Words of domains that are others now, so that rows of older reports are known again.
const RENAMED: [(&str, &str); 5] = [
    ("8-bit codes, normals of tilt 0..80 deg; angle to the stored normal in degrees", super::part::DECODED),
    (
        "normals of tilt 0..80 deg, stored with 8 bits a channel where the name says nothing else; angle to the stored normal in degrees",
        super::part::DECODED,
    ),
    ("n.v and n.l logarithmic in 0.01..1, alpha", "n.v and n.l logarithmic in 0.01..1 at any azimuth, alpha"),
    ("n.v and n.l logarithmic in 0.01..1, roughness", "n.v and n.l logarithmic in 0.01..1 at any azimuth, roughness"),
    (
        "n.v and n.l logarithmic in 0.01..1 in one plane with the tangent",
        "n.v and n.l logarithmic in 0.01..1, each at any azimuth from the tangent",
    ),
];

/// Why a text is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Not JSON, or not of this layout.
    #[error("it is not a report: {0}")]
    Layout(#[from] serde_json::Error),
    /// Of a later layout.
    #[error("its layout is version {0}; this program reads version {SCHEMA}")]
    Version(u32),
    /// With what no run can have measured.
    #[error("{0}")]
    Impossible(String),
}

impl Report {
    /// A report of this machine and day, without rows.
    pub fn begun(effort: Effort) -> Report {
        let (machine, date) = (write::machine(), write::today());
        Report {
            schema: SCHEMA,
            machine,
            date,
            effort,
            parts: Vec::new(),
            rows: Vec::new(),
            nulls: Vec::new(),
            left_out: Vec::new(),
        }
    }

    /// Takes the rows of a part in the place of those that it had, and marks which of them no other beats.
    pub fn take(&mut self, part: &str, mut rows: Vec<Row>) {
        self.rows.retain(|row| row.part != part);
        rows.iter_mut().for_each(|row| part.clone_into(&mut row.part));
        let first = self.rows.len();
        self.rows.append(&mut rows);
        shaders::share(&mut self.rows);
        mark_pareto(&mut self.rows[first..]);
        self.nulls = missing::nulls(&self.rows, &self.left_out);
    }

    /// Takes what a part left out in the place of what was said of it before.
    pub fn leave_out(&mut self, part: &str, left_out: Vec<LeftOut>) {
        self.left_out.retain(|left| left.part != part);
        self.left_out.extend(left_out);
        self.nulls = missing::nulls(&self.rows, &self.left_out);
    }

    /// The rows of a part.
    pub fn rows_of(&self, part: &str) -> Vec<Row> {
        self.rows.iter().filter(|row| row.part == part).cloned().collect()
    }

    /// The parts of which a term's choice wants more than there is: those that were not measured to their end, and that of the
    /// shaders where the term has some.
    pub fn unfinished(&self, term: &str) -> Vec<&str> {
        let is_whole = |part: &str| self.parts.iter().any(|name| name == part);
        let of_term = |part: &str| self.rows.iter().any(|row| row.term == term && row.part == part);
        let wants = |part: &str| of_term(part) || (part == shaders::PART && shaders::has(term));
        PARTS.iter().map(|part| part.name).filter(|part| wants(part) && !is_whole(part)).collect()
    }

    /// Reads `report.json`.
    ///
    /// # Errors
    ///
    /// When the text is not JSON of this layout, or holds what no run can have measured.
    pub fn from_json(text: &str) -> Result<Report, ReportError> {
        let mut report: Report = serde_json::from_str(text)?;
        if report.schema != SCHEMA {
            return Err(ReportError::Version(report.schema));
        }
        for row in &mut report.rows {
            for (before, now) in RENAMED {
                row.domain = row.domain.replace(before, now);
            }
        }
        match faults::first(&report) {
            Some(fault) => Err(ReportError::Impossible(fault)),
            None => Ok(report),
        }
    }

    /// The text of `report.json`, one row a line, so that two of them can be compared by eye. Numbers that JSON cannot hold
    /// (an infinite error) are null.
    pub fn to_json(&self) -> String {
        let rows: Vec<String> = self.rows.iter().map(|row| serde_json::json!(row).to_string()).collect();
        let Report { schema, machine, date, effort, parts, nulls, left_out, .. } = self;
        let head = serde_json::json!({
            "schema": schema, "machine": machine, "date": date, "effort": effort, "parts": parts, "nulls": nulls,
            "left_out": left_out, "rows": []
        });
        head.to_string().replacen("\"rows\":[]}", &format!("\"rows\":[\n{}\n]}}\n", rows.join(",\n")), 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_survives_its_file() {
        let mut report = Report::begun(Effort::Quick);
        report.rows.push(Row { error_rms: Some(0.5), at: Some("n.v = 0".into()), ..Row::new("d", "ggx", "all") });
        assert_eq!(Report::from_json(&report.to_json()).expect("the same layout"), report);
        let why = "no such file".to_owned();
        report.left_out.push(LeftOut { part: "pictures".into(), what: Some("helmet.scene".into()), why });
        assert_eq!(Report::from_json(&report.to_json()).expect("the same layout"), report);
        report.schema = 2;
        let error = Report::from_json(&report.to_json()).expect_err("a later layout");
        assert_eq!(error.to_string(), "its layout is version 2; this program reads version 1");
        Report::from_json("{}").expect_err("no report");
        report.schema = 1;
        for (before, now) in RENAMED {
            report.rows = vec![Row::new("normal_decode", "unorm", before)];
            assert_eq!(Report::from_json(&report.to_json()).expect("a report").rows[0].domain, now);
            report.rows = vec![Row::new("normal_decode", "unorm", now)];
            assert_eq!(Report::from_json(&report.to_json()).expect("a report").rows[0].domain, now);
        }
    }
}
