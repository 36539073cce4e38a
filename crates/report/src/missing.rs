//! Why rows and figures are not there: what a part left out, and for each part, term and figure of which a row has none, one reason. Rows that say more of it have a
//! note of their own.

use serde::{Deserialize, Serialize};

use crate::Row;
use crate::part::levels::NOT_TIMED;
use crate::part::shaders;

/// Why some rows of a part and term have no figure of a kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Null {
    /// The rows' part.
    pub part: String,
    /// Their term.
    pub term: String,
    /// The figure's name in a row.
    pub figure: String,
    /// The reason.
    pub why: String,
}

/// What a part did not measure, of which there are no rows that could say so.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// The part.
    pub part: String,
    /// What of it: an example's name, `an example, a method`, or [`DEVICE`]; none where it is the whole part.
    pub what: Option<String>,
    /// The reason.
    pub why: String,
}

/// What is left out where no device was found.
pub const DEVICE: &str = "device";

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.what {
            Some(what) => write!(f, "{}: {what}: {}", self.part, self.why),
            None => write!(f, "{}: {}", self.part, self.why),
        }
    }
}

/// Whether a row lacks a figure.
type Lacks = fn(&Row) -> bool;

/// Figures that one would look for in every row.
const FIGURES: [(&str, Lacks); 8] = [
    ("error_rms", |row| row.error_rms.is_none()),
    ("error_max", |row| row.error_max.is_none()),
    ("at", |row| row.at.is_none()),
    ("cost_ns", |row| row.cost_ns.is_none()),
    ("cost_batch_ns", |row| row.cost_batch_ns.is_none()),
    ("instructions", |row| row.instructions.is_none()),
    ("gpu_ns", |row| row.gpu_ns.is_none()),
    ("bytes", |row| row.bytes.is_none()),
];

/// Whether a run has a device, as far as it is known.
#[derive(Clone, Copy, PartialEq)]
enum Device {
    /// Something was measured on one.
    Found,
    /// It was looked for.
    NotFound,
    /// No part that needs one was measured.
    NotSought,
}

/// The reasons for all rows, in the order of the rows; the same reason for the same part, term and figure once. `left_out` says whether
/// a device was looked for in vain.
pub fn nulls(rows: &[Row], left_out: &[LeftOut]) -> Vec<Null> {
    let device = if rows.iter().any(|row| row.gpu.is_some()) {
        Device::Found
    } else if left_out.iter().any(|left| left.what.as_deref() == Some(DEVICE)) {
        Device::NotFound
    } else {
        Device::NotSought
    };
    let mut found: Vec<Null> = Vec::new();
    for row in rows {
        for (figure, _) in FIGURES.iter().filter(|(_, is_null)| is_null(row)) {
            let null = Null {
                part: row.part.clone(),
                term: row.term.clone(),
                figure: (*figure).to_owned(),
                why: why(row, figure, device).to_owned(),
            };
            if !found.contains(&null) {
                found.push(null);
            }
        }
    }
    found
}

/// The names of the figures that a row has not.
pub fn of(row: &Row) -> Vec<&'static str> {
    FIGURES.iter().filter(|(_, is_null)| is_null(row)).map(|(figure, _)| *figure).collect()
}

fn why(row: &Row, figure: &str, device: Device) -> &'static str {
    match figure {
        "error_rms" | "error_max" | "at" => no_error(row, figure),
        "cost_ns" | "cost_batch_ns" => no_time(row, figure),
        "instructions" | "gpu_ns" => no_shader(row, figure, device),
        _ => match row.part.as_str() {
            "brdf" | "maps" | "energy" | "mips" | "precision" => {
                "it reads no table, and of maps only what every method reads"
            }
            "shaders" => "what a method reads stands in the rows of its errors",
            _ => "what it reads is not counted",
        },
    }
}

