//! One scene of a study, its text, and its place on an axis.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use sph_run::{FileMark, Method, Subject};
use toml::Table;

use crate::Bounds;
use crate::running::machine::VERSION;

/// One scene of a study.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Name, which is that of its folder too.
    pub name: String,
    /// Label on every axis.
    pub labels: Vec<String>,
    /// Value of the refinement's key.
    pub refinement: Option<f64>,
    /// Names of the references that are judged.
    pub errors: Vec<String>,
    /// Its place on an axis that is gone along until it breaks.
    pub rung: Option<Rung>,
    /// True if it is to be run, false if only an earlier run is shown.
    pub wanted: bool,
    /// The scene.
    pub subject: Arc<dyn Subject>,
    /// Data on which its result depends.
    pub fingerprint: String,
    /// For every override of the scene the path in the study file that gives it, if it does.
    pub(crate) given_by: Vec<Option<String>>,
}

/// A fingerprint of a resolved scene, the content of its data files by their keys, and the program's version.
///
/// Titles and descriptions do not count.
pub fn fingerprint(mut scene: Table, marks: &[FileMark]) -> String {
    scene.remove("title");
    scene.remove("description");
    let scene = toml::to_string(&scene).unwrap_or_default();
    let mut text = format!("sph {VERSION}\n{scene}");
    for mark in marks {
        text.push_str(&format!("{} {}\n", mark.key, mark.content));
    }
    format!("{:08x}-{}", crc32fast::hash(text.as_bytes()), text.len())
}

/// An axis that is gone along until it breaks.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// The axis as the results have it, before any run.
    pub frontier: Frontier,
    /// The last value that must survive.
    pub must: Option<usize>,
    /// True if variants after a red value are run all the same.
    pub to_the_end: bool,
}

/// One axis, gone along with one combination of plugins.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Frontier {
    pub axis: String,
    pub title: String,
    /// Name of the combination; empty if the axis has none.
    pub combination: String,
    pub scene: String,
    /// References in the report; the plot shows the first.
    pub errors: Vec<String>,
    pub judge: Bounds,
    /// Names of the variants, from harmless to absurd.
    pub variants: Vec<String>,
    pub values: Vec<String>,
    /// The last value that must survive.
    pub must: Option<String>,
    /// The last green value before anything that is not green.
    pub green_to: Option<String>,
    /// The last value before the first red one.
    pub holds_to: Option<String>,
    /// The first red value, with the reason.
    pub breaks_at: Option<[String; 2]>,
    /// True if nothing is red up to the value that must survive; unknown while runs are missing.
    pub met: Option<bool>,
}

/// The place of a variant on a ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rung {
    pub ladder: usize,
    /// Number of the combination of plugins with which it is gone along.
    pub combination: usize,
    pub value: usize,
}

/// The text of a scene and the file name against which it names other files.
#[derive(Clone, Debug)]
pub struct SceneText {
    /// Name without folder and extension.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its file.
    pub file: String,
    /// Folders besides its own whose files it may name.
    pub allowed: Vec<PathBuf>,
    /// Method that computes the scene.
    pub method: &'static dyn Method,
}

/// Finds the scene that a study names, from the study's folder; the error is passed on.
pub type FindScene<'a> = dyn Fn(&Path, &str) -> Result<SceneText, String> + 'a;
