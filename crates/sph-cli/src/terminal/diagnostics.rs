//! Mistakes of a scene, shown in its text.

use std::ops::Range;

use ariadne::{Color, Config, IndexType, Label, Report, ReportKind, sources};
use serde_json::{Value as Json, json};
use sph_core::MOST_PROBLEMS;
use sph_io::clean;
use sph_scene::Diagnostic;
use sph_study::Mistake;

/// Diagnostics shown one by one; of the others only the number.
const MOST: usize = 20;

/// The diagnostics as text: the line, a mark under it, the expected value.
pub fn render(all: &[Mistake], colour: bool) -> String {
    let shown = all.iter().take(MOST).map(|located| one(located, colour));
    let mut text: String = shown.collect();
    let more = all.len().saturating_sub(MOST);
    let mut files = all.iter().map(|l| l.diagnostic.file.as_str());
    let first = files.clone().next();
    let file = files.find(|f| *f != "--set").or(first);
    let file = clean(file.unwrap_or("the scene"));
    let count = match all.len() {
        1 => "1 problem".to_string(),
        n if n >= MOST_PROBLEMS => format!("{n} problems and perhaps more"),
        n => format!("{n} problems"),
    };
    if more > 0 {
        text.push_str(&format!("… and {more} more\n"));
    }
    text + &format!("{count} in {file}; nothing was written\n")
}

fn one(located: &Mistake, colour: bool) -> String {
    let d = &cleaned(&located.diagnostic);
    let text = clean(&located.text);
    let plain = || format!("error: {d}\n");
    // A problem of the scene as a whole has no line to be shown, and one that fills the screen is not shown.
    let place = visible(&text, &d.span);
    let Some(place) = place.filter(|place| line_around(&text, place) <= LONGEST) else {
        return plain();
    };
    let span = |range: Range<usize>| (d.file.clone(), range);
    let config = Config::new().with_color(colour);
    let config = config.with_index_type(IndexType::Byte);
    let label = Label::new(span(place.clone()))
        .with_message(if d.path.is_empty() { "here" } else { &d.path })
        .with_color(Color::Red);
    // A kind of one's own is coloured even where colours are off.
    let kind = match colour {
        true => ReportKind::Custom("error", Color::Red),
        false => ReportKind::Error,
    };
    let report = Report::build(kind, span(place))
        .with_config(config)
        .with_message(&d.message)
        .with_label(label)
        .finish();
    let mut bytes = Vec::new();
    let cache = sources([(d.file.clone(), &*text)]);
    let written = report.write(cache, &mut bytes).ok();
    let text = written.and_then(|()| String::from_utf8(bytes).ok());
    text.map_or_else(plain, |text| text.replacen("Error:", "error:", 1))
}

/// Longest line of a scene that is shown, and longest message, bytes.
const LONGEST: usize = 2_000;

/// Length of the line in which a span begins, bytes.
fn line_around(text: &str, span: &Range<usize>) -> usize {
    let (before, after) = text.split_at_checked(span.start).unwrap_or((text, ""));
    let start = before.rfind('\n').map_or(0, |n| n + 1);
    before.len() - start + after.find('\n').unwrap_or(after.len())
}

/// A diagnostic without control characters, and cut where it is too long; spans stay where they are.
fn cleaned(d: &Diagnostic) -> Diagnostic {
    let told = |text: &str| {
        let end = text.char_indices().map(|(k, _)| k).find(|k| *k > LONGEST);
        match end {
            Some(end) => format!("{} … (cut)", clean(&text[..end]).replace('\n', " ")),
            None => clean(text).replace('\n', " "),
        }
    };
    Diagnostic {
        message: told(&d.message),
        path: told(&d.path),
        file: told(&d.file),
        ..d.clone()
    }
}

/// The span, or the character before an empty one; nothing at the start of the text.
fn visible(text: &str, span: &Range<usize>) -> Option<Range<usize>> {
    if !span.is_empty() {
        return Some(span.clone());
    }
    let before = text.get(..span.start)?.trim_end();
    let (last, _) = before.char_indices().next_back()?;
    Some(last..before.len())
}

pub fn json(all: &[Mistake]) -> Json {
    let all = all.iter().map(|l| {
        let d = &l.diagnostic;
        json!({
            "file": d.file, "line": d.line, "column": d.column, "path": d.path, "message": d.message,
        })
    });
    all.collect()
}
