//! The text of a scene as a table.

use toml::Table;
use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Origin};
use crate::text::FILE_BYTES;
use crate::{MOST_PROBLEMS, Override, Source};

impl Source {
    /// The table of the text with the overrides applied.
    ///
    /// # Errors
    /// Errors of syntax, and overrides that do not fit the text.
    pub fn table(&self) -> Result<Table, Vec<Diagnostic>> {
        let text = self.text();
        let whole = |message: &str| vec![self.diagnostic(Origin::File, 0..0, "", message)];
        if text.len() > FILE_BYTES {
            return Err(whole(&format!(
                "the file is longer than {} MiB",
                FILE_BYTES >> 20
            )));
        }
        let syntax = |e: &toml::de::Error| {
            let span = e.span().unwrap_or_else(|| too_deep(text, e.message()));
            let message = match e.message() {
                long if long.contains("as i128") => "the integer does not fit into 64 bits",
                message => message,
            };
            self.diagnostic(Origin::File, span, "", message)
        };
        let (_, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            let told = errors.iter().take(MOST_PROBLEMS);
            let mut all: Vec<_> = told.map(syntax).collect();
            all.sort_by_key(|d| (d.span.start, d.span.end));
            all.dedup_by_key(|d| d.line);
            return Err(without_echoes(all));
        }
        let mut table: Table = toml::from_str(text).map_err(|e| vec![syntax(&e)])?;
        let apply = |o: &Override| o.apply(&mut table).err();
        let problems: Vec<_> = self.overrides.iter().filter_map(apply).collect();
        match problems.is_empty() {
            true => Ok(table),
            false => Err(self.diagnose(&problems)),
        }
    }
}

/// Takes an array that is not closed for one mistake: each line after it is a value without a comma to the reader of TOML.
fn without_echoes(mut all: Vec<Diagnostic>) -> Vec<Diagnostic> {
    const ECHO: &str = "missing comma between array elements";
    let is_echo = |d: &Diagnostic| d.message.starts_with(ECHO);
    let echoes = all.iter().filter(|d| is_echo(d)).count();
    let mut told = false;
    all.retain(|d| !is_echo(d) || !std::mem::replace(&mut told, true));
    if echoes > 1
        && let Some(first) = all.iter_mut().find(|d| is_echo(d))
    {
        first.message =
            "an array is not closed: a `]` is missing here or before, or a comma".into();
    }
    all
}

/// Deepest nesting that the reader of TOML takes.
const DEEPEST: usize = 80;

/// Place at which a text is nested too deeply: the reader reports it without a place.
fn too_deep(text: &str, message: &str) -> std::ops::Range<usize> {
    if !message.contains("recursion") {
        return 0..0;
    }
    let mut depth = 0_usize;
    // Of a key in this place: `a.b.c` is nested as well.
    let mut dots = 0_usize;
    for (k, byte) in text.bytes().enumerate() {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            b'.' => dots += 1,
            b'-' | b'_' | b'"' | b'\'' => {}
            b if b.is_ascii_alphanumeric() => {}
            _ => dots = 0,
        }
        if depth + dots > DEEPEST {
            return k..k + 1;
        }
    }
    0..0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_that_is_not_closed_is_one_mistake_and_a_missing_comma_stays_one() {
        let told = |text: &str| {
            let all = Source::new(text, "t.toml", &[])
                .table()
                .expect_err("a mistake");
            all.into_iter()
                .map(|d| (d.line, d.message))
                .collect::<Vec<_>>()
        };
        let open = told("a = [[0, 1], [2, 3, [4, 5]]\nb = true\nc = \"x\"\n[d]\ne = 1\n");
        assert_eq!(open.len(), 1, "{open:?}");
        assert!(
            open[0].0 <= 2 && open[0].1.starts_with("an array is not closed"),
            "{open:?}"
        );
        let comma = told("a = [[1] [2]]\nb = 3\n");
        assert_eq!(comma.len(), 1, "{comma:?}");
        assert!(comma[0].1.starts_with("missing comma"), "{comma:?}");
    }
}
