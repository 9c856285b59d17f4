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
    /// Remedies that take the bound away or lengthen it, for runs that it holds up; a sentence without its end.
    fn remedy(&self) -> Option<String> {
        None
    }
}
