//! From a text to a scene of grains, or to all its mistakes.

use std::path::PathBuf;

use scene_text::{Diagnostic, SceneProblem, Source, conform, named_files};
use toml::{Table, Value};

use crate::scene::check;
use crate::scene::error::DemError;
use crate::scene::schema::of_scene;
use crate::scene::tables::Scene;

/// A valid scene and the text it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Its text, to show mistakes in that are found later.
    pub source: Source,
    /// Overrides applied, quantities in SI: two scenes with the same table are the same.
    pub table: Table,
}

/// True if a table is that of a scene of grains.
pub fn is_grain_scene(table: &Table) -> bool {
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

fn loaded(source: &Source) -> Result<(Scene, Table), Vec<Diagnostic>> {
    let keyed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let mut value = Value::Table(source.table()?);
    conform(&mut value, &of_scene()).map_err(keyed)?;
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
    /// Every file that the scene names, as it names it, with the key that does.
    pub fn files(&self) -> Vec<(String, String)> {
        named_files(&self.table)
    }

    /// The path of a file that a key of the scene names.
    ///
    /// # Errors
    /// A path that leads out of the folders of the scene.
    pub(crate) fn resolve(&self, key: &str, file: &str) -> Result<PathBuf, DemError> {
        let path = self.source.resolve(key, file);
        path.map_err(|e| DemError::at(key, e))
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
        let files = self.files().into_iter();
        let mut problems: Vec<_> = files.filter_map(missing).collect();
        // Nothing is read from a file that is missing.
        let whole = problems.is_empty();
        for (name, wall) in self.scene.wall.iter().filter(|_| whole) {
            let read = |load| crate::scene::recorded::read(&self.source, name, load).err();
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
