//! What a piece of physics offers a flow.

use sph_core::{AnyField, Evolved};
use sph_neighbours::{Terms, World};
use sph_state::Laws;

use crate::{Limiter, OwnColumn, Refusal, Stages, StepWork};

/// What a contribution may know of the scene that it is in.
pub struct Setting<'a, const D: usize> {
    /// Equations of state with their reference densities and speeds of sound, in the order of the phase numbers.
    pub laws: &'a Laws,
    /// Names of the phases, in the order of their numbers.
    pub phases: &'a [String],
    /// η/ρ₀ of every phase whose law has one viscosity, m²/s; none of the others.
    pub viscosities: &'a [Option<f64>],
    /// The scalar that the formulation integrates for the density, with its rate.
    pub density: Evolved,
    /// Whether densities are sums over positions, which every motion of particles changes.
    pub summed: bool,
    /// Whether pressure is that of the end of the step, which no density that a step adds can overshoot.
    pub pressure_ahead: bool,
    /// The Courant number C of c Δt ≤ C h, for speeds of sound and elastic waves.
    pub courant: f64,
    /// C of νΔt ≤ C h².
    pub viscous: f64,
    /// Whether a step has one kick and one drift, both over all of it.
    pub kicks_once: bool,
    /// A wall that moves, if there is one.
    pub moving_wall: Option<&'a str>,
    /// Columns, walls and kernel before the first step.
    pub world: &'a World<D>,
}

/// A piece of physics. All of it is optional; what nobody offers costs nothing.
///
/// A step asks for it in this order: stages (with the sweep, which sums the terms), kick (velocities and
/// transported scalars, value ← value + Δt rate), drift; between them [`StepWork`] is done.
pub trait Contribution<const D: usize> {
    /// Refuses scenes in which it is not known; asked before everything else.
    ///
    /// # Errors
    /// The key that asks for it, and why not.
    fn check(&self, _setting: &Setting<'_, D>) -> Result<(), Refusal> {
        Ok(())
    }
    /// Columns that carry history, with their values at the start.
    fn columns(&self) -> Vec<OwnColumn<D>> {
        Vec::new()
    }
    /// Which of its columns are advanced in time, and the columns of their rates. A rate is written by a stage, or
    /// by terms that declare to write it: they add to `rates.more[world.slot(rate)?]`, all in one sweep.
    fn transported(&self) -> Vec<Evolved> {
        Vec::new()
    }
    /// Columns that somebody has to compute, although no stage, term or work reads them.
    fn goals(&self) -> Vec<AnyField> {
        Vec::new()
    }
    /// What must be known of all particles, at every evaluation. A stage that nobody needs is left out.
    fn stages(&self, _setting: &Setting<'_, D>) -> Stages<D> {
        Vec::new()
    }
    /// Terms of the interaction sweep.
    fn terms(&self, _setting: &Setting<'_, D>) -> Terms<D> {
        Vec::new()
    }
    /// Whether its terms change the density, with [`Rates::scalar`](sph_neighbours::Rates).
    fn changes_density(&self, _setting: &Setting<'_, D>) -> bool {
        false
    }
    /// Stages that depend on what is read by the stages and terms of all, by probes and by outputs.
    fn stages_for(&self, _setting: &Setting<'_, D>, _read: &[AnyField]) -> Stages<D> {
        Vec::new()
    }
    /// Terms that leave in a column what works read after the sweep (`later`), where no stage or term of all, probe or
    /// output has read it before (`read`).
    fn riding(
        &self,
        _setting: &Setting<'_, D>,
        _read: &[AnyField],
        _later: &[AnyField],
    ) -> Terms<D> {
        Vec::new()
    }
    /// Bounds on the step.
    fn limiters(&self, _setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        Vec::new()
    }
    /// Work within a step; asked once, after everything else. `read` are columns that are read by the stages and terms of
    /// all, by probes and by outputs.
    ///
    /// # Errors
    /// The key that does not fit the scene.
    fn works(
        &mut self,
        _setting: &Setting<'_, D>,
        _read: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        Ok(Vec::new())
    }
    /// What to change where one of its terms has thrown a particle about; `path` is its table in the scene.
    fn remedy(&self, _path: &str) -> Option<String> {
        None
    }
    /// What to change where one of its stages, or its work in a step, has failed; by their names.
    fn remedies_of_failures(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}
