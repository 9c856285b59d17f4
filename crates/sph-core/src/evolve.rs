//! What a time integrator sees: positions, and quantities with a rate.

use crate::{Field, Scalar, StepError, StepLimit};

/// A scalar that a formulation wants integrated in time.
#[derive(Clone, Copy, Debug)]
pub struct Evolved {
    /// The quantity.
    pub value: Field<Scalar>,
    /// Its rate of change.
    pub rate: Field<Scalar>,
}

/// The system a time integrator advances. It knows no particle, only these motions.
pub trait System {
    /// Evaluates all rates at the present state and time.
    ///
    /// # Errors
    /// If a stage fails or a rate is not finite.
    fn evaluate(&mut self) -> Result<(), StepError>;
    /// Velocities and evolved scalars: value += dt · rate.
    ///
    /// # Errors
    /// If a column is missing.
    fn kick(&mut self, dt: f64) -> Result<(), StepError>;
    /// Positions: r += dt · u; walls follow their prescribed motion to `time() + dt`.
    ///
    /// # Errors
    /// If a column is missing.
    fn drift(&mut self, dt: f64) -> Result<(), StepError>;
    /// Present time, s.
    fn time(&self) -> f64;
    /// Bounds on the time step at the evaluated state.
    fn limits(&self) -> Vec<StepLimit>;
}
