//! One driver for the runs of all models: clock, series, fields, pictures, films, checkpoints, resume, summary.
//!
//! A [`Model`] advances to a limit, gives rows and fields, saves itself and reports its end. The driver has no
//! physics: it decides when something is due by a [`Schedule`], owns the files of the run's folder, which it locks, and
//! asks an [`Observer`] after every step whether to go on.
//!
//! * [`run()`]: a whole run.
//! * [`Opened`]: the same in two parts, for a model whose processes must agree in between.
//! * [`Subject`]: a scene that can be run, of whatever [`Method`]: the subject of studies.
//! * [`save_state()`], [`SavedState`]: a checkpoint of any state with `serde`.

mod drive;
mod frames;
mod model;
mod options;
mod schedule;
mod state;
mod subject;

pub use drive::{Opened, run};
pub use frames::{BAD_STATE, BAD_STATE_NEAR, BAD_STATE_PICTURE, Frames, Outlay};
pub use model::{Command, Model, Observer, Poll, Progress, RunCounters, Status, Trouble, Watch};
pub use options::{CHECKPOINT, FileMark, Identity, RunOptions, SERIES, SUMMARY, Start, marks};
pub use schedule::{Schedule, next_multiple};
pub use state::{SavedState, save_state};
pub use subject::{Ended, Method, Subject, unusable};
