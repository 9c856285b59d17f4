//! The text of a scene, kept so that a mistake found at any time can be shown in it.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table};

use crate::diagnostic::{Diagnostic, Origin, line_and_column};
use crate::files::{FILE_BYTES, joined, within};
use crate::overrides::Override;
use crate::{MOST_PROBLEMS, SceneProblem, is_within};

/// The text of a scene file and the overrides on top of it.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name of the scene file.
    pub file: String,
    text: Arc<str>,
    /// The overrides, in the order they were given.
    pub overrides: Vec<Override>,
    allowed: Vec<PathBuf>,
}

impl Source {
    /// A text by the name of its file, and its overrides.
    pub fn new(text: &str, file: &str, overrides: &[Override]) -> Self {
        Source {
            file: file.to_string(),
            text: text.into(),
            overrides: overrides.to_vec(),
            allowed: Vec::new(),
        }
    }

    /// The same, free to name files in further folders.
    pub fn allowing(mut self, folders: &[PathBuf]) -> Self {
        self.allowed.extend_from_slice(folders);
        self
    }

    /// Text of the scene file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text that the span of a diagnostic is in.
    pub fn text_of(&self, diagnostic: &Diagnostic) -> &str {
        self.text_at(diagnostic.origin)
    }

    /// The same, to keep: all diagnostics of a file share one copy.
    pub fn shared_text_of(&self, diagnostic: &Diagnostic) -> Arc<str> {
        match diagnostic.origin {
            Origin::File => self.text.clone(),
            Origin::Override(_) => self.text_of(diagnostic).into(),
        }
    }

    fn text_at(&self, origin: Origin) -> &str {
        match origin {
            Origin::File => &self.text,
            Origin::Override(k) => self.overrides.get(k).map_or("", |o| &o.text),
        }
    }

    /// Finds problems in the text: a value of an override is shown there, others in the file. Sorted by position, those
    /// of overrides last. Of more than [`MOST_PROBLEMS`] the first are placed.
    pub fn diagnose(&self, problems: &[SceneProblem]) -> Vec<Diagnostic> {
        let table = DeTable::parse_recoverable(&self.text).0;
        let placed = problems.iter().take(MOST_PROBLEMS);
        let placed = placed.map(|p| self.place(table.get_ref(), p));
        let mut all: Vec<Diagnostic> = placed.collect();
        all.sort_by_key(|d| (d.origin, d.span.start, d.span.end));
        all.dedup();
        all
    }

    fn place(&self, table: &DeTable<'_>, problem: &SceneProblem) -> Diagnostic {
        let within = |inner: &str, outer: &str| outer.is_empty() || is_within(inner, outer);
        let path = problem.path.as_str();
        let set_by = |hit: &dyn Fn(&str) -> bool| self.overrides.iter().rposition(|o| hit(&o.path));
        let in_file = locate(table, path);
        let by = set_by(&|o| within(path, o)).or_else(|| match in_file.exact {
            true => None,
            false => set_by(&|o| within(o, path)),
        });
        let (origin, span) = match by {
            Some(k) => (Origin::Override(k), 0..self.overrides[k].text.len()),
            None => (Origin::File, in_file.span),
        };
        self.diagnostic(origin, span, path, &problem.message)
    }

    /// A diagnostic at a span, which ends at the latest with its first line.
    pub(crate) fn diagnostic(
        &self,
        origin: Origin,
        span: Range<usize>,
        path: &str,
        message: &str,
    ) -> Diagnostic {
        let text = self.text_at(origin);
        let start = text.floor_char_boundary(span.start);
        let end = text.floor_char_boundary(span.end.max(span.start));
        let first = text[start..end].find(['\n', '\r']);
        let end = first.map_or(end, |n| start + n);
        let (line, column) = line_and_column(text, start);
        let file = match origin {
            Origin::File => self.file.clone(),
            Origin::Override(_) => "--set".to_string(),
        };
        Diagnostic {
            message: message.replace('\n', " "),
            path: path.to_string(),
            span: start..end,
            line,
            column,
            file,
            origin,
        }
    }

