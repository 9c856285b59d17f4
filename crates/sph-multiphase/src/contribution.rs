//! Formulations and interfaces in a scene.

use sph_contribution::{
    Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, contributes, light_body_limit,
    sound_limit,
};

use crate::{
    Acting, Dilatation, Formulation, FormulationEntry, PressureEntry, PressureScheme,
    PressureStage, interface_limit,
};

/// The formulation that a scene names, with its equations of state.
struct Compressible<const D: usize> {
    /// The formulation: density and its pressure.
    formulation: Box<dyn Formulation<D>>,
    /// The pressure scheme; without one the equations of state give the pressure.
    scheme: Option<Box<dyn PressureScheme<D>>>,
    /// True if the scene chooses a finder of free surfaces.
    surfaces: bool,
}

contributes!("formulation", Compressible);

impl<const D: usize> FromPlugins<D> for Compressible<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let scheme = plugins.one::<D, PressureEntry>();
        Some(Compressible {
            formulation: plugins.one::<D, FormulationEntry>()?,
            scheme,
            surfaces: plugins.names("surface"),
        })
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
                offer.limiter(sound_limit(setting.courant, setting.laws.clone()));
                if let Some(limit) = interface_limit(setting.laws) {
                    offer.limiter(limit);
                }
                if !setting.world.walls.bodies.is_empty() {
                    offer.limiter(light_body_limit(setting.laws));
                }
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
