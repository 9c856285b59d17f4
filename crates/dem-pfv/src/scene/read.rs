//! From a text to a scene of grains, or to all its mistakes.

use std::collections::BTreeMap;

use scene_text::{Diagnostic, SceneProblem, Source, conform, suggestion};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::{Value as Json, json};
use toml::{Table, Value};

use crate::scene::check;
use crate::scene::error::DemError;
use crate::scene::schema::of_scene;
use crate::scene::tables::{Probe, Reference, Scene};

/// A valid scene and the text it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Measurements by name.
    pub probes: BTreeMap<String, Probe>,
    /// Comparisons by name.
    pub references: BTreeMap<String, Reference>,
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
        Ok((scene, probes, references, table)) => Ok(Loaded {
            scene,
            probes,
            references,
            source,
            table,
        }),
        Err(Mistakes::Placed(diagnostics)) => Err((source, diagnostics)),
        Err(Mistakes::Keyed(problems)) => {
            let diagnostics = source.diagnose(&problems);
            Err((source, diagnostics))
        }
    }
}

enum Mistakes {
    Placed(Vec<Diagnostic>),
    Keyed(Vec<SceneProblem>),
}

type Parts = (
    Scene,
    BTreeMap<String, Probe>,
    BTreeMap<String, Reference>,
    Table,
);

fn loaded(source: &Source) -> Result<Parts, Mistakes> {
    let mut value = Value::Table(source.table().map_err(Mistakes::Placed)?);
    let mut problems = conform(&mut value, &of_scene()).err().unwrap_or_default();
    let Value::Table(table) = value else {
        return Err(Mistakes::Keyed(problems));
    };
    let probes = tagged::<Probe>(&table, "probe", &mut problems);
    let references = tagged::<Reference>(&table, "reference", &mut problems);
    if !problems.is_empty() {
        return Err(Mistakes::Keyed(problems));
    }
    let unread = |e: toml::de::Error| Mistakes::Keyed(vec![SceneProblem::new("", e.message())]);
    let scene: Scene = table.clone().try_into().map_err(unread)?;
    let problems = check::scene(&scene, &probes, &references, source);
    match problems.is_empty() {
        true => Ok((scene, probes, references, table)),
        false => Err(Mistakes::Keyed(problems)),
    }
}

/// Tables that the key `kind` distinguishes, each held against the schema of its kind.
fn tagged<T: DeserializeOwned + JsonSchema>(
    scene: &Table,
    name: &str,
    problems: &mut Vec<SceneProblem>,
) -> BTreeMap<String, T> {
    let root = schemars::schema_for!(T).to_value();
    let mut all = BTreeMap::new();
    let given = scene.get(name).and_then(Value::as_table);
    for (key, value) in given.into_iter().flatten() {
        let path = format!("{name}.{key}");
        match one::<T>(value, &root, name) {
            Ok(read) => {
                all.insert(key.clone(), read);
            }
            Err(found) => problems.extend(found.into_iter().map(|p| {
                let path = match p.path.as_str() {
                    "" => path.clone(),
                    inside => format!("{path}.{inside}"),
                };
                SceneProblem::new(path, p.message)
            })),
        }
    }
    all
}

fn one<T: DeserializeOwned>(
    value: &Value,
    root: &Json,
    what: &str,
) -> Result<T, Vec<SceneProblem>> {
    let variants = root["oneOf"].as_array().into_iter().flatten();
    let named: BTreeMap<&str, &Json> = variants
        .filter_map(|v| Some((v["properties"]["kind"]["const"].as_str()?, v)))
        .collect();
    let known = || named.keys().copied().collect::<Vec<_>>().join(", ");
    let told = |path: &str, message: String| vec![SceneProblem::new(path, message)];
    let Some(kind) = value.get("kind").and_then(Value::as_str) else {
        return Err(told(
            "",
            format!("the key `kind` is missing: one of {}", known()),
        ));
    };
    let Some(variant) = named.get(kind) else {
        let near = suggestion(kind, named.keys().copied());
        let message = format!(
            "there is no {what} of the kind `{kind}`{near} (there are: {})",
            known()
        );
        return Err(told("kind", message));
    };
    let mut schema = (*variant).clone();
    if let Some(defs) = root.get("$defs") {
        schema["$defs"] = defs.clone();
    }
    schema["additionalProperties"] = json!(false);
    let mut value = value.clone();
    conform(&mut value, &schema)?;
    value
        .try_into()
        .map_err(|e: toml::de::Error| told("", e.message().to_string()))
}

impl Loaded {
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
        let mut problems: Vec<_> = self.scene.files().into_iter().filter_map(missing).collect();
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