    /// The path of a file that the scene names in the value of a key.
    ///
    /// It starts at the scene's folder and stays there or in an allowed folder, links followed. A path that
    /// the command line gives is taken as it is.
    ///
    /// # Errors
    /// If the path leads elsewhere.
    pub fn resolve(&self, key: &str, file: &str) -> Result<PathBuf, String> {
        let folder = Path::new(&self.file).parent().unwrap_or(Path::new(""));
        let by = self.overrides.iter().rfind(|o| is_within(key, &o.path));
        match by.is_some_and(|o| o.users) {
            true => joined(folder, file),
            false => within(folder, file, &self.allowed),
        }
    }

    /// The table of the text with the overrides applied.
    ///
    /// # Errors
    /// Errors of syntax, and overrides that do not fit the text.
    pub fn table(&self) -> Result<Table, Vec<Diagnostic>> {
        let text = self.text();
        let whole = |message: &str| vec![self.diagnostic(Origin::File, 0..0, "", message)];
        if text.len() > FILE_BYTES {
            let most = FILE_BYTES >> 20;
            return Err(whole(&format!("the file is longer than {most} MiB")));
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
fn too_deep(text: &str, message: &str) -> Range<usize> {
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

/// A place in the text, and whether it is that of the whole path or of a parent.
struct Place {
    span: Range<usize>,
    exact: bool,
}

/// The place of `phase.water.density` or `wall.tank.polyline[0][1]`, or of its nearest parent.
///
/// A key with a value gives the span of both; a table gives the span of its name.
fn locate(table: &DeTable<'_>, path: &str) -> Place {
    let mut span = 0..0;
    let mut rest = path;
    let mut inside = TextNode::Table(table);
    while !rest.is_empty() {
        let step = match inside {
            TextNode::Table(table) => named(table, rest),
            TextNode::List(items) => indexed(items, rest),
            TextNode::Leaf => None,
        };
        let Some((there, value, remaining)) = step else {
            let exact = false;
            return Place { span, exact };
        };
        span = there;
        rest = remaining.strip_prefix('.').unwrap_or(remaining);
        inside = match value.get_ref() {
            DeValue::Table(table) => TextNode::Table(table),
            DeValue::Array(items) => TextNode::List(items),
            _ => TextNode::Leaf,
        };
    }
    let exact = true;
    Place { span, exact }
}

enum TextNode<'t> {
    Table(&'t DeTable<'t>),
    List(&'t [Spanned<DeValue<'t>>]),
    Leaf,
}

type Step<'t, 'p> = (Range<usize>, &'t Spanned<DeValue<'t>>, &'p str);

/// The longest key that the path starts with: a quoted key may hold a dot.
fn named<'t, 'p>(table: &'t DeTable<'t>, path: &'p str) -> Option<Step<'t, 'p>> {
    let fits = |key: &str| {
        let rest = path.strip_prefix(key)?;
        (rest.is_empty() || rest.starts_with(['.', '['])).then_some(rest)
    };
    let entries = table.iter().filter_map(|(key, value)| {
        let rest = fits(key.get_ref())?;
        Some((key, value, rest))
    });
    let (key, value, rest) = entries.min_by_key(|(_, _, rest)| rest.len())?;
    let (name, text) = (key.span(), value.span());
    let span = match value.get_ref() {
        DeValue::Table(_) => name,
        _ if text.end >= name.end => name.start..text.end,
        _ => name,
    };
    Some((span, value, rest))
}

fn indexed<'t, 'p>(items: &'t [Spanned<DeValue<'t>>], path: &'p str) -> Option<Step<'t, 'p>> {
    let (index, rest) = path.strip_prefix('[')?.split_once(']')?;
    let value = items.get(index.parse::<usize>().ok()?)?;
    Some((value.span(), value, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_that_is_not_closed_is_one_mistake_and_a_missing_comma_stays_one() {
        let told = |text: &str| {
            let all = Source::new(text, "t.toml", &[]).table();
            let all = all.expect_err("a mistake");
            assert_eq!(all.len(), 1, "{all:?}");
            (all[0].line, all[0].message.clone())
        };
        let open = told("a = [[0, 1], [2, 3, [4, 5]]\nb = true\nc = \"x\"\n[d]\ne = 1\n");
        let (line, message) = &open;
        let one = *line <= 2 && message.starts_with("an array is not closed");
        assert!(one, "{open:?}");
        let comma = told("a = [[1] [2]]\nb = 3\n");
        assert!(comma.1.starts_with("missing comma"), "{comma:?}");
    }
}
