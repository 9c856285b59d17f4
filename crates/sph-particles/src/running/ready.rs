//! A run before its first step.

use std::sync::Arc;

use sph_neighbours::Nearby;
use sph_neighbours::decomposition::Transport;
use sph_run::{RunOptions, Start};
use sph_scene::Scene;

use crate::RunError;
use crate::running::counters::Counters;
use crate::running::course::{DerivedState, Running, StateBeforeStep};
use crate::running::output::Outputs;
use crate::running::ranked;
use crate::running::series::Extrema;
use crate::running::watches::{DepartureWatch, EnergyWatch, MachWatch};
use crate::setup::{assemble_share, readable, refuse_the_indivisible, rehearse, short_steps};
use crate::zones::attach;

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
