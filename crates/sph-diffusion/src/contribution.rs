//! Smoothers and shifting in a scene.

use sph_contribution::{Contribution, Offer, OwnColumn, Refusal, Setting};
use sph_core::fields;

use crate::diffusion_limit::fastest;
use crate::{MeanAcceleration, ShiftedFlow, Shifting, Smoother};

/// The smoother that a scene names.
pub struct Smoothed<const D: usize>(pub Box<dyn Smoother<D>>);

impl<const D: usize> Contribution<D> for Smoothed<D> {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let column = |_| OwnColumn::zero(fields::MEAN_ACCELERATION.any());
        self.0.accelerated().map(column).into_iter().collect()
    }
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stages = self.0.stages(setting.laws);
        offer.terms.push(self.0.term(setting.laws));
        offer.changes_density = true;
        if !(setting.pressure_ahead && self.0.of_pressures()) {
            offer.limiters.extend(self.0.limiter(setting.laws));
        }
        if let Some(of) = self.0.accelerated() {
            offer.hook(MeanAcceleration::new(of, fastest(setting.laws)));
        }
        offer.remedy = Some(format!("lower the strength in {}", offer.path));
        Ok(())
    }
}

/// The shifting that a scene names.
pub struct Shifted<const D: usize>(pub Box<dyn Shifting<D>>);

impl<const D: usize> Contribution<D> for Shifted<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.goals.push(fields::SHIFT_VELOCITY.any());
        offer.stages = self.0.stages(setting.laws);
        let flow = ShiftedFlow {
            summed: setting.summed,
        };
        offer.terms.extend(self.0.term(flow));
        offer.changes_density = !offer.terms.is_empty();
        offer.remedy = Some(format!("weaken {}", offer.path));
        Ok(())
    }
}
