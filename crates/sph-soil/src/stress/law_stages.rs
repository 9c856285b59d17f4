//! Viscosities, stresses and yielding by the laws of a scene, as columns.

use sph_core::{Access, Declares, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;
use sph_rheology::{Elastic, Inputs, Yielding};

use crate::stress::strain_rate::in_space;
use crate::stress::{Blend, LawInputs};

/// η of every particle by the law of its phase; where phases differ or a law depends on the flow. Where forces are
/// blended it is that of the liquid alone.
pub struct ViscosityStage {
    /// The laws and their inputs.
    pub law_inputs: LawInputs,
    /// True if there is an eddy viscosity to add.
    pub eddies: bool,
}

impl Declares for ViscosityStage {
    fn name(&self) -> String {
        "rheology".into()
    }
    fn access(&self) -> Access {
        let access = self.law_inputs.access().writes(fields::VISCOSITY);
        match self.eddies {
            true => access.here(fields::EDDY_VISCOSITY),
            false => access,
        }
    }
}

impl<const D: usize> Stage<World<D>> for ViscosityStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let blend = self.law_inputs.blend;
        let mut viscosity = world.free.take(fields::VISCOSITY)?;
        self.law_inputs
            .each(world, &mut viscosity, |law, inputs, _, out| {
                match law.elastic().filter(|elastic| elastic.blends()) {
                    Some(elastic) if blend == Blend::Forces => {
                        elastic.liquid_viscosity(inputs, out)
                    }
                    _ => law.viscosity(inputs, out),
                }
            })?;
        if self.eddies {
            let eddies = world.free.get(fields::EDDY_VISCOSITY)?;
            viscosity.iter_mut().zip(eddies).for_each(|(v, e)| *v += e);
        }
        Ok(world.free.put(fields::VISCOSITY, viscosity)?)
    }
}

/// [`CARRIED_STRESS`](fields::CARRIED_STRESS) from the remembered one; zero in phases without
/// an elastic part. Where forces are blended it is the whole stress of the solid, cut to the yield stress.
pub struct CarriedStress(pub LawInputs);

impl Declares for CarriedStress {
    fn name(&self) -> String {
        "carried stress".into()
    }
    fn access(&self) -> Access {
        self.0
            .access()
            .here(fields::ELASTIC_STRESS)
            .writes(fields::CARRIED_STRESS)
    }
}

impl<const D: usize> Stage<World<D>> for CarriedStress {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let blend = self.0.blend;
        let mut carried = world.free.take(fields::CARRIED_STRESS)?;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        self.0.each(world, &mut carried, |law, inputs, run, out| {
            match law.elastic() {
                Some(elastic) if blend == Blend::Forces => {
                    let stress = &stress[run];
                    let yielding = yielding(elastic, inputs, stress);
                    let all = out.iter_mut().zip(stress).zip(&yielding);
                    all.for_each(|((out, stress), yielding)| *out = *stress * yielding.held);
                }
                Some(elastic) => elastic.carried(inputs, &stress[run], out),
                None => out.fill(Symmetric::ZERO),
            }
        })?;
        Ok(world.free.put(fields::CARRIED_STRESS, carried)?)
    }
}

fn yielding(elastic: &dyn Elastic, inputs: &Inputs<'_>, stress: &[Symmetric]) -> Vec<Yielding> {
    let mut yielding = vec![Yielding::NONE; stress.len()];
    elastic.yielding(inputs, stress, &mut yielding);
    yielding
}

/// The stress at the end of the step in two parts: sτⁿ in [`CARRIED_STRESS`](fields::CARRIED_STRESS), and s𝒢 in
/// [`ELASTIC_STIFFNESS`](fields::ELASTIC_STIFFNESS) for what the step adds, s 2𝒢Δt D(uⁿ⁺¹), which is solved for with the viscosity.
///
/// s = (1 − ζ) min(1, τ_y/|τⁿ + 2𝒢Δt D|) is what yielding leaves, with strain rate and step of the step before, also where the
/// viscosity follows the velocity within the step. With a = 𝒢Δt²k²/ρ of the direct second differences and b of the nested first ones that
/// remember, a shear wave of wave number k is stable if b < 2a + 4: always, as nested differences are the softer ones; it loses the
/// share 1 − 1/√(1 + a) of its amplitude in a step. To compression the viscous operator gives 3𝒢 where 4/3 𝒢 are remembered: the
/// rest is a viscosity of the volume, 5/3 s𝒢Δt. Ours.
pub struct ImplicitElasticStress(pub LawInputs);

