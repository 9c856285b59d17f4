//! From a text to a scene of grains, or to all its mistakes; the schema and the files of a scene.

use std::path::PathBuf;

use scene_text::{Diagnostic, SceneProblem, Source, conform, named_files, suggestion, unit_factor};
use serde_json::{Map, Value as Json, json};
use sph_core::{editors, kind_of, schema_of};
use sph_io::{Table, read_table};
use toml::Value;

use crate::coupled::Recorded;
use crate::scene::{DemError, RecordedLoad, Scene, check};

/// A valid scene and the text it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Its text, to show mistakes in that are found later.
    pub source: Source,
    /// Overrides applied, quantities in SI: two scenes with the same table are the same.
    pub table: toml::Table,
}

/// True if a table is that of a scene of grains.
pub fn is_grain_scene(table: &toml::Table) -> bool {
    table.contains_key("grains")
}

/// Reads the scene of a text with its origin.
///
/// # Errors
/// Every mistake found, with its place.
pub fn read(source: Source) -> Result<Loaded, (Source, Vec<Diagnostic>)> {
    match loaded(&source) {
        Ok((scene, table)) => Ok(Loaded {
            scene,
            source,
            table,
        }),
        Err(diagnostics) => Err((source, diagnostics)),
    }
}

fn loaded(source: &Source) -> Result<(Scene, toml::Table), Vec<Diagnostic>> {
    let keyed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let mut value = Value::Table(source.table()?);
    conform(&mut value, &schema_of::<Scene>()).map_err(keyed)?;
    let unread = |e: toml::de::Error| keyed(vec![SceneProblem::new("", e.message())]);
    let scene: Scene = value.clone().try_into().map_err(unread)?;
    let table = value.as_table().cloned().unwrap_or_default();
    let problems = check::scene(&scene, &table, source);
    match problems.is_empty() {
        true => Ok((scene, table)),
        false => Err(keyed(problems)),
    }
}

impl Loaded {
    /// The path of a file that a key of the scene names.
    pub(crate) fn resolve(&self, key: &str, file: &str) -> Result<PathBuf, DemError> {
        let path = self.source.resolve(key, file);
        path.map_err(|e| DemError::at(key, e))
    }

    /// The load of a wall, from its file.
    ///
    /// # Errors
    /// A file that is not there, holds no such columns, or does not reach as far as the run starts.
    pub(crate) fn recorded(&self, wall: &str, load: &RecordedLoad) -> Result<Recorded, DemError> {
        let key = |name: &str| format!("wall.{wall}.recorded.{name}");
        let at = |name: &str, why: String| DemError::at(key(name), why);
        if load.columns.len() != load.places.len() {
            let [columns, places] = [load.columns.len(), load.places.len()];
            return Err(at(
                "columns",
                format!("{columns} columns for {places} places"),
            ));
        }
        let path = self.resolve(&key("file"), &load.file)?;
        let table = read_table(&path).map_err(|e| at("file", e.to_string()))?;
        let times = column(&table, "time", "s").map_err(|e| at("file", e))?;
        let columns = load.columns.iter().map(|name| column(&table, name, "Pa"));
        let columns: Result<Vec<_>, _> = columns.collect();
        let columns = columns.map_err(|e| at("columns", e))?;
        let rows = 0..times.len();
        let pressures = rows.flat_map(|row| columns.iter().map(move |c| c[row] - load.less));
        let recorded = Recorded {
            axis: load.axis,
            places: load.places.clone(),
            times: times.iter().map(|t| t - load.start).collect(),
            pressures: pressures.collect(),
        };
        if let Some(problem) = recorded.problem() {
            return Err(DemError::at(format!("wall.{wall}.recorded"), problem));
        }
        match recorded.times.last() {
            Some(last) if *last > 0.0 => Ok(recorded),
            _ => Err(at(
                "start",
                format!("the table has no row after {} s", load.start),
            )),
        }
    }

    /// Checks that every file of the scene exists, and that those with loads hold the columns of the scene.
    ///
    /// # Errors
    /// Those that are not, by their keys.
    pub fn check_files(&self) -> Result<(), DemError> {
        let missing = |(key, file): (String, String)| {
            let path = self.source.resolve(&key, &file).ok()?;
            let message = format!("there is no file `{}`", path.display());
            (!path.is_file()).then(|| SceneProblem::new(key, message))
        };
        let files = named_files(&self.table).into_iter();
        let mut problems: Vec<_> = files.filter_map(missing).collect();
        // Nothing is read from a file that is missing.
        let whole = problems.is_empty();
        for (name, wall) in self.scene.wall.iter().filter(|_| whole) {
            let read = |load| self.recorded(name, load).err();
            match wall.recorded.as_ref().and_then(read) {
                Some(DemError::Scene(found)) => problems.extend(found),
                Some(other) => return Err(other),
                None => {}
            }
        }
        match problems.is_empty() {
            true => Ok(()),
            false => Err(DemError::Scene(problems)),
        }
    }
}

/// Tables with one plugin at most, and the kind of it.
const PLUGINS: [(&str, &str); 6] = [
    ("/$defs/Grains/properties/contact", "contact-law"),
    ("/$defs/Start/properties/contact", "contact-law"),
    ("/$defs/Start/properties/wall_contact", "contact-law"),
    ("/$defs/Box/properties/contact", "contact-law"),
    ("/$defs/Wall/properties/contact", "contact-law"),
    ("/$defs/Fluid/properties/conductance", "conductance"),
];

/// The schema for editors, with the plugins of this binary. Numbers may also be strings with a unit.
pub fn editor_schema() -> Json {
    let (mut root, mut shared) = (schema_of::<Scene>(), Map::new());
    for (place, kind) in PLUGINS {
        if let (Some(place), Some(kind)) = (root.pointer_mut(place), kind_of(kind)) {
            place["maxProperties"] = json!(1);
            editors::name_plugins(place, kind, &mut shared);
        }
    }
    editors::finished(root, "Scene of grains", shared)
}

/// A column in SI; its head may have a unit.
fn column(table: &Table, name: &str, alike: &str) -> Result<Vec<f64>, String> {
    let names = table.columns.iter().map(|c| c.name.as_str());
    let absent = || {
        format!(
            "the table has no column `{name}`{}",
            suggestion(name, names)
        )
    };
    let values = table.column(name).ok_or_else(absent)?;
    let head = table.columns.iter().find(|c| c.name == name);
    let unit = head.map_or("", |c| c.unit.as_str());
    let factor = match unit {
        "" => 1.0,
        unit => unit_factor(unit, alike)?,
    };
    Ok(values.iter().map(|x| factor * x).collect())
}
