//! All plugins as a page of Markdown, for the book.

use std::fmt::Write as _;

use serde_json::Value as Json;

use super::{KERNELS, LAWS};
use crate::terminal::layout::paragraph;

/// Kinds that are drawn by `sph plugins KIND NAME --picture docs/images/FIRST-NAME.svg`: kind, FIRST, description.
const DRAWN: [(&str, &str, &str); 2] = [
    (LAWS, "law", "sheared alone"),
    (KERNELS, "kernel", "and its slope"),
];
/// Pictures of runs and walls, one a line: kind, name, file in `docs/images`, description.
const SHOWN: &str = "\
eddy-viscosity k-epsilon dam-break-k-epsilon.png A dam break with k–ε
equation-of-state compressible-grains columns-runout.png Run-out of columns of sand
implicit-viscosity backward-euler implicit-error-against-time.png Error against run time
linear-solver automatic solver-scaling.png Time per solve over the number of particles
mover rigid-body floating-box.png A floating box
open-boundary velocity-inlet channel-open.png A channel between two open faces
smoother delta-sph granular-pile-lajeunesse.png A pile of beads at rest
walls usaw gamma-gear.png γ around a gear";
/// Longest line.
const LONGEST: usize = 120;
/// Stands for a space at which no line ends.
const GLUE: char = '\0';

/// A page of kinds in the form of `sph plugins --json`.
pub fn markdown(kinds: &[Json]) -> String {
    let mut page = String::from(
        "# Plugins\n\nAll that a scene may name. This page is what `sph plugins --markdown` prints; a test holds it to that.\n\
         `sph plugins KIND NAME` shows one of them with a snippet for a scene.\n\n",
    );
    for kind in kinds {
        let name = text(&kind["kind"]);
        let purpose = text(&kind["purpose"]);
        line(&mut page, &item(&format!("[{name}](#{name}): {purpose}")));
    }
    for kind in kinds {
        let (name, purpose) = (text(&kind["kind"]), text(&kind["purpose"]));
        let default = kind["default"].as_str().map_or(String::new(), |plugin| {
            format!(" `{plugin}` is taken if a scene names none.")
        });
        let head = format!("\n## {name}\n\n{}.{default}", capital(purpose));
        line(&mut page, &head);
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
    line(page, &format!("\n### {name}\n\n{}", wrapped(&told, 0)));
    if let Some(picture) = picture(kind, name) {
        line(page, &format!("\n{picture}"));
    }
    let parameters = plugin["parameters"].as_array().into_iter().flatten();
    let items: Vec<String> = parameters.map(self::parameter).collect();
    if !items.is_empty() {
        line(page, &format!("\n{}", items.join("\n")));
    }
}

/// A picture of a plugin, where there is one.
fn picture(kind: &str, name: &str) -> Option<String> {
    if let Some((_, first, seen)) = DRAWN.iter().find(|drawn| drawn.0 == kind) {
        return Some(format!("![`{name}`, {seen}](images/{first}-{name}.svg)"));
    }
    let named = format!("{kind} {name} ");
    let shown = SHOWN.lines().find_map(|line| line.strip_prefix(&named));
    let (file, seen) = shown?.split_once(' ')?;
    Some(format!("![{seen}](images/{file})"))
}

/// A parameter: name, unit, default, meaning.
fn parameter(parameter: &Json) -> String {
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
    item(&format!("`{name}` ({unit}{default}): {meaning}"))
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

/// A text in lines that are not too long, without the end of the last one.
fn wrapped(text: &str, indent: usize) -> String {
    // Characters that begin a list or a heading must not begin a line: such a word stays with the one before it.
    let begins = |word: &str| {
        let number = word.starts_with(|c: char| c.is_ascii_digit()) && word.ends_with(['.', ')']);
        number || word.starts_with(['-', '+', '*', '#', '=', '>', '|'])
    };
    let mut kept = String::new();
    for word in text.split(' ') {
        kept.push(if begins(word) { GLUE } else { ' ' });
        kept.push_str(word);
    }
    let lines = paragraph(indent, LONGEST, kept.trim_start_matches([' ', GLUE]));
    lines.trim().replace(GLUE, " ")
}

/// An item of a list.
fn item(text: &str) -> String {
    format!("* {}", wrapped(text, 2))
}
