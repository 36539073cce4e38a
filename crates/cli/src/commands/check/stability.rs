//! What `check --stability` found, as tables for people and as JSON.

use std::path::{Path, PathBuf};

use halfvector_reference::{Edge, Finding, Precision, Stability};
use halfvector_scene::{Scene, SceneMaterial};
use serde_json::{Map, Value, json};

/// What was found in a file.
pub(super) struct Judged {
    pub(super) file: PathBuf,
    single: Stability,
    /// The same in f16, where that was asked for.
    half: Option<Stability>,
}

impl Judged {
    /// Runs a material's nodes in f32 and f64, and in f16 where that is asked for.
    pub(super) fn new(file: &Path, material: &SceneMaterial, f16: bool) -> Result<Judged, String> {
        let mut scene = Scene { materials: vec![material.clone()], ..Scene::default() };
        scene.load_images().map_err(|error| error.to_string())?;
        let judge =
            |precision| halfvector_reference::stability(&scene, 0, precision).map_err(|error| error.to_string());
        let half = f16.then(|| judge(Precision::Half)).transpose()?;
        Ok(Judged { file: file.to_owned(), single: judge(Precision::Single)?, half })
    }

    /// Whether any arithmetic gets something wrong.
    pub(super) fn is_unstable(&self) -> bool {
        std::iter::once(&self.single).chain(&self.half).any(|stability| !stability.unstable.is_empty())
    }

    /// The tables; none where nothing was found.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for (number, stability) in std::iter::once(("f32", &self.single)).chain(self.half.iter().map(|s| ("f16", s))) {
            if !stability.unstable.is_empty() {
                lines.push(format!("{}: unstable in {number}:", self.file.display()));
                lines.extend(unstable_table(number, &stability.unstable));
            }
            if !stability.edges.is_empty() {
                lines.push(format!("{}: edges, where {number} may take the other side:", self.file.display()));
                lines.extend(edge_table(&stability.edges));
            }
        }
        lines
    }
}

/// Writes the lists `unstable` and `edges` of f32, and of f16 in an object of that name where that was asked for.
pub(super) fn json(judged: &[Judged], f16: bool, result: &mut Value) {
    let all = |number: &str, of: fn(&Judged) -> Option<&Stability>, result: &mut Value| {
        let found = || judged.iter().filter_map(|j| Some((j.file.as_path(), of(j)?)));
        let unstable = found().flat_map(|(file, s)| s.unstable.iter().map(move |f| finding_json(file, number, f)));
        result["unstable"] = unstable.collect();
        result["edges"] = found().flat_map(|(file, s)| s.edges.iter().map(move |e| edge_json(file, e))).collect();
    };
    all("f32", |judged| Some(&judged.single), result);
    if f16 {
        all("f16", |judged| judged.half.as_ref(), &mut result["f16"]);
    }
}

/// A row for each node, and lines with where and what else.
fn unstable_table(number: &str, findings: &[Finding]) -> Vec<String> {
    let mut rows = vec![(
        ["node", "output", number, "exact", "apart", "NaN", "infinite", "underflows"].map(str::to_owned).to_vec(),
        Vec::new(),
    )];
    for finding in findings {
        let Finding { node, label, output, narrow, exact, input, nan, infinite, underflows, beyond_f16, behind } =
            finding;
        let apart = if finding.error().is_finite() { format!("{:.2e}", finding.error()) } else { "-".to_owned() };
        let mut cells = vec![format!("`{label}`"), format!("{node}.{output}"), short(*narrow), short(*exact), apart];
        cells.extend([nan, infinite, underflows].map(usize::to_string));
        let mut below = vec![place(input)];
        if *beyond_f16 > 0 {
            below.push(format!("beyond f16's range at {beyond_f16} points"));
        }
        if !behind.is_empty() {
            below.push(format!("wrong behind it, and not judged by themselves: {}", behind.join(", ")));
        }
        rows.push((cells, below));
    }
    table(&rows)
}

fn edge_table(edges: &[Edge]) -> Vec<String> {
    let mut rows = vec![(["node", "output", "from", "to"].map(str::to_owned).to_vec(), Vec::new())];
    for Edge { node, label, output, from, to, input } in edges {
        let cells = vec![format!("`{label}`"), format!("{node}.{output}"), short(*from), short(*to)];
        rows.push((cells, vec![place(input)]));
    }
    table(&rows)
}

