//! The k–ε closure as a plugin.

use rayon::prelude::*;
use sph_contribution::{Birth, Contribution, Offer, OwnColumn, Refusal, Setting};
use sph_core::{Access, Evolved, Field, StepError, Tensor, fields, parameters, plugin};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::World;
use sph_soil::stress::StressDivergence;

use super::diffusion::{Diffusion, diffusion_limit};
use super::earsm::extra_stress;
use super::work::Sources;
use crate::bed::surface_share;
use crate::closures::{ClosureCommon, KIND, acts_on, rubs, viscosities};
use crate::{
    AlgebraicStress, AtWall, DISSIPATION, DISSIPATION_RATE, EDDY_STRESS, KEpsilonModel,
    RealisableModel, RoughBed, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE, Variant,
};

/// η_t = ρ C_μ k²/ε, with
///
/// dk/dt = div((ν + ν_t/σ_k) grad k) + P − ε,
/// dε/dt = div((ν + ν_t/σ_ε) grad ε) + (C_ε1 P − C_ε2 ε) ε/k:
///
/// the standard model, with P = min(√C_μ, C_μ k S/ε) k S. Diffusion is explicit, and dissipation is that of the end of
/// the step, so that both are positive by construction; nothing is clipped. Within a spacing of walls with a wall
/// function k = u*²/√C_μ and ε = u*³/(κz), or that of `at_wall`. Nothing passes through other walls and the surface.
/// `variant` takes other equations, "realisable" those of [`RealisableModel`], "explicit-algebraic" C_μ of
/// [`AlgebraicStress`].
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
#[plugin(EddyViscosityEntry [2, 3], "k-epsilon", "two transported scalars: the energy of eddies and its dissipation",
    source: "Launder and Spalding 1974; Issa 2004, Eq. 5.28–5.33", cfg(not(test)))]
pub struct KEpsilon {
    /// k at the start, everywhere; with `dissipation`.
    #[parameter(default, unit: "m²/s²", above: 0.0)]
    pub energy: Option<f64>,
    /// ε at the start, everywhere; with `energy`.
    #[parameter(default, unit: "m²/s³", above: 0.0)]
    pub dissipation: Option<f64>,
    /// The start of an open channel, in the place of `energy` and `dissipation`.
    #[parameter(default)]
    pub channel: Option<ChannelStart>,
    /// κ of the wall values.
    #[parameter(default: 0.41, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.22")]
    pub karman: f64,
    /// Equations of k and ε.
    #[parameter(default)]
    pub variant: Variant,
    /// Values of k and ε next to walls with a wall function.
    #[parameter(default,
        source: "Issa 2004, Eq. 5.33; Launder and Spalding 1974; Ferrand et al. 2013; the flux of ε is ours")]
    pub at_wall: AtWall,
    /// Names of the phases that it acts on: fluids with one viscosity. To be left out where there is one.
    #[parameter(default)]
    pub phases: Vec<String>,
    /// The bed of another phase as a rough wall.
    #[parameter(default)]
    pub bed: Option<RoughBed>,
    /// True if production is damped where a free surface cuts the support: P (2C − 1), C = Σ V w/γ.
    #[parameter(default)]
    pub damped_at_surfaces: bool,
    /// Depth H of a channel at whose surface ε = k^{3/2}/(0.18 H), in the particles whose support the surface cuts by a quarter
    /// and more; nothing passes through the surface if left out.
    #[parameter(default, unit: "m", above: 0.0, source: "Celik and Rodi 1984")]
    pub surface_depth: Option<f64>,
}

impl KEpsilon {
    /// k and ε at the start, at a height; none if the scene has none.
    fn start(&self, height: f64) -> Option<[f64; 2]> {
        match (self.channel, self.energy, self.dissipation) {
            (Some(channel), None, None) => Some(channel.at(self.karman, height)),
            (None, Some(k), Some(e)) => Some([k, e]),
            _ => None,
        }
    }
}

impl Variant {
    /// The column of velocity gradients, if C_μ depends on them.
    fn gradients(self) -> Option<Field<Tensor>> {
        (self != Variant::Standard).then_some(fields::VELOCITY_GRADIENT)
    }

