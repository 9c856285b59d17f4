//! From the axes of a study file to labels and the scene values behind them.

use std::collections::BTreeSet;

use sph_core::{SceneProblem, is_within};
use sph_scene::Override;
use toml::{Table, Value};

use crate::reading::file;

/// A scene value with the place of the study file that gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Set {
    pub value: Override,
    pub path: String,
}

/// A direction in which variants differ.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyAxis {
    pub name: String,
    pub choices: Vec<Choice>,
}

/// A place on an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choice {
    pub label: String,
    /// Name in folders: the label, after the axis' name where the label is a bare value.
    pub slug: String,
    /// Name of a scene in place of the study's, and its path in the study file.
    pub scene: Option<(String, String)>,
    pub sets: Vec<Set>,
}

impl Choice {
    /// A place of a name that sets nothing.
    pub fn named(name: &str) -> Self {
        Choice {
            label: name.to_string(),
            slug: name.to_string(),
            ..Choice::default()
        }
    }
}

impl StudyAxis {
    /// True if its places set a key of the scene, or something around or in it.
    pub fn touches(&self, key: &str) -> bool {
        let sets = self.choices.iter().flat_map(|c| &c.sets);
        let mut paths = sets.map(|s| &s.value.path);
        paths.any(|path| is_within(path, key) || is_within(key, path))
    }
}

const AXES: usize = 100;

/// All axes of a study file.
///
/// # Errors
/// Every axis that is not one, with its place in the file.
pub fn axes(given: &[file::AxisTable]) -> Result<Vec<StudyAxis>, Vec<SceneProblem>> {
    if given.len() > AXES {
        let message = format!("{} axes are more than {AXES}", given.len());
        return Err(vec![SceneProblem::new("vary", message)]);
    }
    let mut problems = Vec::new();
    let mut axes: Vec<StudyAxis> = Vec::new();
    for (k, axis) in given.iter().enumerate() {
        let at = format!("vary[{k}]");
        match one(axis.name.as_ref(), &axis.places, &at) {
            Ok(axis) if axes.iter().any(|a| a.name == axis.name) => {
                let message = format!("there is another axis called `{}`", axis.name);
                problems.push(SceneProblem::new(at, message));
            }
            Ok(axis) => axes.push(axis),
            Err(problem) => problems.push(problem),
        }
    }
    match problems.is_empty() {
        true => Ok(axes),
        false => Err(problems),
    }
}

/// One axis of a study file, by its name, if it has one, and its path.
///
/// # Errors
/// Its first mistake, with its place in the file.
pub(crate) fn one(
    name: Option<&String>,
    places: &file::Places,
    at: &str,
) -> Result<StudyAxis, SceneProblem> {
    let labels = places.labels.as_ref();
    let problem = |key: &str, message: &str| SceneProblem::new(format!("{at}{key}"), message);
    let given = (&places.key, &places.values, &places.entries);
    let (name, choices): (String, Vec<Choice>) = match given {
        (Some(key), Some(values), None) => {
            let last = || key.rsplit('.').next().unwrap_or(key).to_string();
            let name = name.cloned().unwrap_or_else(last);
            if labels.is_some_and(|l| l.len() != values.len()) {
                let why = "there must be one label for every value";
                return Err(problem(".labels", why));
            }
            let choice = |(k, value): (usize, &Value)| {
                let set = set(key, value.clone(), format!("{at}.values[{k}]"))?;
                let bare = label(value);
                let given = labels.map(|l| l[k].clone());
                Ok(Choice {
                    slug: given.clone().unwrap_or_else(|| format!("{name}-{bare}")),
                    label: given.unwrap_or(bare),
                    sets: vec![set],
                    ..Choice::default()
                })
            };
            let choices: Result<_, SceneProblem> = values.iter().enumerate().map(choice).collect();
            (name.clone(), choices?)
        }
        (None, None, Some(entries)) => {
            if labels.is_some() {
                return Err(problem(".labels", "entries have names, not labels"));
            }
            let missing = "the key `name` is missing: what tables and plots call this axis";
            let name = name.cloned().ok_or_else(|| problem("", missing))?;
            let choice = |(k, entry): (usize, &file::Entry)| {
                let at = format!("{at}.entries[{k}]");
                let named = entry.scene.clone();
                Ok(Choice {
                    scene: named.map(|scene| (scene, format!("{at}.scene"))),
                    sets: sets(&entry.set, &format!("{at}.set"))?,
                    ..Choice::named(&entry.name)
                })
            };
            let choices: Result<_, SceneProblem> = entries.iter().enumerate().map(choice).collect();
            (name, choices?)
        }
        _ => {
            let message = "an axis has either `key` and `values`, or `name` and `entries`";
            return Err(problem("", message));
        }
    };
    if choices.is_empty() {
        return Err(problem("", "an axis needs a value"));
    }
    let mut seen = BTreeSet::new();
    match choices.iter().find(|c| !seen.insert(&c.label)) {
        Some(twice) => Err(problem("", &format!("`{}` is there twice", twice.label))),
        None => Ok(StudyAxis { name, choices }),
    }
}