fn no_error(row: &Row, figure: &str) -> &'static str {
    match (row.part.as_str(), row.term.as_str()) {
        ("shaders", _) => "a shader's cost: the errors of the method are rows of their own",
        ("maps", "normal_decode") => "a single texel: its error is the largest one",
        ("pictures", _) if figure == "at" => "no pixel differs, or none by more than the reference's noise",
        ("pictures", _) => "the noise of the reference hides it: error_bound is what it is at most",
        ("precision", _) => "the form in 64 bits is what the others are held against",
        ("ibl", "split_sum") => "the sum over all light is the truth",
        ("peers", _) if figure == "at" && row.error_max.is_some() => "it was not recorded",
        ("peers", _) => "speed or length is compared, at the same work",
        _ => "it has no finite error: the inputs of the row say why",
    }
}

fn no_time(row: &Row, figure: &str) -> &'static str {
    let is_batch = figure == "cost_batch_ns";
    if is_batch && row.note.as_deref() == Some(NOT_TIMED) {
        return NOT_TIMED;
    }
    match (row.part.as_str(), row.term.as_str()) {
        ("shaders", _) => "a shader is counted, and timed on the device",
        ("ibl", "prefilter") => "a bake is timed as a whole, and shared out among its texels in cost_batch_ns",
        ("precision", _) => "its arithmetic is what is looked at",
        ("peers", _) => "a shader is counted, and other work has a time of one kind",
        (_, "normal_frame") => "the methods are timed under the term normal",
        ("energy", "dfg") if !is_batch => "a lookup of any table takes what the row table says",
        _ if is_batch => "it has no form for batches",
        _ => "it is not timed by itself: instructions and gpu_ns are those of a shader with it",
    }
}

fn no_shader(row: &Row, figure: &str, device: Device) -> &'static str {
    match row.part.as_str() {
        "pictures" if row.method == "cpu" => "the processor draws it",
        "precision" | "peers" => "it is no whole shader, or one that was not drawn",
        _ if device == Device::NotFound && figure == "gpu_ns" => "no device was found",
        _ if device == Device::NotSought && figure == "gpu_ns" => {
            "nothing was measured on a device so far: the parts shaders and pictures do it"
        }
        "shaders" if shaders::reads_no_file(row) => "the height map that it reads is no file, so that it is not drawn",
        "shaders" => "the device has no clock, or refused it",
        _ if figure == "gpu_ns" && row.instructions.is_some() => "its shader is not drawn: see the row of part shaders",
        "maps" | "brdf" | "energy" | "mips" | "ibl" | "lobes" | "specular_aa" => {
            "no shader has it, or the part shaders was not measured: it is chosen in the library, or by a bake"
        }
        _ => "it was not measured",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_null_has_a_reason_and_each_is_told_once() {
        let row = |method: &str| Row {
            part: "brdf".into(),
            cost_ns: Some(1.0),
            error_rms: Some(0.1),
            ..Row::new("d", method, "all")
        };
        let rows = [row("a"), row("b")];
        let found = nulls(&rows, &[]);
        let figures: Vec<&str> = found.iter().map(|null| null.figure.as_str()).collect();
        assert_eq!(figures, ["error_max", "at", "cost_batch_ns", "instructions", "gpu_ns", "bytes"]);
        assert_eq!(of(&rows[0]), figures);
        assert!(found.iter().all(|null| !null.why.is_empty()));
    }

    /// A run of parts that need no device does not say that there is none.
    #[test]
    fn a_device_that_was_not_sought_is_not_missed() {
        let rows = [Row { part: "brdf".into(), ..Row::new("d", "a", "all") }];
        let why = |left_out: &[LeftOut]| {
            let found = nulls(&rows, left_out).into_iter().find(|null| null.figure == "gpu_ns");
            found.expect("a reason").why
        };
        assert!(why(&[]).starts_with("nothing was measured on a device"), "{}", why(&[]));
        let left = LeftOut { part: "shaders".into(), what: Some(DEVICE.into()), why: "none was found".into() };
        assert_eq!(why(&[left]), "no device was found");
    }
}
