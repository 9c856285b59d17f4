//! Work in a thread of its own, while the thread of Python passes on progress and Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use sph_run::{Command, Observer, Progress};

/// Time between two looks of the thread of Python.
const LOOK: Duration = Duration::from_millis(100);
/// The first look comes sooner, for work that is short.
const FIRST_LOOK: Duration = Duration::from_millis(5);

/// What a run has told since the last look.
#[derive(Default)]
struct Updates {
    progress: Option<Progress>,
    messages: Vec<String>,
}

/// What both threads know.
#[derive(Default)]
pub struct Shared {
    told: Mutex<Updates>,
    /// Raised to stop the work.
    pub stop: Arc<AtomicBool>,
}

/// The side of the run.
pub struct Watching<'a>(pub &'a Shared);

impl Observer for Watching<'_> {
    fn step(&mut self, progress: &Progress) -> Command {
        let mut told = self.0.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.progress = Some(progress.clone());
        match self.0.stop.load(Ordering::SeqCst) {
            true => Command::Stop,
            false => Command::Continue,
        }
    }

    fn message(&mut self, text: &str) {
        let mut told = self.0.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.messages.push(text.to_string());
    }
}

/// Does work that a thread of its own does, and calls `progress(time, end, step, dt, limiter, particles)` and
/// `message(text)` of Python now and then. If `progress` returns false, the work is told to stop.
///
/// # Errors
/// What the callbacks or a signal raise, once the work has stopped.
pub fn watched<T: Send>(
    py: Python<'_>,
    shared: &Shared,
    progress: Option<&Bound<'_, PyAny>>,
    message: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let mut raised: Option<PyErr> = None;
    let done = std::thread::scope(|scope| {
        let (sender, receiver) = sync_channel::<()>(1);
        let worker = scope.spawn(move || {
            let result = work();
            // The receiver has gone if it did not wait.
            let _ = sender.send(());
            result
        });
        let mut receiver = receiver;
        let mut wait = FIRST_LOOK;
        loop {
            let (back, ended) = py.detach(move || {
                let ended = receiver.recv_timeout(wait);
                (receiver, !matches!(ended, Err(RecvTimeoutError::Timeout)))
            });
            receiver = back;
            wait = (2 * wait).min(LOOK);
            let looked = py
                .check_signals()
                .and_then(|()| shared.look(progress, message));
            if let Err(error) = looked {
                shared.stop.store(true, Ordering::SeqCst);
                raised.get_or_insert(error);
            }
            if ended {
                break;
            }
        }
        py.detach(|| worker.join())
    });
    match (done, raised) {
        (_, Some(error)) => Err(error),
        (Ok(done), None) => Ok(done),
        (Err(_), None) => Err(PyRuntimeError::new_err(
            "the run panicked, which is a defect",
        )),
    }
}

impl Shared {
    fn look(
        &self,
        progress: Option<&Bound<'_, PyAny>>,
        message: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let told = {
            let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
            std::mem::take(&mut *told)
        };
        if let Some(message) = message {
            for text in &told.messages {
                message.call1((text,))?;
            }
        }
        let (Some(now), Some(progress)) = (told.progress, progress) else {
            return Ok(());
        };
        let said = (
            now.time,
            now.end,
            now.step,
            now.dt,
            now.limiter,
            now.particles,
        );
        let wanted = progress.call1(said)?;
        if !wanted.is_none() && !wanted.is_truthy()? {
            self.stop.store(true, Ordering::SeqCst);
        }
        Ok(())
    }
}
