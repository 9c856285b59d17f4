//! The k–ε closure as a plugin.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_contribution::{Contribution, Limiter, OwnColumn, Refusal, Setting, StepWork};
use sph_core::{Access, AnyField, Declares, Evolved, Stage, StepError, fields, register};
use sph_neighbours::{Lanewise, Terms, World};
use sph_viscosity::{EddyViscosity, EddyViscosityEntry};

use super::diffusion::{Diffusion, DiffusionLimit};
use super::model::KEpsilonModel;
use super::start::ChannelStart;
use super::work::Sources;
use crate::closures::behind::{Behind, KIND};
use crate::columns::{DISSIPATION, DISSIPATION_RATE, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE};

/// η_t = ρ C_μ k²/ε, with
///
/// dk/dt = div((ν + ν_t/σ_k) grad k) + P − ε,
/// dε/dt = div((ν + ν_t/σ_ε) grad ε) + (C_ε1 P − C_ε2 ε) ε/k:
///
/// the standard model, with P = min(√C_μ, C_μ k S/ε) k S. Diffusion is explicit, and what is dissipated is that of the end
/// of the step, so that both are positive by construction; nothing is clipped. Within a spacing of walls with a wall
/// function k = u*²/√C_μ and ε = u*³/(κz). Nothing passes through other walls and the surface.
///
/// The constants imply κ = √((C_ε2 − C_ε1) σ_ε √C_μ) = 0.433 in a logarithmic layer.
///
/// Sources: Launder and Spalding 1974; Issa 2004, Eq. 5.28–5.33 and 5.61–5.66; Guimet and Laurence 2002 (production).
///
/// ```toml
/// [eddy-viscosity.k-epsilon]
/// energy = "1e-3 m²/s²"
/// dissipation = "1e-4 m²/s³"
/// ```
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct KEpsilon {
    /// k at the start, everywhere; with `dissipation`.
    #[schemars(extend("unit" = "m²/s²", "exclusiveMinimum" = 0.0))]
    pub energy: Option<f64>,
    /// ε at the start, everywhere; with `energy`.
    #[schemars(extend("unit" = "m²/s³", "exclusiveMinimum" = 0.0))]
    pub dissipation: Option<f64>,
    /// The start of an open channel, in the place of `energy` and `dissipation`.
    pub channel: Option<ChannelStart>,
    /// κ of the wall values.
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0, "source" = "Issa 2004, Eq. 6.22"))]
    pub karman: f64,
}

impl Default for KEpsilon {
    fn default() -> Self {
        KEpsilon {
            energy: None,
            dissipation: None,
            channel: None,
            karman: 0.41,
        }
    }
}

impl KEpsilon {
    /// k and ε at the start, at a height; none if the scene does not say.
    fn start(&self, height: f64) -> Option<[f64; 2]> {
        let model = KEpsilonModel::default();
        match (self.channel, self.energy, self.dissipation) {
            (Some(channel), None, None) => Some(channel.at(&model, self.karman, height)),
            (None, Some(k), Some(e)) => Some([k, e]),
            _ => None,
        }
    }
}

/// [`fields::EDDY_VISCOSITY`] of k and ε.
struct EddyStage;

impl Declares for EddyStage {
    fn name(&self) -> String {
        "k-epsilon".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::DENSITY)
            .here(TURBULENT_ENERGY)
            .here(DISSIPATION)
            .writes(fields::EDDY_VISCOSITY)
    }
}

impl<const D: usize> Stage<World<D>> for EddyStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut eddies = world.free.take(fields::EDDY_VISCOSITY)?;
        let model = KEpsilonModel::default();
        let density = world.free.get(fields::DENSITY)?;
        let energy = world.free.get(TURBULENT_ENERGY)?;
        let dissipation = world.free.get(DISSIPATION)?;
        for (i, eddy) in eddies.iter_mut().enumerate() {
            *eddy = density[i] * model.eddy_viscosity(energy[i], dissipation[i]);
        }
        Ok(world.free.put(fields::EDDY_VISCOSITY, eddies)?)
    }
}

impl<const D: usize> EddyViscosity<D> for KEpsilon {
    fn stage(&self) -> Box<dyn Stage<World<D>>> {
        Box::new(EddyStage)
    }
    fn contribution(&self) -> Option<Box<dyn Contribution<D>>> {
        Some(Box::new(*self))
    }
}

impl<const D: usize> Contribution<D> for KEpsilon {
    fn check(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let behind = Behind {
            name: "k-epsilon",
            ..Behind::default()
        };
        behind.check(setting)?;
        if self.start(0.0).is_none() {
            return Err(Refusal::of(
                KIND,
                "",
                "k and ε at the start are missing: either both `energy` and `dissipation` were expected, or `channel` alone",
            ));
        }
        match setting.world.walls.elements.grip.iter().any(|g| *g > 0.0) {
            false => Ok(()),
            true => Err(Refusal::of(
                KIND,
                "",
                "k and ε have no values at walls that rub without a wall function: write `condition = \"free-slip\"` there \
                 and name the walls in `[wall-function.log-law]`",
            )),
        }
    }
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let own = *self;
        let at = move |k: usize, height: f64| own.start(height).map_or(0.0, |start| start[k]);
        vec![
            OwnColumn::scalar(TURBULENT_ENERGY, move |b| at(0, b.position[D - 1])),
            OwnColumn::scalar(DISSIPATION, move |b| at(1, b.position[D - 1])),
        ]
    }
    fn transported(&self) -> Vec<Evolved> {
        vec![
            Evolved {
                value: TURBULENT_ENERGY,
                rate: TURBULENT_ENERGY_RATE,
            },
            Evolved {
                value: DISSIPATION,
                rate: DISSIPATION_RATE,
            },
        ]
    }
    fn terms(&self, _: &Setting<'_, D>) -> Terms<D> {
        let model = KEpsilonModel::default();
        vec![
            Box::new(Lanewise(Diffusion::<0>(model.sigma_k))),
            Box::new(Lanewise(Diffusion::<1>(model.sigma_epsilon))),
        ]
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        vec![Box::new(DiffusionLimit(setting.viscous))]
    }
    fn works(
        &mut self,
        setting: &Setting<'_, D>,
        _: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        let viscosity = setting.viscosities.iter().flatten().next();
        Ok(vec![Box::new(Sources {
            model: KEpsilonModel::default(),
            karman: self.karman,
            viscosity: viscosity.copied().unwrap_or_default(),
        })])
    }
    fn remedy(&self, _: &str) -> Option<String> {
        Some("look at k and ε at the start: the eddy viscosity is 0.09 k²/ε".into())
    }
}

register!(
    EddyViscosityEntry [2, 3],
    KEpsilon,
    "k-epsilon",
    "two transported scalars: the energy of eddies and its dissipation",
    "Launder and Spalding 1974; Issa 2004, Eq. 5.28–5.33"
);
