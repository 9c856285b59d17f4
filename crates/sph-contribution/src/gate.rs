//! Sources and sinks of particles.

use sph_core::{Access, StepError};
use sph_neighbours::World;

use crate::Newborn;

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
