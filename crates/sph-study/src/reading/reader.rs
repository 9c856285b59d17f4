//! The scenes of all variants, and the conditions on all of them together.

use std::borrow::Cow;
use std::collections::BTreeMap;

use sph_core::{SceneProblem, suggestion};
use sph_run::{Subject, marks};
use sph_scene::{Override, Source};
use toml::{Table, Value};

use crate::reading::combine::{Combination, fits};
use crate::reading::mistake::placed;
use crate::reading::variant::fingerprint;
use crate::{Mistake, Refused, SceneText, Set, StudyAxis, StudyFile, Variant};

/// The key over which the order of convergence is computed, where a study names none.
const REFINEMENT: &str = "numerics.spacing";

pub(crate) struct Inputs<'a> {
    pub name: String,
    pub file: StudyFile,
    pub source: Source,
    pub find: &'a dyn Fn(&str) -> Result<SceneText, String>,
    /// Settings put on top of every variant from outside.
    pub set: &'a [Override],
    /// Patterns of the names of the variants that are to be run; none for all.
    pub only: &'a [String],
}

pub(crate) struct Reader<'a> {
    pub inputs: &'a Inputs<'a>,
    /// The scene of all places that have none of their own.
    pub scene: &'a SceneText,
    pub axes: &'a [StudyAxis],
    pub common: Vec<Set>,
    /// References that the scene must have, with their places in the study file.
    pub errors: Vec<(String, String)>,
    pub refinement: Option<String>,
}

/// The key over which the order of convergence is computed.
pub(crate) fn refinement(file: &StudyFile, axes: &[StudyAxis]) -> Option<String> {
    let varied = || axes.iter().any(|a| a.touches(REFINEMENT));
    let given = file.refinement.clone();
    given.or_else(|| varied().then(|| REFINEMENT.to_string()))
}

