//! The tables that the example `evaluate` refuses, and what it says.

#[path = "../../examples/evaluate/table.rs"]
mod table;

use table::Table;

/// Reads one number of a table, or says why not.
fn number(text: &str, column: &str) -> Result<f64, String> {
    let table = Table::parse(text).map_err(|e| e.to_string())?;
    let column = table.column(column).map_err(|e| e.to_string())?;
    let row = table.rows().next().ok_or("no row")?;
    row.number(column).map_err(|e| e.to_string())
}

#[test]
fn numbers_are_read() {
    assert_eq!(number("\u{feff}id,roughness\r\n\r\n\"a,\"\"b\", 0.5 \r\n", "roughness"), Ok(0.5));
    let table = Table::parse("id,x\n\"a,\"\"b\",1\n").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(table.rows().next().map(|r| r.text(0)), Some("a,\"b"));
    let row = table.rows().next().expect("a row");
    assert_eq!(row.problem("too long".into()).to_string(), "line 2: too long");
}

#[test]
fn errors_say_where() {
    let cases = [
        ("", "x", "the file is empty; its first line names the columns"),
        ("id,y\n1,2\n", "x", "line 1: column `x`: there is no such column; the columns are id, y"),
        ("id,x\n1,2\n1\n", "x", "line 3: 1 cells, but the header names 2 columns"),
        ("id,x\n\n1,zwei\n", "x", "line 3: column `x`: `zwei` is not a number"),
        ("id,x\n1,inf\n", "x", "line 2: column `x`: `inf` is not a finite number"),
        ("id,x\n1,\"2\n", "x", "line 2: a double quote is opened and not closed"),
    ];
    for (text, column, message) in cases {
        assert_eq!(number(text, column), Err(message.to_string()));
    }
}
