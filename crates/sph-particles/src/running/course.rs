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
use crate::running::series::Extrema;
use crate::running::watches::{DepartureWatch, EnergyWatch, MachWatch};
use crate::setup::Assembled;
use crate::zones::Coupling;

/// A run on its way.
pub(crate) struct Running<'a, const D: usize> {
    pub scene: &'a Scene,
    pub options: &'a RunOptions,
    /// The ranks among which the flow is divided, if it is.
    pub ranks: Option<Arc<dyn Transport>>,
    pub parts: Assembled<D>,
    pub zones: Coupling<D>,
    /// All of a flow of which `parts` has this rank's part; on the first of several ranks alone.
    pub whole: Option<Assembled<D>>,
    pub counters: Counters,
    /// Extrema over the rows.
    pub extrema: Extrema,
    /// The state before the last step, if any was kept.
    pub good: Option<Snapshot<D>>,
    pub known: DerivedState,
    /// The last step that was tried, s, and its limit.
    pub tried: (f64, &'static str),
    /// Bounds of the step at hand.
    pub limits: Vec<StepLimit>,
    pub mach: MachWatch,
    pub energy: EnergyWatch,
    pub departure: DepartureWatch,
    /// Every rank's share, on the first at the end.
    pub shares: Vec<RankShare>,
    /// Neighbours of the particles of all ranks, at the end.
    pub around: Nearby,
}

/// Work done with the present state.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DerivedState {
    /// Its derived columns are computed.
    pub evaluated: bool,
    /// The first rank has all of it; with all that is derived from it.
    pub gathered: Option<bool>,
    /// Something of it was written.
    pub written: bool,
}

impl<const D: usize> Running<'_, D> {
    /// True if this process writes.
    pub fn writes(&self) -> bool {
        self.ranks.as_ref().is_none_or(|ranks| ranks.rank() == 0)
    }
}
