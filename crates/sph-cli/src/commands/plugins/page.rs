//! All plugins as a page of Markdown, for the book.

use std::fmt::Write as _;

use serde_json::Value as Json;

use super::{KERNELS, LAWS};

/// Kinds that are drawn by `sph plugins KIND NAME --picture docs/images/FIRST-NAME.svg`: kind, FIRST, description.
const DRAWN: [(&str, &str, &str); 2] = [
    (LAWS, "law", "sheared alone"),
    (KERNELS, "kernel", "and its slope"),
];
/// Pictures of runs and walls: kind, name, file in `docs/images`, description.
const SHOWN: [(&str, &str, &str, &str); 8] = [
    (
        "eddy-viscosity",
        "k-epsilon",
        "dam-break-k-epsilon.png",
        "A dam break with k–ε",
    ),
    (
        "equation-of-state",
        "compressible-grains",
        "columns-runout.png",
        "Run-out of columns of sand",
    ),
    (
        "implicit-viscosity",
        "backward-euler",
        "implicit-error-against-time.png",
        "Error against run time",
    ),
    (
        "linear-solver",
        "automatic",
        "solver-scaling.png",
        "Time per solve over the number of particles",
    ),
    ("mover", "rigid-body", "floating-box.png", "A floating box"),
    (
        "open-boundary",
        "velocity-inlet",
        "channel-open.png",
        "A channel between two open faces",
    ),
    (
        "smoother",
        "delta-sph",
        "granular-pile-lajeunesse.png",
        "A pile of beads at rest",
    ),
    ("walls", "usaw", "gamma-gear.png", "γ around a gear"),
];
/// Longest line.
const LONGEST: usize = 120;

/// A page of kinds in the form of `sph plugins --json`.
pub fn markdown(kinds: &[Json]) -> String {
    let mut page = String::from(
        "# Plugins\n\nAll that a scene may name. This page is what `sph plugins --markdown` prints; a test holds it to that.\n\
         `sph plugins KIND NAME` shows one of them with a snippet for a scene.\n\n",
    );
    for kind in kinds {
        let name = text(&kind["kind"]);
        line(
            &mut page,
            &wrapped(
                &format!("* [{name}](#{name}): {}", text(&kind["purpose"])),
                "  ",
            ),
        );
    }
    for kind in kinds {
        let (name, purpose) = (text(&kind["kind"]), text(&kind["purpose"]));
        let default = kind["default"].as_str().map_or(String::new(), |plugin| {
            format!(" `{plugin}` is taken if a scene names none.")
        });
        line(
            &mut page,
            &format!("\n## {name}\n\n{}.{default}", capital(purpose)),
        );
        let plugins = kind["plugins"].as_array().into_iter().flatten();
        plugins.for_each(|plugin| one(&mut page, name, plugin));
    }
    page
}

fn one(page: &mut String, kind: &str, plugin: &Json) {
    let dimensions = plugin["dimensions"].as_array().into_iter().flatten();
    let dimensions: Vec<String> = dimensions.map(|d| format!("{d}D")).collect();
    let provider = text(&plugin["provider"]);
    let provider = provider.split(' ').next().unwrap_or_default();
    let mut facts = vec![format!("source: {}", text(&plugin["source"]))];
    if !dimensions.is_empty() {
        facts.push(dimensions.join(" and "));
    }
    facts.push(format!("crate `{provider}`"));
    let (name, summary) = (text(&plugin["name"]), text(&plugin["summary"]));
    let told = format!("{}; {}.", capital(summary), facts.join("; "));
    line(page, &format!("\n### {name}\n\n{}", wrapped(&told, "")));
    if let Some(picture) = picture(kind, name) {
        line(page, &format!("\n{picture}"));
    }
    let parameters = plugin["parameters"].as_array().into_iter().flatten();
    let items: Vec<String> = parameters.map(item).collect();
    if !items.is_empty() {
        line(page, &format!("\n{}", items.join("\n")));
    }
}

/// A picture of a plugin, where there is one.
fn picture(kind: &str, name: &str) -> Option<String> {
    if let Some((_, first, seen)) = DRAWN.iter().find(|drawn| drawn.0 == kind) {
        return Some(format!("![`{name}`, {seen}](images/{first}-{name}.svg)"));
    }
    let shown = SHOWN.iter().find(|s| (s.0, s.1) == (kind, name));
    shown.map(|(_, _, file, seen)| format!("![{seen}](images/{file})"))
}

/// A parameter: name, unit, default, meaning.
fn item(parameter: &Json) -> String {
    let unit = match text(&parameter["unit"]) {
        "" | "1" => String::new(),
        unit => format!("{unit}, "),
    };
    let default = match (&parameter["required"], &parameter["default"]) {
        (Json::Bool(true), _) => "required".to_string(),
        (_, Json::Null) => "may be left out".to_string(),
        (_, value) => format!("default `{value}`"),
    };
    let mut meaning = text(&parameter["meaning"]).trim().to_string();
    let choices = parameter["choices"].as_array().into_iter().flatten();
    let choices: Vec<String> = choices.map(|c| format!("`{}`", text(c))).collect();
    if !choices.is_empty() {
        let _ = write!(meaning, " One of {}.", choices.join(", "));
    }
    match text(&parameter["source"]) {
        "" => {}
        source => {
            let _ = write!(meaning, " Source: {source}.");
        }
    }
    let name = text(&parameter["name"]);
    wrapped(&format!("* `{name}` ({unit}{default}): {meaning}"), "  ")
}

fn text(value: &Json) -> &str {
    value.as_str().unwrap_or_default()
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>());
    first.unwrap_or_default() + letters.as_str()
}

fn line(page: &mut String, text: &str) {
    page.push_str(text);
    page.push('\n');
}

/// A text in lines that are not too long, the second and all later ones behind `indent`.
fn wrapped(text: &str, indent: &str) -> String {
    let mut pieces: Vec<String> = Vec::new();
    for word in text.split(' ') {
        // Characters that begin a list or a heading must not begin a line: it stays with the word before it.
        let number = word.starts_with(|c: char| c.is_ascii_digit()) && word.ends_with(['.', ')']);
        let begins = number || word.starts_with(['-', '+', '*', '#', '=', '>', '|']);
        match pieces.last_mut().filter(|_| begins) {
            Some(before) => {
                before.push(' ');
                before.push_str(word);
            }
            None => pieces.push(word.to_string()),
        }
    }
    let mut lines = String::new();
    let mut length = 0;
    for piece in &pieces {
        let letters = piece.chars().count();
        if length > 0 && length + 1 + letters > LONGEST {
            lines.push('\n');
            lines.push_str(indent);
            length = indent.len();
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(piece);
        length += letters;
    }
    lines
}