impl Declares for ImplicitElasticStress {
    fn name(&self) -> String {
        "carried stress, ahead".into()
    }
    fn access(&self) -> Access {
        self.0
            .access()
            .here((fields::ELASTIC_STRESS, fields::VELOCITY_GRADIENT))
            .writes((fields::CARRIED_STRESS, fields::ELASTIC_STIFFNESS))
    }
}

impl<const D: usize> Stage<World<D>> for ImplicitElasticStress {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let dt = world.dt;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        let mut stiffness = vec![0.0; stress.len()];
        let shares = |elastic: &dyn Elastic, inputs: &Inputs<'_>, run: std::ops::Range<usize>| {
            let twice = 2.0 * elastic.shear_modulus() * dt;
            let both = stress[run.clone()].iter().zip(&gradient[run]);
            let trial = both.map(|(stress, gradient)| {
                *stress + Symmetric::part_of(in_space(gradient)).deviator() * twice
            });
            let trial: Vec<Symmetric> = trial.collect();
            yielding(elastic, inputs, &trial)
        };
        self.0
            .each(world, &mut stiffness, |law, inputs, run, out| {
                if let Some(elastic) = law.elastic() {
                    let modulus = elastic.shear_modulus();
                    let all = out.iter_mut().zip(shares(elastic, inputs, run));
                    all.for_each(|(out, y)| *out = modulus * (y.solid * y.held));
                }
            })?;
        let mut carried = world.free.take(fields::CARRIED_STRESS)?;
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        self.0.each(world, &mut carried, |law, _, run, out| {
            let Some(elastic) = law.elastic() else {
                return out.fill(Symmetric::ZERO);
            };
            let modulus = elastic.shear_modulus();
            let all = stress[run.clone()].iter().zip(&stiffness[run]);
            let all = out.iter_mut().zip(all);
            all.for_each(|(out, (stress, stiff))| *out = *stress * (stiff / modulus));
        })?;
        world.free.put(fields::CARRIED_STRESS, carried)?;
        Ok(world.free.put(fields::ELASTIC_STIFFNESS, stiffness)?)
    }
}

/// [`FRICTION_SHARE`](fields::FRICTION_SHARE), [`SOLID_FRACTION`](fields::SOLID_FRACTION) and
/// [`YIELD_FACTOR`](fields::YIELD_FACTOR) from the remembered stress; 1 in phases without an elastic part.
pub struct Yielded {
    law_inputs: LawInputs,
    /// Kept for its memory.
    yielding: Vec<Yielding>,
}

impl Yielded {
    /// That of some laws.
    pub fn new(law_inputs: LawInputs) -> Self {
        let yielding = Vec::new();
        Yielded {
            law_inputs,
            yielding,
        }
    }
}

impl Declares for Yielded {
    fn name(&self) -> String {
        "yielding".into()
    }
    fn access(&self) -> Access {
        self.law_inputs
            .access()
            .here(fields::ELASTIC_STRESS)
            .writes((fields::FRICTION_SHARE, fields::SOLID_FRACTION))
            .writes(fields::YIELD_FACTOR)
    }
}

impl<const D: usize> Stage<World<D>> for Yielded {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let all = &mut self.yielding;
        self.law_inputs.yielding(world, stress, all)?;
        type Share = fn(&Yielding) -> f64;
        let columns: [(_, Share); 3] = [
            (fields::FRICTION_SHARE, |y| y.friction),
            (fields::SOLID_FRACTION, |y| y.solid),
            (fields::YIELD_FACTOR, |y| y.held),
        ];
        for (field, share) in columns {
            let column = world.free.get_mut(field)?;
            let all = column.iter_mut().zip(&self.yielding);
            all.for_each(|(value, yielding)| *value = share(yielding));
        }
        Ok(())
    }
}
