//! From a study file to variants that are known to be good, before any of them is run.

use std::path::Path;

use sph_core::{RegistryError, SceneProblem, suggestion, typed};
use sph_scene::{Override, Source, read_text};

use crate::reading::combine::{combinations, fits};
use crate::reading::mistake::placed;
use crate::reading::reader::{Inputs, Reader, refinement};
use crate::reading::{axis, ladder};
use crate::{FindScene, Ladder, Refused, StudyAxis, StudyFile, Variant};

/// A study whose variants are known to be good.
#[derive(Clone, Debug)]
pub struct Study {
    /// Name of the file without extension.
    pub name: String,
    /// The file.
    pub file: StudyFile,
    pub(crate) scene: String,
    /// Names of the references that are judged, the first one by plots.
    pub errors: Vec<String>,
    pub(crate) axes: Vec<StudyAxis>,
    /// Key over which the order of convergence is computed.
    pub(crate) refinement: Option<String>,
    /// Axes that are gone along until they break, instead of varied values.
    pub ladders: Vec<Ladder>,
    /// Settings put on top of every variant, as of `--set`.
    pub(crate) set: Vec<String>,
    /// The variants, in the order in which they run.
    pub variants: Vec<Variant>,
    pub(crate) source: Source,
}

impl Study {
    /// Reads a study file and the scenes of all its variants.
    ///
    /// `set` is put on top of every variant; variants that fit none of the patterns `only` are shown but not run.
    ///
    /// # Errors
    /// Every mistake of the study and of the scenes that follow from it.
    pub fn read(
        path: &Path,
        find: &FindScene,
        set: &[Override],
        only: &[String],
    ) -> Result<Self, ReadError> {
        let name = path.display().to_string();
        let text = read_text(path).map_err(|why| ReadError::Unreadable(name.clone(), why))?;
        Self::parse(&text, path, find, set, only)
    }

    /// Reads a study from a text; `path` is its file, from which it names the scene.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(
        text: &str,
        path: &Path,
        find: &FindScene,
        set: &[Override],
        only: &[String],
    ) -> Result<Self, ReadError> {
        let source = Source::new(text, &path.display().to_string(), &[]);
        let table = source.table();
        let table = table.map_err(|found| Refused::from_diagnostics(&source, found))?;
        let file = typed(&table).map_err(|error| match error {
            RegistryError::Parameters(problems) => Refused::in_study(&source, &problems),
            other => Refused::at(&source, "", other.to_string()),
        })?;
        let name = path.file_stem().and_then(|s| s.to_str());
        let folder = path.parent().unwrap_or(Path::new(""));
        let inputs = Inputs {
            name: name.unwrap_or("study").to_string(),
            file,
            source,
            find: &|scene| find(folder, scene),
            set,
            only,
        };
        let study = match inputs.file.axis.is_empty() {
            true => varied(inputs)?,
            false => plan_ladders(inputs)?,
        };
        let fitted = |p: &String| study.variants.iter().any(|v| fits(p, &v.name));
        if let Some(pattern) = only.iter().find(|p| !fitted(p)) {
            let names = || study.variants.iter().map(|v| v.name.as_str());
            let mut near = suggestion(pattern, names());
            if let (true, Some(one)) = (near.is_empty(), names().next()) {
                near = format!("; they are called like `{one}`");
            }
            return Err(ReadError::Only(pattern.clone(), near));
        }
        Ok(study)
    }

    /// Variants that run one after the other because each may keep the next from being run, by their numbers.
    pub(crate) fn chains(&self) -> Vec<Vec<usize>> {
        let chain = |k: &usize| self.variants[*k].rung.map(|r| (r.ladder, r.combination));
        let all: Vec<usize> = (0..self.variants.len()).collect();
        let chains = all.chunk_by(|a, b| chain(a).is_some() && chain(a) == chain(b));
        chains.map(<[usize]>::to_vec).collect()
    }

    /// Assembles a variant as a run would; returns the work of a run, of particles the pairs in the sweeps of all steps.
    ///
    /// # Errors
    /// Everything its plugins refuse, in the study file where that is to blame.
    pub fn assemble(&self, variant: &Variant) -> Result<f64, Refused> {
        let problems = match variant.subject.assemble() {
            Ok(work) => return Ok(work),
            Err(problems) => problems,
        };
        let scene = variant.subject.source();
        let found = scene.diagnose(&problems);
        let mut mistakes = placed(&self.source, &variant.given_by, scene, &found);
        // A mistake without a key of the study still belongs to a variant.
        for mistake in &mut mistakes {
            if mistake.diagnostic.file != self.source.file {
                let message = &mut mistake.diagnostic.message;
                *message = format!("variant `{}`: {message}", variant.name);
            }
        }
        Err(Refused { mistakes })
    }
}