impl Reader<'_> {
    /// Every variant, or every mistake once.
    pub fn all(&self, all: &[Combination]) -> Result<Vec<Variant>, Refused> {
        let mut variants = Vec::new();
        let mut found: Vec<(&str, Mistake)> = Vec::new();
        for combination in all {
            match self.one(combination) {
                Ok(variant) => variants.push(variant),
                Err(mistakes) => {
                    found.extend(mistakes.into_iter().map(|m| (&*combination.name, m)))
                }
            }
        }
        match found.is_empty() {
            true => Ok(variants),
            false => Err(Refused {
                mistakes: self.told_once(found, all.len()),
            }),
        }
    }

    /// Each mistake once; a mistake of some variants is shown with one of them.
    fn told_once(&self, found: Vec<(&str, Mistake)>, variants: usize) -> Vec<Mistake> {
        let mut times: BTreeMap<String, usize> = BTreeMap::new();
        for (_, mistake) in &found {
            *times.entry(mistake.diagnostic.to_string()).or_default() += 1;
        }
        let mut told = Vec::new();
        for (name, mut mistake) in found {
            let diagnostic = &mut mistake.diagnostic;
            let Some(count) = times.remove(&diagnostic.to_string()) else {
                continue;
            };
            if count < variants && diagnostic.file != self.inputs.source.file {
                diagnostic.message = format!("variant `{name}`: {}", diagnostic.message);
            }
            told.push(mistake);
        }
        told
    }

    fn one(&self, combination: &Combination) -> Result<Variant, Vec<Mistake>> {
        let scene = self.scene(&combination.choices)?;
        let (overrides, given_by) = self.overrides(&scene, &combination.choices);
        let place =
            |scene: &Source, found: &[_]| placed(&self.inputs.source, &given_by, scene, found);
        let text = Source::new(&scene.text, &scene.file, &overrides).allowing(&scene.allowed);
        let read = scene.method.read(text);
        let subject = read.map_err(|(source, found)| place(&source, &found))?;
        let mut problems = self.missing_references(&*subject);
        let refinement = self.refinement.as_ref();
        let refinement = refinement.map(|key| value_at(&subject.resolved(), key));
        if let Some(Err(why)) = &refinement {
            problems.push(SceneProblem::new("refinement", why.clone()));
        }
        if !problems.is_empty() {
            return Err(Refused::in_study(&self.inputs.source, &problems).mistakes);
        }
        let scene = subject.source();
        let unreadable = |problem| place(scene, &scene.diagnose(&[problem]));
        let resolved = subject.resolved();
        let marks = marks(scene, &resolved).map_err(unreadable)?;
        let labels = self.axes.iter().zip(&combination.choices);
        let only = self.inputs.only;
        let name = combination.name.clone();
        Ok(Variant {
            labels: labels.map(|(a, k)| a.choices[*k].label.clone()).collect(),
            refinement: refinement.and_then(Result::ok),
            wanted: only.is_empty() || only.iter().any(|p| fits(p, &name)),
            fingerprint: fingerprint(resolved, &marks),
            errors: self.errors.iter().map(|e| e.0.clone()).collect(),
            rung: None,
            name,
            subject,
            given_by,
        })
    }

    /// The scene of a combination: that of the last choice that names one, or the study's.
    fn scene(&self, choices: &[usize]) -> Result<Cow<'_, SceneText>, Vec<Mistake>> {
        let chosen = self.axes.iter().zip(choices).rev();
        let mut own = chosen.filter_map(|(axis, k)| axis.choices[*k].scene.as_ref());
        let Some((name, path)) = own.next() else {
            return Ok(Cow::Borrowed(self.scene));
        };
        let found = (self.inputs.find)(name).map(Cow::Owned);
        found.map_err(|why| Refused::at(&self.inputs.source, path, why).mistakes)
    }

    /// Settings put on the scene, in this order, with their places.
    fn overrides(
        &self,
        scene: &SceneText,
        choices: &[usize],
    ) -> (Vec<Override>, Vec<Option<String>>) {
        let mut all: Vec<(Override, Option<String>)> = Vec::new();
        if !self.inputs.file.keep_output {
            let quiet = scene.method.quiet().iter();
            let quiet = quiet.filter_map(|text| Override::parse(text).ok());
            all.extend(quiet.map(|o| (o, None)));
        }
        let chosen = self.axes.iter().zip(choices);
        let chosen = chosen.flat_map(|(axis, k)| &axis.choices[*k].sets);
        let own = self.common.iter().chain(chosen);
        all.extend(own.map(|s| (s.value.clone(), Some(s.path.clone()))));
        all.extend(self.inputs.set.iter().map(|o| (o.clone(), None)));
        all.into_iter().unzip()
    }

    fn missing_references(&self, subject: &dyn Subject) -> Vec<SceneProblem> {
        let known = subject.references();
        let names = self.errors.iter().cloned();
        let missing = names.filter(|(name, _)| !known.contains(name));
        let problem = |(name, path): (String, String)| {
            let near = suggestion(&name, known.iter().map(String::as_str));
            let message = match known.join(", ") {
                none if none.is_empty() => "the scene has no reference to judge by".to_string(),
                all => format!("the scene has no reference called `{name}`{near} (it has: {all})"),
            };
            SceneProblem::new(path, message)
        };
        missing.map(problem).collect()
    }
}

/// The positive number at a key of a scene.
fn value_at(scene: &Table, key: &str) -> Result<f64, String> {
    let mut parts = key.split('.');
    let first = parts.next().and_then(|part| scene.get(part));
    let number = match parts.fold(first, |here, part| here?.as_table()?.get(part)) {
        Some(Value::Float(x)) => *x,
        Some(Value::Integer(i)) => *i as f64,
        Some(other) => {
            let why = format!("`{key}` is refined over and must be a number, found {other}");
            return Err(why);
        }
        None => return Err(format!("no scene of the study has a value at `{key}`")),
    };
    let why = || format!("`{key}` is refined over and must be positive, found {number}");
    let valid = number > 0.0 && number.is_finite();
    valid.then_some(number).ok_or_else(why)
}
