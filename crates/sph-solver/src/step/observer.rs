//! Observers of the boundaries within a step. They change nothing but columns of their own.

use sph_contribution::StepPhase;
use sph_core::StepError;
use sph_neighbours::{Interaction, World};

/// A boundary between two parts of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// The stages have run.
    Evaluated,
    /// Velocities and scalars are advanced next.
    Kicks,
    /// Velocities and scalars have been advanced.
    Kicked,
    /// The hook of a number has run in a phase.
    Hooked(StepPhase, usize),
    /// All hooks after the kick have run.
    KickEnds,
    /// Walls have turned velocities.
    Constrained,
    /// Particles drift next.
    Drifts,
}

/// The flow at a boundary.
pub(crate) struct ObservedFlow<'a, const D: usize> {
    pub world: &'a mut World<D>,
    /// The terms of the sweep.
    pub terms: &'a [Box<dyn Interaction<D>>],
    /// Length of the kick or drift, s.
    pub dt: f64,
}

/// An observer of a flow at the boundaries within its steps.
pub(crate) trait Observer<const D: usize>: Send {
    /// Looks.
    ///
    /// # Errors
    /// If a column is missing.
    fn observe(&mut self, at: Boundary, seen: &mut ObservedFlow<'_, D>) -> Result<(), StepError>;
}
