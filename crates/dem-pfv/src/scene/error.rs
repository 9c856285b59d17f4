//! Errors of scenes that cannot be read, assembled or run, with the names of the grains and walls at fault.

use scene_text::SceneProblem;
use sph_io::IoError;
use thiserror::Error;

use crate::coupled::CoupledError;
use crate::grains::{GrainError, Partner};
use crate::scene::{Loaded, planes};

/// Errors that keep a scene from its end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DemError {
    /// Mistakes of the scene, by their keys.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Scene(Vec<SceneProblem>),
    /// A file.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A checkpoint that does not fit.
    #[error("cannot resume: {0}")]
    Resume(String),
    /// Threads that could not be started, and the reason of the system.
    #[error("cannot start {0} threads: {1}")]
    Threads(usize, String),
    /// The run failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
}

impl DemError {
    /// A mistake at a key.
    pub(crate) fn at(path: impl Into<String>, message: impl ToString) -> Self {
        Self::Scene(vec![SceneProblem::new(path, message.to_string())])
    }

    /// 2 where nothing was run because of a wrong request, 1 otherwise.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(_) | Self::Resume(_) => 2,
            Self::Io(_) | Self::Threads(..) | Self::Failed(_) => 1,
        }
    }
}

/// A step that went wrong.
#[derive(Debug, Error)]
#[error("at t = {time} s, step {step}: {error}{named}")]
pub struct Failure {
    /// Time, s.
    pub time: f64,
    /// Steps made.
    pub step: u64,
    /// The error; it names the grain, the wall or the cell.
    #[source]
    pub error: CoupledError,
    /// Names of the grains and the wall that the error has as numbers, in brackets; empty without names.
    pub named: String,
    /// The grain at fault, if it is one.
    pub grain: Option<usize>,
    /// Place of that grain, m.
    pub position: Option<[f64; 3]>,
}

/// A refusal at the start with the names of its walls, and with the lines of its grains if they come from a file.
pub fn at_start(loaded: &Loaded, error: GrainError) -> DemError {
    let file = loaded.scene.start.file.as_ref();
    let message = format!("{error}{}", named(loaded, &error));
    DemError::at(file.map_or("start", |_| "start.file"), message)
}

/// The names of the walls and the lines of the grains that an error numbers, in brackets; empty if it has none.
pub fn named(loaded: &Loaded, error: &GrainError) -> String {
    let mut names = Vec::new();
    if let GrainError::InWall(_, wall, ..)
    | GrainError::BadWall(wall, _)
    | GrainError::TooDeep {
        body: Partner::Wall(wall),
        ..
    } = error
        && let Some(name) = planes(&loaded.scene).get(*wall)
    {
        names.push(format!("wall {wall} is `{name}`"));
    }
    if let Some(file) = &loaded.scene.start.file {
        for grain in error.grains() {
            if let Some(line) = line(loaded, file, grain) {
                names.push(format!("grain {grain} is line {line} of `{file}`"));
            }
        }
    }
    match names.is_empty() {
        true => String::new(),
        false => format!(" ({})", names.join(", ")),
    }
}

/// Line of the file in which a grain stands, from 1.
fn line(loaded: &Loaded, file: &str, grain: usize) -> Option<usize> {
    let path = loaded.source.resolve("start.file", file).ok()?;
    let text = scene_text::read_text(&path).ok()?;
    rows(&text).nth(grain).map(|(line, _)| line)
}

/// Rows of a file of spheres with the numbers of their lines, from 1; without comments and empty lines.
pub fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(line, row)| {
        let row = row.split('#').next().unwrap_or_default().trim();
        (!row.is_empty()).then_some((line + 1, row))
    })
}
