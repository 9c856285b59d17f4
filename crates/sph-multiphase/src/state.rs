//! The stage that applies the equations of state.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

use crate::BoundState;

/// p = p(ρ), phase by phase; one virtual call per run of particles of the same phase.
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
        match self.laws.len() {
            1 => access,
            _ => access.here(fields::PHASE),
        }
    }
}

impl<const D: usize> Stage<World<D>> for PressureStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        const BATCH: usize = 1024;
        let mut pressure = world.free.take(fields::PRESSURE)?;
        let density = world.free.get(fields::DENSITY)?;
        let batches = pressure
            .par_chunks_mut(BATCH)
            .zip(density.par_chunks(BATCH));
        match &self.laws[..] {
            [law] => batches.for_each(|(p, rho)| law.pressure(rho, p)),
            laws => {
                let phase = world.free.get(fields::PHASE)?;
                batches
                    .zip(phase.par_chunks(BATCH))
                    .for_each(|((p, rho), phase)| {
                        let mut from = 0;
                        for run in phase.chunk_by(|a, b| a == b) {
                            let to = from + run.len();
                            laws[run[0] as usize].pressure(&rho[from..to], &mut p[from..to]);
                            from = to;
                        }
                    });
            }
        }
        Ok(world.free.put(fields::PRESSURE, pressure)?)
    }
}
