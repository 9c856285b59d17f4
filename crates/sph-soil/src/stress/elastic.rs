//! Motion of the remembered quantities of an elastic material.

use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, Declares, Pool, Stage, StepError, Symmetric, Vect, fields};
use sph_neighbours::World;
use sph_rheology::{Elastic, Gradient, jaumann};

use crate::stress::law_stages::yielding;
use crate::stress::strain_rate::{in_space, set_strain_rates};
use crate::stress::{GradientStage, LawInputs};

/// Advances [`ELASTIC_STRESS`](fields::ELASTIC_STRESS) while positions drift, with the velocities
/// of the drift: together with the kick this is symplectic, and undamped elastic waves keep their
/// energy.
///
/// Where the force is made of displacements, [`ELASTIC_DISPLACEMENT`](fields::ELASTIC_DISPLACEMENT) and
/// [`STRESS_ROTATION`](fields::STRESS_ROTATION) go with it, and the stress is not cut.
///
/// Leaves velocity gradients and strain rates of the drift for the next evaluation.
pub struct ElasticMotion<const D: usize> {
    /// The gradient of the velocity.
    pub gradient: GradientStage<D>,
    /// The laws and their inputs.
    pub law_inputs: LawInputs,
    /// True if the force is made of displacements.
    pub displaced: bool,
    /// Gradients of a run of particles, kept for their memory.
    pub gradients: Pool<Vec<Gradient>>,
}

impl<const D: usize> ElasticMotion<D> {
    /// Advances all stresses over `dt` at the present places and velocities.
    pub(crate) fn apply(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        self.gradient.run(world)?;
        self.advance(world, dt)
    }

    /// The same between two steps of a force: copies of others' particles follow their owners at once.
    pub(crate) fn apply_within(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        world.run(&mut self.gradient)?;
        self.advance(world, dt)
    }

    fn advance(&self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        if world.free.has(fields::STRAIN_RATE.name) {
            set_strain_rates(world)?;
        }
        if self.displaced {
            return self.displace(world, dt);
        }
        let mut stress = world.free.take(fields::ELASTIC_STRESS)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        self.law_inputs
            .each(world, &mut stress, |law, inputs, run, out| {
                let Some(elastic) = law.elastic() else {
                    return out.fill(Symmetric::ZERO);
                };
                let mut gradients = self.gradients.acquire();
                gradients.clear();
                gradients.extend(gradient[run].iter().map(in_space));
                elastic.advance(inputs, &gradients, dt, out);
            })?;
        Ok(world.free.put(fields::ELASTIC_STRESS, stress)?)
    }

    /// Advances displacements, turns and stresses together.
    fn displace(&self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let stress = world.free.take(fields::ELASTIC_STRESS)?;
        let turn = world.free.take(fields::STRESS_ROTATION)?;
        let displacement = world.free.take(fields::ELASTIC_DISPLACEMENT)?;
        let all = stress.into_iter().zip(turn).zip(displacement);
        let memory = all.map(|((stress, turn), displacement)| Memory {
            stress,
            turn,
            displacement,
        });
        let mut memory: Vec<Memory<D>> = memory.collect();
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        self.law_inputs
            .each(world, &mut memory, |law, inputs, run, out| {
                let Some(elastic) = law.elastic() else {
                    return;
                };
                let stress: Vec<Symmetric> = out.iter().map(|m| m.stress).collect();
                let yielding = yielding(elastic, inputs, &stress);
                let moved = gradient[run.clone()].iter().zip(&velocity[run]);
                out.iter_mut().zip(yielding).zip(moved).for_each(
                    |((memory, yielding), (gradient, velocity))| match yielding.forgets {
                        true => *memory = Memory::none(),
                        false => memory.advance(elastic, &in_space(gradient), velocity, dt),
                    },
                );
            })?;
        let free = &mut world.free;
        let stress = memory.iter().map(|m| m.stress).collect();
        let turn = memory.iter().map(|m| m.turn).collect();
        let displacement = memory.iter().map(|m| m.displacement).collect();
        free.put(fields::ELASTIC_STRESS, stress)?;
        free.put(fields::STRESS_ROTATION, turn)?;
        Ok(free.put(fields::ELASTIC_DISPLACEMENT, displacement)?)
    }
}

impl<const D: usize> StepHook<D> for ElasticMotion<D> {
    fn name(&self) -> String {
        "elastic motion".into()
    }
    fn access(&self) -> Access {
        let access = self.gradient.access().and(self.law_inputs.access());
        let access = access
            .remembers((fields::ELASTIC_STRESS, fields::VELOCITY_GRADIENT))
            .writes(fields::STRAIN_RATE);
        match self.displaced {
            false => access,
            true => access
                .here(fields::VELOCITY)
                .remembers((fields::ELASTIC_DISPLACEMENT, fields::STRESS_ROTATION)),
        }
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::BeforeDrift]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        self.apply(moment.world, moment.dt)
    }
}

#[derive(Clone, Copy)]
struct Memory<const D: usize> {
    /// τ, not cut.
    stress: Symmetric,
    /// J.
    turn: Symmetric,
    /// X.
    displacement: Vect<D>,
}

impl<const D: usize> Memory<D> {
    fn none() -> Self {
        Memory {
            stress: Symmetric::ZERO,
            turn: Symmetric::ZERO,
            displacement: Vect::zeros(),
        }
    }

    /// J takes what the stress gains besides 2𝒢D′Δt.
    fn advance(&mut self, elastic: &dyn Elastic, gradient: &Gradient, velocity: &Vect<D>, dt: f64) {
        let modulus = elastic.shear_modulus();
        let before = self.stress;
        self.stress = jaumann::advanced(&before, gradient, modulus, dt);
        let strained = Symmetric::part_of(*gradient).deviator() * (2.0 * modulus * dt);
        self.turn = self.turn + (self.stress - before - strained);
        self.displacement += velocity * dt;
    }
}
