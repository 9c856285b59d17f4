//! Progress of a run, for its observers.

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
