//! Tables of a page.

use std::fmt::Write as _;

use sph_io::escape;

/// A table with its heads, if there are any; every row has a class.
pub(crate) fn grid(
    heads: &[String],
    rows: &[Vec<String>],
    class: impl Fn(usize) -> String,
) -> String {
    let mut text = String::from("<div class=\"wide\"><table>\n");
    let cells = |row: &[String], tag: &str| -> String {
        let cell = |c: &String| format!("<{tag}>{}</{tag}>", escape(c));
        row.iter().map(cell).collect()
    };
    if !heads.is_empty() {
        let _ = writeln!(text, "<tr>{}</tr>", cells(heads, "th"));
    }
    for (k, row) in rows.iter().enumerate() {
        let _ = match class(k).as_str() {
            "" => writeln!(text, "<tr>{}</tr>", cells(row, "td")),
            class => writeln!(text, "<tr class=\"{class}\">{}</tr>", cells(row, "td")),
        };
    }
    text.push_str("</table></div>\n");
    text
}

/// A table whose rows are alike.
pub(crate) fn plain_grid(heads: &[String], rows: &[Vec<String>]) -> String {
    grid(heads, rows, |_| String::new())
}
