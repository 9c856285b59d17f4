//! Values of probes before the first step.

use sph_core::StepError;
use sph_probes::Probe;
use sph_scene::Scene;
use sph_solver::{Flow, SolverError};

/// Probes by name.
pub type Probes<const D: usize> = [(String, Box<dyn Probe<D>>)];

/// Measures once without writing, so that a wrong probe is found before anything exists.
pub fn rehearse<const D: usize>(
    scene: &Scene,
    flow: &mut Flow<D>,
    probes: &Probes<D>,
) -> Result<(), SolverError> {
    measure_walls(flow, probes)?;
    for (name, probe) in probes {
        let kind = match scene.gauge.contains_key(name) {
            true => "gauge",
            false => "probe",
        };
        let problem = |e: StepError| match e {
            StepError::Stage { reason, .. } => SolverError::at(format!("{kind}.{name}"), reason),
            other => other.into(),
        };
        probe.measure(&flow.world).map_err(problem)?;
    }
    Ok(())
}

/// Measures the forces on walls that probes read.
pub fn measure_walls<const D: usize>(
    flow: &mut Flow<D>,
    probes: &Probes<D>,
) -> Result<(), StepError> {
    let read = probes.iter().filter_map(|(_, p)| p.needs().force_on);
    let read: Vec<&str> = read.collect();
    match read.is_empty() {
        true => Ok(()),
        false => flow.measure_wall_forces(|name| read.contains(&name)),
    }
}
