//! The end of a run or a study, and errors that end a command, with their texts.

use dem_pfv::scene::DemError;
use serde_json::{Value as Json, json};
use sph_core::{SceneProblem, number};
use sph_io::IoError;
use sph_io::curves::DrawError;
use sph_particles::RunError;
use sph_scene::Source;
use sph_solver::SolverError;
use sph_study::{Mistake, ReadError};

use crate::terminal::console::CommandOutput;
use crate::terminal::{console, diagnostics};

/// The end of a run or a study, which may be a stop by the user.
#[derive(Default)]
pub struct Ended {
    /// Its summary or results.
    pub told: CommandOutput,
    /// State that is kept and the command to go on, if it stopped before its end.
    pub going_on: Option<String>,
}

impl Ended {
    /// Prints the summary or results, to a program even if quiet, and after a stop the command to go on.
    pub(crate) fn conclude(&self, json: bool, quiet: bool) -> Result<(), Trouble> {
        if json || !quiet {
            self.told.print(json);
        }
        let Some(going_on) = &self.going_on else {
            return Ok(());
        };
        console::err(going_on);
        Err(Trouble::Interrupted)
    }
}

/// The reason why a command ended early.
pub enum Trouble {
    /// The command line has a mistake.
    Usage(String),
    /// The scene has mistakes.
    Scene(Vec<Mistake>),
    /// The run failed; the summary it left, if it did.
    Failed {
        /// The error.
        told: Box<ModelError>,
        /// Content of `summary.json`.
        summary: Option<Box<Json>>,
        /// The way to go on.
        advice: Option<String>,
    },
    /// The run stopped with a checkpoint; all messages are written.
    Interrupted,
    /// Two compared results differ; all messages are written.
    Different,
}

/// A mistake in the command line.
impl From<String> for Trouble {
    fn from(message: String) -> Self {
        Trouble::Usage(message)
    }
}

impl From<ReadError> for Trouble {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Refused(refused) => Trouble::Scene(refused.mistakes),
            other => Trouble::Usage(other.to_string()),
        }
    }
}

impl From<IoError> for Trouble {
    fn from(error: IoError) -> Self {
        ModelError::from(RunError::Io(error)).into()
    }
}

/// A file that cannot be written is a failure; other errors are mistakes in the arguments.
impl From<DrawError> for Trouble {
    fn from(error: DrawError) -> Self {
        match error {
            DrawError::Io(error @ (IoError::Write(..) | IoError::DiskFull(..))) => error.into(),
            other => Trouble::usage(other.to_string()),
        }
    }
}

/// Text of an error of a model.
#[derive(Default)]
pub struct ModelError {
    /// Mistakes of the scene, if it is these.
    mistakes: Vec<SceneProblem>,
    error: String,
    /// The particle, and possible remedies, in lines.
    more: String,
    code: u8,
    pub ran: bool,
    pub remedy: Option<&'static str>,
}

impl From<RunError> for ModelError {
    fn from(error: RunError) -> Self {
        let mut told = ModelError {
            error: error.to_string(),
            code: 1,
            ..ModelError::default()
        };
        match error {
            RunError::Solver(SolverError::Scene(problems)) => told.mistakes = problems,
            RunError::Solver(SolverError::Plan(_)) => {
                told.mistakes = vec![SceneProblem::new("", told.error.clone())];
            }
            RunError::Failed(failure) => {
                told.ran = true;
                told.more = crate::commands::outcome::failure(&failure);
            }
            RunError::Io(io) => {
                told.remedy = remedy(&io);
                // One that could not be *written* leaves the one before.
                if let IoError::Read(path, _) | IoError::Checkpoint(path, _) = io
                    && path.extension().is_some_and(|e| e == "sph")
                {
                    let why = "a checkpoint that cannot be read cannot be resumed";
                    told.more = format!("{why}: start again without --resume\n");
                }
            }
            _ => {}
        }
        told
    }
}

impl From<DemError> for ModelError {
    fn from(error: DemError) -> Self {
        let mut told = ModelError {
            error: error.to_string(),
            code: error.exit_code(),
            ..ModelError::default()
        };
        match error {
            DemError::Scene(problems) => told.mistakes = problems,
            DemError::Failed(failure) => {
                told.ran = true;
                if let (Some(grain), Some(at)) = (failure.grain, failure.position) {
                    let at = at.map(number::plain).join(", ");
                    told.more = format!("grain {grain} at ({at}) m\n");
                }
                told.more.push_str(
                    "bad_state.vtu and bad_state.png show all grains as they were, the one at fault ringed\n\
                     the last checkpoint stands: try --resume --changed with a smaller run.safety\n",
                );
            }
            DemError::Io(io) => told.remedy = remedy(&io),
            _ => {}
        }
        told
    }
}

impl From<ModelError> for Trouble {
    fn from(told: ModelError) -> Self {
        Trouble::Failed {
            told: Box::new(told),
            summary: None,
            advice: None,
        }
    }
}

impl Trouble {
    /// Text of an error of a model, with places in the scene if the scene is at fault.
    pub fn in_scene(error: impl Into<ModelError>, source: &Source) -> Self {
        let told = error.into();
        match told.mistakes.as_slice() {
            [] => told.into(),
            found => Trouble::Scene(Mistake::located(source, &source.diagnose(found))),
        }
    }

    /// A bad command line.
    pub fn usage(message: impl Into<String>) -> Self {
        Trouble::Usage(message.into())
    }

    /// 1 for a run that failed or was interrupted, 2 for bad usage or a bad scene.
    pub fn exit_code(&self) -> u8 {
        match self {
            Trouble::Usage(_) | Trouble::Scene(_) => 2,
            Trouble::Failed { told, .. } => told.code,
            Trouble::Interrupted | Trouble::Different => 1,
        }
    }

    /// The text for a person.
    pub fn text(&self, colour: bool) -> String {
        match self {
            Trouble::Usage(message) => format!("error: {message}\n"),
            Trouble::Scene(all) => diagnostics::render(all, colour),
            Trouble::Failed { told, advice, .. } => {
                let advice = advice.as_ref();
                let advice = advice.map_or(String::new(), |advice| format!("{advice}\n"));
                format!("error: {}\n{}{advice}", told.error, told.more)
            }
            Trouble::Interrupted | Trouble::Different => String::new(),
        }
    }

    /// The output for a program: diagnostics as an array, or the summary that a failed run left.
    pub fn json(&self) -> Json {
        match self {
            Trouble::Usage(message) => json!([{ "message": message }]),
            Trouble::Scene(all) => diagnostics::json(all),
            Trouble::Failed { told, summary, .. } => match summary {
                // The remaining text, or else the error alone.
                Some(summary) => (**summary).clone(),
                None => json!([{ "message": told.error }]),
            },
            Trouble::Interrupted | Trouble::Different => Json::Null,
        }
    }

    /// Reports to a person on stderr, and with `json` a program on stdout.
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

/// First remedy where a file could not be written.
fn remedy(error: &IoError) -> Option<&'static str> {
    match error {
        IoError::DiskFull(..) => Some("make room"),
        IoError::Write(..) | IoError::NotWritable(..) => Some("make the folder writable"),
        _ => None,
    }
}
