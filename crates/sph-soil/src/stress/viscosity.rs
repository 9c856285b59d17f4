//! The viscosity column.

use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

use crate::stress::{Blend, LawInputs};

/// η of every particle by the law of its phase; where phases differ or a law depends on the flow. Where forces are
/// blended it is that of the liquid alone.
pub struct ViscosityStage {
    /// The laws and their inputs.
    pub law_inputs: LawInputs,
    /// True if there is an eddy viscosity to add.
    pub eddies: bool,
}

impl Declares for ViscosityStage {
    fn name(&self) -> String {
        "rheology".into()
    }
    fn access(&self) -> Access {
        let access = self.law_inputs.access().writes(fields::VISCOSITY);
        match self.eddies {
            true => access.here(fields::EDDY_VISCOSITY),
            false => access,
        }
    }
}

impl<const D: usize> Stage<World<D>> for ViscosityStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let blend = self.law_inputs.blend;
        let mut viscosity = world.free.take(fields::VISCOSITY)?;
        self.law_inputs
            .each(world, &mut viscosity, |law, inputs, _, out| {
                match law.elastic().filter(|elastic| elastic.blends()) {
                    Some(elastic) if blend == Blend::Forces => {
                        elastic.liquid_viscosity(inputs, out)
                    }
                    _ => law.viscosity(inputs, out),
                }
            })?;
        if self.eddies {
            let eddies = world.free.get(fields::EDDY_VISCOSITY)?;
            viscosity.iter_mut().zip(eddies).for_each(|(v, e)| *v += e);
        }
        Ok(world.free.put(fields::VISCOSITY, viscosity)?)
    }
}
