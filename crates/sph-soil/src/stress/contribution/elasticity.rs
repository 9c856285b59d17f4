//! The elastic force in a scene: which one, with what it cannot be combined, and the step that elastic waves allow.

use sph_contribution::{
    Contribution, FromPlugins, Limiter, Offer, OutsideForce, Plugins, Refusal, Setting, bound,
    contributes,
};
use sph_core::{AnyField, Pool};
use sph_neighbours::{Interaction, World};
use sph_rheology::Rheology;

use super::Materials;
use crate::stress::adjoint::{AdjointDivergence, stress_correction};
use crate::stress::law_stages::{carried_stress, implicit_elastic_stress, yield_shares};
use crate::stress::{
    Blend, Blended, ElasticForce, ElasticMotion, ElasticSubSteps, HourglassDamping,
};

struct Elasticity<const D: usize>(Materials<D>);

#[cfg(not(test))]
contributes!("elastic-force", Elasticity);

impl<const D: usize> FromPlugins<D> for Elasticity<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let materials = Materials::from_plugins(plugins)?;
        materials.force.is_some().then_some(Elasticity(materials))
    }
}

const KIND: &str = "elastic-force";

impl<const D: usize> Elasticity<D> {
    fn term(&self, force: &dyn ElasticForce<D>) -> Box<dyn Interaction<D>> {
        let term: Box<dyn Interaction<D>> = match self.0.adjoint() {
            Some(_) => Box::new(AdjointDivergence),
            None => force.term(&self.0.law_inputs()),
        };
        match force.blend() {
            Blend::Forces => Box::new(Blended::solid(term)),
            Blend::Stresses => term,
        }
    }

    /// α√(𝒢ρ) by phase, Pa s/m.
    fn hourglass(&self, force: &dyn ElasticForce<D>, setting: &Setting<'_, D>) -> Vec<f64> {
        let both = setting.laws.iter().zip(self.0.laws.iter());
        let strength = both.map(|(law, rheology)| {
            let Some(elastic) = rheology.elastic() else {
                return 0.0;
            };
            let impedance = (elastic.shear_modulus() * law.reference().density).sqrt();
            force.hourglass(elastic.blends()) * impedance
        });
        strength.collect()
    }

    /// The largest √(c₀² + k𝒢/ρ₀) over the phases with an elastic part, m/s.
    fn wave_speed(&self, setting: &Setting<'_, D>) -> Option<f64> {
        let stiffness = self.0.force.as_ref()?.stiffness();
        let both = setting.laws.iter().zip(self.0.laws.iter());
        let speeds = both.filter_map(|(law, rheology)| {
            let reference = law.reference();
            let shear = rheology.elastic()?.shear_modulus() / reference.density;
            Some((reference.sound_speed.powi(2) + stiffness * shear).sqrt())
        });
        speeds.reduce(f64::max)
    }
}

impl<const D: usize> Contribution<D> for Elasticity<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let Some(force) = &self.0.force else {
            return Ok(());
        };
        self.check(&**force, setting)?;
        if !force.sub_steps() {
            offer.terms.push(self.term(&**force));
            if let Some(speed) = self.wave_speed(setting).filter(|_| !force.implicit()) {
                offer.limiter(wave_limit(setting.courant, speed, force.stiffness()));
            }
        }
        let strength = self.hourglass(&**force, setting);
        if strength.iter().any(|s| *s > 0.0) {
            offer.term(HourglassDamping { strength });
        }
        offer.stored.push(Box::new(self.0.law_inputs()));
        offer.remedy = Some(format!(
            "lower Young's modulus of the soil, give it `damping`, or change {}",
            offer.path
        ));
        Ok(())
    }
    fn offer_to_readers(
        &mut self,
        setting: &Setting<'_, D>,
        read: &[AnyField],
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        let Some(force) = &self.0.force else {
            return Ok(());
        };
        let law_inputs = self.0.law_inputs();
        match self.0.ahead() {
            true => offer.stage(implicit_elastic_stress(law_inputs.clone())),
            false => offer.stage(carried_stress(law_inputs.clone())),
        }
        offer.stage(yield_shares(law_inputs.clone()));
        if let Some(gradient) = self.0.adjoint() {
            offer.stage(stress_correction(gradient.clone()));
        }
        let Some(gradient) = self.0.gradient_stage(read) else {
            return Ok(());
        };
        offer.fresh_state = true;
        let motion = ElasticMotion {
            gradient,
            law_inputs: law_inputs.clone(),
            displaced: force.displaced(),
            gradients: Pool::default(),
        };
        match self.wave_speed(setting).filter(|_| force.sub_steps()) {
            None => offer.hook(motion),
            Some(speed) => {
                // About half of the 2/max k̂ at which nested differences k̂ on a lattice become unstable (1.73 to 1.76 h for
                // `wendland-c2` at h = 2δr).
                let longest = 0.8 * setting.world.kernel.smoothing_length() / speed;
                let term: OutsideForce<D> = self.term(&**force).into();
                let sub_steps = ElasticSubSteps {
                    term: term.clone(),
                    motion,
                    carried: Box::new(carried_stress(law_inputs)),
                    longest,
                    touched: Vec::new(),
                    acceleration: Vec::new(),
                    mean: Vec::new(),
                    behind: 0.0,
                };
                offer.outside.push(term);
                let bound = format!(
                    "elastic sub-steps: {longest:.2e} s at most, as many within a step as it takes"
                );
                offer.inner_bounds.push(bound);
                offer.hook(sub_steps);
            }
        }
        Ok(())
    }
}

