//! From a file to a validated scene, or to all its mistakes.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use scene_text::{Diagnostic, Override, Source, read_text};
use sph_core::{SceneProblem, conform, kinds};
use thiserror::Error;
use toml::{Table, Value};

use crate::Scene;
use crate::checks;
use crate::reading::plugins::{self, Plugins};
use crate::reading::suited::add_suited;
use crate::reading::{hints, limits, renamed, schema, units};

/// A valid scene and the text it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Its text, to show mistakes in that are found later.
    pub source: Source,
}

impl Loaded {
    /// The scene as a table: overrides applied, quantities of the scene's own keys in SI.
    ///
    /// Two scenes with the same table are the same scene, however they are written.
    pub fn resolved(&self) -> Table {
        match resolved(&self.source) {
            Ok((Value::Table(table), _)) => table,
            // It has been read from this source before.
            _ => Table::new(),
        }
    }
}

/// A scene that is not valid.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The mistakes found, sorted by position.
    pub diagnostics: Vec<Diagnostic>,
    /// The text they stand in.
    pub source: Source,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.diagnostics.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Refused {}

/// Errors of loading a scene from a file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A file that cannot be read, and the reason of the system.
    #[error("cannot read `{0}`: {1}")]
    Unreadable(String, String),
    /// The scene has mistakes.
    #[error(transparent)]
    Refused(Box<Refused>),
}

/// Reads a scene file, with overrides put on top.
///
/// # Errors
/// If the file cannot be read, or with the mistakes in it: all of its form and its plugins, or else all of its content.
pub fn load(path: &Path, overrides: &[Override]) -> Result<Loaded, LoadError> {
    let file = path.display().to_string();
    let text = read_text(path).map_err(|why| LoadError::Unreadable(file.clone(), why))?;
    let source = Source::new(&text, &file, overrides);
    read(source).map_err(|refused| LoadError::Refused(Box::new(refused)))
}

/// Reads a scene from a text; `name` is its file name, against which it names other files.
///
/// # Errors
/// Every mistake found.
pub fn parse(text: &str, name: &str, overrides: &[Override]) -> Result<Loaded, Refused> {
    read(Source::new(text, name, overrides))
}

/// Reads the scene of a text with its origin.
///
/// # Errors
/// Every mistake found.
pub fn read(source: Source) -> Result<Loaded, Refused> {
    match scene(&source) {
        Ok(scene) => Ok(Loaded { scene, source }),
        Err(diagnostics) => Err(Refused {
            diagnostics,
            source,
        }),
    }
}

fn scene(source: &Source) -> Result<Scene, Vec<Diagnostic>> {
    let diagnosed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let unread = |e: toml::de::Error| diagnosed(vec![SceneProblem::new("", e.message())]);
    let (resolved, mut remarks) = resolved(source)?;
    let mut whole = resolved.as_table().cloned().unwrap_or_default();
    units::to_dynamic(&mut whole);
    let (of_plugins, mistakes) = plugins::of_plugins(&whole);
    let mut table = Value::Table(whole.clone());
    let plugins = take_plugins(&mut table).map_err(unread)?;
    let mut scene: Scene = table.try_into().map_err(unread)?;
    scene.plugins = plugins;
    let mut problems = checks::scene(&mut scene, source);
    add_new(&mut problems, mistakes);
    if !problems.is_empty() {
        return Err(diagnosed(hints::added(problems, &whole)));
    }
    add_suited(&mut scene);
    remarks.extend(of_plugins);
    let remarks = source.diagnose(&remarks);
    scene.remarks = remarks.iter().map(Diagnostic::to_string).collect();
    for (name, wall) in &mut scene.wall {
        let found = source.diagnose(&[SceneProblem::new(format!("wall.{name}"), "")]);
        wall.place = found.first().map(|d| format!("{}:{}", d.file, d.line));
    }
    Ok(scene)
}

/// Takes the tables out that name plugins: kinds are open, so that no type has them as fields.
fn take_plugins(scene: &mut Value) -> Result<BTreeMap<&'static str, Plugins>, toml::de::Error> {
    let mut all = BTreeMap::new();
    let Some(scene) = scene.as_table_mut() else {
        return Ok(all);
    };
    for kind in kinds().iter().filter(|k| k.has_table()) {
        if let Some(plugins) = scene.remove(kind.name) {
            all.insert(kind.name, plugins.try_into()?);
        }
    }
    Ok(all)
}

/// The table of the scene in the form of its schema, and remarks on its numbers.
fn resolved(source: &Source) -> Result<(Value, Vec<SceneProblem>), Vec<Diagnostic>> {
    let mut table = source.table()?;
    let diagnosed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let mut problems = limits::check(&table);
    if !problems.is_empty() {
        return Err(diagnosed(problems));
    }
    let former = renamed::replace(&mut table).unwrap_or_else(|both| {
        problems.push(both);
        Vec::new()
    });
    problems.extend(checks::tables(&table));
    problems.extend(units::convert(&mut table));
    let mut written = table.clone();
    units::to_dynamic(&mut written);
    let mut value = Value::Table(table);
    let mut remarks = conform(&mut value, &schema::of_scene()).unwrap_or_else(|found| {
        problems.extend(found);
        Vec::new()
    });
    remarks.extend(former);
    match problems.is_empty() {
        true => Ok((value, remarks)),
        false => {
            add_new(&mut problems, plugins::of_plugins(&written).1);
            Err(diagnosed(hints::added(problems, &written)))
        }
    }
}

/// Adds problems at keys of which nothing is known yet.
fn add_new(problems: &mut Vec<SceneProblem>, more: Vec<SceneProblem>) {
    for problem in more {
        if problems.iter().all(|p| p.path != problem.path) {
            problems.push(problem);
        }
    }
}
