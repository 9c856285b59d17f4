//! The commands of the command line.

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use pyo3::prelude::*;
use sph_cli::library::{self, SceneArguments};

use crate::errors;
use crate::scene::opened;
use crate::watch::{Shared, Watching, watched};

/// Text for people, JSON for programs.
type Pair = (String, String);

/// `sph check`.
#[pyfunction]
pub fn check(
    scene: &Bound<'_, PyAny>,
    set: Vec<String>,
    allow_path: Vec<PathBuf>,
    threads: Option<usize>,
) -> PyResult<Pair> {
    let py = scene.py();
    let opened = opened(scene, set, allow_path)?;
    let told = py.detach(|| library::check(&opened, threads));
    let told = told.map_err(|t| errors::from_trouble(py, &t))?;
    Ok((told.text, told.json.to_string()))
}

/// `sph explain`.
#[pyfunction]
pub fn explain(
    scene: &Bound<'_, PyAny>,
    set: Vec<String>,
    allow_path: Vec<PathBuf>,
) -> PyResult<Pair> {
    let py = scene.py();
    let opened = opened(scene, set, allow_path)?;
    let told = py.detach(|| library::explain(&opened));
    let told = told.map_err(|t| errors::from_trouble(py, &t))?;
    Ok((told.text, told.json.to_string()))
}

/// How a run is asked for.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RunArguments {
    set: Vec<String>,
    allow_path: Vec<PathBuf>,
    out: Option<PathBuf>,
    threads: Option<u16>,
    resume: bool,
    changed: bool,
    start: Option<PathBuf>,
}

/// `sph run`: text, JSON, folder, and whether it was stopped before its end.
#[pyfunction]
pub fn run(
    scene: &Bound<'_, PyAny>,
    arguments: RunArguments,
    progress: Option<&Bound<'_, PyAny>>,
    message: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, String, PathBuf, bool)> {
    let py = scene.py();
    let (set, allow_path) = (arguments.set, arguments.allow_path);
    let opened = opened(scene, set.clone(), allow_path.clone())?;
    let wanted = library::RunArguments {
        scene: SceneArguments {
            scene: opened.shown.clone(),
            set,
            allow_path,
        },
        out: arguments.out,
        threads: arguments.threads,
        resume: arguments.resume && arguments.start.is_none(),
        changed: arguments.changed,
        from: arguments.start,
        ..Default::default()
    };
    let folder = library::folder(&wanted, &opened);
    let shared = Shared::default();
    let ran = watched(py, &shared, progress, message, || {
        library::run(&wanted, &opened, &mut Watching(&shared))
    })?;
    let ended = ran.map_err(|t| errors::from_run(py, &t))?;
    let stopped = ended.going_on.is_some();
    Ok((
        ended.told.text,
        ended.told.json.to_string(),
        folder,
        stopped,
    ))
}

/// How a study is asked for.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct StudyArguments {
    set: Vec<String>,
    allow_path: Vec<PathBuf>,
    out: Option<PathBuf>,
    threads: Option<u16>,
    only: Vec<String>,
    fresh: bool,
    quiet: bool,
}

/// `sph study`: text, JSON, and how to go on if it was stopped before its end.
#[pyfunction]
pub fn study(
    py: Python<'_>,
    study: String,
    arguments: StudyArguments,
) -> PyResult<(String, String, Option<String>)> {
    let wanted = library::StudyArguments {
        study: Some(study),
        out: arguments.out,
        threads: arguments.threads,
        only: arguments.only,
        set: arguments.set,
        allow_path: arguments.allow_path,
        fresh: arguments.fresh,
        quiet: arguments.quiet,
        ..Default::default()
    };
    let shared = Shared::default();
    let stop = shared.stop.clone();
    let done = watched(py, &shared, None, None, || library::study(&wanted, stop))?;
    debug_assert!(!shared.stop.load(Ordering::SeqCst));
    let studied = done.map_err(|t| errors::from_trouble(py, &t))?;
    Ok((
        studied.told.text,
        studied.told.json.to_string(),
        studied.going_on,
    ))
}

/// The command line itself, with the arguments of the process after `python -m sph`; its exit code.
#[pyfunction]
pub fn main(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| sph_cli::library::command_line(arguments))
}
