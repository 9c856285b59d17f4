//! Tables of a page.

use std::fmt::Write as _;

use sph_io::escape;

/// A table with its heads, if there are any; every row has a class.
pub(crate) fn grid<H: AsRef<str>>(
    heads: &[H],
    rows: &[Vec<String>],
    class: impl Fn(usize) -> String,
) -> String {
    fn cells<C: AsRef<str>>(row: &[C], tag: &str) -> String {
        let cell = |c: &C| format!("<{tag}>{}</{tag}>", escape(c.as_ref()));
        row.iter().map(cell).collect()
    }
    let mut text = String::from("<div class=\"wide\"><table>\n");
    if !heads.is_empty() {
        let _ = writeln!(text, "<tr>{}</tr>", cells(heads, "th"));
    }
    for (k, row) in rows.iter().enumerate() {
        let _ = match class(k).as_str() {
            "" => writeln!(text, "<tr>{}</tr>", cells(row, "td")),
            class => writeln!(text, "<tr class=\"{class}\">{}</tr>", cells(row, "td")),
        };
    }
    text + "</table></div>\n"
}

pub(crate) fn plain_grid(heads: &[&str], rows: &[Vec<String>]) -> String {
    grid(heads, rows, |_| String::new())
}
