//! The pressure between the grains in a scene.

use sph_contribution::{Contribution, Setting, Stages};

use crate::{EffectivePressure, PorePressure, Rheologies};

/// The effective pressure that a scene names.
pub struct GrainPressure<const D: usize> {
    /// What gives it.
    pub effective: Box<dyn EffectivePressure<D>>,
    /// The laws, in the order of the phase numbers.
    pub laws: Rheologies,
}

impl<const D: usize> Contribution<D> for GrainPressure<D> {
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        let both = self.laws.iter().zip(setting.laws.iter());
        let soils = both.map(|(law, state)| {
            let soil = law.needs().pressure;
            soil.then(|| state.reference().density)
        });
        let stage = self.effective.stage(soils.collect());
        vec![stage, Box::new(PorePressure)]
    }
    fn remedies_of_failures(&self) -> Vec<(&'static str, String)> {
        let why = "the pressure between the grains could not be solved for: raise \
                   `effective-pressure.laplace.iterations`, or loosen its `tolerance`";
        vec![("effective pressure", why.into())]
    }
}
