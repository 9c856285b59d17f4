//! Text files of two columns of numbers, their heads, and which columns of a file count.

use std::path::Path;

use scene_text::{decoded, read_bytes};
use sph_core::{suggestion, unit_factor};

use crate::Line;

/// Longest text file, bytes.
const BYTES: u64 = 64 << 20;
/// Most rows of a file, and most blocks of them: their readers take fewer.
const ROWS: usize = 4_000_000;
const BLOCKS: usize = 200_000;
/// Most columns of a file of which some are chosen.
const COLUMNS: usize = 1_000;

/// Two numbers and the line they stand in, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row {
    pub line: usize,
    pub values: [f64; 2],
}

/// The text of a file of UTF-8 that is neither empty nor too long.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    decoded(read_bytes(path, BYTES)?).map_err(|(_, line, column)| {
        let name = path.display();
        format!("`{name}`, line {line}: this is no UTF-8 text (column {column})")
    })
}

/// The rows of a file, in blocks separated by blank lines and comments; never none.
pub(crate) fn read(path: &Path, form: &Form) -> Result<Vec<Vec<Row>>, String> {
    named(&text(path)?, &path.display().to_string(), form)
}

/// The same from the text of a file called `name`.
pub(crate) fn named(text: &str, name: &str, form: &Form) -> Result<Vec<Vec<Row>>, String> {
    let blocks = parse(text, form).map_err(|why| format!("`{name}`, {why}"))?;
    match blocks.is_empty() {
        true => Err(format!("`{name}` holds no numbers")),
        false => Ok(blocks),
    }
}

impl Line {
    /// The lines of a table of two columns, one for every block of rows.
    ///
    /// # Errors
    /// If a row is not two finite numbers, or a line has one corner only: the given name, the place, the fault there.
    pub fn from_csv(text: &str, name: &str) -> Result<Vec<Self>, String> {
        lines(text, name, &Form::places(&None, None))
    }
}

/// The lines of the text of a file called `name`: a block of rows is one.
pub(crate) fn lines(text: &str, name: &str, form: &Form) -> Result<Vec<Line>, String> {
    let line = |block: Vec<Row>| {
        let begins = block.first().map_or(0, |row| row.line);
        let points = block.iter().map(|row| row.values).collect();
        let closed = false;
        let tidy = Line { points, closed }.tidied(0.0);
        let why = || format!("`{name}`: the line that begins in line {begins} has one corner only");
        (tidy.points.len() > 1).then_some(tidy).ok_or_else(why)
    };
    named(text, name, form)?.into_iter().map(line).collect()
}

/// Columns are separated by commas, semicolons or blanks; the first line, or the comment before the first row, may
/// name them.
fn parse(text: &str, form: &Form) -> Result<Vec<Vec<Row>>, String> {
    let mut blocks: Vec<Vec<Row>> = Vec::new();
    let (mut begun, mut rows, mut comment) = (false, 0, "");
    let mut chosen: Option<ColumnChoice> = None;
    // A row of millions of columns is not kept.
    let most = form.columns.as_ref().map_or(3, |_| COLUMNS);
    for (k, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let (content, note) = line.split_once('#').unwrap_or((line, ""));
        let content = content.trim();
        if content.is_empty() {
            begun = false;
            if !note.trim().is_empty() {
                comment = note.trim();
            }
            continue;
        }
        let line = k + 1;
        let at_line = |why: String| format!("line {line}: {why}");
        let (fields, columns) = cells(content, most);
        let numbers: Vec<Option<f64>> = fields.iter().map(|f| f.parse().ok()).collect();
        let chosen = match &mut chosen {
            Some(chosen) => chosen,
            none => {
                let named = numbers.iter().all(Option::is_none);
                let said = match named {
                    true => ColumnChoice::from_heads(form, &heads(content)),
                    // A comment may say anything.
                    false => Some(heads(comment))
                        .filter(|heads| heads.len() == columns)
                        .and_then(|heads| ColumnChoice::from_heads(form, &heads).ok())
                        .map_or_else(|| ColumnChoice::from_heads(form, &[]), Ok),
                };
                let first = none.insert(said.map_err(at_line)?);
                if named {
                    continue;
                }
                first
            }
        };
        if chosen.only && columns != 2 {
            let why =
                format!("expected 2 numbers with a comma between them, found {columns} columns");
            return Err(at_line(why));
        }
        let number = |column: usize| match numbers.get(chosen.at[column]) {
            Some(Some(x)) if x.is_finite() => Ok(x * chosen.factors[column]),
            Some(Some(x)) => Err(at_line(format!("expected a finite number, found {x}"))),
            Some(None) => {
                let text = fields[chosen.at[column]];
                Err(at_line(format!("`{text}` is not a number")))
            }
            None => Err(at_line(format!("there are {columns} columns only"))),
        };
        let values = [number(0)?, number(1)?];
        if !begun {
            blocks.push(Vec::new());
            begun = true;
        }
        rows += 1;
        if rows > ROWS || blocks.len() > BLOCKS {
            let why = format!("more than {ROWS} rows, or more than {BLOCKS} blocks of them");
            return Err(at_line(why));
        }
        if let Some(block) = blocks.last_mut() {
            block.push(Row { line, values });
        }
    }
    Ok(blocks)
}

