//! One variant: its repetitions, and the end of its folder.

use std::path::{Path, PathBuf};
use std::time::Instant;

use sph_io::IoError;
use sph_run::{
    BAD_STATE, CHECKPOINT, Command, Ended, Identity, Observer, Progress, RunOptions, Start,
};

use crate::{Origin, Record, Status, Study, Variant};

/// Options of a study.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// Folder of all its files.
    pub out: PathBuf,
    /// Threads; `None` for all cores.
    pub threads: Option<usize>,
    /// True if finished variants are run again.
    pub fresh: bool,
    /// Machine and program of the variants, for the records.
    pub origin: Origin,
}

impl Options {
    /// On all cores; finished variants stay.
    pub fn new(out: impl Into<PathBuf>, origin: Origin) -> Self {
        Options {
            out: out.into(),
            threads: None,
            fresh: false,
            origin,
        }
    }

    /// Folder of a variant.
    pub fn folder(&self, variant: &Variant) -> PathBuf {
        self.out.join("variants").join(&variant.name)
    }

    /// Earlier results of a variant.
    pub fn known(&self, variant: &Variant) -> Option<Record> {
        let record = Record::load(&self.folder(variant));
        let forgotten = self.fresh && variant.wanted;
        record.filter(|r| !forgotten && r.fingerprint == variant.fingerprint)
    }

    /// Threads in force.
    pub fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.unwrap_or_else(cores)
    }
}

/// A watcher of a study; variants may call it from several threads.
pub trait Watcher: Sync {
    /// A repetition of a variant begins or goes on.
    fn started(&self, _variant: &Variant, _repetition: usize) {}
    /// After every step.
    fn step(&self, _variant: &Variant, _progress: &Progress) {}
    /// A line worth saying.
    fn message(&self, _variant: &Variant, _text: &str) {}
    /// A variant has come to an end, or had one.
    fn finished(&self, _variant: &Variant, _record: &Record) {}
    /// True to stop, with finished variants kept.
    fn stop(&self) -> bool {
        false
    }
}

impl Watcher for () {}

pub(crate) struct Job<'a> {
    pub study: &'a Study,
    pub variant: &'a Variant,
    pub options: &'a Options,
    pub threads: usize,
    pub watcher: &'a dyn Watcher,
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Cause {
    Asked,
    Limit,
}

