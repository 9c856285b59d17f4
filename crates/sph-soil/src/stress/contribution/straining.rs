//! Gradients of the velocity in a scene.

use sph_contribution::{Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, contributes};
use sph_core::{AnyField, fields};

use super::Materials;
use crate::stress::{StrainRate, StrainRateTerm};

/// Velocity gradients and strain rates, where a law or a stage needs them.
struct Straining<const D: usize>(Materials<D>);

#[cfg(not(test))]
contributes!("velocity-gradient", Straining);

impl<const D: usize> FromPlugins<D> for Straining<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let materials = Materials::from_plugins(plugins)?;
        materials.gradient.is_some().then_some(Straining(materials))
    }
}

impl<const D: usize> Contribution<D> for Straining<D> {
    fn offer(&mut self, _: &Setting<'_, D>, _: &mut Offer<D>) -> Result<(), Refusal> {
        Ok(())
    }
    fn offer_to_readers(
        &mut self,
        _: &Setting<'_, D>,
        read: &[AnyField],
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        // An elastic motion leaves the gradients of its drift.
        if let (Some(stage), None) = (self.0.gradient_stage(read), &self.0.force) {
            offer.stage(stage);
        }
        let Some(formula) = self.0.gradient.clone() else {
            return Ok(());
        };
        match self.0.strain_rides(read) {
            false => offer.stage(StrainRate),
            true => {
                let term = Box::new(StrainRateTerm { formula });
                offer.riding.push((fields::STRAIN_RATE.any(), term));
            }
        }
        Ok(())
    }
}
