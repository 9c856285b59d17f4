//! The share of the strain rate that is plastic.

use sph_core::{Access, StepError, fields};
use sph_neighbours::World;
use sph_rheology::Yielding;

use crate::stress::LawInputs;

/// Plastic shares of soils with an elastic part: strain that the skeleton takes back moves no grain past another.
///
/// The share is 1 where the remembered stress reaches the yield stress within 1 %, and that of the liquid elsewhere.
pub(crate) struct PlasticShare(pub LawInputs);

/// Share of the yield stress from which a material yields.
const YIELDS: f64 = 0.99;

impl PlasticShare {
    /// The columns that it reads.
    pub fn access(&self) -> Access {
        self.0.access().here(fields::ELASTIC_STRESS)
    }

    /// Plastic shares of all particles.
    pub fn shares<const D: usize>(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let stress: Vec<_> = stress.iter().map(|t| *t * (1.0 / YIELDS)).collect();
        let mut yielding = vec![Yielding::NONE; stress.len()];
        self.0.each(world, &mut yielding, |law, inputs, run, out| {
            if let Some(elastic) = law.elastic() {
                elastic.yielding(inputs, &stress[run], out);
            }
        })?;
        let share = |y: &Yielding| match y.held < 1.0 {
            true => 1.0,
            false => y.friction,
        };
        Ok(yielding.iter().map(share).collect())
    }
}
