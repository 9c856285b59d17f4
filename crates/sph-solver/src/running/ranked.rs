//! A run on several ranks: the first gathers what all have found, and writes it.

use std::sync::Arc;

use sph_core::{StepError, System};
use sph_decomposition::{PartError, Transport};
use sph_scene::Scene;

use crate::failure::error::SolverError;
use crate::running::beginning::begin;
use crate::running::course::Running;
use crate::running::options::RunOptions;
use crate::setup::assemble::{Assembled, assemble};
use crate::step::stages::lock;

/// Whether all ranks are ready, which all must ask.
pub(crate) fn all_ready<T>(
    ranks: &dyn Transport,
    ready: Result<T, SolverError>,
) -> Result<T, SolverError> {
    let mut failed = [f64::from(u8::from(ready.is_err()))];
    let told = ranks.largest(&mut failed).map_err(PartError::from);
    let ready = ready?;
    told.map_err(StepError::from)?;
    match failed[0] > 0.0 {
        true => Err(StepError::from(PartError::Elsewhere).into()),
        false => Ok(ready),
    }
}

/// Refuses what cannot be divided between ranks, before anything is written.
pub(crate) fn refuse_the_indivisible<const D: usize>(
    parts: &Assembled<D>,
    ranks: usize,
) -> Result<(), SolverError> {
    if parts.integrator.keeps_state() {
        let why = "it goes back to a state within a step, which cannot follow particles to another rank: take \
                   `symplectic-euler` for several ranks";
        return Err(SolverError::at("integrator", why));
    }
    if let Some(why) = parts.flow.indivisible() {
        return Err(SolverError::at("", why));
    }
    let particles = parts.flow.world.free.len();
    match ranks > particles {
        true => Err(SolverError::at(
            "",
            format!("{ranks} ranks for {particles} particles: some would own nothing"),
        )),
        false => Ok(()),
    }
}

/// Leaves this rank its part; the first gets another assembly, for the whole.
pub(crate) fn divide<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    ranks: Arc<dyn Transport>,
    parts: &mut Assembled<D>,
) -> Result<Option<Assembled<D>>, SolverError> {
    let mut whole = None;
    if ranks.rank() == 0 {
        let mut all = assemble::<D>(scene)?;
        begin(scene, options, false, &mut all.flow, &mut ())?;
        whole = Some(all);
    }
    parts.flow.divide(ranks)?;
    Ok(whole)
}

impl<const D: usize> Running<'_, D> {
    /// What is shown and measured: the whole flow, where this process has it.
    pub(crate) fn shown(&self) -> &Assembled<D> {
        self.whole.as_ref().unwrap_or(&self.parts)
    }

    /// Brings the whole flow to the state of all ranks; with all that is derived from it, if it is to be `evaluated`. Every rank
    /// must ask. Nothing where one process runs all.
    pub(crate) fn gather(&mut self, evaluated: bool) -> Result<(), SolverError> {
        let flow = &mut self.parts.flow;
        let Some(parts) = &mut flow.parts else {
            return Ok(());
        };
        parts.all_well().map_err(StepError::from)?;
        let whole = self.whole.as_mut().map(|w| &mut w.flow);
        let Some(whole) = whole else {
            return Ok(parts.gather(&flow.world, None).map_err(StepError::from)?);
        };
        let gathered = parts.gather(&flow.world, Some(&mut whole.world));
        gathered.map_err(StepError::from)?;
        if let (Some(own), Some(all)) = (&flow.walls, &whole.walls) {
            let states = lock(own).states();
            let (set, time) = (&mut whole.world.walls, flow.world.time);
            let moved = lock(all).put_back(set, &states, time);
            moved.map_err(|e| SolverError::at("wall", e.to_string()))?;
        }
        whole.loads.clone_from(&flow.loads);
        whole.world.lists.builds = flow.world.lists.builds;
        whole.restored = true;
        if evaluated {
            whole.evaluate()?;
        }
        Ok(())
    }

    /// A cause to end the run that any rank has, which all must ask for.
    pub(crate) fn agreed(&mut self, own: Option<StepError>) -> Option<StepError> {
        let Some(parts) = &mut self.parts.flow.parts else {
            return own;
        };
        match parts.any(own.is_some(), false) {
            Ok(_) => None,
            Err(elsewhere) => Some(own.unwrap_or_else(|| elsewhere.into())),
        }
    }

    /// Ends the run on all ranks if one could not write.
    pub(crate) fn all_have_written(
        &mut self,
        written: Result<(), SolverError>,
    ) -> Result<(), SolverError> {
        let Some(parts) = &mut self.parts.flow.parts else {
            return written;
        };
        match parts.any(written.is_err(), false) {
            Err(PartError::Elsewhere) if written.is_err() => written,
            Err(other) => Err(StepError::from(other).into()),
            Ok(_) => Ok(()),
        }
    }

    /// Tells the other ranks of a failure that they may not know of; gives the cause that the first of those has who know one.
    pub(crate) fn known_to_all(&mut self, cause: StepError) -> StepError {
        match &mut self.parts.flow.parts {
            None => cause,
            Some(parts) => parts.confess(cause),
        }
    }
}
