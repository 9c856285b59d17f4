//! The text of a scene, kept so that a mistake found at any time can be shown in it.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Origin, floor_char, line_and_column};
use crate::locate::locate;
use crate::overrides::Override;
use crate::paths::{PathProblem, joined, within};
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
        let mut all: Vec<Diagnostic> = problems
            .iter()
            .take(MOST_PROBLEMS)
            .map(|p| self.place(table.get_ref(), p))
            .collect();
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
        let start = floor_char(text, span.start);
        let end = floor_char(text, span.end.max(span.start));
        let end = text[start..end]
            .find(['\n', '\r'])
            .map_or(end, |n| start + n);
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
    pub fn resolve(&self, key: &str, file: &str) -> Result<PathBuf, PathProblem> {
        let folder = Path::new(&self.file).parent().unwrap_or(Path::new(""));
        let by = self.overrides.iter().rfind(|o| is_within(key, &o.path));
        match by.is_some_and(|o| o.users) {
            true => joined(folder, file),
            false => within(folder, file, &self.allowed),
        }
    }
}
