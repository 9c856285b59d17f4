//! Sources and sinks of particles, and particles that come in.

use std::sync::Arc;

use sph_core::{Access, StepError, Vect};
use sph_neighbours::World;

/// A place where particles leave or come in at the end of a step.
///
/// Departures are counted and taken out, then outlets are emptied, then births come in.
pub trait Gate<const D: usize>: Send {
    /// Name in errors.
    fn name(&self) -> String;
    /// Columns that it reads and writes.
    fn access(&self) -> Access;
    /// Names of the exits by which particles leave.
    fn exits(&self) -> Vec<String> {
        Vec::new()
    }
    /// Particles that leave at the end of a step of `dt` seconds, by their slots, ascending, each with the number of the
    /// [exit](Self::exits).
    ///
    /// # Errors
    /// If a column is missing or a value impossible; the step is then rolled back.
    fn departures(
        &mut self,
        _world: &mut World<D>,
        _dt: f64,
    ) -> Result<Vec<(u32, usize)>, StepError> {
        Ok(Vec::new())
    }
    /// Particles that come in at the end of a step of `dt` seconds.
    ///
    /// # Errors
    /// As [`departures`](Self::departures).
    fn births(&mut self, _world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        Ok(Vec::new())
    }
}

/// A particle that comes into the flow at the end of a step.
///
/// Its density is that of the equation of state's pressure there; the quantity that a formulation integrates follows
/// from it. Densities that are sums get its mass at once: let a particle in with little of it, or where no particle is
/// near.
#[derive(Clone, Debug)]
pub struct Newborn<const D: usize> {
    /// Position, m.
    pub position: Vect<D>,
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Density, kg/m³.
    pub density: f64,
    /// Mass, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Number of its phase.
    pub phase: u32,
    /// Its origin, for columns that [begin](crate::Birth) with it.
    pub body: Arc<str>,
    /// Values of columns that contributions bring along, by the names of the columns; the others begin with the values
    /// of the columns.
    pub values: Arc<[(String, f64)]>,
}
