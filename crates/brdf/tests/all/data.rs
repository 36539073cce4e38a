//! Tables of numbers from the folder of truth data, where there is one.

use std::path::PathBuf;

/// A table of comma-separated values with a header line.
pub(crate) struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// One row of a table, by column name.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    table: &'a Table,
    cells: &'a [String],
}

impl Table {
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row { table: self, cells })
    }
}

impl<'a> Row<'a> {
    pub(crate) fn text(self, column: &str) -> &'a str {
        let index = self.table.header.iter().position(|h| h == column).expect("a column of the table");
        &self.cells[index]
    }

    pub(crate) fn number(self, column: &str) -> f64 {
        self.text(column).parse().expect("a number")
    }
}

/// The table `brdf/<name>` of `$HALFVECTOR_DATA` (by default `../shared/data` beside the project), or `None` and a
/// printed line where it is not there.
pub(crate) fn table(name: &str) -> Option<Table> {
    let folder = std::env::var_os("HALFVECTOR_DATA")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let path = folder.join("brdf").join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: no {}", path.display());
        return None;
    };
    Some(parse(&text))
}

/// The points of the BRDF's truth: the few that stand in this package, and all where there is the folder of truth data.
pub(crate) fn points() -> Vec<Table> {
    let own = parse(include_str!("../data/brdf_points.csv"));
    [Some(own), table("brdf_points_shared.csv")].into_iter().flatten().collect()
}

fn parse(text: &str) -> Table {
    let mut lines = text.lines().map(cells);
    let header = lines.next().expect("a header line");
    Table { header, rows: lines.collect() }
}

/// The cells of a line; a cell in double quotes may hold commas.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("one at least").push(c),
        }
    }
    cells
}