fn set(key: &str, value: Value, at: String) -> Result<Set, SceneProblem> {
    let value = Override::new(key, value);
    let value = value.map_err(|p| SceneProblem::new(&at, format!("{key}: {}", p.message)))?;
    Ok(Set { value, path: at })
}

/// The scene values of a table, whose keys are paths as in `--set` or tables of such.
///
/// A table under a plain key is gone into; one under a key with a dot, and an empty one, is the value itself.
///
/// # Errors
/// A key that is no path.
pub fn sets(table: &Table, at: &str) -> Result<Vec<Set>, SceneProblem> {
    let mut all = Vec::new();
    collect(table, "", at, &mut all)?;
    Ok(all)
}

fn collect(table: &Table, key: &str, at: &str, all: &mut Vec<Set>) -> Result<(), SceneProblem> {
    for (name, value) in table {
        let below = match key {
            "" => name.clone(),
            key => format!("{key}.{name}"),
        };
        let at = format!("{at}.{name}");
        match value {
            Value::Table(inner) if !inner.is_empty() && !name.contains('.') => {
                collect(inner, &below, &at, all)?;
            }
            value => all.push(set(&below, value.clone(), at)?),
        }
    }
    Ok(())
}

/// A value as it stands in tables.
pub fn label(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(x) => format!("{x}"),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Vec<StudyAxis>, String> {
        #[derive(serde::Deserialize)]
        struct Vary {
            vary: Vec<file::AxisTable>,
        }
        let Vary { vary } = toml::from_str(text).unwrap();
        axes(&vary).map_err(|all| all[0].to_string())
    }

    #[test]
    fn values_and_entries_become_scene_values_with_their_places() {
        let axes = parsed(
            "[[vary]]\nkey = 'numerics.spacing'\nvalues = [0.5, '2 mm']\n\
             [[vary]]\nname = 'viscosity'\nentries = [{ name = 'off', set = { shifting = {}, \
             'body.a.box' = [[0], [1]], viscous-operator.krimi = {} } }]",
        )
        .unwrap();
        assert_eq!(axes[0].name, "spacing");
        assert_eq!(axes[0].choices[1].slug, "spacing-2 mm");
        assert!(axes[0].touches("numerics.spacing") && axes[0].touches("numerics"));
        assert!(!axes[0].touches("numerics.spacing_x"));
        let sets = &axes[1].choices[0].sets;
        let paths: Vec<_> = sets.iter().map(|s| (&*s.value.path, &*s.path)).collect();
        assert_eq!(
            paths,
            [
                ("body.a.box", "vary[1].entries[0].set.body.a.box"),
                ("shifting", "vary[1].entries[0].set.shifting"),
                (
                    "viscous-operator.krimi",
                    "vary[1].entries[0].set.viscous-operator.krimi"
                ),
            ]
        );
    }

    #[test]
    fn invalid_axes_are_refused() {
        for (axis, message) in [
            ("key = 'a'", "either `key` and `values`"),
            ("key = 'a'\nvalues = []", "needs a value"),
            ("key = 'a'\nvalues = [1, 1]", "`1` is there twice"),
            (
                "key = 'a'\nvalues = [1]\nlabels = []",
                "one label for every",
            ),
            ("key = 'a..b'\nvalues = [1]", "vary[0].values[0]: a..b: "),
            ("entries = [{ name = 'x' }]", "`name` is missing"),
        ] {
            let told = parsed(&format!("[[vary]]\n{axis}")).unwrap_err();
            assert!(told.contains(message), "{axis}: {told}");
        }
        let twice = "[[vary]]\nkey = 'a.x'\nvalues = [1]\n[[vary]]\nkey = 'b.x'\nvalues = [1]";
        let told = parsed(twice).unwrap_err();
        assert!(told.contains("another axis called `x`"), "{told}");
    }
}
