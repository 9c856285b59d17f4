//! Models that a driver runs, the watchers of their progress, and the first sign of trouble.

use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_io::{ColourRanges, IoError};

use crate::frames::Frames;
use crate::options::Start;

/// A state that advances in time, with its outputs.
///
/// Where several processes compute one flow together, each has a model and a driver of its own: they are asked the same
/// in the same order, and one of them alone has files.
pub trait Model {
    /// Error that ends a run.
    type Error: From<IoError> + std::error::Error;
    /// Content of `summary.json`.
    type Summary: Serialize;

    /// Puts the model where the run begins: by the scene, or at a checkpoint; `own` is that of the run's folder.
    /// Returns the counts until there.
    ///
    /// # Errors
    /// A checkpoint that cannot be read, or is of another run.
    fn begin(
        &mut self,
        start: &Start,
        own: &Path,
        observer: &mut Watch<'_>,
    ) -> Result<RunCounters, Self::Error>;

    /// One step that does not go beyond a time (s), repeated by the model. At a time that is reached nothing
    /// moves: the state is prepared for outputs, and judged.
    ///
    /// # Errors
    /// An error that ends the run.
    fn advance(&mut self, limit: f64, observer: &mut Watch<'_>) -> Result<Progress, Self::Error>;

    /// Names and units of the columns of `series.csv`.
    fn columns(&self) -> Vec<(String, String)>;

    /// The row of now, as long as [`Model::columns`].
    ///
    /// # Errors
    /// If it cannot be measured.
    fn row(&mut self, observer: &mut Watch<'_>) -> Result<Vec<f64>, Self::Error>;

    /// Shows the fields of now: pieces for ParaView, pictures. Without frames another process writes.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn show(
        &mut self,
        frames: Option<&mut Frames>,
        observer: &mut Watch<'_>,
    ) -> Result<(), Self::Error>;

    /// Writes a checkpoint from which [`Model::begin`] goes on bit for bit, with these counts.
    ///
    /// # Errors
    /// If it cannot be written.
    fn save(&mut self, books: &RunCounters, own: &Path) -> Result<(), Self::Error>;

    /// Common decision of all processes of the run: the error of any, or a stop of any.
    ///
    /// # Errors
    /// A file that one could not write; a process that is gone.
    fn agree(&mut self, wish: Poll<Self::Error>) -> Result<bool, Self::Error> {
        match wish {
            Poll::Written(done) => done.map(|()| false),
            Poll::Stop(stop) => Ok(stop),
        }
    }

    /// Summary of a run that is over or failed; findings may be added to the error.
    /// Nothing where another process reports it.
    ///
    /// # Errors
    /// If the state cannot be summed up.
    fn conclude(
        &mut self,
        ended: Result<Status, &mut Self::Error>,
        books: &RunCounters,
        observer: &mut Watch<'_>,
    ) -> Result<Option<Self::Summary>, Self::Error>;
}

/// A question to all processes of a run.
#[derive(Debug)]
pub enum Poll<E> {
    /// Outcome of writing the files that were due.
    Written(Result<(), E>),
    /// True to stop.
    Stop(bool),
}

/// End of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It reached its end.
    #[default]
    Done,
    /// It stopped on an error.
    Failed,
    /// It was stopped and left a checkpoint.
    Interrupted,
}

/// Counts of a driver, kept in checkpoints.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct RunCounters {
    /// Simulated time, s.
    pub time: f64,
    /// Rows of the series that were due so far.
    pub rows: u64,
    /// Time of the last row, s: a run that is over has its last row.
    #[serde(with = "bits")]
    pub last_row: Option<f64>,
    /// Bytes of the series.
    #[serde(rename = "series_position")]
    pub series: u64,
    /// Outputs of fields written.
    pub outputs: usize,
    /// Time of the next output of fields, s.
    #[serde(with = "bits")]
    pub next_output: Option<f64>,
    /// Checkpoints that were due so far.
    pub checkpoints: u64,
    /// Ranges of the colours of pictures.
    pub colours: ColourRanges,
    /// Wall-clock time, s.
    pub wall_seconds: f64,
    /// Wall-clock time of the writing since the run began or went on, s.
    #[serde(skip)]
    pub output_seconds: f64,
}

/// Times as bits, so that nothing is lost on the way through a text.
mod bits {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(time: &Option<f64>, to: S) -> Result<S::Ok, S::Error> {
        time.map(f64::to_bits).serialize(to)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<Option<f64>, D::Error> {
        Ok(Option::deserialize(from)?.map(f64::from_bits))
    }
}

/// Progress of a run.
#[derive(Clone, Debug, Default)]
pub struct Progress {
    /// Simulated time, s.
    pub time: f64,
    /// Simulated time at the end, s; a model leaves it to the driver.
    pub end: f64,
    /// Steps taken.
    pub step: u64,
    /// The last step, s.
    pub dt: f64,
    /// Bound that limited it.
    pub limiter: &'static str,
    /// Particles, grains, or other items of the model.
    pub particles: usize,
}

/// Command of an observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Go on.
    Continue,
    /// Write a checkpoint and stop.
    Stop,
}

/// A watcher of a run.
pub trait Observer {
    /// After every step.
    fn step(&mut self, progress: &Progress) -> Command;
    /// A line worth saying.
    fn message(&mut self, text: &str);
}

/// A silent watcher.
impl Observer for () {
    fn step(&mut self, _progress: &Progress) -> Command {
        Command::Continue
    }
    fn message(&mut self, _text: &str) {}
}

/// A watcher for messages of a model.
pub type Watch<'a> = dyn Observer + Send + 'a;

/// When, where and in which quantity a step first failed, whether or not a shorter one helped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trouble {
    /// Time of the state that was bad, s.
    pub time: f64,
    /// Steps taken before it.
    pub step: u64,
    /// The quantity, or the stage that reported it.
    pub quantity: String,
    /// The particle, where it is one's.
    pub particle: Option<u32>,
    /// Its place, m; empty if of no particle, or not finite.
    pub position: Vec<f64>,
    /// The value, if it is finite.
    pub value: Option<f64>,
    /// Reason.
    pub reason: String,
}
