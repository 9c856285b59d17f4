//! A run on its way: the particles, and their counts.

use std::sync::Arc;

use sph_core::StepLimit;
use sph_neighbours::Nearby;
use sph_neighbours::decomposition::Transport;
use sph_run::{RunOptions, Start};
use sph_scene::Scene;
use sph_solver::Snapshot;

use crate::RunError;
use crate::results::summary::RankShare;
use crate::running::counters::Counters;
use crate::running::output::Outputs;
use crate::running::ranked;
use crate::running::watches::{DepartureWatch, EnergyWatch, MachWatch};
use crate::running::writing::Extrema;
use crate::setup::{
    Assembled, assemble_share, readable, refuse_the_indivisible, rehearse, short_steps,
};
use crate::zones::{Coupling, attach};

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

/// A run that has not begun, of a scene that nothing is refused of.
pub(crate) fn ready<'a, const D: usize>(
    scene: &'a Scene,
    options: &'a RunOptions,
    ranks: Option<Arc<dyn Transport>>,
) -> Result<Running<'a, D>, RunError> {
    let share = ranked::share(scene, options, ranks.as_ref());
    let mut parts = assemble_share::<D>(scene, share)?;
    let begun = !parts.flow.is_blank();
    if begun {
        rehearse(scene, &mut parts.flow, &parts.probes)?;
        let mut limits = parts.flow.step_limits()?;
        parts.flow.least_limits(&mut limits)?;
        let remedies = parts.flow.remedies_of_bounds()?;
        let short = short_steps(scene, &limits, &remedies)?;
        parts.warnings.extend(short);
    }
    readable(scene)?;
    if let Some(name) = scene.zone.keys().next() {
        let why = match (&ranks, &options.start) {
            (Some(_), _) => Some("zones run in one process: take `--ranks` out"),
            (_, Start::From(_)) => Some("a run with zones begins at its start: take `--from` out"),
            _ => None,
        };
        if let Some(why) = why {
            return Err(RunError::at(format!("zone.{name}"), why));
        }
    }
    let zones = attach(scene, &parts)?;
    if let Some(ranks) = &ranks {
        refuse_the_indivisible(&parts.flow, ranks.ranks())?;
    }
    Ok(Running {
        scene,
        options,
        ranks,
        whole: None,
        counters: Counters::begin(),
        extrema: Extrema::NONE,
        outputs: Outputs::from_scene(scene, parts.pressure),
        good: StateBeforeStep::default(),
        known: DerivedState::default(),
        tried: (0.0, "none"),
        limits: Vec::new(),
        mach: MachWatch::default(),
        energy: EnergyWatch::from_scene(scene, &parts.flow, None),
        departure: DepartureWatch::default(),
        shares: Vec::new(),
        around: Nearby::NONE,
        parts,
        zones,
    })
}
