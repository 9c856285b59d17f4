//! Friction of fluids in a scene, explicit or solved for, and of soils on walls.

use sph_contribution::{
    Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, Stages, contributes,
};
use sph_core::{AnyField, Stage};
use sph_multiphase::linear::{ImplicitViscosityEntry, LinearSolver, LinearSolverEntry, TimeScheme};
use sph_multiphase::viscosity::{ImplicitViscosity, PicardUpdates, viscous_limit};
use sph_neighbours::World;
use sph_rheology::Rheology;

use super::Materials;
use crate::stress::law_stages::viscosities;
use crate::stress::strain_rate::strain_rates;
use crate::stress::{Blend, Blended, CoulombFriction};

struct Friction<const D: usize> {
    materials: Materials<D>,
    implicit: Option<(Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>)>,
}

#[cfg(not(test))]
contributes!("viscous-operator", Friction);

impl<const D: usize> FromPlugins<D> for Friction<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let scheme = plugins.one::<D, ImplicitViscosityEntry>();
        let implicit = scheme.and_then(|s| Some((s, plugins.one::<D, LinearSolverEntry>()?)));
        Some(Friction {
            materials: Materials::from_plugins(plugins)?,
            implicit,
        })
    }
}

impl<const D: usize> Friction<D> {
    fn solved_for(&self) -> bool {
        self.materials.implicit_share.is_some()
    }

    fn viscosity_stage(&self) -> impl Stage<World<D>> + use<D> {
        viscosities(self.materials.law_inputs(), self.materials.eddies)
    }

    /// η/ρ₀, the largest that the laws allow, m²/s.
    fn largest(&self, setting: &Setting<'_, D>) -> f64 {
        let both = setting.laws.iter().zip(self.materials.laws.iter());
        let kinematic =
            both.map(|(state, law)| law.largest_viscosity() / state.reference().density);
        match self.materials.eddies {
            true => f64::INFINITY,
            false => kinematic.fold(0.0, f64::max),
        }
    }
}

impl<const D: usize> Contribution<D> for Friction<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let (materials, viscosity) = (&self.materials, self.materials.viscosity());
        if materials.inviscid() && self.solved_for() {
            let why = "no phase of this scene has a viscosity, so that there is nothing to solve for: take this table out, \
                       or give a phase a viscosity";
            return Err(Refusal::at_key("implicit-viscosity", "", why));
        }
        if !materials.inviscid() {
            offer.stages = materials.operator.stages(viscosity);
        }
        let why = "the friction could not be solved for: name a solver with more iterations \
                   (`[linear-solver.conjugate-gradient] iterations`), or `[linear-solver.cholesky]`, which needs none";
        (offer.remedies_of_failures).push((ImplicitViscosity::<D>::NAME, why.into()));
        if self.solved_for() {
            let remedy = "it is solved for, so look at the rheology: a smaller largest viscosity, or another \
                          [linear-solver]";
            offer.remedy = Some(remedy.into());
            return Ok(());
        }
        let remedy =
            "treat the viscosity implicitly (`[implicit-viscosity.backward-euler]`), or lower it";
        offer.remedy = Some(remedy.into());
        if !materials.inviscid() {
            let term = materials.operator.term(viscosity);
            match materials.law_inputs().blend {
                Blend::Forces => offer.term(Blended::friction(term, &materials.laws)),
                Blend::Stresses => offer.terms.push(term),
            }
        }
        let largest = self.largest(setting);
        if largest > 0.0 {
            let mut laws = materials.laws.iter();
            let coefficient = setting.viscous / materials.operator.stiffness();
            let constant = !materials.eddies && laws.all(|l| l.uniform_viscosity().is_some());
            offer.limiter(viscous_limit(coefficient, largest, constant));
        }
        Ok(())
    }
    fn offer_to_readers(
        &mut self,
        setting: &Setting<'_, D>,
        read: &[AnyField],
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        offer.stage(self.viscosity_stage());
        let Some(solve) = self.implicit.take() else {
            return Ok(());
        };
        let materials = &self.materials;
        let (operator, viscosity) = (&materials.operator, materials.viscosity());
        let mut stages: Stages<D> = Vec::new();
        let gradient = materials.gradient_stage(read);
        if let Some(gradient) = gradient.filter(|_| materials.law_inputs().strain_rate()) {
            stages.push(Box::new(gradient));
            stages.push(Box::new(strain_rates()));
            stages.push(Box::new(self.viscosity_stage()));
        }
        let lagged = PicardUpdates {
            stages,
            stiffens: materials.ahead(),
            may_hold: setting.delayed_yield,
        };
        let coupling = operator.coupling(viscosity);
        offer.outside.push(operator.term(viscosity).into());
        offer.solves.push(ImplicitViscosity::<D>::NAME.into());
        offer.hook(ImplicitViscosity::new(coupling, solve, lagged));
        Ok(())
    }
}

struct WallFriction<const D: usize>(Materials<D>);

#[cfg(not(test))]
contributes!("walls", WallFriction);

impl<const D: usize> FromPlugins<D> for WallFriction<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        Some(WallFriction(Materials::from_plugins(plugins)?))
    }
}

impl<const D: usize> Contribution<D> for WallFriction<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if setting.world.walls.elements.coulomb.is_empty() {
            return Ok(());
        }
        let slips = |l: &dyn Rheology| l.elastic().is_none() && l.uniform_viscosity().is_some();
        offer.hook(CoulombFriction {
            rubs: self.0.laws.iter().map(|l| !slips(&**l)).collect(),
            pressure: self.0.grain_pressure(),
            pressed: Vec::new(),
        });
        Ok(())
    }
}
