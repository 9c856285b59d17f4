//! The pressure between the grains in a scene.

use sph_contribution::{Contribution, Offer, Refusal, Setting};

use crate::{EffectivePressure, PorePressure, Rheologies};

/// The effective pressure that a scene names.
pub struct GrainPressure<const D: usize> {
    /// What gives it.
    pub effective: Box<dyn EffectivePressure<D>>,
    /// The laws, in the order of the phase numbers.
    pub laws: Rheologies,
}

impl<const D: usize> Contribution<D> for GrainPressure<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let both = self.laws.iter().zip(setting.laws.iter());
        let soils = both.map(|(law, state)| {
            let soil = law.needs().pressure;
            soil.then(|| state.reference().density)
        });
        offer.stages.push(self.effective.stage(soils.collect()));
        offer.stage(PorePressure);
        let why = "the pressure between the grains could not be solved for: raise \
                   `effective-pressure.laplace.iterations`, or loosen its `tolerance`";
        let remedy = ("effective pressure", why.into());
        offer.remedies_of_failures.push(remedy);
        Ok(())
    }
}
