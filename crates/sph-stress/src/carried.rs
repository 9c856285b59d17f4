//! The elastic stress that acts.

use rayon::prelude::*;
use sph_core::{Access, Declares, Field, Scalar, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;
use sph_rheology::Inputs;

use crate::Rheologies;
use crate::batches::{BATCH, runs};
use crate::viscosity::inputs_of;

/// [`CARRIED_STRESS`](fields::CARRIED_STRESS) from the remembered one; zero in phases without
/// an elastic part.
pub struct CarriedStress {
    /// The laws.
    pub laws: Rheologies,
    /// The pressure that makes friction.
    pub pressure: Field<Scalar>,
}

impl Declares for CarriedStress {
    fn name(&self) -> String {
        "carried stress".into()
    }
    fn access(&self) -> Access {
        inputs_of(&self.laws, self.pressure)
            .here(fields::ELASTIC_STRESS)
            .writes(fields::CARRIED_STRESS)
    }
}

impl<const D: usize> Stage<World<D>> for CarriedStress {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut carried = world.free.take(fields::CARRIED_STRESS)?;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let strain_rate = world.free.get(fields::STRAIN_RATE).unwrap_or(&[]);
        let pressure = world.free.get(self.pressure).unwrap_or(&[]);
        let phase = match self.laws.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        let batches = carried.par_chunks_mut(BATCH).enumerate();
        batches.for_each(|(k, carried)| {
            let from = k * BATCH;
            for (law, run) in runs(phase, from, carried.len()) {
                let out = &mut carried[run.start - from..run.end - from];
                let inputs = Inputs {
                    strain_rate: strain_rate.get(run.clone()).unwrap_or(&[]),
                    pressure: pressure.get(run.clone()).unwrap_or(&[]),
                };
                match self.laws[law].elastic() {
                    Some(elastic) => elastic.carried(&inputs, &stress[run], out),
                    None => out.fill(Symmetric::ZERO),
                }
            }
        });
        Ok(world.free.put(fields::CARRIED_STRESS, carried)?)
    }
}