impl<const D: usize> Elasticity<D> {
    /// Refuses combinations in which a force is not known.
    fn check(&self, force: &dyn ElasticForce<D>, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        if force.implicit() {
            self.refuse_implicit()?;
        }
        if force.blend() == Blend::Forces {
            self.refuse_blend()?;
        }
        self.refuse_adjoint(force, setting)?;
        if let (true, Some(name)) = (force.displaced(), setting.moving_wall) {
            let why = format!(
                "the displacement of a wall is not remembered, and the wall `{name}` moves: take \
                 [elastic-force.divergence]"
            );
            return Err(Refusal::at_key(KIND, "", why));
        }
        match force.sub_steps() {
            true => self.refuse_sub_steps(force, setting.kicks_once),
            false => Ok(()),
        }
    }

    fn refuse_implicit(&self) -> Result<(), Refusal> {
        let why = match self.0.implicit_share {
            None => {
                "what the step adds to the stress is solved for with the viscosity: add \
                 [implicit-viscosity.backward-euler], or take `implicit` out"
            }
            Some(share) if share < 1.0 => {
                "the stress of the end of the step is all of the force: take \
                 [implicit-viscosity.backward-euler], or take `implicit` out"
            }
            Some(_) if !self.0.operator.leaves_rotations() => {
                "what the step adds to the stress must not brake rotations, as this viscous operator does at free \
                 surfaces: take [viscous-operator.monaghan-gingold], or take `implicit` out"
            }
            Some(_) if self.0.adjoint().is_some() => {
                "it was not shown to be stable with the `adjoint` force: take one of the two out"
            }
            Some(_) => return Ok(()),
        };
        Err(Refusal::at_key(KIND, "implicit", why))
    }

    fn refuse_blend(&self) -> Result<(), Refusal> {
        let blends = |law: &dyn Rheology| law.elastic().is_some_and(|e| e.blends());
        let damps = |law: &dyn Rheology| law.elastic().is_some_and(|e| e.damps());
        let mut laws = self.0.laws.iter();
        let why = if !laws.any(|law| blends(&**law)) {
            "no law of this scene is liquid where it yields: take `blend` out"
        } else if self.0.implicit_share.is_some() {
            "a share of a force is not known as a symmetric system: take [implicit-viscosity] out, or blend \
             \"stresses\""
        } else if self.0.laws.iter().any(|law| damps(&**law)) {
            "where forces are blended the solid has no viscosity, and the `damping` of the law would do nothing: let it \
             be 0, or blend \"stresses\""
        } else {
            return Ok(());
        };
        Err(Refusal::at_key(KIND, "blend", why))
    }

    fn refuse_adjoint(
        &self,
        force: &dyn ElasticForce<D>,
        setting: &Setting<'_, D>,
    ) -> Result<(), Refusal> {
        if self.0.adjoint().is_none() {
            return Ok(());
        }
        let (points, elements) = (&setting.world.walls.points, &setting.world.walls.elements);
        let slips = |factors: &[f64]| factors.iter().any(|factor| *factor < 1.0);
        let why = if force.displaced() {
            "the force is made of displacements and not of a stress: take `adjoint` out, or take \
             [elastic-force.divergence]"
        } else if slips(&points.friction_factor) || slips(&elements.friction_factor) {
            "the adjoint force is not known at walls that slip: take `adjoint` out, or let all walls be \"no-slip\""
        } else {
            return Ok(());
        };
        Err(Refusal::at_key("velocity-gradient", "adjoint", why))
    }

    fn refuse_sub_steps(
        &self,
        force: &dyn ElasticForce<D>,
        kicks_once: bool,
    ) -> Result<(), Refusal> {
        let why = if force.implicit() {
            "stresses of the end of the step have no need of sub-steps: take one of `implicit` and `sub_steps` out"
        } else if force.blend() == Blend::Forces {
            "where forces are blended the share of the others is not known within the step: take `sub_steps` out, or \
             blend \"stresses\""
        } else if self.0.adjoint().is_some() {
            "the `adjoint` force was not tried in sub-steps: take one of the two out"
        } else if !kicks_once {
            "sub-steps go between one kick and one drift over all of the step: take [integrator.symplectic-euler], or \
             take `sub_steps` out"
        } else {
            return Ok(());
        };
        Err(Refusal::at_key(KIND, "sub_steps", why))
    }
}

/// Δt ≤ C h / √(c₀² + k𝒢/ρ₀): pressure waves in an elastic material, k being the `stiffness` of its
/// [force](crate::stress::ElasticForce::stiffness), 4/3 for a divergence, and `speed`, m/s, the largest root over the
/// phases. Ours; the thesis has none.
fn wave_limit<const D: usize>(courant: f64, speed: f64, stiffness: f64) -> impl Limiter<D> {
    let formula = format!("elastic wave: dt <= {courant} h / sqrt(c² + {stiffness:.2} G/ρ)");
    let remedy = "`elastic-force.divergence.sub_steps = true` with [integrator.symplectic-euler] takes this bound away: \
                  the elastic force then has steps of its own within that of the flow";
    let longest = move |world: &World<D>| Ok(courant * world.kernel.smoothing_length() / speed);
    bound("elastic wave", formula, Some(remedy), longest)
}
