//! Reading tables of numbers, such as reference data.
//!
//! A table is text with one row per line, cells separated by commas (or semicolons, or tabs, whichever the first line
//! uses). Blank lines and lines starting with `#` are skipped, spaces around cells ignored. The first line names the
//! columns, with a unit in brackets if known: `time[s]`; if it holds only numbers, the columns are named `column1`,
//! `column2`, ….

use std::fs;
use std::path::Path;

use crate::error::{IoError, Result};

/// Named columns of equal length.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// In the order of the file.
    pub columns: Vec<TableColumn>,
}

/// One column of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// Name without the unit.
    pub name: String,
    /// Text in brackets; empty if there was none.
    pub unit: String,
    /// One value per row.
    pub values: Vec<f64>,
}

impl Table {
    /// The values under `name`, given with or without its unit.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let found = self.columns.iter().find(|c| c.answers_to(name));
        found.map(|c| c.values.as_slice())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }
}

impl TableColumn {
    fn named(heading: &str) -> Self {
        let (name, unit) = heading
            .strip_suffix(']')
            .and_then(|h| h.split_once('['))
            .unwrap_or((heading, ""));
        Self {
            name: name.trim().into(),
            unit: unit.trim().into(),
            values: Vec::new(),
        }
    }

    fn answers_to(&self, name: &str) -> bool {
        let asked = Self::named(name.trim());
        asked.name == self.name && (asked.unit.is_empty() || asked.unit == self.unit)
    }
}

/// Reads all columns of `path`; every cell must be a number.
pub fn read_table(path: impl AsRef<Path>) -> Result<Table> {
    let path = path.as_ref();
    parse(&text(path)?, path, None)
}

/// Reads only the columns `names` of `path`, in that order; cells of other columns may hold anything or nothing.
pub fn read_columns(path: impl AsRef<Path>, names: &[&str]) -> Result<Table> {
    let path = path.as_ref();
    parse(&text(path)?, path, Some(names))
}

/// Most columns of a table.
const COLUMNS: usize = 10_000;

impl Table {
    /// Reads all columns of a text; `name` is its name in errors.
    ///
    /// # Errors
    /// The line and the column that hold no number.
    pub fn parse(text: &str, name: &str) -> Result<Self> {
        parse(text, Path::new(name), None)
    }
}

fn text(path: &Path) -> Result<String> {
    let bytes = fs::read(path).map_err(|e| IoError::read(path, e))?;
    String::from_utf8(bytes).map_err(|e| {
        let before = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|b| **b == b'\n').count();
        let begun = before.rsplit(|b| *b == b'\n').next().unwrap_or_default();
        let column = 1 + String::from_utf8_lossy(begun).chars().count();
        let problem = format!("this is no UTF-8 text (column {column})");
        IoError::Table(path.into(), line, problem)
    })
}

fn parse(text: &str, path: &Path, names: Option<&[&str]>) -> Result<Table> {
    let fault = |line: usize, problem: String| IoError::Table(path.into(), line, problem);
    let text = text.trim_start_matches('\u{feff}');
    let lines = text.lines().enumerate().map(|(i, l)| (i + 1, l.trim()));
    let mut lines = lines.filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
    let none = || fault(1, "the table has no rows".into());
    let (line, first) = lines.next().ok_or_else(none)?;
    let separator = [',', ';', '\t'].into_iter().find(|&c| first.contains(c));
    let separator = separator.unwrap_or(',');
    let cells = split(first, separator);
    if cells.len() > COLUMNS {
        return Err(fault(line, format!("more than {COLUMNS} columns")));
    }
    let bare = cells.iter().all(|c| c.parse::<f64>().is_ok());
    let numbered = |(i, cell): (usize, &String)| match bare {
        true => TableColumn::named(&format!("column{}", i + 1)),
        false => TableColumn::named(cell),
    };
    let headings: Vec<TableColumn> = cells.iter().enumerate().map(numbered).collect();
    let place = |name: &&str| {
        let found = headings.iter().position(|h| h.answers_to(name));
        found.ok_or_else(|| {
            let known: Vec<&str> = headings.iter().map(|h| h.name.as_str()).collect();
            let known = known.join("`, `");
            fault(line, format!("no column `{name}`, there are `{known}`"))
        })
    };
    let chosen: Vec<usize> = match names {
        Some(names) => names.iter().map(place).collect::<Result<_>>()?,
        None => (0..headings.len()).collect(),
    };
    let mut columns: Vec<_> = chosen.iter().map(|&i| headings[i].clone()).collect();
    for (line, row) in bare.then_some((line, first)).into_iter().chain(lines) {
        let cells = split(row, separator);
        let (found, wanted) = (cells.len(), headings.len());
        if found != wanted {
            let more = if found > COLUMNS { "more than " } else { "" };
            let found = found.min(COLUMNS);
            let problem = format!("{more}{found} cells for {wanted} columns");
            return Err(fault(line, problem));
        }
        for (&i, column) in chosen.iter().zip(&mut columns) {
            let (cell, number, name) = (&cells[i], i + 1, &column.name);
            let value = cell.parse().map_err(|_| match cell.as_str() {
                "" => fault(line, format!("column {number} `{name}` is empty")),
                _ => {
                    let problem = format!("column {number} `{name}` is not a number but `{cell}`");
                    fault(line, problem)
                }
            })?;
            column.values.push(value);
        }
    }
    Ok(Table { columns })
}

