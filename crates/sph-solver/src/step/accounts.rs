//! Opens the energy budget where a probe reads it.

use sph_contribution::integrators::{Integrator, IntegratorEntry};
use sph_core::Contract;
use sph_multiphase::Formulation;
use sph_probes::Probe;
use sph_scene::Scene;

use crate::error::SolverError;
use crate::setup::choices::own_accounts;
use crate::step::energy_budget::EnergyBudget;
use crate::step::flow::Flow;

/// Opens the energy budget of a flow, if a probe reads it.
///
/// # Errors
/// If steps have another form than the budget takes, or particles come in or leave.
pub fn open<const D: usize>(
    scene: &Scene,
    probes: &[(String, Box<dyn Probe<D>>)],
    integrator: &dyn Integrator,
    formulation: &dyn Formulation<D>,
    flow: &mut Flow<D>,
) -> Result<(), SolverError> {
    let Some((name, _)) = probes.iter().find(|(_, probe)| probe.needs().books) else {
        return Ok(());
    };
    let comes = !flow.gates.is_empty();
    let goes = !flow.outlets.labels().is_empty();
    let why = match (integrator.kicks_once(), comes || goes) {
        (false, _) => {
            let take = IntegratorEntry::KIND.advice();
            format!("energy is booked for steps of one kick and one drift: take {take}")
        }
        (_, true) => {
            "particles come in or leave, and their energy is not booked: take the probe out".into()
        }
        _ => {
            let books = EnergyBudget::open(formulation, flow, &own_accounts(scene))?;
            flow.observers.push(Box::new(books));
            return Ok(());
        }
    };
    let kind = scene.table_of_probe(name);
    Err(SolverError::at(format!("{kind}.{name}.kind"), why))
}
