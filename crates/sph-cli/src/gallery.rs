//! Descriptions of the shipped scenes from docs/gallery.toml: theme, subject, error and run time of each.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::shipped;

/// The file as it was when the program was built.
pub static GALLERY: LazyLock<Gallery> = LazyLock::new(|| {
    toml::from_str(shipped::GALLERY)
        .expect("docs/gallery.toml is read by every test of `sph scenes`")
});

/// Descriptions of all shipped scenes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gallery {
    /// Machine and method of the run times.
    pub times: String,
    /// The scenes to begin with, and why.
    pub start: Vec<[String; 2]>,
    pub theme: Vec<Theme>,
}

/// Scenes that belong together.
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
    /// Subject in a few words.
    pub shows: String,
    /// References and errors, Markdown.
    pub measured: Option<String>,
    /// The moment of the picture, and its differences from the shipped scene.
    pub picture: String,
}

impl Gallery {
    /// The theme and the entry of a scene.
    pub fn find(&self, name: &str) -> Option<(&Theme, &Entry)> {
        let all = self.theme.iter();
        let mut all = all.flat_map(|theme| theme.entry.iter().map(move |entry| (theme, entry)));
        all.find(|(_, entry)| entry.scenes.contains_key(name))
    }
}
