//! A small reader of comma-separated values that says where what is wrong.

use std::fmt;

/// What is wrong with a table, and where.
#[derive(Debug)]
pub(crate) struct Problem {
    /// Line of the file, from 1; 0 for the file as a whole.
    line: usize,
    /// Name of the column, where it is one.
    column: Option<String>,
    what: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}: ", self.line)?;
        }
        if let Some(column) = &self.column {
            write!(f, "column `{column}`: ")?;
        }
        f.write_str(&self.what)
    }
}

/// A table with a header line, as text.
pub(crate) struct Table {
    header: Vec<String>,
    /// Number of the line in the file, and its cells.
    rows: Vec<(usize, Vec<String>)>,
}

impl Table {
    /// Reads a table; empty lines are passed over.
    pub(crate) fn parse(text: &str) -> Result<Table, Problem> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let (_, header) = lines.next().ok_or_else(|| Problem {
            line: 0,
            column: None,
            what: "the file is empty; its first line names the columns".into(),
        })?;
        let header = cells(1, header)?;
        let mut rows = Vec::new();
        for (index, line) in lines {
            let row = cells(index + 1, line)?;
            if row.len() != header.len() {
                let what = format!("{} cells, but the header names {} columns", row.len(), header.len());
                return Err(Problem { line: index + 1, column: None, what });
            }
            rows.push((index + 1, row));
        }
        Ok(Table { header, rows })
    }

    /// Place of a column.
    pub(crate) fn column(&self, name: &str) -> Result<usize, Problem> {
        self.header.iter().position(|h| h == name).ok_or_else(|| Problem {
            line: 1,
            column: Some(name.into()),
            what: format!("there is no such column; the columns are {}", self.header.join(", ")),
        })
    }

    /// The rows: each cell by its column.
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|(line, cells)| Row { table: self, line: *line, cells })
    }
}

/// A row of a table.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    table: &'a Table,
    line: usize,
    cells: &'a [String],
}

impl<'a> Row<'a> {
    /// A cell as it is.
    pub(crate) fn text(self, column: usize) -> &'a str {
        &self.cells[column]
    }

    /// A cell as a finite number.
    pub(crate) fn number(self, column: usize) -> Result<f64, Problem> {
        let problem = |what: String| Problem { line: self.line, column: Some(self.table.header[column].clone()), what };
        let text = self.text(column).trim();
        let number: f64 = text.parse().map_err(|_| problem(format!("`{text}` is not a number")))?;
        if number.is_finite() { Ok(number) } else { Err(problem(format!("`{text}` is not a finite number"))) }
    }

    /// A problem of this row.
    pub(crate) fn problem(self, what: String) -> Problem {
        Problem { line: self.line, column: None, what }
    }
}

/// The cells of a line; a cell in double quotes may hold commas and doubled quotes.
fn cells(line: usize, text: &str) -> Result<Vec<String>, Problem> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        let cell = cells.last_mut().expect("one cell at least");
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cell.push(c),
        }
    }
    if quoted {
        return Err(Problem { line, column: None, what: "a double quote is opened and not closed".into() });
    }
    Ok(cells)
}
