//! The state that time integrators advance: positions, and quantities with a rate; bounds on their steps.

use crate::{Field, Scalar, StepError};

/// A scalar that a formulation integrates in time.
#[derive(Clone, Copy, Debug)]
pub struct Evolved {
    /// The quantity.
    pub value: Field<Scalar>,
    /// Its rate of change.
    pub rate: Field<Scalar>,
}

/// The state that [`System::recall`] puts back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recall {
    /// Positions, velocities, integrated scalars and the clock.
    State,
    /// Velocities and integrated scalars: undoes kicks.
    Motion,
    /// Integrated scalars.
    Scalars,
}

/// The system a time integrator advances. It has these motions, and no particles.
pub trait System {
    /// Evaluates all rates at the present state and time.
    ///
    /// # Errors
    /// If a stage fails, a rate is not finite or a column is missing, as everywhere below.
    fn evaluate(&mut self) -> Result<(), StepError>;
    /// Evaluates the rates at the present positions and velocities, but with density and pressure
    /// as they were last evaluated.
    fn evaluate_forces(&mut self) -> Result<(), StepError>;
    /// Remembers the state and its rates.
    fn keep(&mut self) -> Result<(), StepError>;
    /// Puts back the state that was kept last; rates stay as they are.
    fn recall(&mut self, what: Recall) -> Result<(), StepError>;
    /// Rates become the mean of the present and the kept ones.
    fn average_rates(&mut self) -> Result<(), StepError>;
    /// Velocities and evolved scalars: value += dt · rate.
    fn kick(&mut self, dt: f64) -> Result<(), StepError>;
    /// Positions: r += dt · u, and with them the scalars that the motion compresses; walls follow their prescribed motion to `time() + dt`.
    fn drift(&mut self, dt: f64) -> Result<(), StepError>;
    /// Present time, s.
    fn time(&self) -> f64;
    /// Bounds on the time step at the evaluated state.
    fn limits(&self) -> Vec<StepLimit>;
}

/// A plugin's own bound on the time step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepLimit {
    /// Short name for the summary: "sound", "viscosity", "force".
    pub name: &'static str,
    /// Largest stable step, s; infinite where it does not bind.
    pub dt: f64,
}

impl StepLimit {
    /// A bound of `dt` seconds called `name`.
    pub fn new(name: &'static str, dt: f64) -> Self {
        StepLimit { name, dt }
    }

    /// The smallest of several bounds; a bound that is not a number counts as zero.
    pub fn least(limits: &[StepLimit]) -> Option<&StepLimit> {
        let key = |l: &StepLimit| if l.dt.is_nan() { 0.0 } else { l.dt };
        limits.iter().min_by(|a, b| key(a).total_cmp(&key(b)))
    }
}
