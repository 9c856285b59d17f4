//! docs/gallery.md.

use crate::gallery::{Entry, Gallery};
use crate::terminal::layout::paragraph;

/// Longest line.
const WIDTH: usize = 120;

/// The page.
pub fn markdown(gallery: &Gallery) -> String {
    let about = format!(
        "`sph scenes` lists the scenes, `sph run NAME` runs one, prints its errors and writes them to `summary.json`. {} \
         This page is what `sph scenes --markdown` prints from [gallery.toml](gallery.toml); a test holds it to that, and \
         compares the errors of short runs with what they print. After longer ones `scripts/scene-errors RESULTS` puts the \
         errors of your runs beside this page. How each number is made, and where it falls short: \
         [validation](validation.md).",
        gallery.times
    );
    let mut page = format!("# Gallery\n\n{}", paragraph(0, WIDTH, &about));
    page.push_str("\n## Start here\n\n");
    for [name, why] in &gallery.start {
        let line = format!("* {}: {why}. {}", link(name), image(name));
        page.push_str(&item(&line));
    }
    for theme in &gallery.theme {
        page.push_str(&format!("\n## {}\n\n", theme.title));
        if let Some(text) = &theme.text {
            page.push_str(&format!("{}\n", paragraph(0, WIDTH, text)));
        }
        theme
            .entry
            .iter()
            .for_each(|entry| page.push_str(&of_entry(entry)));
    }
    page
}

fn of_entry(entry: &Entry) -> String {
    let names: Vec<String> = entry.scenes.keys().map(|name| link(name)).collect();
    let times: Vec<&str> = entry.scenes.values().map(String::as_str).collect();
    let measured = entry
        .measured
        .as_ref()
        .map_or(String::new(), |m| format!(" {m}"));
    let images: Vec<String> = entry.scenes.keys().map(|name| image(name)).collect();
    // Its moment alone is no difference from the shipped scene.
    let picture = match entry.picture.contains(", ") {
        true => format!(" Picture at {}.", entry.picture),
        false => String::new(),
    };
    item(&format!(
        "* {}: {}.{measured} Time: {}.{picture} {}",
        names.join(", "),
        entry.shows,
        times.join(", "),
        images.join(" ")
    ))
}

/// An item of a list, broken between words.
fn item(text: &str) -> String {
    let lines = paragraph(2, WIDTH, text);
    lines
        .strip_prefix("  * ")
        .map_or(lines.clone(), |rest| format!("* {rest}"))
}

fn link(name: &str) -> String {
    format!("[`{name}`](../scenes/{name}.toml)")
}

fn image(name: &str) -> String {
    format!("![{name}](images/scenes/{name}.png)")
}