/// The trimmed cells of `row`, of more than [`COLUMNS`] one more than these; separators between double quotes do
/// not count.
fn split(row: &str, separator: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in row.chars() {
        if c == '"' {
            quoted = !quoted;
        } else if c == separator && !quoted {
            if cells.len() > COLUMNS {
                break;
            }
            cells.push(String::new());
        } else if let Some(cell) = cells.last_mut() {
            cell.push(c);
        }
    }
    for cell in &mut cells {
        *cell = cell.trim().into();
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, names: Option<&[&str]>) -> Result<Table> {
        parse(text, Path::new("ref.csv"), names)
    }

    fn complaint(text: &str) -> String {
        read(text, None).unwrap_err().to_string()
    }

    #[test]
    fn comments_spaces_units_and_line_ends_are_understood() {
        let text =
            "\u{feff}# source\r\n time [s] , p[Pa]\r\n\r\n 0.0, 1e3 \r\n# mid\r\n0.5 ,-2\r\n";
        let table = read(text, None).unwrap();
        assert_eq!(table.column("time"), Some(&[0.0, 0.5][..]));
        assert_eq!(table.column("p[Pa]"), Some(&[1e3, -2.0][..]));
        assert_eq!(table.column("p[kPa]"), None);
        assert_eq!(table.columns[0].unit, "s");
    }

    #[test]
    fn a_missing_header_and_other_separators_are_accepted() {
        let table = read("0;1\n2;3\n", None).unwrap();
        assert_eq!(table.column("column2"), Some(&[1.0, 3.0][..]));
        assert_eq!(read("a\tb\n0\t1", None).unwrap().rows(), 1);
    }

    #[test]
    fn only_the_columns_asked_for_need_be_numbers() {
        let text = "Re,study,St\n100,\"Tom, Dick\",0.16\n200,,0.19\n";
        let table = read(text, Some(&["St", "Re"])).unwrap();
        assert_eq!(table.columns[0].values, [0.16, 0.19]);
        assert_eq!(table.columns[1].values, [100.0, 200.0]);
        let error = read(text, Some(&["Cd"])).unwrap_err().to_string();
        let named = error.contains("`Cd`") && error.contains("`study`");
        assert!(named, "{error}");
    }

    #[test]
    fn errors_name_file_line_and_column() {
        let empty = complaint("# c\nt,p\n0,1\n2,\n");
        assert_eq!(empty, "ref.csv, line 4: column 2 `p` is empty");
        let word = complaint("t,p\nx,1\n");
        let wanted = "ref.csv, line 2: column 1 `t` is not a number but `x`";
        assert_eq!(word, wanted);
        assert!(complaint("t,p\n0,1,2\n").contains("line 2: 3 cells for 2 columns"));
        assert!(complaint("# nothing\n\n").contains("no rows"));
        let absent = read_table("/no/such/file.csv").unwrap_err();
        assert!(matches!(absent, IoError::Read(..)));
    }
}
