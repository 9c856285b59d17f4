//! The viscosity column.

use rayon::prelude::*;
use sph_core::{Access, Declares, Field, Scalar, Stage, StepError, fields};
use sph_neighbours::World;
use sph_rheology::Inputs;

use crate::Rheologies;
use crate::batches::{BATCH, runs};

/// η of every particle by the law of its phase; where phases differ or a law depends on the flow.
pub struct ViscosityStage {
    /// The laws.
    pub laws: Rheologies,
    /// The pressure that makes friction.
    pub pressure: Field<Scalar>,
}

/// What the laws read, as columns.
pub fn inputs_of(laws: &Rheologies, pressure: Field<Scalar>) -> Access {
    let mut access = Access::none();
    if laws.len() > 1 {
        access = access.here(fields::PHASE);
    }
    if laws.iter().any(|l| l.needs().strain_rate) {
        access = access.here(fields::STRAIN_RATE);
    }
    match laws.iter().any(|l| l.needs().pressure) {
        true => access.here(pressure),
        false => access,
    }
}

impl Declares for ViscosityStage {
    fn name(&self) -> String {
        "rheology".into()
    }
    fn access(&self) -> Access {
        inputs_of(&self.laws, self.pressure).writes(fields::VISCOSITY)
    }
}

impl<const D: usize> Stage<World<D>> for ViscosityStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut viscosity = world.free.take(fields::VISCOSITY)?;
        let strain_rate = world.free.get(fields::STRAIN_RATE).unwrap_or(&[]);
        let pressure = world.free.get(self.pressure).unwrap_or(&[]);
        let phase = match self.laws.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        let batches = viscosity.par_chunks_mut(BATCH).enumerate();
        batches.for_each(|(k, viscosity)| {
            let from = k * BATCH;
            for (law, run) in runs(phase, from, viscosity.len()) {
                let inputs = Inputs {
                    strain_rate: strain_rate.get(run.clone()).unwrap_or(&[]),
                    pressure: pressure.get(run.clone()).unwrap_or(&[]),
                };
                let out = &mut viscosity[run.start - from..run.end - from];
                self.laws[law].viscosity(&inputs, out);
            }
        });
        Ok(world.free.put(fields::VISCOSITY, viscosity)?)
    }
}
