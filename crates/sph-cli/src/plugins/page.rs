//! All plugins as a page of Markdown, for the book.

use std::fmt::Write as _;

use serde_json::Value as Json;

/// Plugins of this kind are drawn by `sph plugins KIND NAME --picture docs/images/law-NAME.svg`.
const DRAWN: &str = "rheology";
/// Longest line of prose; rows of tables cannot be broken.
const LONGEST: usize = 120;

/// A page of kinds as `sph plugins --json` tells them.
pub fn of(kinds: &[Json]) -> String {
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
        line(&mut page, &format!("\n## {name}\n\n{}.", capital(purpose)));
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
    if kind == DRAWN {
        let picture = format!("\n![`{name}`, sheared alone](images/law-{name}.svg)");
        line(page, &picture);
    }
    let parameters = plugin["parameters"].as_array().into_iter().flatten();
    let rows: Vec<String> = parameters.map(row).collect();
    if !rows.is_empty() {
        line(
            page,
            "\n| parameter | unit | default | meaning |\n|---|---|---|---|",
        );
        line(page, &rows.join("\n"));
    }
}

fn row(parameter: &Json) -> String {
    let unit = match text(&parameter["unit"]) {
        "" | "1" => "–",
        unit => unit,
    };
    let default = match (&parameter["required"], &parameter["default"]) {
        (Json::Bool(true), _) => "required".to_string(),
        (_, Json::Null) => "–".to_string(),
        (_, value) => format!("`{value}`"),
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
    let cells = [text(&parameter["name"]), unit, &default, &meaning];
    let [name, unit, default, meaning] = cells.map(|c| c.replace('|', "\\|"));
    format!("| `{name}` | {unit} | {default} | {meaning} |")
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
    let mut lines = String::new();
    let mut length = 0;
    for word in text.split(' ') {
        let letters = word.chars().count();
        // What begins a list or a heading must not begin a line.
        let number = word.starts_with(|c: char| c.is_ascii_digit()) && word.ends_with(['.', ')']);
        let safe = !number && !word.starts_with(['-', '+', '*', '#', '=', '>', '|']);
        if length > 0 && length + 1 + letters > LONGEST && safe {
            lines.push('\n');
            lines.push_str(indent);
            length = indent.len();
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(word);
        length += letters;
    }
    lines
}
