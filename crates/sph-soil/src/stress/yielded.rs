//! Yielding of the materials of a scene, as columns.

use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;
use sph_rheology::Yielding;

use crate::stress::LawInputs;

/// [`FRICTION_SHARE`](fields::FRICTION_SHARE), [`SOLID_FRACTION`](fields::SOLID_FRACTION) and
/// [`YIELD_FACTOR`](fields::YIELD_FACTOR) from the remembered stress; 1 in phases without an elastic part.
pub struct Yielded {
    law_inputs: LawInputs,
    /// Kept for its memory.
    yielding: Vec<Yielding>,
}

impl Yielded {
    /// That of some laws.
    pub fn new(law_inputs: LawInputs) -> Self {
        let yielding = Vec::new();
        Yielded {
            law_inputs,
            yielding,
        }
    }
}

impl Declares for Yielded {
    fn name(&self) -> String {
        "yielding".into()
    }
    fn access(&self) -> Access {
        self.law_inputs
            .access()
            .here(fields::ELASTIC_STRESS)
            .writes(fields::FRICTION_SHARE)
            .writes(fields::SOLID_FRACTION)
            .writes(fields::YIELD_FACTOR)
    }
}

impl<const D: usize> Stage<World<D>> for Yielded {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let Yielded {
            law_inputs,
            yielding,
        } = self;
        yielding.clear();
        yielding.resize(world.free.len(), Yielding::NONE);
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        law_inputs.each(world, yielding, |law, inputs, run, out| {
            if let Some(elastic) = law.elastic() {
                elastic.yielding(inputs, &stress[run], out);
            }
        })?;
        type Share = fn(&Yielding) -> f64;
        let columns: [(_, Share); 3] = [
            (fields::FRICTION_SHARE, |y| y.friction),
            (fields::SOLID_FRACTION, |y| y.solid),
            (fields::YIELD_FACTOR, |y| y.held),
        ];
        for (field, share) in columns {
            let column = world.free.get_mut(field)?;
            let all = column.iter_mut().zip(&*yielding);
            all.for_each(|(value, yielding)| *value = share(yielding));
        }
        Ok(())
    }
}