/// Columns as wide as their widest cell; what stands below a row is indented.
fn table(rows: &[(Vec<String>, Vec<String>)]) -> Vec<String> {
    let columns = rows.first().map_or(0, |(cells, _)| cells.len());
    let width = |column: usize| rows.iter().map(|(cells, _)| cells[column].chars().count()).max().unwrap_or_default();
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut lines = Vec::new();
    for (cells, below) in rows {
        let cells: Vec<String> = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        lines.push(format!("  {}", cells.join("  ")).trim_end().to_owned());
        lines.extend(below.iter().map(|line| format!("    {line}")));
    }
    lines
}

/// Where: numbers as f32 has them.
fn place(input: &[(String, f64)]) -> String {
    if input.is_empty() {
        return "whatever the point".to_owned();
    }
    let place: Vec<String> = input.iter().map(|(name, x)| format!("{name} = {}", *x as f32)).collect();
    format!("at {}", place.join(", "))
}

/// Nine digits.
fn short(x: f64) -> String {
    let rounded = format!("{x:.8e}").parse().unwrap_or(x);
    if x == 0.0 || !x.is_finite() || (1e-4..1e9).contains(&x.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

fn finding_json(file: &Path, number: &str, finding: &Finding) -> Value {
    let Finding { node, label, output, narrow, exact, input, nan, infinite, underflows, beyond_f16, behind } = finding;
    // JSON has no infinity and no NaN: null.
    json!({
        "file": file.display().to_string(),
        "node": node,
        "node_label": label,
        "output": output,
        number: narrow,
        "f64": exact,
        "error": finding.error(),
        "input": input_json(input),
        "not_finite": nan + infinite,
        "nan": nan,
        "infinite": infinite,
        "underflows": underflows,
        "beyond_f16": beyond_f16,
        "behind": behind,
    })
}

fn edge_json(file: &Path, edge: &Edge) -> Value {
    let Edge { node, label, output, from, to, input } = edge;
    json!({
        "file": file.display().to_string(),
        "node": node,
        "node_label": label,
        "output": output,
        "from": from,
        "to": to,
        "input": input_json(input),
    })
}

fn input_json(input: &[(String, f64)]) -> Map<String, Value> {
    input.iter().map(|(name, x)| (name.clone(), json!(x))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding() -> Finding {
        Finding {
            node: "log".to_owned(),
            label: "Logarithm".to_owned(),
            output: "out.x".to_owned(),
            narrow: f64::NAN,
            exact: 1.25e-12,
            input: vec![("uv0.x".to_owned(), f64::from(0.3_f32))],
            nan: 512,
            infinite: 0,
            underflows: 3,
            beyond_f16: 0,
            behind: vec!["tint".to_owned(), "mask".to_owned()],
        }
    }

    #[test]
    fn a_finding_is_a_row_and_lines_below() {
        let lines = unstable_table("f32", &[finding()]);
        assert_eq!(
            lines,
            [
                "  node         output     f32  exact     apart  NaN  infinite  underflows",
                "  `Logarithm`  log.out.x  NaN  1.25e-12  -      512  0         3",
                "    at uv0.x = 0.3",
                "    wrong behind it, and not judged by themselves: tint, mask",
            ]
        );
        let everywhere = Finding { input: Vec::new(), behind: Vec::new(), beyond_f16: 2, ..finding() };
        let lines = unstable_table("f32", &[everywhere]);
        assert_eq!(lines[2..], ["    whatever the point", "    beyond f16's range at 2 points"]);
    }

    #[test]
    fn an_edge_has_both_sides() {
        let edge = Edge {
            node: "checker".to_owned(),
            label: "Checker".to_owned(),
            output: "out".to_owned(),
            from: 0.0,
            to: 1.0,
            input: vec![("uv0.y".to_owned(), 0.5)],
        };
        let expected =
            ["  node       output       from  to", "  `Checker`  checker.out  0     1", "    at uv0.y = 0.5"];
        assert_eq!(edge_table(&[edge]), expected);
    }
}