fn varied(inputs: Inputs<'_>) -> Result<Study, Refused> {
    let (file, source) = (&inputs.file, &inputs.source);
    let refused = |problems: Vec<SceneProblem>| Refused::in_study(source, &problems);
    let at = |path: &str, why: String| Refused::at(source, path, why);
    let axes = axis::axes(&file.vary).map_err(refused)?;
    let all = combinations(&axes, file.combine, &file.skip).map_err(refused)?;
    let errors = file.error.paths("error");
    if errors.is_empty() && file.scaling.is_none() {
        let why = "a study needs an `error`, or the `scaling` of a cost";
        return Err(at("error", why.into()));
    }
    for (key, name) in file.means.iter().flat_map(|m| [("x", &m.x), ("y", &m.y)]) {
        if !errors.iter().any(|(error, _)| error == name) {
            let near = suggestion(name, errors.iter().map(|(error, _)| error.as_str()));
            let why = format!("`{name}` is not judged: expected a name of `error`{near}");
            return Err(at(&format!("means.{key}"), why));
        }
    }
    let between = file.scaling.as_ref().and_then(|s| s.between.as_ref());
    if let Some(name) = between.filter(|name| !axes.iter().any(|a| a.name == **name)) {
        let near = suggestion(name, axes.iter().map(|a| a.name.as_str()));
        let why = format!("there is no axis `{name}`{near}");
        return Err(at("scaling.between", why));
    }
    let scene = match &file.scene {
        Some(scene) => (inputs.find)(scene),
        None => Err("a study needs a scene, or axes that have their own".into()),
    };
    let scene = scene.map_err(|why| at("scene", why))?;
    let reader = Reader {
        inputs: &inputs,
        scene: &scene,
        axes: &axes,
        common: axis::sets(&file.set, "set").map_err(|p| refused(vec![p]))?,
        refinement: refinement(file, &axes),
        errors,
    };
    let variants = reader.all(&all)?;
    Ok(Study {
        errors: reader.errors.into_iter().map(|e| e.0).collect(),
        refinement: reader.refinement,
        scene: scene.name,
        ladders: Vec::new(),
        set: inputs.set.iter().map(|o| o.text.to_string()).collect(),
        name: inputs.name,
        file: inputs.file,
        source: inputs.source,
        axes,
        variants,
    })
}

/// Axes that are gone along until they break.
fn plan_ladders(inputs: Inputs<'_>) -> Result<Study, Refused> {
    let (ladders, variants) = ladder::read(&inputs)?;
    let mut scenes: Vec<&str> = Vec::new();
    for ladder in &ladders {
        let scene = &ladder.frontier.scene;
        if !scenes.contains(&scene.as_str()) {
            scenes.push(scene);
        }
    }
    Ok(Study {
        errors: Vec::new(),
        refinement: None,
        scene: scenes.join(", "),
        axes: ladder::columns(),
        set: inputs.set.iter().map(|o| o.text.to_string()).collect(),
        name: inputs.name,
        file: inputs.file,
        source: inputs.source,
        ladders,
        variants,
    })
}

/// Errors of loading a study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    #[error("cannot read `{0}`: {1}")]
    Unreadable(String, String),
    /// A pattern that no variant fits.
    #[error("no variant is called `{0}`{1}")]
    Only(String, String),
    /// The study has mistakes.
    #[error(transparent)]
    Refused(#[from] Refused),
}
