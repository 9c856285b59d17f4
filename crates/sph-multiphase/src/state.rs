//! The stage that applies the equations of state.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

use crate::BoundState;

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
    /// Whether some law reads the strain rate.
    fn sheared(&self) -> bool {
        self.laws.iter().any(|law| law.needs_strain_rate())
    }
}

impl<const D: usize> Stage<World<D>> for PressureStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        const BATCH: usize = 1024;
        let mut pressure = world.free.take(fields::PRESSURE)?;
        let density = world.free.get(fields::DENSITY)?;
        let strain_rate = match self.sheared() {
            true => world.free.get(fields::STRAIN_RATE)?,
            false => &[],
        };
        // Without the column all slices of it are empty.
        let rates = |from: usize, to: usize| strain_rate.get(from..to).unwrap_or_default();
        let batches = pressure
            .par_chunks_mut(BATCH)
            .zip(density.par_chunks(BATCH))
            .enumerate()
            .map(|(k, (p, rho))| (k * BATCH, p, rho));
        match &self.laws[..] {
            [law] => batches.for_each(|(first, p, rho)| {
                law.sheared_pressure(rho, rates(first, first + rho.len()), p);
            }),
            laws => {
                let phase = world.free.get(fields::PHASE)?;
                batches
                    .zip(phase.par_chunks(BATCH))
                    .for_each(|((first, p, rho), phase)| {
                        let mut from = 0;
                        for run in phase.chunk_by(|a, b| a == b) {
                            let to = from + run.len();
                            let rate = rates(first + from, first + to);
                            let law = &laws[run[0] as usize];
                            law.sheared_pressure(&rho[from..to], rate, &mut p[from..to]);
                            from = to;
                        }
                    });
            }
        }
        Ok(world.free.put(fields::PRESSURE, pressure)?)
    }
}
