//! Seepage in a scene.

use sph_contribution::{Contribution, Refusal, Setting, StepWork};
use sph_core::{AnyField, fields};

use crate::{Seepage, SeepagePhases};

/// The seepage that a scene names.
pub struct Seeping<const D: usize>(pub Box<dyn Seepage<D>>);

const KIND: &str = "seepage";

impl<const D: usize> Contribution<D> for Seeping<D> {
    fn check(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        match setting.density.value == fields::DENSITY_CONSTANT {
            true => Ok(()),
            false => Err(Refusal::of(
                KIND,
                "",
                "particles give and take mass, which is known with densities that are sums over positions: take \
                 [formulation.hu-adams]",
            )),
        }
    }
    fn works(
        &mut self,
        setting: &Setting<'_, D>,
        _: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        let phases = SeepagePhases {
            names: setting.phases,
            laws: setting.laws,
            density: setting.density.value,
        };
        let flow = self.0.flow(&phases);
        flow.map(|flow| vec![flow])
            .map_err(|(key, why)| Refusal::of(KIND, key, why))
    }
}
