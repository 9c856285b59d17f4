//! A run on its way: the particles, and their counts.

use std::sync::Arc;

use sph_core::StepLimit;
use sph_neighbours::Nearby;
use sph_neighbours::decomposition::Transport;
use sph_run::RunOptions;
use sph_scene::Scene;
use sph_solver::Snapshot;

use crate::results::summary::RankShare;
use crate::running::counters::Counters;
use crate::running::output::Outputs;
use crate::running::series::Extrema;
use crate::running::watches::{DepartureWatch, EnergyWatch, MachWatch};
use crate::setup::Assembled;
use crate::zones::Coupling;

/// A run on its way.
pub(crate) struct Running<'a, const D: usize> {
    pub(crate) scene: &'a Scene,
    pub(crate) options: &'a RunOptions,
    /// The ranks among which the flow is divided, if it is.
    pub(crate) ranks: Option<Arc<dyn Transport>>,
    pub(crate) parts: Assembled<D>,
    /// Its zones of finer particles.
    pub(crate) zones: Coupling<D>,
    /// All of a flow of which `parts` has this rank's part; on the first of several ranks alone.
    pub(crate) whole: Option<Assembled<D>>,
    pub(crate) counters: Counters,
    /// Extrema over the rows.
    pub(crate) extrema: Extrema,
    pub(crate) outputs: Outputs,
    /// The state before the last step.
    pub(crate) good: StateBeforeStep<D>,
    /// Knowledge of the present state.
    pub(crate) known: DerivedState,
    /// The last step that was tried, s, and its limit.
    pub(crate) tried: (f64, &'static str),
    /// Bounds of the step at hand.
    pub(crate) limits: Vec<StepLimit>,
    pub(crate) mach: MachWatch,
    pub(crate) energy: EnergyWatch,
    pub(crate) departure: DepartureWatch,
    /// Every rank's share, on the first at the end.
    pub(crate) shares: Vec<RankShare>,
    /// Neighbours of the particles of all ranks, at the end.
    pub(crate) around: Nearby,
}

/// The state before the last step, if any was kept.
#[derive(Default)]
pub(crate) struct StateBeforeStep<const D: usize> {
    pub(crate) snapshot: Snapshot<D>,
    pub(crate) taken: bool,
}

impl<const D: usize> StateBeforeStep<D> {
    pub(crate) fn state(&self) -> Option<&Snapshot<D>> {
        self.taken.then_some(&self.snapshot)
    }
}

/// Work done with the present state.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DerivedState {
    /// Its derived columns are computed.
    pub(crate) evaluated: bool,
    /// The first rank has all of it; with all that is derived from it.
    pub(crate) gathered: Option<bool>,
    /// Something of it was written.
    pub(crate) written: bool,
}

impl<const D: usize> Running<'_, D> {
    /// True if this process writes.
    pub(crate) fn writes(&self) -> bool {
        self.ranks.as_ref().is_none_or(|ranks| ranks.rank() == 0)
    }
}
