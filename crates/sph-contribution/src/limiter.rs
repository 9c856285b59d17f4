//! Bounds on the time step.

use sph_core::{StepError, StepLimit};
use sph_neighbours::World;

/// A plugin's bound on the step at the present state.
pub trait Limiter<const D: usize>: Send + Sync {
    /// The bound with its name.
    ///
    /// # Errors
    /// If a column is missing.
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError>;
    /// The formula, for listings.
    fn formula(&self) -> String;
    /// What takes the bound away or lengthens it, for runs that it holds up; a sentence without its end.
    fn remedy(&self) -> Option<String> {
        None
    }
}
