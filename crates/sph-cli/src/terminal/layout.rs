//! Text in columns.

use serde_json::Value as Json;
use sph_particles::setup::Memory;

use crate::number;

/// Rows as columns with two spaces between; the last column is not padded.
pub fn columns(indent: usize, rows: &[Vec<String>]) -> String {
    let width = |k: usize| {
        let cells = rows.iter().filter(|r| k + 1 < r.len());
        cells
            .filter_map(|r| Some(r.get(k)?.chars().count()))
            .max()
            .unwrap_or(0)
    };
    let mut text = String::new();
    for row in rows {
        let mut line = " ".repeat(indent);
        for (k, cell) in row.iter().enumerate() {
            line.push_str(cell);
            if k + 1 < row.len() {
                line.extend(std::iter::repeat_n(
                    ' ',
                    2 + width(k) - cell.chars().count(),
                ));
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// A name beside its value.
pub fn row(name: &str, value: impl Into<String>) -> Vec<String> {
    vec![name.to_string(), value.into()]
}

/// Rows as columns below their heads.
pub fn table(heads: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let heads = heads.iter().map(|h| h.to_string()).collect();
    let rows: Vec<Vec<String>> = std::iter::once(heads).chain(rows).collect();
    columns(2, &rows)
}

/// Rows as columns below their heads, and below each row its details.
pub fn table_and_below(heads: &[&str], rows: Vec<(Vec<String>, String)>) -> String {
    let (rows, below): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let table = table(heads, rows);
    let below = std::iter::once(String::new()).chain(below);
    let lines = table.lines().zip(below);
    lines
        .map(|(line, below)| format!("{line}\n{}", paragraph(6, 98, &below)))
        .collect()
}

/// Titles with their rows, but for those without rows, and warnings, if there are any.
pub fn sections<const N: usize>(
    parts: [(&str, Vec<Vec<String>>); N],
    warnings: &[String],
) -> String {
    let mut text = String::new();
    for (title, rows) in parts.into_iter().filter(|(_, rows)| !rows.is_empty()) {
        text.push_str(&format!("\n{title}\n{}", columns(2, &rows)));
    }
    if !warnings.is_empty() {
        text.push_str(&format!("\nwarnings\n{}", remarks(warnings)));
    }
    text
}

/// A text broken between words, every line indented.
pub fn paragraph(indent: usize, width: usize, text: &str) -> String {
    let mut lines = String::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let long = indent + line.chars().count() + 1 + word.chars().count() > width;
        if long && !line.is_empty() {
            lines.push_str(&format!("{:indent$}{line}\n", ""));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        lines.push_str(&format!("{:indent$}{line}\n", ""));
    }
    lines
}

/// A list of remarks, each with a dash, broken between words.
pub fn remarks(remarks: &[String]) -> String {
    let item = |r: &String| {
        let text = paragraph(4, 98, r);
        format!("  - {}", text.trim_start())
    };
    remarks.iter().map(item).collect()
}

/// Parameters of a plugin in one line, empty if it has none.
pub fn parameters(all: &Json) -> String {
    let one = |(name, value): (&String, &Json)| format!("{name} = {value}");
    let given = all.as_object().into_iter().flatten();
    let list: Vec<String> = given.filter(|(_, v)| !v.is_null()).map(one).collect();
    list.join(", ")
}

/// The memory of a run, and the parts that are a twentieth of it and more.
pub fn memory(memory: &Memory) -> String {
    let all = memory.total();
    let parts = memory.parts().into_iter();
    let parts: Vec<String> = parts
        .filter(|(_, bytes)| *bytes > 0.05 * all)
        .map(|(name, bytes)| format!("{name} {}", number::percent(bytes / all)))
        .collect();
    format!("{}: {}", number::bytes(all), parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_characters_and_paragraphs_broken_between_words() {
        let rows = [["ρ", "1"], ["time", "2"]].map(|r| r.map(String::from).to_vec());
        assert_eq!(columns(1, &rows), " ρ     1\n time  2\n");
        assert_eq!(paragraph(2, 10, "one two three"), "  one two\n  three\n");
    }
}
