//! The tables of a study file.

use std::collections::BTreeMap;

use serde_json::Value as Json;
use sph_core::parameters;
use toml::{Table, Value};

use crate::Scaling;

/// A table whose keys are those of a scene.
type SceneValues = serde_json::Map<String, Json>;

/// A study file as it stands.
#[parameters]
pub struct StudyFile {
    /// The comparison in one line.
    pub title: String,
    /// Subject of the study and its results.
    pub description: Option<String>,
    /// The scene: a path relative to the study file, or the name of a shipped scene. Every `axis` may have its own.
    pub scene: Option<String>,
    /// Name, or names, of the scene's references by which variants are judged; plots show the first.
    #[parameter(default)]
    pub error: OneOrMany,
    /// Scene values put on every variant.
    #[parameter(default)]
    #[schemars(with = "SceneValues")]
    pub set: Table,
    /// Axes of variation.
    #[parameter(default)]
    pub vary: Vec<AxisTable>,
    /// Instead of `vary`: axes that are gone along one by one, each from harmless to absurd, until it breaks.
    #[parameter(default)]
    pub axis: Vec<Ladder>,
    /// Combinations of plugins with which every `axis` is gone along; the scenes' own if left out.
    #[parameter(default)]
    pub combination: Vec<Combination>,
    /// Bounds of green and of yellow by quantity, for every `axis` that gives none of its own.
    #[parameter(default)]
    pub judge: Bounds,
    /// Combination of axes: crossed, or side by side.
    #[parameter(default)]
    pub combine: Combine,
    /// Key of the scene over which the order of convergence is computed; `numerics.spacing` if left out and varied.
    pub refinement: Option<String>,
    /// Cost against the number of particles, with or without `error`.
    pub scaling: Option<Scaling>,
    /// A plot of means: of a reference with the norm `mean` over those of another, beside the values of both.
    pub means: Option<MeansPlot>,
    /// Number of runs of a variant; its time is the least.
    #[parameter(default: 1, min: 1, max: 1000)]
    pub repetitions: usize,
    /// True if variants run one by one with all threads, false if side by side with one thread each.
    #[parameter(default: true)]
    pub serial: bool,
    /// Largest wall-clock time of a variant, s; no limit if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub time_limit: Option<f64>,
    /// True if variants write the pictures, fields and checkpoints of the scene.
    #[parameter(default)]
    pub keep_output: bool,
    /// Combinations that are left out: names of axes, each with a label or a list of labels.
    #[parameter(default)]
    #[schemars(with = "Vec<BTreeMap<String, Json>>")]
    pub skip: Vec<BTreeMap<String, Value>>,
}

/// Two judged references whose means are plotted, markers for every number of particles.
#[parameters]
#[derive(serde::Serialize)]
pub struct MeansPlot {
    /// Name of the reference along the horizontal axis.
    pub x: String,
    /// Name of the reference along the vertical axis.
    pub y: String,
}

/// One direction in which variants differ.
#[parameters]
pub struct AxisTable {
    /// Name in tables and plots; the last part of `key` if left out.
    pub name: Option<String>,
    /// Its places.
    #[serde(flatten)]
    pub places: Places,
}

/// Places on an axis.
#[parameters]
pub struct Places {
    /// Key of the scene that takes the `values`.
    pub key: Option<String>,
    /// Values of `key`, along an `axis` from harmless to absurd.
    #[schemars(with = "Option<Vec<Json>>")]
    pub values: Option<Vec<Value>>,
    /// Names of the `values`, as many.
    pub labels: Option<Vec<String>>,
    /// Instead of `key` and `values`: named entries, each with the scene values that it sets.
    pub entries: Option<Vec<Entry>>,
}

/// An axis that is gone along until it breaks.
#[parameters]
pub struct Ladder {
    /// Name in tables and folders.
    pub name: String,
    /// Varied quantity, with its unit, for pages and plots.
    pub title: String,
    /// Scene of this axis; the study's if left out.
    pub scene: Option<String>,
    /// References of the scene in the report; the plot shows the first.
    #[parameter(default)]
    pub error: OneOrMany,
    /// Scene values put on every run of this axis.
    #[parameter(default)]
    #[schemars(with = "SceneValues")]
    pub set: Table,
    /// Its places.
    #[serde(flatten)]
    pub places: Places,
    /// Label of the last value that must survive.
    #[schemars(with = "Option<Json>")]
    pub must: Option<Value>,
    /// Bounds of green and of yellow by quantity: a reference, or a quantity of every run.
    #[parameter(default)]
    pub judge: Bounds,
    /// True if variants after a red value are run all the same.
    #[parameter(default)]
    pub to_the_end: bool,
}

/// A combination of plugins with which axes are gone along.
#[parameters]
pub struct Combination {
    /// Name in tables and folders.
    pub name: String,
    /// Names of the axes that it is for; all if left out.
    #[parameter(default)]
    pub axes: Vec<String>,
    /// Scene values that it sets, before those of the axis' values.
    #[parameter(default)]
    #[schemars(with = "SceneValues")]
    pub set: Table,
}

/// Largest value that is green and largest that is yellow, by the name of the quantity.
pub type Bounds = BTreeMap<String, [f64; 2]>;

/// A named place on an axis.
#[parameters]
pub struct Entry {
    /// Name in tables, plots and folders.
    pub name: String,
    /// Scene in place of the study's: two models of the same sample stand side by side.
    pub scene: Option<String>,
    /// Scene values that it sets; a plugin takes the place of the present one, `shifting = {}` removes it.
    #[parameter(default)]
    #[schemars(with = "SceneValues")]
    pub set: Table,
}

/// Combination of axes to variants.
#[parameters]
pub enum Combine {
    /// Every value with every other.
    #[default]
    Product,
    /// The first values together, the second ones, and so on.
    Zip,
}

/// One name or several.
#[parameters]
#[serde(untagged)]
pub enum OneOrMany {
    /// One.
    One(String),
    /// Several.
    Many(Vec<String>),
}

impl Default for OneOrMany {
    fn default() -> Self {
        OneOrMany::Many(Vec::new())
    }
}

impl OneOrMany {
    /// The names with their paths below a key of the study file.
    pub fn paths(&self, key: &str) -> Vec<(String, String)> {
        match self {
            OneOrMany::One(name) => vec![(name.clone(), key.to_string())],
            OneOrMany::Many(names) => {
                let path = |(k, name): (usize, &String)| (name.clone(), format!("{key}[{k}]"));
                names.iter().enumerate().map(path).collect()
            }
        }
    }
}
