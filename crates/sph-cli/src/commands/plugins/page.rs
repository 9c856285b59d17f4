//! All plugins as a page of Markdown, for the book.

use serde_json::Value as Json;
use sph_core::{Parameter, PluginInfo, PluginKind, comma_list, parameters, some_unit};

use super::snippet::choices_of;
use super::{KERNELS, LAWS, dimensions, required};
use crate::terminal::paragraph;

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
const LONGEST: usize = 120;
/// Stands for a space at which no line ends.
const GLUE: char = '\0';

pub fn markdown(kinds: &[&PluginKind]) -> String {
    let mut page = String::from(
        "# Plugins\n\nAll that a scene may name. This page is what `sph plugins --markdown` prints; a test holds it to that.\n\
         `sph plugins KIND NAME` shows one of them with a snippet for a scene.\n\n",
    );
    let entry = |kind: &&PluginKind| item(&format!("[{0}](#{0}): {1}", kind.name, kind.purpose));
    page.extend(kinds.iter().map(entry));
    for kind in kinds {
        let (name, purpose) = (kind.name, capital(kind.purpose));
        let default = kind.default.map_or(String::new(), |plugin| {
            format!(" `{plugin}` is taken if a scene names none.")
        });
        page.push_str(&format!("\n## {name}\n\n{purpose}.{default}\n"));
        page.extend((kind.plugins)().iter().map(|plugin| one(name, plugin)));
    }
    page
}

fn one(kind: &str, plugin: &PluginInfo) -> String {
    let (name, schema) = (plugin.name, (plugin.schema)());
    let provider = plugin.provider.split(' ').next().unwrap_or_default();
    let mut facts = vec![format!("source: {}", plugin.source)];
    if !plugin.dimensions.is_empty() {
        facts.push(dimensions(plugin, " and "));
    }
    facts.push(format!("crate `{provider}`"));
    let summary = format!("{}; {}.", capital(plugin.summary), facts.join("; "));
    let mut text = format!("\n### {name}\n\n{}\n", wrapped(&summary, 0));
    text.extend(picture(kind, name).map(|picture| format!("\n{picture}\n")));
    let all = parameters(&schema);
    text.push_str(if all.is_empty() { "" } else { "\n" });
    text.extend(all.iter().map(|p| parameter(p, &schema)));
    text
}

fn picture(kind: &str, name: &str) -> Option<String> {
    if let Some((_, first, seen)) = DRAWN.iter().find(|drawn| drawn.0 == kind) {
        return Some(format!("![`{name}`, {seen}](images/{first}-{name}.svg)"));
    }
    let named = format!("{kind} {name} ");
    let shown = SHOWN.lines().find_map(|line| line.strip_prefix(&named));
    let (file, seen) = shown?.split_once(' ')?;
    Some(format!("![{seen}](images/{file})"))
}

fn parameter(parameter: &Parameter, schema: &Json) -> String {
    let Parameter { name, source, .. } = parameter;
    let unit = some_unit(&parameter.unit).map_or(String::new(), |unit| format!("{unit}, "));
    let default = match (&parameter.default, required(schema, name)) {
        (_, true) => "required".to_string(),
        (Some(value), _) if !value.is_null() => format!("default `{value}`"),
        _ => "may be left out".to_string(),
    };
    let mut meaning = parameter.meaning.trim().to_string();
    let choices = choices_of(schema, name).into_iter();
    let choices = comma_list(choices.map(|c| format!("`{}`", c.value)));
    if !choices.is_empty() {
        meaning.push_str(&format!(" One of {choices}."));
    }
    if !source.is_empty() {
        meaning.push_str(&format!(" Source: {source}."));
    }
    item(&format!("`{name}` ({unit}{default}): {meaning}"))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>());
    first.unwrap_or_default() + letters.as_str()
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

fn item(text: &str) -> String {
    format!("* {}\n", wrapped(text, 2))
}