/// The first columns of a row, `most` at most, and how many there are.
fn cells(content: &str, most: usize) -> (Vec<&str>, usize) {
    match content.contains([',', ';']) {
        true => first_of(content.split([',', ';']).map(str::trim), most),
        false => first_of(content.split_whitespace(), most),
    }
}

/// The cells of a line of heads.
fn heads(line: &str) -> Vec<&str> {
    match line.contains([',', ';']) {
        true => line.split([',', ';']).take(COLUMNS).collect(),
        false => joined(line),
    }
}

fn first_of<'t>(mut columns: impl Iterator<Item = &'t str>, most: usize) -> (Vec<&'t str>, usize) {
    let first: Vec<&str> = columns.by_ref().take(most).collect();
    let count = first.len() + columns.count();
    (first, count)
}

/// Keys of a scene for two columns of a file.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// Their names, or their numbers from 1; the only two if left out.
    pub columns: Option<Vec<String>>,
    /// Factor from the numbers of each to SI; that of the unit in its head, else 1, if left out.
    pub factors: [Option<f64>; 2],
    /// SI units of the columns.
    pub alike: [&'static str; 2],
}

impl Form {
    /// Two coordinates.
    pub fn places(columns: &Option<Vec<String>>, factor: Option<f64>) -> Self {
        Form {
            columns: columns.clone(),
            factors: [factor; 2],
            alike: ["m"; 2],
        }
    }
}

/// The columns of a file that count.
#[derive(Debug)]
pub(crate) struct ColumnChoice {
    /// Their places, from 0.
    pub at: [usize; 2],
    /// Factor from the numbers of each to SI.
    pub factors: [f64; 2],
    /// True if there are no others.
    pub only: bool,
}

impl ColumnChoice {
    /// Of a file with these heads, which may be none, unless a column is not there or a unit is none of what it holds.
    pub fn from_heads(form: &Form, cells: &[&str]) -> Result<Self, String> {
        let heads: Vec<Head> = cells.iter().map(|c| Head::parse(c)).collect();
        let place = |name: &String| {
            let found = heads.iter().position(|h| h.name == *name);
            let number = name.parse::<usize>().ok().filter(|n| *n > 0);
            found.or(number.map(|n| n - 1)).ok_or_else(|| {
                let near = suggestion(name, heads.iter().map(|h| h.name.as_str()));
                format!("there is no column `{name}`{near}")
            })
        };
        let at = match form.columns.as_deref() {
            Some([a, b]) => [place(a)?, place(b)?],
            _ => [0, 1],
        };
        let mut factors = [1.0; 2];
        for k in 0..2 {
            let unit = heads.get(at[k]).and_then(|h| h.unit.as_deref());
            factors[k] = match (form.factors[k], unit) {
                (Some(factor), _) => factor,
                (None, Some(unit)) => unit_factor(unit, form.alike[k])?,
                (None, None) => 1.0,
            };
        }
        let only = form.columns.is_none();
        Ok(ColumnChoice { at, factors, only })
    }
}

