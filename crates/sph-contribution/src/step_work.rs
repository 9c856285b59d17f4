//! What a piece of physics does within a step, between the evaluations.

use std::sync::Arc;

use serde_json::Value as Json;
use sph_core::{Access, AnyField, Field, Scalar, StepError};
use sph_neighbours::{Interaction, WallForce, World};

use crate::Newborn;

/// A force that acts outside of the interaction sweep.
pub type OutsideForce<const D: usize> = Arc<dyn Interaction<D>>;

/// All forces that act: the terms of the sweep, then those outside of it.
#[derive(Clone, Copy)]
pub struct Forces<'a, const D: usize> {
    /// The terms of the sweep.
    pub sweep: &'a [Box<dyn Interaction<D>>],
    /// What acts outside of it.
    pub outside: &'a [OutsideForce<D>],
}

impl<'a, const D: usize> Forces<'a, D> {
    /// One after the other.
    pub fn iter(&self) -> impl Iterator<Item = &'a dyn Interaction<D>> + use<'a, D> {
        let sweep = self
            .sweep
            .iter()
            .map(|term| -> &'a dyn Interaction<D> { &**term });
        let outside = self.outside.iter();
        sweep.chain(outside.map(|force| -> &'a dyn Interaction<D> { &**force }))
    }
}

/// An energy that single particles store, J, by their index.
pub type StoredEnergy<'a> = Box<dyn Fn(usize) -> f64 + Sync + 'a>;

/// Work on velocities, positions and columns of its own within a step. All of it is optional.
///
/// A kick asks for [`before_kick`](Self::before_kick), advances velocities and transported scalars (or asks
/// [`kick`](Self::kick) instead), and asks for [`after_kick`](Self::after_kick). A drift asks for
/// [`before_walls`](Self::before_walls), lets walls turn velocities, asks for [`before_drift`](Self::before_drift), moves
/// particles and walls (in two halves with [`amid_drift`](Self::amid_drift) between them, where somebody wants that), and
/// asks for [`after_drift`](Self::after_drift). Integrators of second order ask for parts of it twice.
///
/// What it remembers from step to step belongs into columns: only they are rolled back when a step fails, and only they
/// are in checkpoints.
pub trait StepWork<const D: usize>: Send {
    /// For timings, and where something fails.
    fn name(&self) -> String;
    /// Columns that its work reads and writes; somebody computes those it reads.
    fn access(&self) -> Access;
    /// Columns that it leaves for the next step: they carry history.
    fn remembered(&self) -> Vec<AnyField> {
        Vec::new()
    }
    /// Why it needs all particles at once, if it does ([`Stage::needs_all`](sph_core::Stage::needs_all)).
    fn needs_all(&self) -> Option<&'static str> {
        None
    }
    /// How often it goes from particles to their neighbours ([`Stage::rings`](sph_core::Stage::rings)).
    fn rings(&self) -> usize {
        1
    }
    /// Scalars that it advances in time, as velocities are.
    fn advanced(&self) -> Vec<Field<Scalar>> {
        Vec::new()
    }
    /// The force that it takes out of the sweep, for those who measure forces.
    fn force(&self) -> Option<OutsideForce<D>> {
        None
    }
    /// Whether it advances the velocities itself, with [`kick`](Self::kick).
    fn kicks(&self) -> bool {
        false
    }
    /// Whether it has work in the middle of a drift.
    fn halves_drifts(&self) -> bool {
        false
    }
    /// Whether density, volume, pressure and γ are to be those of the present positions before a drift.
    fn needs_state_in_drifts(&self) -> bool {
        false
    }
    /// Before velocities are advanced; `forces` are all that act.
    ///
    /// # Errors
    /// If a column is missing or a value impossible, as everywhere below; the step is then rolled back.
    fn before_kick(
        &mut self,
        _world: &mut World<D>,
        _forces: Forces<'_, D>,
    ) -> Result<(), StepError> {
        Ok(())
    }
    /// Advances the velocities by `dt` seconds with the acceleration and its own force.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn kick(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// Work on velocities and scalars that have been advanced by `dt` seconds.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn after_kick(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// Before walls turn the velocities with which particles drift.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn before_walls(&mut self, _world: &mut World<D>) -> Result<(), StepError> {
        Ok(())
    }
    /// Before particles drift for `dt` seconds.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn before_drift(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// In the middle of a drift over `dt` seconds; lists, wall contacts and γ are those of the place.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn amid_drift(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// Work on positions that have been advanced by `dt` seconds.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn after_drift(&mut self, _world: &mut World<D>, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }
    /// Names of the faces by which it takes particles out.
    fn exits(&self) -> Vec<String> {
        Vec::new()
    }
    /// Particles that leave at the end of a step of `dt` seconds, by their slots, ascending, each with the number of the
    /// [exit](Self::exits). They are counted and taken out, before others come in.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn departures(
        &mut self,
        _world: &mut World<D>,
        _dt: f64,
    ) -> Result<Vec<(u32, usize)>, StepError> {
        Ok(Vec::new())
    }
    /// Whether particles may come in by it.
    fn gives_birth(&self) -> bool {
        false
    }
    /// Particles that come in at the end of a step of `dt` seconds, after others have left by outlets.
    ///
    /// # Errors
    /// As [`before_kick`](Self::before_kick).
    fn births(&mut self, _world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        Ok(Vec::new())
    }
    /// Forces on the walls in the last kick, in the order of their numbers, besides those of terms.
    fn wall_forces(&self) -> &[WallForce<D>] {
        &[]
    }
    /// The energy that it stores in particles.
    fn energy<'a>(&'a self, _world: &'a World<D>) -> Option<StoredEnergy<'a>> {
        None
    }
    /// What bounds it besides the step, for listings.
    fn bound(&self) -> Option<String> {
        None
    }
    /// Most bytes that it holds beside columns, at the present state and for a step of `dt` seconds.
    ///
    /// # Errors
    /// If a column is missing.
    fn bytes(&self, _world: &mut World<D>, _dt: f64) -> Result<usize, StepError> {
        Ok(0)
    }
    /// Most bytes that it has held beside columns so far.
    fn most_bytes(&self) -> usize {
        0
    }
    /// What it has counted, for the summary and for checkpoints.
    fn counts(&self) -> Option<Json> {
        None
    }
    /// Goes on with what a run that is resumed had counted.
    fn recount(&mut self, _counts: Json) {}
    /// Why a run that has come to its end has no result.
    fn verdict(&self) -> Option<StepError> {
        None
    }
    /// Why its results should be doubted, at the end of a run.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }
    /// What a person may try next time, at the end of a run.
    fn advice(&self, _world: &World<D>) -> Vec<String> {
        Vec::new()
    }
}
