//! docs/gallery.md.

use sph_core::comma_list;

use crate::gallery::{Entry, Gallery};
use crate::terminal::paragraph;

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
        page.extend(theme.entry.iter().map(of_entry));
    }
    page
}

fn of_entry(entry: &Entry) -> String {
    let names = comma_list(entry.scenes.keys().map(|name| link(name)));
    let times = comma_list(entry.scenes.values());
    let shows = &entry.shows;
    let measured = entry.measured.as_ref();
    let measured = measured.map_or(String::new(), |m| format!(" {m}"));
    let images: Vec<String> = entry.scenes.keys().map(|name| image(name)).collect();
    // Its moment alone is no difference from the shipped scene.
    let picture = match entry.picture.contains(", ") {
        true => format!(" Picture at {}.", entry.picture),
        false => String::new(),
    };
    let images = images.join(" ");
    item(&format!(
        "* {names}: {shows}.{measured} Time: {times}.{picture} {images}"
    ))
}

/// An item of a list, broken between words.
fn item(text: &str) -> String {
    paragraph(2, WIDTH, text).replacen("  * ", "* ", 1)
}

fn link(name: &str) -> String {
    format!("[`{name}`](../scenes/{name}.toml)")
}

fn image(name: &str) -> String {
    format!("![{name}](images/scenes/{name}.png)")
}
