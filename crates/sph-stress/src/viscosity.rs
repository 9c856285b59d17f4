//! The viscosity column.

use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

use crate::{Blend, Felt};

/// η of every particle by the law of its phase; where phases differ or a law depends on the flow. Where forces are
/// blended it is that of the liquid alone.
pub struct ViscosityStage(pub Felt);

impl Declares for ViscosityStage {
    fn name(&self) -> String {
        "rheology".into()
    }
    fn access(&self) -> Access {
        self.0.access().writes(fields::VISCOSITY)
    }
}

impl<const D: usize> Stage<World<D>> for ViscosityStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let blend = self.0.blend;
        let mut viscosity = world.free.take(fields::VISCOSITY)?;
        self.0.each(world, &mut viscosity, |law, inputs, _, out| {
            match law.elastic().filter(|elastic| elastic.blends()) {
                Some(elastic) if blend == Blend::Forces => elastic.liquid_viscosity(inputs, out),
                _ => law.viscosity(inputs, out),
            }
        })?;
        Ok(world.free.put(fields::VISCOSITY, viscosity)?)
    }
}