    fn set<const D: usize>(self, world: &World<D>, eddies: &mut [f64]) -> Result<(), StepError> {
        let (density, energy) = world.free.all((fields::DENSITY, TURBULENT_ENERGY))?;
        let dissipation = world.free.get(DISSIPATION)?;
        let gradients = world.free.all(self.gradients())?.unwrap_or_default();
        let c_mu = |i: usize, time: f64| match self {
            Variant::Standard => KEpsilonModel::C_MU,
            Variant::Realisable => RealisableModel::c_mu(&gradients[i], time),
            Variant::ExplicitAlgebraic => AlgebraicStress::anisotropy(&gradients[i], time).c_mu(),
        };
        let all = eddies.par_iter_mut().enumerate();
        all.with_min_len(512).for_each(|(i, eddy)| {
            let time = energy[i] / dissipation[i];
            *eddy = density[i] * c_mu(i, time) * energy[i] * time;
        });
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for KEpsilon {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let at = |own: KEpsilon, k: usize| {
            move |birth: &Birth<'_, D>| {
                let start = own.start(birth.position[D - 1]);
                let start = start.filter(|_| acts_on(&own.phases, birth.phase));
                start.map_or(0.0, |start| start[k])
            }
        };
        vec![
            OwnColumn::scalar(TURBULENT_ENERGY, at(self.clone(), 0)).positive(),
            OwnColumn::scalar(DISSIPATION, at(self.clone(), 1)).positive(),
        ]
    }
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let common = ClosureCommon {
            name: "k-epsilon",
            phases: &self.phases,
            bed: self.bed.as_ref(),
            ..ClosureCommon::default()
        };
        let variant = self.variant;
        let access = Access::none()
            .here((fields::DENSITY, TURBULENT_ENERGY, DISSIPATION))
            .here(variant.gradients());
        let set = move |world: &World<D>, eddies: &mut [f64]| variant.set(world, eddies);
        common.offer_to(setting, ("k-epsilon", access), set, offer)?;
        if self.start(0.0).is_none() {
            let why = "k and ε at the start are missing: either both `energy` and `dissipation` were expected, or \
                       `channel` alone";
            return Err(Refusal::at_key(KIND, "", why));
        }
        if rubs(setting) && setting.phases.len() == 1 {
            let why = "k and ε have no values at walls that rub without a wall function: write `condition = \
                       \"free-slip\"` there and name the walls in `[wall-function.log-law]`";
            return Err(Refusal::at_key(KIND, "", why));
        }
        let both = [
            (TURBULENT_ENERGY, TURBULENT_ENERGY_RATE),
            (DISSIPATION, DISSIPATION_RATE),
        ];
        let both = both.map(|(value, rate)| Evolved { value, rate });
        offer.transported.extend(both);
        if self.damped_at_surfaces || self.surface_depth.is_some() {
            offer.stage(surface_share());
        }
        let through = self.at_wall == AtWall::BothFluxes;
        offer.term(Diffusion {
            sigma: self.variant.sigmas(),
            wall_flux: through.then_some(KEpsilonModel::C_MU),
        });
        if self.variant == Variant::ExplicitAlgebraic {
            offer.stage(extra_stress());
            offer.term(StressDivergence {
                name: "stress of eddies",
                stress: EDDY_STRESS,
            });
        }
        offer.limiter(diffusion_limit(setting.viscous));
        offer.hook(Sources {
            variant: self.variant,
            at_wall: self.at_wall,
            karman: self.karman,
            viscosities: viscosities(&self.phases, setting),
            damped: self.damped_at_surfaces,
            surface_depth: self.surface_depth,
        });
        let remedy = "look at k and ε at the start: the eddy viscosity is 0.09 k²/ε";
        offer.remedy = Some(remedy.into());
        Ok(())
    }
}

/// k = u*²/√C_μ (1 − z/H) and ε = u*³/(κz) (1 − z/H): where production balances dissipation in a wide open channel.
///
/// Source: Issa 2004, Eq. 5.33 with 6.24.
#[parameters]
pub struct ChannelStart {
    /// u*.
    #[parameter(unit: "m/s", above: 0.0)]
    pub friction_velocity: f64,
    /// Depth H.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Height of the bed.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

/// Nearer to bed and surface than this share of the depth, k and ε are those there, so that both are positive.
const LEAST_SHARE: f64 = 1e-3;

impl ChannelStart {
    /// k and ε at a height.
    pub fn at(&self, karman: f64, height: f64) -> [f64; 2] {
        let share = (height - self.bottom) / self.depth;
        let share = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        let at_wall = KEpsilonModel::at_wall(self.friction_velocity, share * self.depth, karman);
        at_wall.map(|value| value * (1.0 - share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §3.7: ν_t = κu*z(1 − z/H).
    #[test]
    fn its_eddies_are_those_of_the_channel() {
        let start = ChannelStart {
            friction_velocity: 0.05,
            depth: 0.4,
            bottom: -1.0,
        };
        for z in [0.01, 0.2, 0.39] {
            let [k, e] = start.at(0.41, z - 1.0);
            let exact = 0.41 * 0.05 * z * (1.0 - z / 0.4);
            assert!((KEpsilonModel::eddy_viscosity(k, e) / exact - 1.0).abs() < 1e-12);
        }
        let [k, e] = start.at(0.41, 5.0);
        assert!(k > 0.0 && e > 0.0);
    }
}
