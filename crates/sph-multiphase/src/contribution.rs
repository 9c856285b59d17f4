//! Formulations and interfaces in a scene.

use std::sync::Arc;

use sph_contribution::{Contribution, LightBodyLimit, Offer, Refusal, Setting, SoundLimit};
use sph_state::PressureStage;

use crate::{Acting, Dilatation, Formulation, InterfaceLimit, PressureScheme};

/// The formulation that a scene names, with its equations of state.
pub struct Compressible<const D: usize> {
    /// What density is.
    pub formulation: Arc<dyn Formulation<D>>,
    /// Which pressure acts; that of the equations of state if there is none.
    pub scheme: Option<Box<dyn PressureScheme<D>>>,
    /// Whether the scene names what free surfaces are.
    pub surfaces: bool,
}

impl<const D: usize> Compressible<D> {
    /// Bounds of sound.
    fn sound_limits(setting: &Setting<'_, D>, offer: &mut Offer<D>) {
        offer.limiter(SoundLimit {
            courant: setting.courant,
            laws: setting.laws.clone(),
        });
        if let Some(limit) = InterfaceLimit::of(setting.laws) {
            offer.limiter(limit);
        }
        if !setting.world.walls.bodies.is_empty() {
            let laws = setting.laws.clone();
            offer.limiter(LightBodyLimit { laws });
        }
    }
}

impl<const D: usize> Contribution<D> for Compressible<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.stages = self.formulation.stages();
        let state = PressureStage {
            laws: setting.laws.clone(),
        };
        match &self.scheme {
            None => {
                offer.stage(state);
                Self::sound_limits(setting, offer);
            }
            Some(scheme) => {
                offer.stages.push(scheme.stage(Acting {
                    state,
                    dilatation: self.formulation.dilatation(),
                    surfaces: self.surfaces,
                }));
                offer.limiters = scheme.limiters(setting);
            }
        }
        offer.terms.push(self.formulation.pressure_term());
        if let Some(compressed) = self.formulation.compressed() {
            offer.advanced.push(compressed.value);
            offer.hook(Dilatation::new(compressed, self.formulation.divergence()));
        }
        Ok(())
    }
}
