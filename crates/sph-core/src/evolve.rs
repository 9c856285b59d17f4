//! The state that time integrators advance: positions, and quantities with a rate.

use crate::{Field, Scalar, StepError, StepLimit};

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
    /// If a stage fails or a rate is not finite.
    fn evaluate(&mut self) -> Result<(), StepError>;
    /// Evaluates the rates at the present positions and velocities, but with density and pressure
    /// as they were last evaluated.
    ///
    /// # Errors
    /// As [`System::evaluate`].
    fn evaluate_forces(&mut self) -> Result<(), StepError>;
    /// Remembers the state and its rates.
    ///
    /// # Errors
    /// If a column is missing.
    fn keep(&mut self) -> Result<(), StepError>;
    /// Puts back the state that was kept last; rates stay as they are.
    ///
    /// # Errors
    /// If a column is missing.
    fn recall(&mut self, what: Recall) -> Result<(), StepError>;
    /// Rates become the mean of the present and the kept ones.
    ///
    /// # Errors
    /// If a column is missing.
    fn average_rates(&mut self) -> Result<(), StepError>;
    /// Velocities and evolved scalars: value += dt · rate.
    ///
    /// # Errors
    /// If a column is missing.
    fn kick(&mut self, dt: f64) -> Result<(), StepError>;
    /// Positions: r += dt · u, and with them the scalars that the motion compresses; walls follow their prescribed motion to `time() + dt`.
    ///
    /// # Errors
    /// If a column is missing.
    fn drift(&mut self, dt: f64) -> Result<(), StepError>;
    /// Present time, s.
    fn time(&self) -> f64;
    /// Bounds on the time step at the evaluated state.
    fn limits(&self) -> Vec<StepLimit>;
}
