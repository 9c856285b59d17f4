//! A run from start to end.

use std::path::{Path, PathBuf};
use std::time::Instant;

use sph_io::{FolderLock, IoError, SeriesWriter};

use crate::frames::{Frames, Outlay};
use crate::model::{Command, Model, Poll, Progress, RunCounters, Status, Watch};
use crate::options::{CHECKPOINT, RunOptions, SERIES, SUMMARY, Start};
use crate::schedule::{DueOutputs, Schedule};

/// Runs a model; it is at its start, or goes on from the checkpoint of its folder.
///
/// # Errors
/// A folder that another run has, files that cannot be written, what goes wrong in the model.
pub fn run<M: Model>(
    model: &mut M,
    options: &RunOptions,
    schedule: &Schedule<'_>,
    outlay: Outlay,
    observer: &mut Watch<'_>,
) -> Result<Option<M::Summary>, M::Error> {
    let opened = Opened::open(model, options, Some(outlay), observer)?;
    opened.drive(model, schedule, observer)
}

/// A run whose folder is its own, and whose model is where it begins.
pub struct Opened {
    folder: PathBuf,
    start: Start,
    books: RunCounters,
    files: Option<Files>,
    _lock: Option<FolderLock>,
    started: Instant,
    /// Wall-clock time of earlier parts of the run, s.
    before: f64,
}

struct Files {
    series: SeriesWriter,
    frames: Frames,
}

impl Opened {
    /// Takes the folder of a run and puts its model where it begins. A process without an `outlay` writes nothing.
    ///
    /// # Errors
    /// A folder that another run has, files that cannot be written, a checkpoint that is none of this run.
    pub fn open<M: Model>(
        model: &mut M,
        options: &RunOptions,
        outlay: Option<Outlay>,
        observer: &mut Watch<'_>,
    ) -> Result<Self, M::Error> {
        let (folder, started) = (&options.out, Instant::now());
        let mut held = None;
        if outlay.is_some() {
            held = Some(take(folder, observer)?);
            sph_io::writable(folder)?;
            sph_io::sweep_temporaries(folder)?;
        }
        let checkpoint = folder.join(CHECKPOINT);
        let books = model.begin(&options.start, &checkpoint, observer)?;
        let goes_on = options.start.goes_on();
        // An old checkpoint must not be resumed into the files of this run.
        if outlay.is_some() && !goes_on && checkpoint.exists() {
            observer.message(&format!(
                "note: the earlier run in {} is overwritten (--resume would have gone on with it)",
                folder.display()
            ));
            std::fs::remove_file(&checkpoint).map_err(|e| IoError::Write(checkpoint, e))?;
        }
        let files = match outlay {
            None => None,
            Some(outlay) => {
                let path = folder.join(SERIES);
                // First the steps that may be refused: a changed scene may measure other columns.
                let series = match goes_on {
                    false => SeriesWriter::create(path, model.columns())?,
                    true => SeriesWriter::open_truncated(path, books.series, model.columns())?,
                };
                let changed = options.start == Start::Changed;
                let frames = Frames::open(
                    folder,
                    outlay,
                    goes_on.then_some(books.outputs),
                    changed.then_some(books.time),
                    books.colours.clone(),
                )?;
                Some(Files { series, frames })
            }
        };
        Ok(Opened {
            folder: folder.clone(),
            start: options.start.clone(),
            before: books.wall_seconds,
            books,
            files,
            _lock: held,
            started,
        })
    }

    /// Steps the model to the end, and writes the outputs that are due.
    ///
    /// # Errors
    /// Files that cannot be written, what goes wrong in the model.
    pub fn drive<M: Model>(
        mut self,
        model: &mut M,
        schedule: &Schedule<'_>,
        observer: &mut Watch<'_>,
    ) -> Result<Option<M::Summary>, M::Error> {
        match self.drive_to_end(model, schedule, observer)? {
            Ok(status) => {
                let film = self.files.as_ref().map(|f| f.frames.film());
                let film = film.unwrap_or(Ok(())).map_err(M::Error::from);
                model.agree(Poll::Written(film))?;
                let summary = model.conclude(Ok(status), self.counters(), observer)?;
                self.write_summary::<M>(summary.as_ref())?;
                Ok(summary)
            }
            Err(mut error) => {
                let summary = model.conclude(Err(&mut error), self.counters(), observer);
                let told = summary.and_then(|summary| self.write_summary::<M>(summary.as_ref()));
                // The failure itself matters more than an error of writing about it.
                if let Err(problem) = told {
                    observer.message(&format!("the summary could not be written: {problem}"));
                }
                Err(error)
            }
        }
    }

