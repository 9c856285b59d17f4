//! What a piece of physics offers a flow.

use sph_core::{Access, Evolved, Stage, StepError};
use sph_multiphase::{Laws, Limiter};
use sph_neighbours::{Interaction, World};

use crate::OwnColumn;

/// Stages of a contribution.
pub type Stages<const D: usize> = Vec<Box<dyn Stage<World<D>>>>;

/// What a contribution may know of the scene that it is in.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// Equations of state with their reference densities and speeds of sound, in the order of the phase numbers.
    pub laws: &'a Laws,
    /// Names of the phases, in the order of their numbers.
    pub phases: &'a [String],
}

/// A piece of physics. All of it is optional; what nobody offers costs nothing.
///
/// A step asks for it in this order: stages (with the sweep, which sums the terms), kick (velocities and
/// transported scalars, value ← value + Δt rate), [`after_kick`](Self::after_kick), drift,
/// [`after_drift`](Self::after_drift). Integrators of second order ask for parts of it twice.
pub trait Contribution<const D: usize>: Send {
    /// Columns that carry history, with their values at the start.
    fn columns(&self) -> Vec<OwnColumn<D>> {
        Vec::new()
    }
    /// Which of its columns are advanced in time, and the columns of their rates. A rate is written by a stage, or
    /// by terms that declare to write it: they add to `rates.more[world.slot(rate)?]`, all in one sweep.
    fn transported(&self) -> Vec<Evolved> {
        Vec::new()
    }
    /// What must be known of all particles, at every evaluation. A stage that nobody needs is left out.
    fn stages(&self, _setting: &Setting<'_>) -> Stages<D> {
        Vec::new()
    }
    /// Terms of the interaction sweep.
    fn terms(&self, _setting: &Setting<'_>) -> Vec<Box<dyn Interaction<D>>> {
        Vec::new()
    }
    /// Bounds on the step.
    fn limiters(&self, _setting: &Setting<'_>) -> Vec<Box<dyn Limiter<D>>> {
        Vec::new()
    }
    /// Columns that the work after kicks and drifts reads and writes, so that somebody computes them.
    fn work(&self) -> Access {
        Access::none()
    }
    /// Work on velocities and scalars that have been advanced by `dt` seconds.
    ///
    /// # Errors
    /// If a column is missing or a value impossible; the step is then rolled back.
    fn after_kick(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// Work on positions that have been advanced by `dt` seconds.
    ///
    /// # Errors
    /// As [`after_kick`](Self::after_kick).
    fn after_drift(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// What a person should know of it at the end of a run.
    fn advice(&self, _world: &World<D>) -> Vec<String> {
        Vec::new()
    }
}
