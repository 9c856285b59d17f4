//! The stage that applies the equations of state.

use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::{World, by_phase};
use sph_rheology::state::BoundState;

/// p = p(ρ) or p(ρ, γ̇), phase by phase; one virtual call per run of particles of the same phase.
pub struct PressureStage {
    /// The laws, in the order of the phase numbers.
    pub laws: std::sync::Arc<[Box<dyn BoundState>]>,
}

impl Declares for PressureStage {
    fn name(&self) -> String {
        "equation of state".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .here(fields::DENSITY)
            .writes(fields::PRESSURE);
        let access = match self.sheared() {
            true => access.here(fields::STRAIN_RATE),
            false => access,
        };
        match self.laws.len() {
            1 => access,
            _ => access.here(fields::PHASE),
        }
    }
}

impl PressureStage {
    /// True if some law reads the strain rate.
    fn sheared(&self) -> bool {
        self.laws.iter().any(|law| law.needs_strain_rate())
    }
}

impl<const D: usize> Stage<World<D>> for PressureStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut pressure = world.free.take(fields::PRESSURE)?;
        let density = world.free.get(fields::DENSITY)?;
        let strain_rate = match self.sheared() {
            true => world.free.get(fields::STRAIN_RATE)?,
            false => &[],
        };
        let phase = match self.laws.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        by_phase(phase, &mut pressure, |law, run, pressure| {
            // Without the column all slices of it are empty.
            let rate = strain_rate.get(run.clone()).unwrap_or_default();
            self.laws[law].sheared_pressure(&density[run], rate, pressure);
        });
        Ok(world.free.put(fields::PRESSURE, pressure)?)
    }
}
