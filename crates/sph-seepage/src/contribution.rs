//! Seepage in a scene.

use sph_contribution::{Contribution, Hook, Offer, Refusal, Setting};
use sph_core::fields;

use crate::{Seepage, SeepagePhases};

/// The seepage that a scene names.
pub struct Seeping<const D: usize>(pub Box<dyn Seepage<D>>);

const KIND: &str = "seepage";

impl<const D: usize> Contribution<D> for Seeping<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if setting.density.value != fields::DENSITY_CONSTANT {
            return Err(Refusal::of(
                KIND,
                "",
                "particles give and take mass, which is known with densities that are sums over positions: take \
                 [formulation.hu-adams]",
            ));
        }
        let phases = SeepagePhases {
            names: setting.phases,
            laws: setting.laws,
            density: setting.density.value,
        };
        let flow = self.0.flow(&phases);
        let flow = flow.map_err(|(key, why)| Refusal::of(KIND, key, why))?;
        offer.hooks.push(Hook::Plain(flow));
        Ok(())
    }
}