    /// The books as they are now.
    fn counters(&mut self) -> &RunCounters {
        let books = &mut self.books;
        books.wall_seconds = self.before + self.started.elapsed().as_secs_f64();
        books
    }

    fn write_summary<M: Model>(&self, summary: Option<&M::Summary>) -> Result<(), M::Error> {
        let written = summary.map(|s| sph_io::write_json(self.folder.join(SUMMARY), s));
        Ok(written.unwrap_or(Ok(()))?)
    }

    /// Outcome of the run; a file that cannot be written does not end it.
    fn drive_to_end<M: Model>(
        &mut self,
        model: &mut M,
        schedule: &Schedule<'_>,
        observer: &mut Watch<'_>,
    ) -> Result<Result<Status, M::Error>, M::Error> {
        let time = self.books.time;
        match self.start {
            Start::Afresh => self.books.next_output = (schedule.next_output)(-1.0),
            Start::From(_) | Start::Changed => {
                self.books.next_output = (schedule.next_output)(time);
            }
            Start::Resumed => {}
        }
        let mut limit = time;
        loop {
            let now = match model.advance(limit, observer) {
                Ok(now) => Progress {
                    end: schedule.end,
                    ..now
                },
                Err(error) => return Ok(Err(error)),
            };
            let stepped = now.time > self.books.time;
            self.books.time = now.time;
            if stepped {
                let command = observer.step(&now);
                let late = |most| self.counters().wall_seconds > most;
                let stop = command == Command::Stop || schedule.max_wall.is_some_and(late);
                match model.agree(Poll::Stop(stop)) {
                    Ok(false) => {}
                    Ok(true) => {
                        self.save(model)?;
                        return Ok(Ok(Status::Interrupted));
                    }
                    Err(error) => return Ok(Err(error)),
                }
            }
            let due = schedule.due(now.time, &self.books);
            if due.any() {
                let begun = Instant::now();
                let written = self.write(model, schedule, due, observer);
                self.books.output_seconds += begun.elapsed().as_secs_f64();
                model.agree(Poll::Written(written))?;
                // The gathered findings are judged.
                if let Err(error) = model.advance(now.time, observer) {
                    return Ok(Err(error));
                }
            }
            if now.time >= schedule.end {
                return Ok(Ok(Status::Done));
            }
            if schedule.max_steps.is_some_and(|most| now.step >= most) {
                if schedule.capped == Status::Interrupted {
                    observer.message("the largest number of steps is reached");
                }
                self.save(model)?;
                return Ok(Ok(schedule.capped));
            }
            limit = schedule.target(&self.books);
        }
    }

    fn write<M: Model>(
        &mut self,
        model: &mut M,
        schedule: &Schedule<'_>,
        due: DueOutputs,
        observer: &mut Watch<'_>,
    ) -> Result<(), M::Error> {
        let time = self.books.time;
        if due.row {
            let row = model.row(observer)?;
            if let Some(files) = &mut self.files {
                files.series.row(&row)?;
                self.books.series = files.series.position();
            }
            schedule.row_written(time, &mut self.books);
        }
        if due.output {
            let mut frames = self.files.as_mut().map(|f| &mut f.frames);
            model.show(frames.as_deref_mut(), observer)?;
            let books = &mut self.books;
            books.outputs += 1;
            if let Some(frames) = frames {
                frames.written += 1;
                books.colours.clone_from(&frames.colours);
            }
            books.next_output = (schedule.next_output)(time);
        }
        if due.checkpoint {
            schedule.checkpoint_due(time, &mut self.books);
            self.save(model)?;
        }
        Ok(())
    }

    fn save<M: Model>(&mut self, model: &mut M) -> Result<(), M::Error> {
        let checkpoint = self.folder.join(CHECKPOINT);
        model.save(self.counters(), &checkpoint)
    }
}

/// Takes the folder of a run until the lock is dropped; reports a folder that was left by a killed run.
///
/// # Errors
/// If another run holds it, or it cannot be made.
fn take(folder: &Path, observer: &mut Watch<'_>) -> Result<FolderLock, IoError> {
    let lock = FolderLock::take(folder)?;
    let out = folder.display();
    if let Some(dead) = lock.taken_over_from() {
        observer.message(&format!(
            "note: {dead} had {out} and is gone without giving it back; it is taken over"
        ));
    }
    if !lock.holds() {
        observer.message(&format!(
            "note: the file system of {out} has no locks; take care that no other run writes there"
        ));
    }
    Ok(lock)
}
