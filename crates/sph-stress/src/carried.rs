//! The elastic stress that acts.

use sph_core::{Access, Declares, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;
use sph_rheology::Yielding;

use crate::{Blend, Felt};

/// [`CARRIED_STRESS`](fields::CARRIED_STRESS) from the remembered one; zero in phases without
/// an elastic part. Where forces are blended it is the whole stress of the solid, cut to the yield stress.
pub struct CarriedStress(pub Felt);

impl Declares for CarriedStress {
    fn name(&self) -> String {
        "carried stress".into()
    }
    fn access(&self) -> Access {
        self.0
            .access()
            .here(fields::ELASTIC_STRESS)
            .writes(fields::CARRIED_STRESS)
    }
}

impl<const D: usize> Stage<World<D>> for CarriedStress {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let blend = self.0.blend;
        let mut carried = world.free.take(fields::CARRIED_STRESS)?;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        self.0.each(world, &mut carried, |law, inputs, run, out| {
            match law.elastic() {
                Some(elastic) if blend == Blend::Forces => {
                    let stress = &stress[run];
                    let mut yielding = vec![Yielding::NONE; stress.len()];
                    elastic.yielding(inputs, stress, &mut yielding);
                    let all = out.iter_mut().zip(stress).zip(&yielding);
                    all.for_each(|((out, stress), yielding)| *out = *stress * yielding.held);
                }
                Some(elastic) => elastic.carried(inputs, &stress[run], out),
                None => out.fill(Symmetric::ZERO),
            }
        })?;
        Ok(world.free.put(fields::CARRIED_STRESS, carried)?)
    }
}