impl Job<'_> {
    /// Runs the missing repetitions; the record has all that is known afterwards, also after a failure.
    pub fn run(&self) -> (Record, Result<(), IoError>) {
        let file = &self.study.file;
        let mut record = self.options.known(self.variant).unwrap_or_default();
        let settled = record.settles(&self.variant.fingerprint, file.repetitions, file.time_limit);
        if !settled && (!self.variant.wanted || (self.stop)()) {
            return (record, Ok(()));
        }
        let result = match settled {
            true => Ok(()),
            false => self.repeat(&mut record),
        };
        if result.is_ok() {
            self.watcher.finished(self.variant, &record);
        }
        (record, result)
    }

    fn repeat(&self, record: &mut Record) -> Result<(), IoError> {
        let folder = self.options.folder(self.variant);
        if record.fingerprint.is_empty() && folder.exists() {
            // Files there belong to another scene, or are obsolete; a killed run of
            // this one is known by its checkpoint.
            self.remove_results(&folder)?;
        }
        sph_io::writable(&folder)?;
        record.fingerprint.clone_from(&self.variant.fingerprint);
        record.origin.clone_from(&self.options.origin);
        record.time_limit = self.study.file.time_limit;
        record.reason = None;
        while record.wall_seconds.len() < self.study.file.repetitions {
            record.status = Status::Interrupted;
            let ended = self.run_once(&folder, record)?;
            record.save(&folder)?;
            if ended != Status::Done {
                break;
            }
            if !self.study.file.keep_output {
                remove(&folder.join(CHECKPOINT));
            }
        }
        Ok(())
    }

    fn remove_results(&self, folder: &Path) -> Result<(), IoError> {
        let record = Record::path(folder);
        let kept = folder.join(CHECKPOINT).exists() && !record.exists() && !self.options.fresh;
        if kept {
            return Ok(());
        }
        // Not where another run has started.
        let _lock = sph_io::FolderLock::take(folder)?;
        std::fs::remove_dir_all(folder).map_err(|e| IoError::Write(folder.into(), e))
    }

    /// One repetition; the status is its outcome.
    fn run_once(&self, folder: &Path, record: &mut Record) -> Result<Status, IoError> {
        let repetition = record.wall_seconds.len();
        self.watcher.started(self.variant, repetition);
        let identity = format!("{} repetition {repetition}", self.variant.fingerprint);
        let identity = Identity::of_text(identity);
        let mut options = RunOptions::new(folder, identity).threads(self.threads);
        if folder.join(CHECKPOINT).exists() {
            options.start = Start::Resumed;
        }
        let limit = self.study.file.time_limit;
        let mut observer = StepRelay {
            job: self,
            since: Instant::now(),
            left: limit.map(|l| l - record.spent),
            cause: None,
        };
        let subject = &self.variant.subject;
        let mut ended = subject.run(&options, &mut observer)?;
        if matches!(ended, Ended::Unusable) {
            options.start = Start::Afresh;
            observer.since = Instant::now();
            observer.left = limit;
            ended = subject.run(&options, &mut observer)?;
        }
        let cause = observer.cause;
        match ended {
            Ended::Done(summary) => {
                record.add(&Record::from_summary(&summary));
                if record.wall_seconds.len() >= self.study.file.repetitions {
                    record.status = Status::Done;
                }
                return Ok(Status::Done);
            }
            Ended::Stopped(summary) => {
                let run = Record::from_summary(&summary);
                record.look(&run);
                (record.status, record.reason) = self.stopped(run.size.simulated_seconds, cause);
            }
            Ended::Failed(summary, reason) => {
                record.look(&Record::from_summary(&summary));
                record.size.threads = self.threads;
                record.status = Status::Failed;
                record.reason = Some(reason);
                if !self.study.file.keep_output {
                    remove(&folder.join(CHECKPOINT));
                    remove(&folder.join(BAD_STATE));
                }
            }
            Ended::Unusable => {
                record.status = Status::Failed;
                record.reason = Some("what was to start afresh found a checkpoint".into());
            }
        }
        Ok(record.status)
    }

    /// The note on a run that stopped at a time, s.
    fn stopped(&self, time: f64, cause: Option<Cause>) -> (Status, Option<String>) {
        let at = format!("at t = {time:.4} of {} s", self.variant.subject.end());
        match (cause, self.study.file.time_limit) {
            (Some(Cause::Asked), _) => (Status::Interrupted, None),
            (Some(Cause::Limit), Some(limit)) => (
                Status::OverLimit,
                Some(format!("{at} after the limit of {limit} s")),
            ),
            _ => {
                let by = "by `run.max_steps` or `run.max_wall` of the scene";
                (Status::Failed, Some(format!("stopped {at} {by}")))
            }
        }
    }
}

/// Removes a file that is of no more use; if it stays, it does no harm.
fn remove(file: &Path) {
    let _ = std::fs::remove_file(file);
}

/// Passes a run's steps on, and a stop back.
struct StepRelay<'a> {
    job: &'a Job<'a>,
    since: Instant,
    /// Seconds that are left under the time limit.
    left: Option<f64>,
    cause: Option<Cause>,
}

impl Observer for StepRelay<'_> {
    fn step(&mut self, progress: &Progress) -> Command {
        self.job.watcher.step(self.job.variant, progress);
        let over = |left: f64| self.since.elapsed().as_secs_f64() > left;
        if (self.job.stop)() {
            self.cause = Some(Cause::Asked);
        } else if self.left.is_some_and(over) {
            self.cause = Some(Cause::Limit);
        }
        match self.cause {
            Some(_) => Command::Stop,
            None => Command::Continue,
        }
    }

    fn message(&mut self, text: &str) {
        self.job.watcher.message(self.job.variant, text);
    }
}
