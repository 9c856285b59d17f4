//! Descriptions of the shipped scenes from docs/gallery.toml (theme, subject, error and run time of each), and their page.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use sph_core::comma_list;

use crate::shipped;
use crate::terminal::paragraph;

/// The file as it was when the program was built.
pub static GALLERY: LazyLock<Gallery> = LazyLock::new(|| {
    toml::from_str(shipped::GALLERY)
        .expect("docs/gallery.toml is read by every test of `sph scenes`")
});

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gallery {
    /// Machine and method of the run times.
    pub times: String,
    /// The scenes to begin with, and why.
    pub start: Vec<[String; 2]>,
    pub theme: Vec<Theme>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Theme {
    pub title: String,
    /// Markdown under the heading.
    pub text: Option<String>,
    pub entry: Vec<Entry>,
}

/// One scene, or some that differ in a number.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Run time by name.
    pub scenes: BTreeMap<String, String>,
    pub shows: String,
    /// References and errors, Markdown.
    pub measured: Option<String>,
    /// The moment of the picture, and its differences from the shipped scene.
    pub picture: String,
}

impl Gallery {
    pub fn find(&self, name: &str) -> Option<(&Theme, &Entry)> {
        let all = self.theme.iter();
        let mut all = all.flat_map(|theme| theme.entry.iter().map(move |entry| (theme, entry)));
        all.find(|(_, entry)| entry.scenes.contains_key(name))
    }
}

const WIDTH: usize = 120;

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

fn item(text: &str) -> String {
    paragraph(2, WIDTH, text).replacen("  * ", "* ", 1)
}

fn link(name: &str) -> String {
    format!("[`{name}`](../scenes/{name}.toml)")
}

fn image(name: &str) -> String {
    format!("![{name}](images/scenes/{name}.png)")
}
