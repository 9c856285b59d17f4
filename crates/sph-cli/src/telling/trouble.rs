//! Everything that keeps a command from its end, and how it is told.

use dem_scene::DemError;
use serde_json::{Value as Json, json};
use sph_core::SceneProblem;
use sph_io::IoError;
use sph_run::RunError;
use sph_scene::{LoadError, Source};
use sph_solver::SolverError;
use sph_study::{ReadError, Refused};

use crate::commands::grains;
use crate::telling::console;
use crate::telling::diagnostics::{self, Located};

/// Why a command did not do what it was asked for.
pub enum Trouble {
    /// The command line asks for something that cannot be.
    Usage(String),
    /// The scene has mistakes.
    Scene(Vec<Located>),
    /// The run failed; the summary it left, if it did.
    Failed {
        /// What happened.
        error: RunError,
        /// Content of `summary.json`.
        summary: Option<Box<Json>>,
        /// How to go on.
        advice: Option<String>,
    },
    /// A run of grains failed; as `Failed`.
    Grains {
        /// What happened.
        error: DemError,
        /// Content of `summary.json`.
        summary: Option<Box<Json>>,
        /// How to go on.
        advice: Option<String>,
    },
    /// The run stopped with a checkpoint; everything has been said.
    Interrupted,
    /// What was compared differs; everything has been said.
    Different,
}

impl From<LoadError> for Trouble {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Refused(refused) => {
                Trouble::Scene(diagnostics::located(&refused.source, &refused.diagnostics))
            }
            unreadable => Trouble::Usage(unreadable.to_string()),
        }
    }
}

impl From<ReadError> for Trouble {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Refused(refused) => refused.into(),
            other => Trouble::Usage(other.to_string()),
        }
    }
}

impl From<Refused> for Trouble {
    fn from(refused: Refused) -> Self {
        Trouble::Scene(refused.mistakes.into_iter().map(Located::from).collect())
    }
}

impl Trouble {
    /// What a run of grains says, with places in the scene where it is the scene's fault.
    pub fn of_grains(error: DemError, source: &Source) -> Self {
        match error {
            DemError::Scene(problems) => {
                Trouble::Scene(diagnostics::located(source, &source.diagnose(&problems)))
            }
            error => Trouble::Grains {
                error,
                summary: None,
                advice: None,
            },
        }
    }

    /// A bad command line.
    pub fn usage(message: impl Into<String>) -> Self {
        Trouble::Usage(message.into())
    }

    /// What the solver says, with places in the scene where it is the scene's fault.
    pub fn of(error: impl Into<RunError>, source: &Source) -> Self {
        let problems = match error.into() {
            RunError::Solver(SolverError::Scene(problems)) => problems,
            error if error.exit_code() == 2 => vec![SceneProblem::new("", error.to_string())],
            error => {
                return Trouble::Failed {
                    error,
                    summary: None,
                    advice: None,
                };
            }
        };
        Trouble::Scene(diagnostics::located(source, &source.diagnose(&problems)))
    }

    /// 1 for a run that failed or was interrupted, 2 for bad usage or a bad scene.
    pub fn exit_code(&self) -> u8 {
        match self {
            Trouble::Usage(_) | Trouble::Scene(_) => 2,
            Trouble::Failed { .. } | Trouble::Interrupted | Trouble::Different => 1,
            Trouble::Grains { error, .. } => error.exit_code(),
        }
    }

    /// What a person is told.
    pub fn text(&self, colour: bool) -> String {
        let with = |text: String, advice: &Option<String>| match advice {
            Some(advice) => format!("{text}{advice}\n"),
            None => text,
        };
        match self {
            Trouble::Usage(message) => format!("error: {message}\n"),
            Trouble::Scene(all) => diagnostics::render(all, colour),
            Trouble::Failed { error, advice, .. } => with(failed(error), advice),
            Trouble::Grains { error, advice, .. } => with(grains::failed::text(error), advice),
            Trouble::Interrupted | Trouble::Different => String::new(),
        }
    }

    /// What a program is told: diagnostics as an array, or the summary that a failed run left.
    pub fn json(&self) -> Json {
        match self {
            Trouble::Usage(message) => json!([{ "message": message }]),
            Trouble::Scene(all) => diagnostics::json(all),
            Trouble::Failed { error, summary, .. } => left(summary, error),
            Trouble::Grains { error, summary, .. } => left(summary, error),
            Trouble::Interrupted | Trouble::Different => Json::Null,
        }
    }

    /// Tells a person on stderr, and with `json` a program on stdout.
    pub fn report(&self, json: bool) {
        let text = self.text(console::terminal());
        match self {
            Trouble::Interrupted | Trouble::Different => return,
            Trouble::Scene(_) => console::coloured(&text),
            _ => console::err(&text),
        }
        if json {
            console::json(&self.json());
        }
    }
}

/// The summary that was left, or else the error alone.
fn left(summary: &Option<Box<Json>>, error: &impl std::fmt::Display) -> Json {
    match summary {
        Some(summary) => (**summary).clone(),
        None => json!([{ "message": error.to_string() }]),
    }
}

fn failed(error: &RunError) -> String {
    let mut text = format!("error: {error}\n");
    match error {
        RunError::Failed(failure) => text.push_str(&crate::commands::failed::text(failure)),
        RunError::Io(io) if is_unreadable_checkpoint(io) => text.push_str(
            "a checkpoint that cannot be read cannot be resumed: start again without --resume\n",
        ),
        _ => {}
    }
    text
}

/// Whether a checkpoint could not be read; one that could not be *written* leaves the one before.
fn is_unreadable_checkpoint(error: &IoError) -> bool {
    let read = matches!(error, IoError::Read { .. } | IoError::Checkpoint { .. });
    read && error.path().extension().is_some_and(|e| e == "sph")
}
