//! Text in columns.

use serde_json::Value as Json;
use sph_core::{comma_list, number, unit_suffix};
use sph_particles::setup::Memory;

/// Longest line of prose.
pub const WIDTH: usize = 98;

/// Rows of cells.
pub type Rows = Vec<Vec<String>>;

/// Rows as columns with two spaces between; the last column is not padded.
pub fn columns(indent: usize, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let rows: Vec<_> = rows.into_iter().collect();
    let width = |k: usize| {
        let cells = rows.iter().filter(|r| k + 1 < r.len());
        cells.map(|r| r[k].chars().count()).max().unwrap_or(0)
    };
    let mut text = String::new();
    for row in &rows {
        let mut line = " ".repeat(indent);
        for (k, cell) in row.iter().enumerate() {
            // The last one ends the line, which is trimmed.
            line += &format!("{cell:width$}  ", width = width(k));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

pub fn row(name: &str, value: impl Into<String>) -> Vec<String> {
    vec![name.to_string(), value.into()]
}

pub fn quantities<T: AsRef<str>>(all: &[(T, f64, T)]) -> Rows {
    let value = |x: f64, unit: &T| number::plain(x) + &unit_suffix(unit.as_ref());
    let row = |(name, x, unit): &(T, f64, T)| row(name.as_ref(), value(*x, unit));
    all.iter().map(row).collect()
}

/// Rows as columns below their heads, which have commas between.
pub fn table(heads: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let heads = heads.split(", ").map(String::from).collect();
    columns(2, std::iter::once(heads).chain(rows))
}

/// Rows as columns below their heads, and below each row its details.
pub fn table_and_below(heads: &str, rows: impl Iterator<Item = (Vec<String>, String)>) -> String {
    let (rows, below): (Vec<_>, Vec<_>) = rows.unzip();
    let table = table(heads, rows);
    let below = std::iter::once(String::new()).chain(below);
    let lines = table.lines().zip(below);
    let with = |(line, below): (&str, String)| format!("{line}\n{}", paragraph(6, WIDTH, &below));
    lines.map(with).collect()
}

/// Titles with their rows, but for those without rows, and warnings, if there are any.
pub fn sections<const N: usize>(parts: [(&str, Rows); N], warnings: &[String]) -> String {
    let block = |title: &str, lines| headed(&format!("\n{title}"), lines);
    let parts = parts.map(|(title, rows)| block(title, columns(2, rows)));
    parts.concat() + &block("warnings", remarks(warnings))
}

/// A block of lines below its title; nothing for an empty one.
pub fn headed(title: &str, lines: String) -> String {
    match lines.as_str() {
        "" => lines,
        lines => format!("{title}\n{lines}"),
    }
}

/// A text broken between words, every line indented.
pub fn paragraph(indent: usize, width: usize, text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{:indent$}{word}", "")),
        }
    }
    lines.into_iter().map(|line| line + "\n").collect()
}

pub fn remarks(remarks: &[String]) -> String {
    let item = |r: &String| format!("  - {}", paragraph(4, WIDTH, r).trim_start());
    remarks.iter().map(item).collect()
}

pub fn paragraphs<T: AsRef<str>>(indent: usize, texts: &[T]) -> String {
    let broken = texts
        .iter()
        .map(|text| paragraph(indent, WIDTH, text.as_ref()));
    broken.collect()
}

pub fn listed(names: &[String], none: &str) -> String {
    match names {
        [] => none.to_string(),
        names => names.join(", "),
    }
}

/// Parameters of a plugin in one line, empty if it has none.
pub fn parameters(all: &Json) -> String {
    let given = all.as_object().into_iter().flatten();
    let given = given.filter(|(_, value)| !value.is_null());
    comma_list(given.map(|(name, value)| format!("{name} = {value}")))
}

/// The memory of a run, and the parts that are a twentieth of it and more.
pub fn memory(memory: &Memory) -> String {
    let all = memory.total();
    let parts = memory.parts().into_iter();
    let parts = parts.filter(|(_, bytes)| *bytes > 0.05 * all);
    let parts = parts.map(|(name, bytes)| format!("{name} {}", number::percent(bytes / all)));
    format!("{}: {}", number::bytes(all), comma_list(parts))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_characters_and_paragraphs_broken_between_words() {
        let rows = [["ρ", "1"], ["time", "2"]].map(|r| r.map(String::from).to_vec());
        assert_eq!(columns(1, rows), " ρ     1\n time  2\n");
        assert_eq!(paragraph(2, 10, "one two three"), "  one two\n  three\n");
    }
}
