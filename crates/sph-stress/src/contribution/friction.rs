//! Friction of fluids in a scene, explicit or solved for.

use std::rc::Rc;

use sph_contribution::{Contribution, Limiter, Refusal, Setting, Stages, StepWork};
use sph_core::AnyField;
use sph_implicit::{LinearSolver, TimeScheme};
use sph_neighbours::Terms;
use sph_viscosity::{ImplicitViscosity, Lagged, ViscousLimit};

use crate::{Blend, Blended, Materials, StrainRate, ViscosityStage};

/// The viscous force of the laws.
pub struct Friction<const D: usize> {
    materials: Rc<Materials<D>>,
    implicit: Option<(Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>)>,
    /// Whether a solve may hold soils beyond their strength.
    may_hold: bool,
}

impl<const D: usize> Friction<D> {
    /// Of laws, with what solves for it, if something does; `may_hold` lets a solve hold soils beyond their strength.
    pub fn new(
        materials: Rc<Materials<D>>,
        implicit: Option<(Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>)>,
        may_hold: bool,
    ) -> Self {
        Friction {
            materials,
            implicit,
            may_hold,
        }
    }

    fn solved_for(&self) -> bool {
        self.materials.implicit_share.is_some()
    }

    fn viscosity_stage(&self) -> ViscosityStage {
        ViscosityStage {
            felt: self.materials.felt(),
            eddies: self.materials.eddies.is_some(),
        }
    }

    /// η/ρ₀, the largest that the laws allow, m²/s.
    fn largest(&self, setting: &Setting<'_, D>) -> f64 {
        let both = setting.laws.iter().zip(self.materials.laws.iter());
        let kinematic =
            both.map(|(state, law)| law.largest_viscosity() / state.reference().density);
        match self.materials.eddies {
            Some(_) => f64::INFINITY,
            None => kinematic.fold(0.0, f64::max),
        }
    }
}

impl<const D: usize> Contribution<D> for Friction<D> {
    fn check(&self, _: &Setting<'_, D>) -> Result<(), Refusal> {
        match self.materials.inviscid() && self.solved_for() {
            false => Ok(()),
            true => Err(Refusal::of(
                "implicit-viscosity",
                "",
                "no phase of this scene has a viscosity, so that there is nothing to solve for: take this table out, or \
                 give a phase a viscosity",
            )),
        }
    }
    fn stages(&self, _: &Setting<'_, D>) -> Stages<D> {
        match self.materials.inviscid() {
            true => Vec::new(),
            false => self.materials.operator.stages(self.materials.viscosity()),
        }
    }
    fn terms(&self, _: &Setting<'_, D>) -> Terms<D> {
        let materials = &self.materials;
        if materials.inviscid() || self.solved_for() {
            return Vec::new();
        }
        let term = materials.operator.term(materials.viscosity());
        match materials.felt().blend {
            Blend::Forces => vec![Box::new(Blended::friction(term, &materials.laws))],
            Blend::Stresses => vec![term],
        }
    }
    fn stages_for(&self, setting: &Setting<'_, D>, _: &[AnyField]) -> Stages<D> {
        let eddies = self.materials.eddies.iter();
        let mut stages: Stages<D> = eddies.map(|e| e.stage_in(setting)).collect();
        stages.push(Box::new(self.viscosity_stage()));
        stages
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        let largest = self.largest(setting);
        if largest <= 0.0 || self.solved_for() {
            return Vec::new();
        }
        let mut laws = self.materials.laws.iter();
        vec![Box::new(ViscousLimit {
            coefficient: setting.viscous / self.materials.operator.stiffness(),
            largest,
            constant: self.materials.eddies.is_none()
                && laws.all(|l| l.uniform_viscosity().is_some()),
        })]
    }
    fn works(
        &mut self,
        _: &Setting<'_, D>,
        read: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        let Some(solve) = self.implicit.take() else {
            return Ok(Vec::new());
        };
        let materials = &self.materials;
        let (operator, viscosity) = (&materials.operator, materials.viscosity());
        let mut stages: Stages<D> = Vec::new();
        let gradient = materials.gradient_stage(read);
        if let Some(gradient) = gradient.filter(|_| materials.felt().strain_rate()) {
            stages.push(Box::new(gradient));
            stages.push(Box::new(StrainRate));
            stages.push(Box::new(self.viscosity_stage()));
        }
        let lagged = Lagged {
            stages,
            stiffens: materials.ahead(),
            may_hold: self.may_hold,
        };
        let friction = (operator.coupling(viscosity), operator.term(viscosity));
        Ok(vec![Box::new(ImplicitViscosity::new(
            friction, solve, lagged,
        ))])
    }
    fn remedies_of_failures(&self) -> Vec<(&'static str, String)> {
        let why = "the friction could not be solved for: name a solver with more iterations \
                   (`[linear-solver.conjugate-gradient] iterations`), or `[linear-solver.cholesky]`, which needs none";
        vec![(ImplicitViscosity::<D>::NAME, why.into())]
    }
    fn remedy(&self, _: &str) -> Option<String> {
        Some(match self.materials.implicit_share {
            None => "treat the viscosity implicitly (`[implicit-viscosity.backward-euler]`), or lower it".into(),
            Some(_) => "it is solved for, so look at the rheology: a smaller largest viscosity, or another [linear-solver]"
                .into(),
        })
    }
}