/// A name with its unit: `x [mm]`, `x (mm)` or `x / mm`.
struct Head {
    name: String,
    unit: Option<String>,
}

impl Head {
    fn parse(cell: &str) -> Self {
        let cell = cell.trim().trim_matches('"');
        let cut = cell.find(['[', '(']).or(cell.find('/'));
        let (name, unit) = cut.map_or((cell, ""), |k| cell.split_at(k));
        let unit = unit.trim_matches(['[', ']', '(', ')', '/', ' ']);
        let unit = (!unit.is_empty()).then(|| unit.to_string());
        let name = name.trim().to_string();
        Head { name, unit }
    }
}

/// The cells of a head whose columns are separated by blanks: a unit in brackets belongs to the name before it.
pub(crate) fn joined<'t>(line: &'t str) -> Vec<&'t str> {
    let mut cells: Vec<&'t str> = Vec::new();
    let mut from = 0;
    let ends = line.char_indices().filter(|(_, c)| c.is_whitespace());
    for end in ends.map(|(k, _)| k).chain([line.len()]) {
        let (word, rest) = (&line[from..end], line[end..].trim_start());
        let open =
            word.contains('[') && !word.contains(']') || word.contains('(') && !word.contains(')');
        if word.trim().is_empty() || open || rest.starts_with(['[', '(']) {
            continue;
        }
        cells.push(word.trim());
        from = end;
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Form {
        Form::places(&None, None)
    }

    #[test]
    fn heads_name_columns_and_units() {
        let form = |columns: &[&str]| Form {
            columns: Some(columns.iter().map(|c| c.to_string()).collect()),
            factors: [None; 2],
            alike: ["s", "m"],
        };
        let first =
            |text: &str, columns: &[&str]| parse(text, &form(columns)).map(|b| b[0][0].values);
        for (text, columns) in [
            ("n; t [ms]; x (mm)\n1; 500; 20\n", ["t", "x"]),
            ("# n t[ms] x [mm]\n1 500 20\n", ["t", "x"]),
            ("n,x / cm,t/s\n1,2,0.5\n", ["3", "2"]),
        ] {
            assert_eq!(first(text, &columns), Ok([0.5, 0.02]), "{text}");
        }
        for (text, columns, told) in [
            (
                "t [s], x [kg]\n1,2\n",
                ["t", "x"],
                "`kg` is no unit of length",
            ),
            ("t,x\n1,2\n", ["t", "y"], "no column `y`"),
            ("1 2\n", ["1", "3"], "2 columns only"),
        ] {
            let wrong = first(text, &columns).unwrap_err();
            assert!(wrong.contains(told), "{wrong}");
        }
    }

    #[test]
    fn blocks_are_separated_by_blank_lines_and_comments() {
        let text = "x, y\n0,0\n1 , 2e-1 # corner\n\n3;4\n# next\n5 6\n";
        let blocks = parse(text, &places()).unwrap();
        let rows = blocks.iter().map(|b| b.iter().map(|r| r.values));
        let rows: Vec<Vec<_>> = rows.map(Iterator::collect).collect();
        let first = vec![[0.0, 0.0], [1.0, 0.2]];
        assert_eq!(rows, [first, vec![[3.0, 4.0]], vec![[5.0, 6.0]]]);
        assert_eq!(blocks[1][0].line, 5);
    }

    #[test]
    fn mistakes_name_their_line() {
        let refused = |text: &str| parse(text, &places()).unwrap_err();
        assert!(refused("0,0\n1,2,3").starts_with("line 2: expected 2 numbers"));
        assert!(refused("0,0\n1,b").contains("line 2: `b` is not a number"));
        assert!(refused("0,inf").contains("finite"));
        assert!(refused("x,y\nu,v").contains("`u` is not a number"));
        assert_eq!(parse("x,y\n", &places()).unwrap(), Vec::<Vec<Row>>::new());
    }
}
